//! An address at which this program listens for others: bound as soon as nobody else has it, with what people must know
//! about it.

use std::net::{SocketAddr, TcpListener, TcpStream};
use std::time::{Duration, Instant};

use crate::event::Outbox;

/// How often an address that is taken is tried again.
const BIND_EVERY: Duration = Duration::from_secs(1);

/// The address.
pub(crate) struct Listener {
    at: SocketAddr,
    /// Whether who connects may set actuators.
    takes_commands: bool,
    socket: Option<TcpListener>,
    tried: Option<Instant>,
}

impl Listener {
    pub(crate) fn new(at: SocketAddr, takes_commands: bool) -> Self {
        Self { at, takes_commands, socket: None, tried: None }
    }

    /// Who has connected since the last call; `open` is told people as soon as the address is bound.
    pub(crate) fn accept(
        &mut self,
        outbox: &Outbox,
        open: &dyn Fn(SocketAddr) -> String,
    ) -> Vec<TcpStream> {
        if self.socket.is_none() && self.tried.is_none_or(|tried| tried.elapsed() >= BIND_EVERY) {
            self.tried = Some(Instant::now());
            self.bind(outbox, open);
        }
        let Some(socket) = &self.socket else { return Vec::new() };
        std::iter::from_fn(|| socket.accept().ok()).map(|(stream, _)| stream).collect()
    }

    fn bind(&mut self, outbox: &Outbox, open: &dyn Fn(SocketAddr) -> String) {
        let socket = TcpListener::bind(self.at).and_then(|socket| {
            socket.set_nonblocking(true)?;
            Ok(socket)
        });
        match socket {
            Ok(socket) => {
                outbox.works();
                let at = socket.local_addr().unwrap_or(self.at);
                outbox.note(&open(at));
                if !at.ip().is_loopback() {
                    let may = if self.takes_commands { " and may set actuators" } else { "" };
                    outbox
                        .note(&format!("everybody who reaches this address sees the values{may}"));
                }
                self.socket = Some(socket);
            }
            Err(error) => {
                let what = format!("cannot listen on {}: {error}", self.at);
                outbox.broken(&what, "choose another address with `listen`, or end what has it");
            }
        }
    }
}
