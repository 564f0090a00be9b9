"""A board of a design: messages in, messages out, and what happens to it."""

from __future__ import annotations

import asyncio
import sys
import time
from typing import Any, AsyncIterator, BinaryIO, Callable, ClassVar, Dict, Iterator, List, Optional, Sequence
from typing import Tuple, Type, TypeVar, Union

from .link import DeviceError, Link, Recording, SerialLink, now, opened, usb_ports
from .session import MATCHED, PLAYING, OtherFirmware, Session
from .values import Message, received
from .wire import Health, OtherHealth, Report, Schema, encode_hello_request, encode_report

B = TypeVar("B", bound="Board")
M = TypeVar("M", bound=Message)

STATUS = ("never read", "good", "stale", "failed", "invalid")
"""The words of a device's status in `Health`."""


def say(note: str) -> None:
    """Where notes for people go unless a program says otherwise."""
    print(note, file=sys.stderr)


class Board:
    """A board, from its device or from a recording. Not for several threads at once."""

    NAME: ClassVar[str]
    SCHEMA: ClassVar[Schema]
    MESSAGES: ClassVar[Tuple[Type[Message], ...]]
    BAUD: ClassVar[int]
    SILENCE_MS: ClassVar[Optional[int]]

    def __init__(self, link: Link, reconnect: bool = True, on_note: Callable[[str], None] = say) -> None:
        self.on_note = on_note
        self.on_health: Optional[Callable[[Health], None]] = None
        self.hold = True
        """Whether actuators keep what they were told as long as this board is polled, whatever their failsafe."""
        self._link = link
        self._reconnect = reconnect
        self._session = Session(self.SCHEMA, now(), link.is_recording)
        self._kinds = {cls.FACTS.item.id: cls for cls in self.MESSAGES if cls.FACTS.item.is_sensor}
        self._handlers: List[Tuple[Type[Message], Callable[[Any], None]]] = []
        self._latest: Dict[Type[Message], Message] = {}
        self._health: Optional[Health] = None
        self._sent = 0.0
        self._has_sent = False
        self._is_met = False
        self._is_told = False
        self._lost_at: Optional[float] = None
        self._before = (0, 0, 0)

    @classmethod
    def open(cls: Type[B], path: Optional[str] = None, baud: Optional[int] = None, **options: Any) -> B:
        """Opens a board: a serial port, or `tcp:HOST:PORT`; without a path, the first USB port that answers as one.

        Raises DeviceError if it cannot be opened or found.
        """
        if path is not None:
            return cls(opened(path, baud or cls.BAUD), **options)
        tried = []
        for port in usb_ports():
            try:
                link = SerialLink(port, baud or cls.BAUD)
            except DeviceError as error:
                tried.append(str(error))
                continue
            session, start = Session(cls.SCHEMA, now()), now()
            try:
                while session.state != MATCHED and now() - start < 1.5:
                    link.write(session.to_send(now()))
                    session.feed(link.read(0.05) or b"", now())
            except OtherFirmware as error:
                tried.append("%s: %s" % (port, str(error).splitlines()[0]))
            if session.state == MATCHED:
                return cls(link, **options)
            link.close()
        raise DeviceError("no USB port has a board of this design%s" % "".join("\n  " + one for one in tried))

    @classmethod
    def play(cls: Type[B], source: Union[str, BinaryIO], **options: Any) -> B:
        """Reads a recording: a file's name, or a stream of bytes."""
        return cls(Recording(source), **options)

    def __enter__(self: B) -> B:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Closes the device."""
        self._link.close()

    @property
    def is_ready(self) -> bool:
        """Whether the board is there and runs this design's firmware."""
        return self._link.is_open and self._session.state in (MATCHED, PLAYING)

    @property
    def frames(self) -> int:
        """Frames received."""
        return self._before[0] + self._session.decoder.frames

    @property
    def dropped_bytes(self) -> int:
        """Bytes that belonged to no frame."""
        return self._before[1] + self._session.decoder.dropped_bytes

    @property
    def lost_reports(self) -> int:
        """Reports that the counters of stamps say were lost."""
        return self._before[2] + self._session.lost

    def on(self, kind: Type[M], handler: Callable[[M], None]) -> None:
        """Calls a function with each message of a kind, from `poll` and all that polls."""
        self._handlers.append((kind, handler))

    def latest(self, kind: Type[M]) -> Optional[M]:
        """The latest message of a kind."""
        found = self._latest.get(kind)
        return found if isinstance(found, kind) else None

    def age(self, kind: Type[Message]) -> Optional[float]:
        """How old the latest message of a kind is, in seconds."""
        found = self._latest.get(kind)
        return None if found is None else now() - found.at

    def is_overdue(self, kind: Type[Message]) -> bool:
        """Whether a sensor was silent for three of its cycles."""
        cycle, age = kind.FACTS.cycle_ms, self.age(kind)
        return cycle is not None and (age is None or age > 3e-3 * cycle + 0.1)

    def poll(self, timeout: float = 0.1) -> Optional[List[Message]]:
        """Waits for bytes up to that long, and returns the messages in them; None when a recording is over.

        Raises OtherFirmware if the board runs another design's, and DeviceError if it is gone and not waited for.
        """
        if not self._link.is_open:
            return self._wait(timeout)
        data = self._session.to_send(now()) or self._keep_alive()
        if data and not self._write(data):
            return self._lose()
        chunk = self._link.read(min(timeout, 0.05))
        if chunk is None:
            return None if self._link.is_recording else self._lose()
        messages = []
        at = now()
        for frame in self._session.feed(chunk, at):
            if isinstance(frame, Report):
                messages += [received(self._kinds[id_], raw, at, frame.stamp) for id_, raw in frame.values]
            elif isinstance(frame, Health):
                self._take_health(frame)
            elif isinstance(frame, OtherHealth):
                self._note_once("%s tells its health in version %d, which is not known here" % (self.NAME, frame.version))
        self._look(at)
        for message in messages:
            self._latest[type(message)] = message
            for kind, handler in self._handlers:
                if isinstance(message, kind):
                    handler(message)
        return messages

    def __iter__(self) -> Iterator[Message]:
        """All messages as they come, until a recording is over or the program ends."""
        while True:
            messages = self.poll()
            if messages is None:
                return
            yield from messages

    async def stream(self) -> AsyncIterator[Message]:
        """All messages as they come, for programs with an event loop."""
        loop = asyncio.get_running_loop()
        while True:
            messages = await loop.run_in_executor(None, self.poll)
            if messages is None:
                return
            for message in messages:
                yield message

    def run(self, seconds: Optional[float] = None) -> None:
        """Polls until a time is over, a recording is, or for ever."""
        end = None if seconds is None else now() + seconds
        while end is None or now() < end:
            if self.poll() is None:
                return

    def send(self, *messages: Message, timeout: float = 3.0) -> None:
        """Sets actuators. Waits for a board that has not said yet who it is.

        Raises DeviceError if it does not in time.
        """
        end = now() + timeout
        while not self.is_ready:
            if now() >= end:
                raise DeviceError("%s is not there: nothing was sent" % self.NAME)
            self.poll(0.02)
        values = {one.FACTS.item.id: one.raw if isinstance(one.raw, tuple) else (one.raw,) for one in messages}
        self._write(encode_report(self.SCHEMA, False, values))
        self._has_sent = True
        for message in messages:
            self._latest[type(message)] = message

    def health(self, timeout: float = 3.0) -> Health:
        """Asks the board how it and its devices are. Raises DeviceError if it does not answer."""
        self._health, end = None, now() + timeout
        while self._health is None:
            if now() >= end:
                raise DeviceError("%s does not tell its health" % self.NAME)
            self._session.wants_health = True
            self.poll(0.05)
        return self._health

    def health_every(self, seconds: float) -> None:
        """Asks for health that often from now on; `on_health` takes it."""
        self._session.health_every = seconds

    def _write(self, data: bytes) -> bool:
        self._sent = now()
        return self._link.write(data)

    def _keep_alive(self) -> bytes:
        held = self.hold and self._has_sent and self.SILENCE_MS is not None and self._session.state == MATCHED
        if not held or self.SILENCE_MS is None or now() - self._sent < self.SILENCE_MS / 4000:
            return b""
        return encode_hello_request(self.SCHEMA)

    def _take_health(self, health: Health) -> None:
        self._health = health
        if self.on_health is not None:
            self.on_health(health)

    def _look(self, at: float) -> None:
        if self._session.state == MATCHED and not self._is_met and not self._link.is_recording:
            self._is_met = True
            self.on_note("%s on %s: firmware and program agree" % (self.NAME, self._link.path))
        if self._session.is_unanswered(at) and not self._is_told:
            self._is_told = True
            self.on_note("%s: the board does not say which firmware it runs; asking again" % self._link.path)
        cycles = [kind.FACTS.cycle_ms for kind in self._kinds.values() if kind.FACTS.cycle_ms is not None]
        if self._session.state == MATCHED and cycles and not self._link.is_recording:
            if at - self._session.last_frame > max(1.0, 3e-3 * min(cycles) + 0.1):
                self.on_note("%s says nothing for %.1f s; asking it again" % (self.NAME, at - self._session.last_frame))
                self._session.ask_anew(at)

    def _note_once(self, note: str) -> None:
        if not self._is_told:
            self._is_told = True
            self.on_note(note)

    def _lose(self) -> List[Message]:
        self._link.close()
        if not self._reconnect:
            raise DeviceError("lost %s: the device is gone" % self._link.path)
        if self._lost_at is None:
            self._lost_at = now()
            self.on_note("lost %s: the device is gone; waiting for it" % self._link.path)
        return []

    def _wait(self, timeout: float) -> List[Message]:
        if self._link.find_again():
            self._before = (self.frames, self.dropped_bytes, self.lost_reports)
            self._session = Session(self.SCHEMA, now())
            if self._lost_at is not None:
                self.on_note("back on %s after %.1f s" % (self._link.path, now() - self._lost_at))
            self._lost_at = None
        else:
            time.sleep(min(timeout, 0.05))
        return []


def boards_of(boards: Sequence[Board], timeout: float = 0.02) -> Iterator[Message]:
    """The messages of several boards, as they come, from all in turn."""
    open_ = list(boards)
    while open_:
        for board in list(open_):
            messages = board.poll(timeout)
            if messages is None:
                open_.remove(board)
            else:
                yield from messages
