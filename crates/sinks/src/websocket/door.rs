//! Where clients come in: an address in, a thread for each client out. It is tried again while somebody else has it.

use std::net::{SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::SyncSender;
use std::time::{Duration, Instant};

use sensedsl_limits::CLIENTS_MAX;

use super::Request;
use super::client::{self, Terms};
use crate::event::Outbox;

/// How often an address that is taken is tried again.
const BIND_EVERY: Duration = Duration::from_secs(1);

/// An address, and who has come in.
pub(crate) struct Door {
    listen: SocketAddr,
    terms: Arc<Terms>,
    listener: Option<TcpListener>,
    tried: Option<Instant>,
    last_number: u64,
    alive: Arc<AtomicUsize>,
}

impl Door {
    pub(crate) fn new(listen: SocketAddr, terms: Terms) -> Self {
        let (terms, alive) = (Arc::new(terms), Arc::default());
        Self { listen, terms, listener: None, tried: None, last_number: 0, alive }
    }

    /// Listens, as soon as the address is free, and lets in who waits; `open` is told people then.
    pub(crate) fn tend(
        &mut self,
        hub: &SyncSender<Request>,
        outbox: &Outbox,
        takes_commands: bool,
        open: &dyn Fn(SocketAddr) -> String,
    ) {
        if self.listener.is_none() && self.tried.is_none_or(|tried| tried.elapsed() >= BIND_EVERY) {
            self.tried = Some(Instant::now());
            self.bind(outbox, takes_commands, open);
        }
        let Some(listener) = &self.listener else { return };
        while let Ok((stream, _)) = listener.accept() {
            // One too many: the connection closes when it is dropped.
            if self.alive.load(Ordering::Relaxed) < CLIENTS_MAX {
                self.last_number += 1;
                let (terms, alive) = (Arc::clone(&self.terms), Arc::clone(&self.alive));
                client::start(self.last_number, stream, terms, hub.clone(), alive);
            }
        }
    }

    fn bind(&mut self, outbox: &Outbox, takes_commands: bool, open: &dyn Fn(SocketAddr) -> String) {
        let listener = TcpListener::bind(self.listen).and_then(|listener| {
            listener.set_nonblocking(true)?;
            Ok(listener)
        });
        match listener {
            Ok(listener) => {
                outbox.works();
                let at = listener.local_addr().unwrap_or(self.listen);
                outbox.note(&open(at));
                if !at.ip().is_loopback() {
                    let who = "everybody who reaches this address sees the values";
                    let may = if takes_commands { " and may set actuators" } else { "" };
                    outbox.note(&format!("{who}{may}"));
                }
                self.listener = Some(listener);
            }
            Err(error) => {
                let what = format!("cannot listen on {}: {error}", self.listen);
                outbox.broken(&what, "choose another address with `listen`, or end what has it");
            }
        }
    }
}
