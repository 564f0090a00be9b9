//! Serial ports: opened for this program alone, and found again under another name. `tcp:HOST:PORT` is a link, too: of a
//! simulated board, or of an adapter in the network.

use std::fmt;
use std::io::{self, Read as _, Write as _};
use std::net::{TcpStream, ToSocketAddrs as _};
use std::time::Duration;

use serialport::{ErrorKind, SerialPort, SerialPortType, UsbPortInfo};

/// The longest time that writing may take; a board that does not read for so long is gone.
const WRITE_WITHIN: Duration = Duration::from_secs(1);

/// The longest time that a connection may take.
const CONNECT_WITHIN: Duration = Duration::from_secs(3);

/// What the path of a link over TCP begins with.
const TCP: &str = "tcp:";

/// A serial port that is open, or a link over TCP.
pub struct Port {
    port: Line,
    path: String,
    identity: Option<Identity>,
}

/// What carries the bytes.
enum Line {
    Serial(Box<dyn SerialPort>),
    Tcp(TcpStream),
}

/// What tells a serial port of a USB device from all others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Identity {
    vendor: u16,
    product: u16,
    serial: Option<String>,
    interface: Option<u8>,
}

impl fmt::Display for Identity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:04x}:{:04x}", self.vendor, self.product)?;
        match &self.serial {
            Some(serial) => write!(f, ", serial number {serial}"),
            None => Ok(()),
        }
    }
}

impl Identity {
    fn of(info: &UsbPortInfo) -> Self {
        Self {
            vendor: info.vid,
            product: info.pid,
            serial: info.serial_number.clone(),
            interface: info.interface,
        }
    }
}

/// Why a port is not opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OpenError {
    /// There is no such device.
    Missing,
    /// The user may not open it.
    Denied,
    /// Another program has it.
    Busy,
    /// It is no serial port.
    NotSerial,
    /// Nothing answers at an address of TCP; the system's reason.
    Unreachable(String),
    /// The system's reason.
    Other(String),
}

impl fmt::Display for OpenError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing => f.write_str("there is no such device"),
            Self::Denied => f.write_str("you may not open it"),
            Self::Busy => f.write_str("another program has it open"),
            Self::NotSerial => f.write_str("it is no serial port"),
            Self::Unreachable(why) => write!(f, "nothing answers there ({why})"),
            Self::Other(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for OpenError {}

impl Port {
    /// Opens a port raw and for this program alone, or connects to `tcp:HOST:PORT`, which has no rate.
    ///
    /// # Errors
    /// Fails if it is not there, not a serial port, in use, or not this user's.
    pub fn open(path: &str, baud: u32) -> Result<Self, OpenError> {
        if let Some(address) = path.strip_prefix(TCP) {
            let stream = connect(address).map_err(|why| OpenError::Unreachable(why.to_string()))?;
            return Ok(Self { port: Line::Tcp(stream), path: path.to_owned(), identity: None });
        }
        let port = serialport::new(path, baud).timeout(Duration::from_millis(1)).open();
        let port = port.map_err(|error| why(&error))?;
        // Bytes from before are somebody else's.
        let _ = port.clear(serialport::ClearBuffer::Input);
        let port = Line::Serial(port);
        Ok(Self { port, path: path.to_owned(), identity: identity(path) })
    }

    /// The same port once more, for a thread that reads while another one writes.
    ///
    /// # Errors
    /// Fails if the system has no room for it, or the device is gone.
    pub fn try_clone(&self) -> io::Result<Self> {
        let port = match &self.port {
            Line::Serial(port) => Line::Serial(port.try_clone()?),
            Line::Tcp(stream) => Line::Tcp(stream.try_clone()?),
        };
        Ok(Self { port, path: self.path.clone(), identity: self.identity.clone() })
    }

    /// Its path.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The USB device that it is, if it is one.
    #[must_use]
    pub fn identity(&self) -> Option<&Identity> {
        self.identity.as_ref()
    }

    /// The bytes that come within a time; none if nothing comes.
    ///
    /// # Errors
    /// Fails if the device is gone.
    pub fn read(&mut self, within: Duration) -> io::Result<Vec<u8>> {
        let mut bytes = vec![0; 4_096];
        let within = within.max(Duration::from_millis(1));
        let read = match &mut self.port {
            Line::Serial(port) => {
                port.set_timeout(within)?;
                port.read(&mut bytes)
            }
            Line::Tcp(stream) => {
                stream.set_read_timeout(Some(within))?;
                stream.read(&mut bytes)
            }
        };
        match read {
            Ok(0) => Err(io::ErrorKind::UnexpectedEof.into()),
            Ok(count) => {
                bytes.truncate(count);
                Ok(bytes)
            }
            Err(error) if is_nothing(&error) => Ok(Vec::new()),
            Err(error) => Err(error),
        }
    }

    /// Sends bytes.
    ///
    /// # Errors
    /// Fails if the device is gone, or does not take them.
    pub fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        match &mut self.port {
            Line::Serial(port) => {
                port.set_timeout(WRITE_WITHIN)?;
                port.write_all(bytes)
            }
            Line::Tcp(stream) => stream.write_all(bytes),
        }
    }
}

/// Connects to the first address of a name that answers.
fn connect(address: &str) -> io::Result<TcpStream> {
    let mut why = io::Error::from(io::ErrorKind::AddrNotAvailable);
    for one in address.to_socket_addrs()? {
        match TcpStream::connect_timeout(&one, CONNECT_WITHIN) {
            Ok(stream) => {
                stream.set_nodelay(true)?;
                stream.set_write_timeout(Some(WRITE_WITHIN))?;
                return Ok(stream);
            }
            Err(error) => why = error,
        }
    }
    Err(why)
}

fn is_nothing(error: &io::Error) -> bool {
    let nothing = [io::ErrorKind::TimedOut, io::ErrorKind::WouldBlock, io::ErrorKind::Interrupted];
    nothing.contains(&error.kind())
}

fn why(error: &serialport::Error) -> OpenError {
    let text = error.to_string();
    match error.kind() {
        ErrorKind::Io(io::ErrorKind::NotFound) => OpenError::Missing,
        ErrorKind::Io(io::ErrorKind::PermissionDenied) => OpenError::Denied,
        // What the system says when somebody has locked it; a device that is not there is `NotFound`.
        ErrorKind::NoDevice if cfg!(unix) => OpenError::Busy,
        ErrorKind::NoDevice => OpenError::Missing,
        ErrorKind::Unknown if text.contains("typewriter") || text.contains("ioctl") => {
            OpenError::NotSerial
        }
        ErrorKind::InvalidInput | ErrorKind::Unknown | ErrorKind::Io(_) => OpenError::Other(text),
    }
}

/// The serial ports of this machine that are USB devices, in order, each with what it is.
#[must_use]
pub fn usb_ports() -> Vec<(String, Identity)> {
    let all = serialport::available_ports().unwrap_or_default();
    let mut found: Vec<(String, Identity)> = Vec::new();
    for port in all {
        // A Mac lists each port twice; `cu` is the one that does not wait for a carrier.
        if let SerialPortType::UsbPort(info) = &port.port_type
            && !port.port_name.starts_with("/dev/tty.")
        {
            found.push((port.port_name.clone(), Identity::of(info)));
        }
    }
    found.sort_by(|one, other| one.0.cmp(&other.0));
    found
}

/// What a port is, by its path; links are followed.
fn identity(path: &str) -> Option<Identity> {
    let real = std::fs::canonicalize(path).ok();
    let real = real.and_then(|path| path.into_os_string().into_string().ok());
    let real = real.as_deref().unwrap_or(path);
    usb_ports().into_iter().find(|(name, _)| name == real).map(|(_, identity)| identity)
}

/// The path of the port with an identity, if it is there.
#[must_use]
pub fn find(identity: &Identity) -> Option<String> {
    usb_ports().into_iter().find(|(_, one)| one == identity).map(|(name, _)| name)
}
