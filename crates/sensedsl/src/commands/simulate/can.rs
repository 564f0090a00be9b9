//! The CAN buses of a simulated board as adapters on pseudo-terminals, one for each bus.

use anyhow::Result;
use std::time::Duration;

use sensedsl_twin::bench::Peer;

use super::pty::Pty;
use super::slcan::Slcan;
use crate::terminal::Terminal;

/// All adapters, and the peer that is connected through them.
pub(super) struct Adapters {
    peer: Peer,
    all: Vec<Adapter>,
}

struct Adapter {
    unit: u8,
    pty: Pty,
    line: Slcan,
}

impl Adapters {
    /// Opens a pseudo-terminal for each bus, and prints its name.
    pub(super) fn open(peer: &Peer, terminal: &Terminal) -> Result<Self> {
        let mut all = Vec::new();
        for unit in peer.units() {
            let (pty, line) = (Pty::open()?, Slcan::default());
            terminal.note(&format!("CAN{unit} is at {}\n", pty.name()))?;
            all.push(Adapter { unit, pty, line });
        }
        if all.is_empty() {
            terminal.aside("no device is on a CAN bus, so `--can` opens none")?;
        } else {
            terminal
                .aside("an adapter with the protocol slcan: python-can's `slcan`, or slcand")?;
        }
        Ok(Self { peer: peer.clone(), all })
    }

    /// Moves frames between the board and the programs on its buses.
    pub(super) fn turn(&mut self) {
        for Adapter { unit, pty, line } in &mut self.all {
            let is_connected = pty.wait(Duration::ZERO);
            if !is_connected {
                *line = Slcan::default();
            }
            let mut bytes = Vec::new();
            let received = if is_connected { pty.read() } else { Vec::new() };
            for frame in line.feed(&received, &mut bytes) {
                self.peer.send(*unit, frame);
            }
            for frame in self.peer.receive(*unit) {
                line.show(&frame, &mut bytes);
            }
            pty.write(&bytes, is_connected);
        }
    }
}
