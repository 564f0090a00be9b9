//! A host that closes its port and opens it again, after a judge's run: it must be greeted, and be told everything anew.

use std::collections::BTreeSet;

use anyhow::Result;
use sensedsl_model::design::Transport;

use super::run::{MS, Session};
use crate::Status;

/// What reported in so long before the host left must do so in so long after it is back.
const LOOK_NS: u64 = 1_000 * MS;
/// How long it is away.
const AWAY_NS: u64 = 300 * MS;
/// How long a shell may take until it listens.
const SHELL_NS: u64 = 100 * MS;
/// How soon it must be greeted.
const GREETING_NS: u64 = 200 * MS;

/// Who has reported, and when last.
#[derive(Default)]
pub(super) struct Reporters(std::collections::BTreeMap<u8, u64>);

impl Reporters {
    pub(super) fn take(&mut self, id: u8, now_ns: u64) {
        let _ = self.0.insert(id, now_ns);
    }

    fn since(&self, from_ns: u64) -> BTreeSet<u8> {
        self.0.iter().filter(|(_, at_ns)| **at_ns > from_ns).map(|(id, _)| *id).collect()
    }
}

impl Session<'_> {
    /// Leaves, comes back, and tells the judge what is missing. A world with faults is left alone.
    pub(super) fn come_back(&mut self) -> Result<Status> {
        let is_usb = self.scenery.job.board.link.transport == Transport::Usb;
        if !is_usb || self.is_disturbed {
            return Ok(Status::Done);
        }
        let before = self.reporters.since(self.now_ns.saturating_sub(LOOK_NS));
        self.is_judged = false;
        self.board.link_open(false);
        self.pass(AWAY_NS)?;
        self.is_known = false;
        self.board.link_open(true);
        if self.has_shell {
            // Closing the port has brought it back.
            self.pass(SHELL_NS)?;
            self.ask_now();
        }
        let back_ns = self.now_ns;
        self.pass(GREETING_NS)?;
        let is_greeted = self.is_known;
        self.pass(LOOK_NS)?;
        let missing: Vec<u8> = before.difference(&self.reporters.since(back_ns)).copied().collect();
        let name = |id: &u8| {
            let item = self.scenery.job.schema.items.iter().find(|item| item.id == *id);
            item.map_or_else(|| id.to_string(), |item| item.name.clone())
        };
        let missing: Vec<String> = missing.iter().map(name).collect();
        if !is_greeted {
            let what = "a host that closes its port and opens it again is not greeted";
            self.judge.comes_back(self.now_ns, what.to_owned());
        } else if !missing.is_empty() {
            let what = format!("a host that is back hears nothing of {}", missing.join(", "));
            self.judge.comes_back(self.now_ns, what);
        }
        Ok(self.trouble()?.unwrap_or(Status::Done))
    }

    fn pass(&mut self, for_ns: u64) -> Result<()> {
        let end_ns = self.now_ns + for_ns;
        while self.now_ns < end_ns {
            let _ = self.step(None)?;
        }
        Ok(())
    }
}
