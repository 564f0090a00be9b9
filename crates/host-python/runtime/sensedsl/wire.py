"""The wire between a board and its host: values to frames, and bytes to frames.

A frame is a Netstring of items, each an identifier byte and its value in network byte order. The reference is the
project's page on the wire; the shared vectors hold this module to it, cut at every place.
"""

from __future__ import annotations

import binascii
import struct
from dataclasses import dataclass
from typing import Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

Scalar = Union[bool, int, float]
Values = Tuple[Scalar, ...]

FORMATS: Dict[str, str] = {
    "bool": "?", "uint8": "B", "int8": "b", "uint16": "H", "int16": "h", "uint32": "I", "int32": "i",
    "uint64": "Q", "int64": "q", "float32": "f", "float64": "d",
}
"""The letter of each type for `struct`."""

HELLO = 0
CHECKSUM = 255
HEALTH = 255
HEALTH_VERSION = 1
STAMP_BYTES = 6
CRC_BYTES: Dict[str, int] = {"none": 0, "crc16": 3, "crc32": 5}
"""Bytes of a checksum with its identifier."""


class Item(NamedTuple):
    """A value on a link."""

    id: int
    name: str
    is_sensor: bool
    type: str
    length: Optional[int]

    @property
    def elements(self) -> int:
        """How many elements it has."""
        return 1 if self.length is None else self.length

    @property
    def codec(self) -> struct.Struct:
        """How its bytes are read and written."""
        return struct.Struct(">%d%s" % (self.elements, FORMATS[self.type]))


class Stamp(NamedTuple):
    """When a report was put together."""

    time_us: int
    """Microseconds since the board started; wraps after 71.6 minutes."""
    counter: int
    """Counts reports; wraps. A gap tells how many were lost."""


class DeviceHealth(NamedTuple):
    """How a device is."""

    id: int
    status: int
    """0 never read, 1 good, 2 stale, 3 failed, 4 invalid."""
    age_ms: Optional[int]
    """Milliseconds since its latest value; none for never."""
    failures: Tuple[int, int, int, int, int, int]
    """Not acknowledged, bus error, arbitration lost, timed out, wrong checksum, invalid."""


@dataclass(frozen=True)
class Health:
    """How a board and its devices are."""

    uptime_ms: int
    reset_cause: int
    """0 unknown, 1 power, 2 pin, 3 software, 4 watchdog, 5 window watchdog, 6 low power, 7 the kernel stopped itself."""
    reset_device: int
    reports_sent: int
    reports_refused: int
    load_percent: Optional[int]
    stack_left_bytes: Optional[int]
    devices: Tuple[DeviceHealth, ...]


class Report(NamedTuple):
    """Values of one frame, by identifier, in the order of the payload."""

    stamp: Optional[Stamp]
    values: List[Tuple[int, Values]]


class Hello(NamedTuple):
    """The board's schema hash."""

    hash: int


class HelloRequest(NamedTuple):
    """A host asks for a hello."""


class HealthRequest(NamedTuple):
    """A host asks for health."""


class OtherHealth(NamedTuple):
    """Health of a version that is not known here."""

    version: int


Frame = Union[Report, Hello, HelloRequest, HealthRequest, Health, OtherHealth]


class Schema:
    """All values of one board's link, in the file's order."""

    def __init__(self, items: Sequence[Item], checksum: str = "none", stamp: bool = False) -> None:
        self.items = tuple(items)
        self.checksum = checksum
        self.stamp = stamp
        lines = ["checksum " + checksum] + (["stamp"] if stamp else [])
        for item in self.items:
            kind = "sensor" if item.is_sensor else "actuator"
            array = "" if item.length is None else "[%d]" % item.length
            lines.append("%d %s %s %s%s" % (item.id, kind, item.name, item.type, array))
        self.text = "".join(line + "\n" for line in lines)
        """The text that the hash is made of."""
        self.hash = binascii.crc32(self.text.encode())
        """By which host and board know that they speak of the same devices."""

    @property
    def health_bytes(self) -> int:
        """Bytes of health without a checksum."""
        return 19 + 17 * len(self.items)

    def short_bytes_max(self, sensors: bool) -> int:
        """Bytes of the longest payload but health, without a checksum."""
        report = sum(1 + item.codec.size for item in self.items if item.is_sensor == sensors)
        if sensors and self.stamp and report:
            report += STAMP_BYTES
        return max(report, 5 if sensors else 2)


def _sum(checksum: str, payload: bytes) -> bytes:
    """The checksum of a payload, with its identifier."""
    if checksum == "crc16":
        return b"\xff" + struct.pack(">H", binascii.crc_hqx(payload, 0xFFFF))
    if checksum == "crc32":
        return b"\xff" + struct.pack(">I", binascii.crc32(payload))
    return b""


def _frame(schema: Schema, payload: bytes) -> bytes:
    payload += _sum(schema.checksum, payload)
    return b"%d:%s," % (len(payload), payload)


def encode_report(
    schema: Schema, sensors: bool, values: Dict[int, Values], stamp: Optional[Stamp] = None
) -> bytes:
    """A frame with values by identifier, in the schema's order.

    Raises ValueError for values that do not fit the schema.
    """
    payload = b"" if stamp is None else struct.pack(">BIB", HELLO, stamp.time_us, stamp.counter)
    items = [item for item in schema.items if item.is_sensor == sensors and item.id in values]
    if not items or len(items) != len(values):
        raise ValueError("no value, or one of no such item")
    for item in items:
        try:
            payload += bytes((item.id,)) + item.codec.pack(*values[item.id])
        except (struct.error, OverflowError) as error:
            raise ValueError("%s: %s" % (item.name, error)) from None
    return _frame(schema, payload)


def encode_hello(schema: Schema) -> bytes:
    """The board's hello."""
    return _frame(schema, struct.pack(">BI", HELLO, schema.hash))


def encode_hello_request(schema: Schema) -> bytes:
    """A question for a hello."""
    return _frame(schema, b"\0")


def encode_health_request(schema: Schema) -> bytes:
    """A question for health."""
    return _frame(schema, b"\0\1")


def encode_health(schema: Schema, health: Health) -> bytes:
    """The board's health."""
    load = 255 if health.load_percent is None else health.load_percent
    stack = 65535 if health.stack_left_bytes is None else health.stack_left_bytes
    payload = struct.pack(
        ">BBIBBIIBH", HEALTH, HEALTH_VERSION, health.uptime_ms, health.reset_cause, health.reset_device,
        health.reports_sent, health.reports_refused, load, stack,
    )
    for device in health.devices:
        age = 0xFFFFFFFF if device.age_ms is None else device.age_ms
        payload += struct.pack(">BI6H", device.status, age, *device.failures)
    return _frame(schema, payload)


_INVALID, _INCOMPLETE = -1, -2
_DIGITS = frozenset(b"123456789")


class Decoder:
    """Finds the frames of one direction in a stream, however it is cut.

    Where bytes can be no frame, one is dropped and the rest is looked at again: the first valid frame wins.
    """

    def __init__(self, schema: Schema, sensors: bool = True) -> None:
        self.schema = schema
        self.frames = 0
        """How many frames were found."""
        self.dropped_bytes = 0
        """How many bytes belonged to none."""
        self._sensors = sensors
        self._held = b""
        crc = CRC_BYTES[schema.checksum]
        self._crc = crc
        self._short = schema.short_bytes_max(sensors)
        self._health = schema.health_bytes if sensors else 0
        self._longest = max(self._short, self._health) + crc
        self._hello = 5 if sensors else 1
        self._request = 0 if sensors else 2
        self._stamped = schema.stamp and sensors
        self._sizes: List[int] = [0] * 256
        self._reads: List[Optional[Callable[[bytes, int], Tuple[Scalar, ...]]]] = [None] * 256
        self._bools = [False] * 256
        for item in schema.items:
            if item.is_sensor == sensors:
                self._sizes[item.id] = item.codec.size
                self._reads[item.id] = item.codec.unpack_from
                self._bools[item.id] = item.type == "bool"

    def feed(self, chunk: bytes) -> List[Frame]:
        """Takes the next bytes, and returns the frames that end in them."""
        data = self._held + chunk if self._held else chunk
        frames: List[Frame] = []
        at, end = 0, len(data)
        while at < end:
            length = self._look(data, at, end)
            if length >= 0:
                frames.append(self._read(data, at, length))
                self.frames += 1
                at += length
            elif length == _INCOMPLETE:
                break
            else:
                from_ = at
                at += 1
                while at < end and data[at] not in _DIGITS:
                    at += 1
                self.dropped_bytes += at - from_
        self._held = data[at:]
        return frames

    def _look(self, data: bytes, at: int, end: int) -> int:
        """The length of the frame that starts there, or why there is none."""
        digit = data[at]
        if digit not in _DIGITS:
            return _INVALID
        size = digit - 48
        colon = at + 1
        while True:
            if size > self._longest:
                return _INVALID
            if colon >= end:
                return _INCOMPLETE
            digit = data[colon]
            if digit == 58:
                break
            if not 48 <= digit <= 57:
                return _INVALID
            size = size * 10 + digit - 48
            colon += 1
        start = colon + 1
        comma = start + size
        values = size - self._crc
        if values <= 0 or (values > self._short and values != self._health):
            return _INVALID
        if comma < end and data[comma] != 44:
            return _INVALID
        stop = comma - self._crc
        if self._crc and stop < end and data[stop] != CHECKSUM:
            return _INVALID
        walked = self._walk(data, start, stop, end)
        if walked != 0:
            return walked
        if self._crc:
            if comma > end:
                return _INCOMPLETE
            if data[stop:comma] != _sum(self.schema.checksum, data[start:stop]):
                return _INVALID
        return comma + 1 - at if comma < end else _INCOMPLETE

    def _walk(self, data: bytes, start: int, stop: int, end: int) -> int:
        """Whether the payload is one of the schema: 0, or why not."""
        if start >= end:
            return _INCOMPLETE
        first, values = data[start], stop - start
        if first == HELLO:
            if values == self._hello:
                return 0 if stop <= end else _INCOMPLETE
            if values == self._request:
                if start + 1 >= end:
                    return _INCOMPLETE
                return 0 if data[start + 1] == 1 else _INVALID
            if not self._stamped or not STAMP_BYTES < values <= self._short:
                return _INVALID
            at = start + STAMP_BYTES
        elif first == HEALTH:
            if values != self._health:
                return _INVALID
            return 0 if stop <= end else _INCOMPLETE
        elif self._stamped or values > self._short:
            return _INVALID
        else:
            at = start
        sizes, seen = self._sizes, 0
        while at < stop:
            if at >= end:
                return _INCOMPLETE
            id_ = data[at]
            size, bit = sizes[id_], 1 << id_
            after = at + 1 + size
            if size == 0 or seen & bit or after > stop:
                return _INVALID
            if self._bools[id_]:
                if any(byte > 1 for byte in data[at + 1:after]):
                    return _INVALID
                if after > end:
                    return _INCOMPLETE
            seen |= bit
            at = after
        return 0 if stop <= end else _INCOMPLETE

    def _read(self, data: bytes, at: int, length: int) -> Frame:
        start = data.index(b":", at) + 1
        stop = at + length - 1 - self._crc
        first, values = data[start], stop - start
        if first == HELLO and values == self._hello:
            return Hello(struct.unpack_from(">I", data, start + 1)[0]) if self._sensors else HelloRequest()
        if first == HELLO and values == self._request:
            return HealthRequest()
        if first == HEALTH:
            return self._read_health(data, start)
        stamp = None
        if first == HELLO:
            stamp = Stamp(*struct.unpack_from(">IB", data, start + 1))
            start += STAMP_BYTES
        found: List[Tuple[int, Values]] = []
        while start < stop:
            id_ = data[start]
            read = self._reads[id_]
            assert read is not None
            found.append((id_, read(data, start + 1)))
            start += 1 + self._sizes[id_]
        return Report(stamp, found)

    def _read_health(self, data: bytes, start: int) -> Frame:
        version = data[start + 1]
        if version != HEALTH_VERSION:
            return OtherHealth(version)
        head = struct.unpack_from(">IBBIIBH", data, start + 2)
        devices = []
        for index, item in enumerate(self.schema.items):
            status, age, *failures = struct.unpack_from(">BI6H", data, start + 19 + 17 * index)
            counts = (failures[0], failures[1], failures[2], failures[3], failures[4], failures[5])
            devices.append(DeviceHealth(item.id, status, None if age == 0xFFFFFFFF else age, counts))
        uptime_ms, cause, device, sent, refused, load, stack = head
        return Health(
            uptime_ms, cause, device, sent, refused, None if load == 255 else load,
            None if stack == 65535 else stack, tuple(devices),
        )
