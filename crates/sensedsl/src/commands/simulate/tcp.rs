//! A port of TCP in place of a board's device: for systems without pseudo-terminals, and for hosts on other machines.
//!
//! In: an address. Out: the board's end of a link that one program at a time has.

use std::collections::VecDeque;
use std::io::{ErrorKind, Read as _, Write as _};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream, ToSocketAddrs as _};
use std::time::Duration;

use anyhow::{Context as _, Result};

/// The most bytes that wait for a host that does not read.
const WAITING_MAX: usize = 1 << 16;

/// The board's end.
pub(super) struct Tcp {
    listener: TcpListener,
    at: SocketAddr,
    host: Option<TcpStream>,
    waiting: VecDeque<u8>,
}

impl Tcp {
    /// Listens at `PORT` of this machine, or at `HOST:PORT`; port 0 is one that is free.
    pub(super) fn open(address: &str) -> Result<Self> {
        let failed = || format!("cannot listen at {address}; `--tcp 0` takes a port that is free");
        let listener = match address.parse::<u16>() {
            Ok(port) => TcpListener::bind((Ipv4Addr::LOCALHOST, port)),
            Err(_) => {
                let all: Vec<SocketAddr> =
                    address.to_socket_addrs().with_context(failed)?.collect();
                TcpListener::bind(all.as_slice())
            }
        };
        let listener = listener.with_context(failed)?;
        listener.set_nonblocking(true).with_context(failed)?;
        let at = listener.local_addr().with_context(failed)?;
        Ok(Self { listener, at, host: None, waiting: VecDeque::new() })
    }

    /// The name under which a host application opens it.
    pub(super) fn name(&self) -> String {
        format!("tcp:{}", self.at)
    }

    /// Whether a program has it open; waits a while for one.
    pub(super) fn wait(&mut self, pause: Duration) -> bool {
        std::thread::sleep(pause);
        // A second program would take a part of the bytes: it is let go.
        while let Ok((stream, _)) = self.listener.accept() {
            if self.host.is_none() && stream.set_nonblocking(true).is_ok() {
                let _ = stream.set_nodelay(true);
                self.waiting.clear();
                self.host = Some(stream);
            }
        }
        self.host.is_some()
    }

    /// The bytes that the host has sent.
    pub(super) fn read(&mut self) -> Vec<u8> {
        let mut bytes = vec![0; 4_096];
        let Some(host) = &mut self.host else { return Vec::new() };
        match host.read(&mut bytes) {
            Ok(count) if count > 0 => bytes.truncate(count),
            Err(error) if is_nothing(error.kind()) => bytes.clear(),
            Ok(_) | Err(_) => {
                self.host = None;
                bytes.clear();
            }
        }
        bytes
    }

    /// Sends as much as the host takes; the rest follows later.
    pub(super) fn write(&mut self, bytes: &[u8]) {
        let Some(host) = &mut self.host else { return self.waiting.clear() };
        if self.waiting.len() + bytes.len() > WAITING_MAX {
            self.waiting.clear();
        }
        self.waiting.extend(bytes);
        while !self.waiting.is_empty() {
            match host.write(self.waiting.as_slices().0) {
                Ok(count) if count > 0 => drop(self.waiting.drain(..count)),
                Err(error) if is_nothing(error.kind()) => return,
                Ok(_) | Err(_) => {
                    self.host = None;
                    return;
                }
            }
        }
    }
}

fn is_nothing(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted)
}
