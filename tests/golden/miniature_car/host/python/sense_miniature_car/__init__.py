"""The boards of a design and their messages. Generated: changes are lost when it is generated again.

    with STM32F4DiscoveryBoard.open() as board:
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
    "STM32F4DiscoveryBoard",
    "IRFrontRight",
    "IRRearRight",
    "IRRear",
    "USFront",
    "USFrontRight",
    "USRear",
    "WheelLeftA",
    "WheelLeftB",
    "WheelRightA",
    "WheelRightB",
    "RCSteering",
    "RCThrottle",
    "RCSwitch",
    "Board", "DeviceError", "Health", "Message", "OtherFirmware", "STATUS", "Stamp", "boards_of", "to_pandas",
]

DESIGN = "miniature_car"
"""The design that this package was generated for."""


@dataclass(frozen=True)
class IRFrontRight(Message):
    "The sensor IRFrontRight; `value`, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(1, "IRFrontRight", True, "uint16", None),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=60,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class IRRearRight(Message):
    "The sensor IRRearRight; `value`, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(2, "IRRearRight", True, "uint16", None),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=60,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class IRRear(Message):
    "The sensor IRRear; `value`, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(3, "IRRear", True, "uint16", None),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=60,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class USFront(Message):
    "The sensor USFront; `value` in cm, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(4, "USFront", True, "uint16", None),
        scaling=None,
        unit="cm",
        min=None,
        max=None,
        cycle_ms=70,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class USFrontRight(Message):
    "The sensor USFrontRight; `value` in cm, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(5, "USFrontRight", True, "uint16", None),
        scaling=None,
        unit="cm",
        min=None,
        max=None,
        cycle_ms=70,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class USRear(Message):
    "The sensor USRear; `value` in cm, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(6, "USRear", True, "uint16", None),
        scaling=None,
        unit="cm",
        min=None,
        max=None,
        cycle_ms=70,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class WheelLeftA(Message):
    "The sensor WheelLeftA; `value`, `raw` as uint32."

    FACTS: ClassVar[Facts] = Facts(
        Item(7, "WheelLeftA", True, "uint32", None),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=None,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class WheelLeftB(Message):
    "The sensor WheelLeftB; `value`, `raw` as uint32."

    FACTS: ClassVar[Facts] = Facts(
        Item(8, "WheelLeftB", True, "uint32", None),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=None,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class WheelRightA(Message):
    "The sensor WheelRightA; `value`, `raw` as uint32."

    FACTS: ClassVar[Facts] = Facts(
        Item(9, "WheelRightA", True, "uint32", None),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=None,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class WheelRightB(Message):
    "The sensor WheelRightB; `value`, `raw` as uint32."

    FACTS: ClassVar[Facts] = Facts(
        Item(10, "WheelRightB", True, "uint32", None),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=None,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class RCSteering(Message):
    "The sensor RCSteering; `value` in us, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(11, "RCSteering", True, "uint16", None),
        scaling=None,
        unit="us",
        min=1000.0,
        max=2000.0,
        cycle_ms=None,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class RCThrottle(Message):
    "The sensor RCThrottle; `value` in us, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(12, "RCThrottle", True, "uint16", None),
        scaling=None,
        unit="us",
        min=1000.0,
        max=2000.0,
        cycle_ms=None,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class RCSwitch(Message):
    "The sensor RCSwitch; `value` in us, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(13, "RCSwitch", True, "uint16", None),
        scaling=None,
        unit="us",
        min=1000.0,
        max=2000.0,
        cycle_ms=None,
    )

    value: int
    raw: int


class STM32F4DiscoveryBoard(Board):
    """A board of the design; see `Board`."""

    NAME = "STM32F4DiscoveryBoard"
    SCHEMA = Schema((
        IRFrontRight.FACTS.item,
        IRRearRight.FACTS.item,
        IRRear.FACTS.item,
        USFront.FACTS.item,
        USFrontRight.FACTS.item,
        USRear.FACTS.item,
        WheelLeftA.FACTS.item,
        WheelLeftB.FACTS.item,
        WheelRightA.FACTS.item,
        WheelRightB.FACTS.item,
        RCSteering.FACTS.item,
        RCThrottle.FACTS.item,
        RCSwitch.FACTS.item,
    ), "none", False)
    MESSAGES = (
        IRFrontRight,
        IRRearRight,
        IRRear,
        USFront,
        USFrontRight,
        USRear,
        WheelLeftA,
        WheelLeftB,
        WheelRightA,
        WheelRightB,
        RCSteering,
        RCThrottle,
        RCSwitch,
    )
    BAUD = 115200
    SILENCE_MS = None
