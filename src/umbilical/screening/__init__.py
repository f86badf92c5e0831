"""In which sea can we work? Answers from the frequency domain, without integration in time.

The cable is an elastic bar in line with its own tension, the body hangs at its end in still water, and the sheave
heaves with the vessel. Drag on the body is linearised for the sea at hand.
"""

from umbilical.relations.axial import HeaveTransfer, axial_period, heave_transfer
from umbilical.screening.load import load_operation, operation_names
from umbilical.screening.lower import Lowering, lower
from umbilical.screening.operate import Operability, operate
from umbilical.screening.operation import Operation
from umbilical.screening.response import Response, respond
from umbilical.screening.seas import Seas, read_seas
from umbilical.screening.weather import Weather, weather

__all__ = [
    "HeaveTransfer", "Lowering", "Operability", "Operation", "Response", "Seas", "Weather", "axial_period",
    "heave_transfer", "load_operation", "lower", "operate", "operation_names", "read_seas", "respond", "weather",
]  # fmt: skip
