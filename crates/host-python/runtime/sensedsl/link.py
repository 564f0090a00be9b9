"""The ends that bytes come from: a serial port, found again under another name, a port of TCP, or a recording."""

from __future__ import annotations

import importlib
import socket
import time
from typing import Any, BinaryIO, List, Optional, Tuple, Union


TCP = "tcp:"
"""What the path of a link over TCP begins with."""


class DeviceError(Exception):
    """A device cannot be opened."""


def _serial() -> Any:
    try:
        importlib.import_module("serial.tools.list_ports")
        return importlib.import_module("serial")
    except ImportError:
        raise DeviceError("pyserial is missing: `pip install pyserial`") from None


def usb_ports() -> List[str]:
    """The serial ports of this machine that are USB devices."""
    return sorted(port.device for port in _serial().tools.list_ports.comports() if port.vid is not None)


Identity = Tuple[Optional[int], Optional[int], Optional[str], Optional[str]]


def identity(path: str) -> Optional[Identity]:
    """What tells the USB device behind a port from all others; None for another port."""
    for port in _serial().tools.list_ports.comports(include_links=True):
        if port.device == path and port.vid is not None:
            # Without a serial number, the socket that it is plugged into.
            return port.vid, port.pid, port.serial_number, None if port.serial_number else port.location
    return None


class SerialLink:
    """A serial port, opened raw and for this program alone."""

    is_recording = False

    def __init__(self, path: str, baud: int) -> None:
        self.path = path
        self._baud = baud
        self._identity = identity(path)
        self._port: Any = None
        self.open(path)

    @property
    def is_open(self) -> bool:
        """Whether the device is there."""
        return self._port is not None

    def open(self, path: str) -> None:
        """Opens the device. Raises DeviceError with the reason."""
        serial = _serial()
        try:
            self._port = serial.Serial(path, self._baud, timeout=0, write_timeout=1, exclusive=True)
        except (serial.SerialException, OSError, ValueError) as error:
            there = ", ".join(usb_ports()) or "none"
            raise DeviceError("cannot open %s: %s (USB ports of this machine: %s)" % (path, error, there)) from None
        self.path = path

    def find_again(self) -> bool:
        """Opens a device that is back, by its USB identity where it has one."""
        ports = _serial().tools.list_ports.comports()
        path: Optional[str] = self.path
        if self._identity is not None:
            path = next((port.device for port in ports if identity(port.device) == self._identity), None)
        if path is None:
            return False
        try:
            self.open(path)
        except DeviceError:
            return False
        return True

    def read(self, timeout: float) -> Optional[bytes]:
        """The bytes that come within a time; None if the device is gone."""
        serial = _serial()
        try:
            self._port.timeout = max(timeout, 0.0)
            first: bytes = self._port.read(1)
            if not first:
                return b""
            waiting = self._port.in_waiting
            rest: bytes = self._port.read(waiting) if waiting else b""
            return first + rest
        except (serial.SerialException, OSError, TypeError):
            self.close()
            return None

    def write(self, data: bytes) -> bool:
        """Sends bytes; False if the device is gone."""
        serial = _serial()
        try:
            self._port.write(data)
            return True
        except (serial.SerialException, OSError):
            self.close()
            return False

    def close(self) -> None:
        """Closes the device."""
        if self._port is not None:
            try:
                self._port.close()
            finally:
                self._port = None


class TcpLink:
    """A link over TCP, of `tcp:HOST:PORT`: a simulated board, or an adapter in the network."""

    is_recording = False

    def __init__(self, path: str) -> None:
        self.path = path
        self._socket: Optional[socket.socket] = None
        self.open()

    @property
    def is_open(self) -> bool:
        """Whether the other side is there."""
        return self._socket is not None

    def open(self) -> None:
        """Connects. Raises DeviceError with the reason."""
        host, _, port = self.path[len(TCP) :].rpartition(":")
        try:
            self._socket = socket.create_connection((host.strip("[]"), int(port)), timeout=3)
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        except (OSError, ValueError) as error:
            raise DeviceError("cannot open %s: %s (write tcp:HOST:PORT)" % (self.path, error)) from None

    def find_again(self) -> bool:
        """Connects again."""
        try:
            self.open()
        except DeviceError:
            return False
        return True

    def read(self, timeout: float) -> Optional[bytes]:
        """The bytes that come within a time; None if the other side is gone."""
        if self._socket is None:
            return None
        try:
            self._socket.settimeout(max(timeout, 0.001))
            data = self._socket.recv(4096)
        except (socket.timeout, BlockingIOError):
            return b""
        except OSError:
            data = b""
        if not data:
            self.close()
            return None
        return data

    def write(self, data: bytes) -> bool:
        """Sends bytes; False if the other side is gone."""
        if self._socket is None:
            return False
        try:
            self._socket.settimeout(1)
            self._socket.sendall(data)
            return True
        except OSError:
            self.close()
            return False

    def close(self) -> None:
        """Ends the connection."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None


class Recording:
    """Bytes of a board in a file, or in any stream of bytes."""

    is_recording = True
    is_open = True

    def __init__(self, source: Union[str, BinaryIO]) -> None:
        self.path = source if isinstance(source, str) else "recording"
        self._file: BinaryIO = open(source, "rb") if isinstance(source, str) else source

    def find_again(self) -> bool:
        """A recording does not come back."""
        return False

    def read(self, timeout: float) -> Optional[bytes]:
        """The next bytes; None at the end."""
        return self._file.read(65536) or None

    def write(self, data: bytes) -> bool:
        """Nobody listens."""
        return True

    def close(self) -> None:
        """Closes the file."""
        self._file.close()


Link = Union[SerialLink, TcpLink, Recording]


def opened(path: str, baud: int) -> Link:
    """The link at a path. Raises DeviceError if it cannot be opened."""
    return TcpLink(path) if path.startswith(TCP) else SerialLink(path, baud)


def now() -> float:
    """Seconds of a clock that only goes forward."""
    return time.monotonic()
