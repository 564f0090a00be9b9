//! What a host does beside its session: it tells each fault of a device once, and keeps actuators from their failsafe.

use std::time::Duration;

use sensedsl_wire::{Health, Status, encode_hello_request};

use crate::schema::Board;
use crate::session::State;
use crate::words::{causes, status};

/// The faults of devices that were told.
#[derive(Clone, Debug)]
pub struct Faults {
    told: Vec<Option<Status>>,
}

impl Faults {
    /// For a board of which nothing was told.
    #[must_use]
    pub fn new(board: &Board) -> Self {
        Self { told: vec![None; board.devices.len()] }
    }

    /// A sentence for each device that is at fault now and was not before, or in another way.
    #[must_use]
    pub fn news(&mut self, board: &Board, health: &Health) -> Vec<String> {
        let all = self.told.iter_mut().zip(&board.devices).zip(&health.devices);
        let news = all.filter_map(|((told, device), one)| {
            let fault = Some(one.status).filter(|is| matches!(is, Status::Failed | Status::Stale));
            let last = std::mem::replace(told, fault);
            if fault.is_none() || last == fault {
                return None;
            }
            let why = causes(one.causes.counts());
            let why = if why.is_empty() { why } else { format!(" ({why})") };
            Some(format!("{}: {}{why}", device.name, status(one.status)))
        });
        news.collect()
    }
}

/// The question that keeps actuators from their failsafe, if nothing was sent for long enough. To be asked while
/// something is set.
#[must_use]
pub fn keep_alive(board: &Board, state: State, quiet: Duration) -> Option<Vec<u8>> {
    let silence_ms = board.silence_ms.filter(|_| state == State::Matched)?;
    // Several frames may be lost on the way.
    let is_time = quiet >= Duration::from_millis(u64::from(silence_ms) / 4);
    is_time.then(|| encode_hello_request(&board.schema))
}
