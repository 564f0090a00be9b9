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
    "IRFront",
    "IRFrontRight",
    "USRear",
    "WheelEncoder",
    "Board", "DeviceError", "Health", "Message", "OtherFirmware", "STATUS", "Stamp", "boards_of", "to_pandas",
]

DESIGN = "fig2"
"""The design that this package was generated for."""


@dataclass(frozen=True)
class IRFront(Message):
    "The sensor IRFront; `value`, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(17, "IRFront", True, "uint16", None),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=1000,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class IRFrontRight(Message):
    "The sensor IRFrontRight; `value`, `raw` as uint16."

    FACTS: ClassVar[Facts] = Facts(
        Item(18, "IRFrontRight", True, "uint16", None),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=60,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class USRear(Message):
    "The sensor USRear; `value` in cm, `raw` as uint8."

    FACTS: ClassVar[Facts] = Facts(
        Item(19, "USRear", True, "uint8", None),
        scaling=None,
        unit="cm",
        min=None,
        max=None,
        cycle_ms=80,
    )

    value: int
    raw: int


@dataclass(frozen=True)
class WheelEncoder(Message):
    "The sensor WheelEncoder; `value`, `raw` as uint32."

    FACTS: ClassVar[Facts] = Facts(
        Item(20, "WheelEncoder", True, "uint32", None),
        scaling=None,
        unit=None,
        min=None,
        max=None,
        cycle_ms=None,
    )

    value: int
    raw: int


class STM32F4DiscoveryBoard(Board):
    """A board of the design; see `Board`."""

    NAME = "STM32F4DiscoveryBoard"
    SCHEMA = Schema((
        IRFront.FACTS.item,
        IRFrontRight.FACTS.item,
        USRear.FACTS.item,
        WheelEncoder.FACTS.item,
    ), "none", False)
    MESSAGES = (
        IRFront,
        IRFrontRight,
        USRear,
        WheelEncoder,
    )
    BAUD = 115200
    SILENCE_MS = None
