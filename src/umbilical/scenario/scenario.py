"""One scenario: everything a run depends on."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError, WithJsonSchema, model_validator

from umbilical.errors import ScenarioError
from umbilical.scenario.base import Record, fingerprint, measured, quantity
from umbilical.scenario.control import Control
from umbilical.scenario.document import freeze, override, read_document
from umbilical.scenario.environment import Environment, InitialShape, Straight
from umbilical.scenario.faults import Fault
from umbilical.scenario.hardware import Cable, Motor, Payload
from umbilical.scenario.inventory import inventory
from umbilical.scenario.problems import problems_of
from umbilical.scenario.rope import Rope
from umbilical.scenario.sensors import Sensors
from umbilical.scenario.text import to_toml
from umbilical.scenario.winch import Winch
from umbilical.tables import html_table

ELEMENTS = 64
TOLERANCE = 1e-3
_AUTO: Any = {"anyOf": [{"type": "integer", "minimum": 4, "maximum": 4096}, {"const": "auto"}]}


class Grid(Record):
    """The discretisation. Its order is fixed (5 in the element size, 3 in the step); its fineness is not.

    With ``elements = "auto"`` or a ``tolerance`` a run chooses elements and step itself
    (:mod:`umbilical.engine.resolution`); the number given is then where nothing is run, as for the checks.
    """

    elements: Annotated[int, WithJsonSchema(_AUTO)] = Field(
        default=ELEMENTS, ge=4, le=4096,
        description='elements along the cable, four intervals of nodes each; "auto" chooses by the tolerance',
    )  # fmt: skip
    tolerance: float | None = measured(
        "1", "relative error of the largest displacements of ROV and midpoint by which a run chooses elements and step",
        None, ge=1e-6, le=0.1, reason="below it the step's own round-off counts", fix="1e-3",
    )  # fmt: skip
    step: float = quantity(
        "plant_step", 1e-3, gt=0.0, le=1.0, reason="the plant divides a control period", fix="1e-3 s"
    )

    @model_validator(mode="before")
    @classmethod
    def _automatic(cls, data: Any) -> Any:
        if not isinstance(data, Mapping) or data.get("elements") != "auto":
            return data
        asked = data.get("tolerance")
        return {**data, "elements": ELEMENTS, "tolerance": TOLERANCE if asked is None else asked}


class Output(Record):
    """What is stored. It never changes what is simulated."""

    interval: float = quantity(
        "output_interval", 0.05, gt=0.0, reason="a multiple of the control period", fix="e.g. 0.05 s"
    )


class Scenario(Record):
    """Everything a run depends on, frozen. Two equal scenarios give the same bytes.

    >>> from umbilical.library import load
    >>> heavy = load("paper").replace({"cable.line_density": 3.0, "motors.2.thrust_coefficient": 1.0})
    >>> heavy.cable.line_density, heavy.hash == load("paper").hash
    (3.0, False)
    """

    schema_version: Literal[1] = Field(default=1, description="version of this format")
    name: str = Field(min_length=1, max_length=80, description="short name, also of the result file")
    description: str = Field(default="", description="what it shows, in a sentence")
    duration: float = quantity("duration", gt=0.0, le=1e6, reason="simulated time")
    seed: int = Field(default=0, ge=0, le=2**63 - 1, description="seed of the sensors' noise and drop-outs")
    model: Literal["string", "rope"] = Field(
        default="string", description="the cable: a string in one plane, or a rope in space (docs/rope.md)"
    )
    ideal_thruster: bool = Field(default=False, description="deliver the commanded thrust as it is, without motors")
    cable: Cable
    payload: Payload
    environment: Environment
    winch: Winch
    initial: InitialShape = Straight(shape="straight")
    rope: Rope | None = None
    motors: tuple[Motor, ...] = Field(default=(), max_length=1000)
    faults: tuple[Fault, ...] = ()
    sensors: Sensors = Sensors()
    control: Control
    grid: Grid = Grid()
    output: Output = Output()
    assumed: dict[str, str] = Field(
        default_factory=dict, description="dotted keys whose values are assumed, each with the reason"
    )

    def __hash__(self) -> int:
        return hash(self.hash)

    @property
    def hash(self) -> str:
        """SHA-256 of the canonical text, as hexadecimal digits: equal exactly when scenarios are."""
        return fingerprint(self.to_dict())

    def to_dict(self) -> dict[str, Any]:
        """Plain data (tables, lists, numbers, texts), defaults included."""
        return self.model_dump(mode="json", exclude_none=True)

    def to_toml(self) -> str:
        """Complete TOML text; every key with its unit, its meaning and whether it is assumed."""
        return to_toml(self)

    def _repr_html_(self) -> str:
        """Every value with its unit and meaning, as a table for notebooks."""
        cells = ((e.key, e.value[:60], e.unit, e.meaning) for e in inventory(self, self.assumed))
        head = f"<summary><b>{escape(self.name)}</b>: {escape(self.description)}</summary>"
        return f"<details>{head}{html_table(cells)}</details>"

    def replace(self, overrides: Mapping[str, Any]) -> Scenario:
        """The same scenario with some values changed.

        Args:
            overrides: values by dotted keys; lists are numbered from 1, None takes a key away.

        Raises:
            ScenarioError: with every problem of the fields.
        """
        return validate(override(self.to_dict(), overrides, self.name), self.name)


def parse_document(text: str, origin: str = "scenario") -> Scenario:
    """Scenario of a complete TOML text, one without ``extends``.

    Args:
        text: TOML.
        origin: what to call the text in errors, e.g. a file name.

    Raises:
        FileError: the text is not TOML; the message names line and column.
        ScenarioError: it is, but not of a scenario; every problem is listed.

    >>> from umbilical.library import load
    >>> parse_document(load("paper").to_toml()) == load("paper")
    True
    """
    return validate(read_document(text, origin), origin)


def validate(data: Mapping[str, Any], origin: str = "scenario") -> Scenario:
    """Scenario of plain data; fields are checked one by one, not yet against each other.

    Raises:
        ScenarioError: with every problem.
    """
    try:
        return Scenario.model_validate(freeze(data))
    except ValidationError as error:
        raise ScenarioError(problems_of(error, Scenario), origin) from error
