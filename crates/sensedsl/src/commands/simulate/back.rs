//! A host that closes its port and opens it again, after a judge's run: it must be greeted, and must receive all values
//! again.

use std::collections::BTreeSet;

use anyhow::Result;
use sensedsl_model::design::Transport;

use super::run::{MS, Session};
use crate::status::Status;

/// A device that reported in such a time before the host left must report in such a time after its return.
const LOOK_NS: u64 = 1_000 * MS;
/// How long the host is away.
const AWAY_NS: u64 = 300 * MS;
/// The longest time until a shell listens.
const SHELL_NS: u64 = 100 * MS;
/// The longest time until the board must greet the host.
const GREETING_NS: u64 = 200 * MS;

/// The devices that have reported, each with the time of its last report.
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
    /// Leaves, comes back, and tells the judge what is missing. Does nothing in a world with faults.
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
            // Closing the port has brought the shell back.
            self.pass(SHELL_NS)?;
            self.ask_now();
        }
        let back_ns = self.now_ns;
        self.pass(GREETING_NS)?;
        let is_greeted = self.is_known;
        self.pass(LOOK_NS)?;
        // Code reports what it makes when it likes to.
        let devices = &self.scenery.job.devices;
        let is_codes = |id: &&u8| {
            devices
                .iter()
                .any(|one| one.device.id.value == **id && one.device.kind.code().is_some())
        };
        let after = self.reporters.since(back_ns);
        let missing: Vec<u8> =
            before.difference(&after).filter(|id| !is_codes(id)).copied().collect();
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
