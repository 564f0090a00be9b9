//! Where a host application finds the simulated board: at a pseudo-terminal, at a port of TCP, or nowhere.
//!
//! In: the arguments. Out: the board's end of the link.

use std::time::Duration;

use anyhow::Result;

#[cfg(unix)]
use super::pty::Pty;
use super::tcp::Tcp;
use crate::cli::SimulateArgs;
use crate::terminal::Terminal;

/// The board's end of its link.
pub(super) enum Outlet {
    #[cfg(unix)]
    Pty(Pty),
    Tcp(Tcp),
    /// The board's reports are only printed.
    None,
}

impl Outlet {
    /// Opens what the arguments ask for, and says where it is.
    pub(super) fn open(args: &SimulateArgs, terminal: &Terminal) -> Result<Self> {
        if args.stdout {
            return Ok(Self::None);
        }
        let outlet = match &args.tcp {
            Some(address) => Self::Tcp(Tcp::open(address)?),
            None => Self::usual()?,
        };
        let name = match &outlet {
            #[cfg(unix)]
            Self::Pty(pty) => pty.name().to_owned(),
            Self::Tcp(tcp) => tcp.name(),
            Self::None => return Ok(outlet),
        };
        terminal.note(&format!("the board is at {name}\n"))?;
        terminal.aside("a host application takes it for the board's device; Ctrl-C ends it")?;
        Ok(outlet)
    }

    #[cfg(unix)]
    fn usual() -> Result<Self> {
        Ok(Self::Pty(Pty::open()?))
    }

    /// This system has no pseudo-terminals.
    #[cfg(not(unix))]
    fn usual() -> Result<Self> {
        Ok(Self::Tcp(Tcp::open("0")?))
    }

    /// Whether a program has it open; waits a while for something to happen.
    pub(super) fn wait(&mut self, pause: Duration) -> bool {
        match self {
            #[cfg(unix)]
            Self::Pty(pty) => pty.wait(pause),
            Self::Tcp(tcp) => tcp.wait(pause),
            Self::None => {
                std::thread::sleep(pause);
                false
            }
        }
    }

    /// The bytes that the host has sent.
    pub(super) fn read(&mut self) -> Vec<u8> {
        match self {
            #[cfg(unix)]
            Self::Pty(pty) => pty.read(),
            Self::Tcp(tcp) => tcp.read(),
            Self::None => Vec::new(),
        }
    }

    /// Sends bytes to the host, if one is there.
    pub(super) fn write(&mut self, bytes: &[u8], is_connected: bool) {
        match self {
            #[cfg(unix)]
            Self::Pty(pty) => pty.write(bytes, is_connected),
            Self::Tcp(tcp) if is_connected => tcp.write(bytes),
            Self::Tcp(_) | Self::None => {}
        }
    }
}
