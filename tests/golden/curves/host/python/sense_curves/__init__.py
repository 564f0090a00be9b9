"""The boards of a design and their messages. Generated: changes are lost when it is generated again.

    with Rover.open() as board:
        for message in board:
            print(message)
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Tuple

from ._sensedsl.board import STATUS, Board, boards_of
from ._sensedsl.link import DeviceError
from ._sensedsl.session import OtherFirmware
from ._sensedsl.values import Facts, Message, Scaling, of_raw, of_shown, to_pandas
from ._sensedsl.wire import Health, Item, Schema, Stamp

__all__ = [
    "Rover",
    "Ranger",
    "Line",
    "Bumper",
    "Wheels",
    "Bent",
    "Acceleration",
    "Rate",
    "Position",
    "Escs",
    "Lamps",
    "Winch",
    "Speed",
    "Board", "DeviceError", "Health", "Message", "OtherFirmware", "STATUS", "Stamp", "boards_of", "to_pandas",
]

DESIGN = "curves"
"""The design that this package was generated for."""


@dataclass(frozen=True)
class Ranger(Message):
    "The sensor Ranger: a GP2Y0A21 behind the bumper; `value` in cm, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(1, "Ranger", True, "uint16", None),
        scaling=Scaling(0.0008056640625, 0.0, ((0.4, 80.0), (0.5, 60.0), (0.75, 40.0), (1.3, 20.0), (2.3, 10.0), (3.1, 6.0),)),
        unit="cm",
        min=8.0,
        max=70.0,
        cycle_ms=1000,
    )

    value: float
    raw: int


@dataclass(frozen=True)
class Line(Message):
    "The sensor Line; `value` in percent, `raw` as uint16[8]."

    FACTS: ClassVar[Facts] = Facts(
        Item(10, "Line", True, "uint16", 8),
        scaling=Scaling(1.0, 0.0, ((200.0, 0.0), (3800.0, 100.0),)),
        unit="percent",
        min=1.0,
        max=None,
        cycle_ms=1000,
    )

    value: Tuple[float, ...]
    raw: Tuple[int, ...]


@dataclass(frozen=True)
class Bumper(Message):
    "The sensor Bumper; `value`, `raw` as bool[3]."

    FACTS: ClassVar[Facts] = Facts(
        Item(12, "Bumper", True, "bool", 3),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=1000,
    )

    value: Tuple[bool, ...]
    raw: Tuple[bool, ...]


@dataclass(frozen=True)
class Wheels(Message):
    "The sensor Wheels; `value`, `raw` as int32[2]."

    FACTS: ClassVar[Facts] = Facts(
        Item(13, "Wheels", True, "int32", 2),
        scaling=Scaling(0.25, -90.0, ()),
        unit=None,
        min=None,
        max=None,
        cycle_ms=None,
    )

    value: Tuple[float, ...]
    raw: Tuple[int, ...]


@dataclass(frozen=True)
class Bent(Message):
    "The sensor Bent; `value`, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(14, "Bent", True, "uint16", None),
        scaling=Scaling(1.0, 0.0, ((80.0, 8.0), (250.0, 3.0),)),
        unit=None,
        min=None,
        max=None,
        cycle_ms=1000,
    )

    value: float
    raw: int


@dataclass(frozen=True)
class Acceleration(Message):
    "The sensor Acceleration; `value` in g, `raw` as int16[3]."

    FACTS: ClassVar[Facts] = Facts(
        Item(30, "Acceleration", True, "int16", 3),
        scaling=Scaling(6.103515625e-5, 0.0, ()),
        unit="g",
        min=None,
        max=None,
        cycle_ms=10,
    )

    value: Tuple[float, ...]
    raw: Tuple[int, ...]


@dataclass(frozen=True)
class Rate(Message):
    "The sensor Rate; `value` in deg/s, `raw` as int16[3]."

    FACTS: ClassVar[Facts] = Facts(
        Item(31, "Rate", True, "int16", 3),
        scaling=Scaling(0.007633587786259542, 0.0, ()),
        unit="deg/s",
        min=None,
        max=None,
        cycle_ms=10,
    )

    value: Tuple[float, ...]
    raw: Tuple[int, ...]


@dataclass(frozen=True)
class Position(Message):
    "The sensor Position; `value` in deg, `raw` as int32."

    FACTS: ClassVar[Facts] = Facts(
        Item(41, "Position", True, "int32", None),
        scaling=Scaling(0.2571428571428571, 0.0, ()),
        unit="deg",
        min=None,
        max=None,
        cycle_ms=None,
    )

    value: float
    raw: int


@dataclass(frozen=True)
class Escs(Message):
    "The actuator Escs; `value` in percent, `raw` as uint16[4]."

    FACTS: ClassVar[Facts] = Facts(
        Item(20, "Escs", False, "uint16", 4),
        scaling=Scaling(1.0, 0.0, ((1000.0, 0.0), (2000.0, 100.0),)),
        unit="percent",
        min=None,
        max=None,
        cycle_ms=None,
    )

    value: Tuple[float, ...]
    raw: Tuple[int, ...]

    @classmethod
    def of(cls, value: Tuple[float, ...]) -> Escs:
        """The message that sets it to what is shown. Raises ValueError beyond its limits."""
        return of_shown(cls, value)

    @classmethod
    def of_raw(cls, raw: Tuple[int, ...]) -> Escs:
        """The message that sets it to a code. Raises ValueError beyond its limits."""
        return of_raw(cls, raw)


@dataclass(frozen=True)
class Lamps(Message):
    "The actuator Lamps; `value`, `raw` as bool[3]."

    FACTS: ClassVar[Facts] = Facts(
        Item(21, "Lamps", False, "bool", 3),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=None,
    )

    value: Tuple[bool, ...]
    raw: Tuple[bool, ...]

    @classmethod
    def of(cls, value: Tuple[bool, ...]) -> Lamps:
        """The message that sets it to what is shown. Raises ValueError beyond its limits."""
        return of_shown(cls, value)

    @classmethod
    def of_raw(cls, raw: Tuple[bool, ...]) -> Lamps:
        """The message that sets it to a code. Raises ValueError beyond its limits."""
        return of_raw(cls, raw)


@dataclass(frozen=True)
class Winch(Message):
    "The actuator Winch; `value` in N, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(22, "Winch", False, "uint16", None),
        scaling=Scaling(0.5, 0.0, ((0.0, -50.0), (1000.0, 0.0), (2000.0, 200.0),)),
        unit="N",
        min=-25.0,
        max=100.0,
        cycle_ms=None,
    )

    value: float
    raw: int

    @classmethod
    def of(cls, value: float) -> Winch:
        """The message that sets it to what is shown. Raises ValueError beyond its limits."""
        return of_shown(cls, value)

    @classmethod
    def of_raw(cls, raw: int) -> Winch:
        """The message that sets it to a code. Raises ValueError beyond its limits."""
        return of_raw(cls, raw)


@dataclass(frozen=True)
class Speed(Message):
    "The actuator Speed; `value` in %, `raw` as int16."

    FACTS: ClassVar[Facts] = Facts(
        Item(40, "Speed", False, "int16", None),
        scaling=Scaling(0.01, 0.0, ()),
        unit="%",
        min=-100.0,
        max=100.0,
        cycle_ms=None,
    )

    value: float
    raw: int

    @classmethod
    def of(cls, value: float) -> Speed:
        """The message that sets it to what is shown. Raises ValueError beyond its limits."""
        return of_shown(cls, value)

    @classmethod
    def of_raw(cls, raw: int) -> Speed:
        """The message that sets it to a code. Raises ValueError beyond its limits."""
        return of_raw(cls, raw)


class Rover(Board):
    """A board of the design; see `Board`."""

    NAME = "Rover"
    SCHEMA = Schema((
        Ranger.FACTS.item,
        Line.FACTS.item,
        Bumper.FACTS.item,
        Wheels.FACTS.item,
        Bent.FACTS.item,
        Escs.FACTS.item,
        Lamps.FACTS.item,
        Winch.FACTS.item,
        Acceleration.FACTS.item,
        Rate.FACTS.item,
        Speed.FACTS.item,
        Position.FACTS.item,
    ), "none", False)
    MESSAGES = (
        Ranger,
        Line,
        Bumper,
        Wheels,
        Bent,
        Acceleration,
        Rate,
        Position,
        Escs,
        Lamps,
        Winch,
        Speed,
    )
    BAUD = 115200
    SILENCE_MS = 500
