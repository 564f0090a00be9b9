//! A pseudo-terminal: to a host application, it looks like the device of a board.

use std::collections::VecDeque;
use std::fs::OpenOptions;
use std::os::fd::OwnedFd;
use std::time::Duration;

use anyhow::{Context as _, Result};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{OFlags, fcntl_setfl};
use rustix::io::{FdFlags, fcntl_setfd};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

/// The most bytes that wait for a host that does not read.
const WAITING_MAX: usize = 1 << 16;

/// The board's end.
pub(crate) struct Pty {
    board: OwnedFd,
    name: String,
    waiting: VecDeque<u8>,
}

impl Pty {
    pub(crate) fn open() -> Result<Self> {
        let failed = "the system gives no pseudo-terminal; `--stdout` needs none";
        let board = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).context(failed)?;
        // Not a flag of the call, which macOS does not have: no program is started in between.
        fcntl_setfd(&board, FdFlags::CLOEXEC).context(failed)?;
        grantpt(&board).context(failed)?;
        unlockpt(&board).context(failed)?;
        let name = ptsname(&board, Vec::new()).context(failed)?.to_string_lossy().into_owned();
        // Opening it once makes the system report whether another program has it open. The settings stay.
        let host = OpenOptions::new().read(true).write(true).open(&name).context(failed)?;
        let mut settings = tcgetattr(&host).context(failed)?;
        settings.make_raw();
        tcsetattr(&host, OptionalActions::Now, &settings).context(failed)?;
        fcntl_setfl(&board, OFlags::NONBLOCK).context(failed)?;
        Ok(Self { board, name, waiting: VecDeque::new() })
    }

    /// The name under which a host application opens it.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Whether a program has it open; waits a while for something to happen.
    pub(crate) fn wait(&self, pause: Duration) -> bool {
        let mut wanted = [PollFd::new(&self.board, PollFlags::IN)];
        let most = Timespec { tv_sec: 0, tv_nsec: pause.subsec_nanos().into() };
        match poll(&mut wanted, Some(&most)) {
            Ok(_) if wanted.iter().all(|one| !one.revents().contains(PollFlags::HUP)) => true,
            // While no program has it open, poll returns at once, so the pause has to be made here.
            Ok(_) => {
                std::thread::sleep(pause);
                false
            }
            Err(_) => true,
        }
    }

    /// Whether a program has it open.
    pub(crate) fn is_connected(&self) -> bool {
        let mut wanted = [PollFd::new(&self.board, PollFlags::IN)];
        let is_asked = poll(&mut wanted, Some(&Timespec { tv_sec: 0, tv_nsec: 0 }));
        is_asked.is_ok() && wanted.iter().all(|one| !one.revents().contains(PollFlags::HUP))
    }

    /// The bytes that the host has sent.
    pub(crate) fn read(&self) -> Vec<u8> {
        let mut bytes = vec![0; 4_096];
        let count = rustix::io::read(&self.board, &mut bytes).unwrap_or(0);
        bytes.truncate(count);
        bytes
    }

    /// Sends as much as the host takes; the rest follows later. Without a host, everything is dropped.
    pub(crate) fn write(&mut self, bytes: &[u8], is_connected: bool) {
        if !is_connected || self.waiting.len() + bytes.len() > WAITING_MAX {
            self.waiting.clear();
        }
        if !is_connected {
            return;
        }
        self.waiting.extend(bytes);
        while !self.waiting.is_empty() {
            let next = self.waiting.as_slices().0;
            match rustix::io::write(&self.board, next) {
                Ok(0) | Err(_) => return,
                Ok(count) => drop(self.waiting.drain(..count)),
            }
        }
    }
}
