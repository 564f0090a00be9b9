"""Raw values to shown ones and back, and the messages that carry both."""

from __future__ import annotations

import importlib
import math
from dataclasses import dataclass
from typing import Any, ClassVar, Iterable, List, Optional, Sequence, Tuple, Type, TypeVar

from .wire import Item, Scalar, Stamp, Values


@dataclass(frozen=True)
class Scaling:
    """`scale * raw + offset`, and through the points of `curve` where there are some: linear between two, held beyond."""

    scale: float = 1.0
    offset: float = 0.0
    curve: Tuple[Tuple[float, float], ...] = ()

    def shown(self, raw: float) -> float:
        """The shown value of a raw one."""
        x = self.scale * raw + self.offset
        if not self.curve:
            return x
        if x <= self.curve[0][0]:
            return self.curve[0][1]
        for (x0, y0), (x1, y1) in zip(self.curve, self.curve[1:]):
            if x < x1:
                return y0 + (x - x0) * (y1 - y0) / (x1 - x0)
        return self.curve[-1][1] if not math.isnan(x) else x

    def raw(self, shown: float) -> float:
        """The raw value, with a fraction, that is shown so. Raises ValueError where none is."""
        x: Optional[float] = None if self.curve else shown
        for (x0, y0), (x1, y1) in zip(self.curve, self.curve[1:]):
            if x is None and min(y0, y1) <= shown <= max(y0, y1):
                x = x0 if y0 == y1 else x0 + (shown - y0) * (x1 - x0) / (y1 - y0)
        if x is None:
            raise ValueError("no raw value is shown as %r" % shown)
        return (x - self.offset) / self.scale


_RANGES = {
    "bool": (0, 1), "uint8": (0, 2**8 - 1), "int8": (-2**7, 2**7 - 1), "uint16": (0, 2**16 - 1),
    "int16": (-2**15, 2**15 - 1), "uint32": (0, 2**32 - 1), "int32": (-2**31, 2**31 - 1),
    "uint64": (0, 2**64 - 1), "int64": (-2**63, 2**63 - 1),
}


@dataclass(frozen=True)
class Facts:
    """What the design says of a device."""

    item: Item
    scaling: Optional[Scaling] = None
    """None where the raw value is shown as it is."""
    unit: Optional[str] = None
    min: Optional[float] = None
    max: Optional[float] = None
    cycle_ms: Optional[int] = None
    """From one value to the next; None for values that come when something happens."""

    def shown(self, raw: Values) -> Tuple[Any, ...]:
        """The shown elements of raw ones."""
        scaling = self.scaling
        return raw if scaling is None else tuple(scaling.shown(one) for one in raw)

    def outside(self, shown: Iterable[float]) -> Optional[str]:
        """Which limit an element is beyond, in words."""
        unit = "" if self.unit is None else " " + self.unit
        for one in shown:
            if self.min is not None and one < self.min:
                return "below the minimum of %g%s" % (self.min, unit)
            if self.max is not None and one > self.max:
                return "above the maximum of %g%s" % (self.max, unit)
        return None

    def codes(self, shown: Sequence[float]) -> Values:
        """The codes of shown elements. Raises ValueError for what is beyond a limit or the type."""
        beyond = self.outside(shown)
        if beyond is not None:
            raise ValueError("%s: %r is %s" % (self.item.name, shown, beyond))
        scaling = Scaling() if self.scaling is None else self.scaling
        return tuple(self._code(scaling.raw(one)) for one in shown)

    def checked(self, raw: Sequence[Scalar]) -> Values:
        """Codes, if they are within the limits. Raises ValueError otherwise."""
        beyond = self.outside(self.shown(tuple(raw)))
        if beyond is not None:
            raise ValueError("%s: raw %r is %s" % (self.item.name, raw, beyond))
        return tuple(raw)

    def _code(self, raw: float) -> Scalar:
        if self.item.type.startswith("float"):
            return float(raw)
        code = math.floor(raw + 0.5) if raw >= 0 else math.ceil(raw - 0.5)
        least, greatest = _RANGES[self.item.type]
        if not least <= code <= greatest:
            raise ValueError("%s: %r is beyond %s" % (self.item.name, raw, self.item.type))
        return bool(code) if self.item.type == "bool" else code


@dataclass(frozen=True)
class Message:
    """A value of a device: `value` as people read it, `raw` as it travels."""

    FACTS: ClassVar[Facts]

    value: Any
    raw: Any
    at: float
    """When it arrived, in seconds of `time.monotonic`; 0 for one that is to be sent."""
    stamp: Optional[Stamp]
    """When the board put the report together, where the link has stamps."""

    @property
    def unit(self) -> Optional[str]:
        """The unit of `value`."""
        return self.FACTS.unit

    @property
    def outside(self) -> Optional[str]:
        """Which limit of the design the value is beyond, in words; None for neither."""
        if self.FACTS.item.type == "bool":
            return None
        values = self.value if isinstance(self.value, tuple) else (self.value,)
        return self.FACTS.outside(values)

    def __str__(self) -> str:
        unit = "" if self.unit is None else " " + self.unit
        beyond = "" if self.outside is None else " (%s)" % self.outside
        return "%s = %s%s%s" % (self.FACTS.item.name, self.value, unit, beyond)


M = TypeVar("M", bound=Message)


def received(cls: Type[M], raw: Values, at: float, stamp: Optional[Stamp]) -> M:
    """The message of a value that has come."""
    shown = cls.FACTS.shown(raw)
    if cls.FACTS.item.length is None:
        return cls(shown[0], raw[0], at, stamp)
    return cls(shown, raw, at, stamp)


def of_shown(cls: Type[M], value: Any) -> M:
    """The message that sets an actuator to what is shown."""
    facts = cls.FACTS
    values = (value,) if facts.item.length is None else tuple(value)
    if len(values) != facts.item.elements:
        raise ValueError("%s has %d elements" % (facts.item.name, facts.item.elements))
    return received(cls, facts.codes(values), 0.0, None)


def of_raw(cls: Type[M], raw: Any) -> M:
    """The message that sets an actuator to a code."""
    facts = cls.FACTS
    values = (raw,) if facts.item.length is None else tuple(raw)
    if len(values) != facts.item.elements:
        raise ValueError("%s has %d elements" % (facts.item.name, facts.item.elements))
    return received(cls, facts.checked(values), 0.0, None)


def to_pandas(messages: Iterable[Message]) -> Any:
    """A `pandas.DataFrame` of messages: time, device, value, raw, unit. Needs pandas."""
    pandas: Any = importlib.import_module("pandas")
    rows: List[Tuple[float, str, Any, Any, Optional[str]]] = [
        (one.at, one.FACTS.item.name, one.value, one.raw, one.unit) for one in messages
    ]
    return pandas.DataFrame(rows, columns=["at", "device", "value", "raw", "unit"])
