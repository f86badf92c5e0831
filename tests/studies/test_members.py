"""What the arms of a member share, and what they do not."""

from concurrent.futures import ThreadPoolExecutor

from umbilical import load
from umbilical.engine.simulate import measure


def test_arms_share_what_acts_from_outside_only_where_it_is_the_same() -> None:
    """Runs of one thread, one after the other, give what each gives in a thread of its own."""
    short = load("paper", {"duration": 1.0, "grid.elements": 8})
    other_law = short.replace({"control.law.damping_gain": 30.0})
    other_load = short.replace({"environment.payload_force": [{"kind": "constant", "value": 900.0}]})
    faulty = short.replace({"faults": [{"kind": "partial", "motor": 1, "start": 0.5, "effectiveness": 0.3}]})
    runs = [short, other_law, other_load, faulty, short]
    together = [measure(each).metrics for each in runs]
    alone = [ThreadPoolExecutor(1).submit(measure, each).result().metrics for each in runs]
    assert together == alone
    assert len({str(found) for found in together}) == 4
