"""Whether the board at the other end is the one that is meant. No I/O and no clock in here.

Nothing is believed before the board's hello has told the hash of this design, for which it is asked until it answers.
With another hash its shell is asked for its schema, so that the devices that differ can be named.
"""

from __future__ import annotations

import binascii
from typing import Dict, List, Optional, Tuple

from .wire import Decoder, Frame, Health, Hello, OtherHealth, Report, Schema
from .wire import encode_health_request, encode_hello_request

ASK_EVERY = 0.25
ASK_RARELY_AFTER = 5.0
ASK_RARELY_EVERY = 1.0
UNANSWERED_AFTER = 1.5
SHELL_WITHIN = 1.0
_SHELL: Tuple[Tuple[float, bytes], ...] = (
    (0.0, b"q"), (0.15, b"\rschema\r"), (SHELL_WITHIN, b"q"), (SHELL_WITHIN + 0.15, b"\rschema\r"),
)

ASKING, MATCHED, PLAYING, COMPARING, REFUSED = range(5)


class OtherFirmware(Exception):
    """The board runs the firmware of another design."""


def differences(own: str, board: str) -> List[str]:
    """In what two schema texts differ, a line each."""
    def devices(text: str) -> Dict[str, str]:
        words = [line.split() for line in text.splitlines()]
        return {w[2]: "%s %s, identifier %s" % (w[1], w[3], w[0]) for w in words if len(w) == 4}

    here, there = devices(own), devices(board)
    lines = [
        "%s: %s on the board, %s here" % (name, there.get(name, "not there"), words)
        for name, words in here.items() if there.get(name) != words
    ]
    lines += ["%s: only on the board (%s)" % (name, words) for name, words in there.items() if name not in here]
    heads = [[line for line in text.splitlines() if len(line.split()) < 3] for text in (own, board)]
    if heads[0] != heads[1]:
        lines.insert(0, "the link: %s on the board, %s here" % (", ".join(heads[1]), ", ".join(heads[0])))
    return lines


class Session:
    """A session with a board, from opening its link to losing it."""

    def __init__(self, schema: Schema, now: float, recording: bool = False) -> None:
        self.schema = schema
        self.state = PLAYING if recording else ASKING
        self.decoder = Decoder(schema)
        self.withheld = 0
        """Reports that came while nothing was believed."""
        self.lost = 0
        """Reports that the counters of stamps say were lost."""
        self.last_frame = now
        self.wants_health = not recording
        self.health_every: Optional[float] = None
        self._recording = recording
        self._started = now
        self._asked: Optional[float] = None
        self._requests = 0
        self._others = [Decoder(Schema((), one)) for one in ("none", "crc16", "crc32") if one != schema.checksum]
        self._other_hash: Optional[int] = None
        self._hash = 0
        self._answer = b""
        self._step = 0
        self._health_asked: Optional[float] = None
        self._counter: Optional[int] = None

    def feed(self, data: bytes, now: float) -> List[Frame]:
        """Takes the next bytes, and returns what is believed of them. Raises OtherFirmware once that is known."""
        if self.state == COMPARING:
            self._answer += data[:65536 - len(self._answer)]
            self._compare(now)
        if self.state == ASKING:
            self._listen(data, now)
        believed: List[Frame] = []
        for frame in self.decoder.feed(data):
            self.last_frame = now
            if isinstance(frame, Hello):
                self._hello(frame.hash, now)
            elif self.state not in (MATCHED, PLAYING):
                self.withheld += isinstance(frame, Report)
            elif isinstance(frame, (Report, Health, OtherHealth)):
                self._count(frame)
                believed.append(frame)
        return believed

    def to_send(self, now: float) -> bytes:
        """What to send now; mostly nothing."""
        if self.state == ASKING:
            return self._request(now)
        if self.state == MATCHED:
            return self._health_request(now)
        if self.state == COMPARING:
            self._compare(now)
            if self._step < len(_SHELL) and now - self._started >= _SHELL[self._step][0]:
                self._step += 1
                return _SHELL[self._step - 1][1]
        return b""

    def ask_anew(self, now: float) -> None:
        """A board that said nothing for long may have been restarted, with whatever firmware."""
        self.state, self._started, self._asked, self._requests = ASKING, now, None, 0

    def is_unanswered(self, now: float) -> bool:
        """Whether the board should have said who it is by now."""
        return self.state == ASKING and now - self._started >= UNANSWERED_AFTER

    def _count(self, frame: Frame) -> None:
        if isinstance(frame, Report) and frame.stamp is not None:
            counter = frame.stamp.counter
            if self._counter is not None:
                self.lost += (counter - self._counter - 1) % 256
            self._counter = counter

    def _request(self, now: float) -> bytes:
        every = ASK_RARELY_EVERY if now - self._started >= ASK_RARELY_AFTER else ASK_EVERY
        if self._asked is not None and now - self._asked < every:
            return b""
        self._asked = now
        self._requests += 1
        # A board that does not answer may have another form of frames.
        other = self._others[self._requests % 2].schema
        return encode_hello_request(other if self._requests % 3 == 0 else self.schema)

    def _health_request(self, now: float) -> bytes:
        waited = None if self._health_asked is None else now - self._health_asked
        wanted = self.wants_health and (waited is None or waited >= 1.0)
        due = self.health_every is not None and (waited is None or waited >= self.health_every)
        if not wanted and not due:
            return b""
        self._health_asked, self.wants_health = now, False
        return encode_health_request(self.schema)

    def _listen(self, data: bytes, now: float) -> None:
        """Hellos with another checksum; bytes of a value may look like one, so two equal ones count."""
        for decoder in self._others:
            for frame in decoder.feed(data):
                if isinstance(frame, Hello):
                    if frame.hash == self._other_hash:
                        self._begin_comparing(frame.hash, now)
                    self._other_hash = frame.hash

    def _hello(self, hash_: int, now: float) -> None:
        if hash_ == self.schema.hash:
            if self.state in (ASKING, PLAYING):
                self.state = MATCHED
        elif self._recording:
            self.state = REFUSED
            raise OtherFirmware("this is a recording of other firmware (schema 0x%08x instead of 0x%08x)"
                                % (hash_, self.schema.hash))
        elif self.state not in (COMPARING, REFUSED):
            self._begin_comparing(hash_, now)

    def _begin_comparing(self, hash_: int, now: float) -> None:
        self.state, self._hash, self._started, self._step, self._answer = COMPARING, hash_, now, 0, b""

    def _compare(self, now: float) -> None:
        board = self._board_text()
        if board is None and now - self._started < 2 * SHELL_WITHIN:
            return
        self.state = REFUSED
        lines = [] if board is None else differences(self.schema.text, board)
        raise OtherFirmware(
            "the board runs other firmware than this program was generated for (schema 0x%08x instead of 0x%08x)%s; "
            "flash the firmware of this design, or use the program of the board's"
            % (self._hash, self.schema.hash, "".join("\n  " + line for line in lines)))

    def _board_text(self) -> Optional[str]:
        lines = self._answer.decode("ascii", "replace").replace("\r", "").split("\n")
        for start in (at for at, line in enumerate(lines) if line.startswith("checksum ")):
            text = ""
            for line in lines[start:]:
                text += line + "\n"
                if binascii.crc32(text.encode("ascii", "replace")) == self._hash:
                    return text
        return None
