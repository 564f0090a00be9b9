//! Where clients come in: an address in, a thread for each client out. It is tried again while somebody else has it.

use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::SyncSender;

use sensedsl_limits::CLIENTS_MAX;

use super::Request;
use super::client::{self, Terms};
use crate::event::Outbox;
use crate::listener::Listener;

/// An address, and who has come in.
pub(crate) struct Door {
    listener: Listener,
    terms: Arc<Terms>,
    last_number: u64,
    alive: Arc<AtomicUsize>,
}

impl Door {
    pub(crate) fn new(listener: Listener, terms: Terms) -> Self {
        let (terms, alive) = (Arc::new(terms), Arc::default());
        Self { listener, terms, last_number: 0, alive }
    }

    /// Lets in who waits; `open` is told people as soon as the address is bound.
    pub(crate) fn tend(
        &mut self,
        hub: &SyncSender<Request>,
        outbox: &Outbox,
        open: &dyn Fn(SocketAddr) -> String,
    ) {
        for stream in self.listener.accept(outbox, open) {
            // One too many: the connection closes when it is dropped.
            if self.alive.load(Ordering::Relaxed) < CLIENTS_MAX {
                self.last_number += 1;
                let (terms, alive) = (Arc::clone(&self.terms), Arc::clone(&self.alive));
                client::start(self.last_number, stream, terms, hub.clone(), alive);
            }
        }
    }
}
