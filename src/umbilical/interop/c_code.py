"""The controller of a scenario as C99: two files without heap or library, and what proves them on their target."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from importlib import resources
from itertools import chain
from pathlib import Path

import numpy as np

import umbilical
from umbilical import files
from umbilical.control.allocation.adaptive import initial_kappa
from umbilical.control.cascade import CascadeSettings, MotorMemory, OuterMemory, make_settings, to_readings
from umbilical.control.contract import MotorDecision, MotorReadings, OuterDecision, TipReadings, WinchReadings
from umbilical.errors import Problem, ScenarioError, expect
from umbilical.frames import Frame
from umbilical.interop.c_known import check_known
from umbilical.interop.c_types import c_literal, frame_fields, frame_structs, initialiser, value_structs
from umbilical.interop.c_vectors import UPDATES, Vector, vectors
from umbilical.library import admit
from umbilical.scenario.scenario import Scenario

HOLD = 0.1
"""How long a command outlives its last valid reading, s. Assumed: a tenth of a second, which no source gives."""
_PREFIX = "umb_"
_MOST_HELD = 2**31 - 2


def to_c(
    scenario: Scenario, folder: str | os.PathLike[str], *, prefix: str = _PREFIX, hold: float | None = None,
    force: bool = False,
) -> list[Path]:  # fmt: skip
    """Write the controller of a scenario as C99, with a self-test and a text on its use.

    Driven by the same readings it gives the bits of :class:`umbilical.control.cascade.Cascade`.

    Args:
        scenario: whose ``control`` section is written, with what it believes of ROV and motors.
        folder: where the five files go; made if it is not there.
        prefix: what every name in C begins with, for several controllers in one program.
        hold: how long the last command is held without a valid reading before all commands are 0, s; if left out
            :data:`HOLD`, which is assumed.
        force: replace existing files.

    Returns:
        Header, source, self-test, its vectors, and a text.

    Raises:
        ScenarioError: the scenario was refused, has no law, or asks for what the C controller does not have.
        OutputError: a file cannot be written.

    >>> import tempfile, umbilical
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [path.name for path in to_c(umbilical.load("crosscheck-pd"), folder)][:2]
    ['umbilical_controller.h', 'umbilical_controller.c']
    """
    expect(scenario, "Scenario", "load")
    texts = c_files(scenario, prefix=prefix, hold=hold)
    target = Path(folder)
    files.make_folder(target)
    for name in texts:
        files.check_free(target / name, force=force)
    return [files.write(target / name, text.encode("utf-8"), force=force) for name, text in texts.items()]


def c_files(scenario: Scenario, *, prefix: str = _PREFIX, hold: float | None = None) -> dict[str, str]:
    """The texts that :func:`to_c` writes, by the names of their files."""
    admit(scenario)
    check_known(scenario)
    _check_options(scenario, prefix, HOLD if hold is None else hold)
    settings = make_settings(scenario)
    values = _words(scenario, settings, hold)
    source = template("controller.c")
    used = set(re.findall(r"(?:\.|->)(\w+)", source))
    values |= _structs(scenario, settings, used) | _vectors(list(vectors(scenario)), used)
    texts = {"umbilical_controller.h": template("controller.h"), "umbilical_controller.c": source}
    texts |= {name: template(name) for name in ("selftest.c", "test_vectors.h", "README.txt")}
    return {name: _renamed(fill_template(text, values), prefix) for name, text in texts.items()}


def template(name: str) -> str:
    """A text of this folder's templates."""
    return (resources.files("umbilical.interop") / "templates" / name).read_text(encoding="utf-8")


def fill_template(text: str, values: Mapping[str, str]) -> str:
    """A template with every ``@NAME@`` replaced."""
    return re.sub(r"@([A-Z_]+)@", lambda found: values[found[1]], text)


def _renamed(text: str, prefix: str) -> str:
    """A text with another prefix, in small and in capital letters."""
    return re.sub(r"\bUMB_", prefix.upper(), re.sub(rf"\b{_PREFIX}", prefix, text))


def head(scenario: Scenario) -> str:
    """What scenario and which versions a file was made from, as lines of a comment."""
    versions = f"umbilical {umbilical.__version__}, numpy {np.__version__}"
    lines = [f"scenario  {comment(scenario.name)}", f"hash      {scenario.hash}", f"made by   {versions}"]
    return "".join(f" * {line}\n" for line in lines)


def comment(text: str) -> str:
    """A text that cannot end a comment."""
    return re.sub(r"[^\w .,()+-]", "_", text, flags=re.ASCII)


def held_updates(scenario: Scenario, hold: float) -> int:
    """Whole control periods in ``hold``, s."""
    return int(hold / scenario.control.period * (1.0 + 1e-12))


def _check_options(scenario: Scenario, prefix: str, hold: float) -> None:
    problems = []
    if not re.fullmatch(r"[a-z][a-z0-9_]{0,30}", prefix):
        bound, reason = "small letters, digits and _, a letter first", "every name in C begins with it"
        problems.append(Problem("prefix", repr(prefix), bound, reason, "e.g. umb_"))
    most = _MOST_HELD * scenario.control.period
    if not 0.0 <= hold <= most:
        bound, reason = f"0 to {most:g} s", "updates without a reading are counted, in 32 bits"
        problems.append(Problem("hold", f"{hold:g} s", bound, reason, f"e.g. {HOLD:g} s"))
    if problems:
        raise ScenarioError(problems, "C code")


def _words(scenario: Scenario, settings: CascadeSettings, hold: float | None) -> dict[str, str]:
    """What the templates say of a scenario."""
    period, motors, wanted = scenario.control.period, len(scenario.motors), HOLD if hold is None else hold
    held = held_updates(scenario, wanted)
    outer = f", outer law every {settings.outer_every} updates" if settings.outer_every > 1 else ""
    law = f"{scenario.control.law.kind} law every {period:g} s{outer}, {scenario.control.allocation.method} allocation"
    origin = "assumed; give the one of your vehicle with --hold" if hold is None else "chosen when the file was written"
    ideal = settings.outer.observers.ideal_rates
    return {
        "HEAD": head(scenario), "HASH": scenario.hash, "MOTORS": str(motors), "ROOM": str(max(1, motors)),
        "PERIOD": c_literal(period), "PERIOD_WORDS": f"{period:g}", "UPDATES": str(UPDATES),
        "HOLD": str(held), "HOLD_WORDS": f"{held * period:g} s",
        "HOLD_ORIGIN": f"UMB_HOLD = {held} updates is {origin}.",
        "IDEAL_WORDS": "" if ideal else " /* tip_velocity and tip_slope_rate are not used by this one */",
        "SUMMARY": f"{comment(scenario.name)}, {scenario.hash}\n{law}, {motors} motor{'s' * (motors != 1)}.",
        "OUTPUT": "state.decision." + ("motors[i].motor_voltage" if settings.motors.driven else "outer.thrust_command"),
    }  # fmt: skip


def _structs(scenario: Scenario, settings: CascadeSettings, used: set[str]) -> dict[str, str]:
    """Types and constants, with the names of the controller's frames."""
    kappa = initial_kappa(scenario.control.allocation, len(scenario.motors))
    room = max(1, len(scenario.motors)) + 1
    first = initialiser(np.append(kappa, np.zeros(room - kappa.size)), used)
    constants = (
        f"static const umb_cascade_settings SETTINGS = {initialiser(settings, used)};\n",
        f"static const double INITIAL_KAPPA[{room}] = {first};\n",
    )
    return {
        "READINGS": _frames(used, TipReadings, WinchReadings, MotorReadings),
        "DECISION": _frames(used, OuterDecision, MotorDecision),
        "MEMORY": _frames(used, OuterMemory, MotorMemory),
        "SETTINGS": "\n".join([*value_structs(settings, used), *constants]),
    }


def _frames(used: set[str], *frames: type[Frame]) -> str:
    known: set[str] = set()
    return "\n".join(chain.from_iterable(frame_structs(frame, used, known) for frame in frames))


def _vectors(updates: Sequence[Vector], used: set[str]) -> dict[str, str]:
    """Test vectors as rows of numbers in braces, in the order of the structs."""
    readings = [to_readings(update.measurement) for update in updates]
    room = max(1, updates[0].motors.size)
    names = [f"{name} of motors[{i}]" for i in range(room) for name in frame_fields(MotorDecision, used)]

    seen = [
        ", ".join(["{1", *parts, f"{{{_rows(used, r.motors, MotorReadings)}}}}}"])
        for r in readings
        for parts in [(_rows(used, r.tip, TipReadings), _rows(used, r.winch, WinchReadings))]
    ]
    decided = [
        f"{{{_rows(used, u.outer, OuterDecision)}, {{{_rows(used, u.motors, MotorDecision)}}}}}" for u in updates
    ]
    return {
        "NAMES": ", ".join(f'"{name}"' for name in [*frame_fields(OuterDecision, used), *names]),
        "SAMPLES": ",\n".join(seen),
        "DECIDED": ",\n".join(decided),
        "KAPPAS": ",\n".join(_row(np.append(u.kappa, np.zeros(room + 1 - u.kappa.size))) for u in updates),
    }


def _rows(used: set[str], records: Frame, frame: type[Frame]) -> str:
    """Records in braces; one of zeros where there is none."""
    columns = [np.nan_to_num(records[name]) for name in frame_fields(frame, used)]
    return ", ".join(_row(entry) for entry in zip(*columns, strict=True)) or _row([0.0] * len(columns))


def _row(numbers: Iterable[float]) -> str:
    return "{" + ", ".join(map(c_literal, numbers)) + "}"
