//! Between the host's loop, which never waits, and a sink's thread, which may.
//!
//! In: [`News`]. Out: events in a bounded queue, no more of each device than its rate allows, and the sink's wishes. Of
//! values that are too many the latest goes out as soon as it may; what the queue does not take is counted and told.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, TrySendError, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use sensedsl_host::{Moment, News, Output, Report, What, Wish};
use sensedsl_wire::{Scalar, Stamp};

use crate::event::{Event, Inbox, Outbox, Sink, Values};
use crate::plan::Plan;

/// How many events wait for a sink.
const QUEUE_MAX: usize = 1_024;
/// How many words of presence and health wait for room in the queue.
const WAITING_MAX: usize = 64;
/// How long a sink may take to say goodbye.
const CLOSES_WITHIN: Duration = Duration::from_millis(1_500);
const POLL: Duration = Duration::from_millis(5);

/// A device's rate limit.
#[derive(Clone, Debug, Default)]
struct Gate {
    /// From when on the next value may pass.
    opens: Duration,
    /// The latest value that had to wait.
    waiting: Option<Waiting>,
}

#[derive(Clone, Debug)]
struct Waiting {
    taken: Duration,
    stamp: Option<Stamp>,
    latency: Option<Duration>,
    is_command: bool,
    value: Vec<Scalar>,
}

impl Gate {
    fn passes(&mut self, now: Duration, period: Option<Duration>) -> bool {
        let Some(period) = period else { return true };
        if now < self.opens {
            return false;
        }
        // A value that comes a little late does not make the next ones later still.
        let is_late = now.saturating_sub(self.opens) < period / 2;
        self.opens = if is_late { self.opens + period } else { now + period };
        true
    }
}

/// An [`Output`] that hands everything to a sink.
pub struct Relay {
    plan: Arc<Plan>,
    gates: Vec<Vec<Gate>>,
    queue: Option<SyncSender<Event>>,
    waiting: VecDeque<Event>,
    outbox: Outbox,
    thread: Option<JoinHandle<()>>,
    missed: u64,
}

impl Relay {
    /// Starts the sink's thread.
    #[must_use]
    pub fn start(name: &'static str, plan: Arc<Plan>, sink: Box<dyn Sink>) -> Self {
        let (queue, events) = sync_channel(QUEUE_MAX);
        let outbox = Outbox::new(name);
        let own = outbox.clone();
        let thread = std::thread::spawn(move || sink.run(&Inbox(events), &own));
        let gates = plan.boards.iter().map(|board| vec![Gate::default(); board.routes.len()]);
        let gates = gates.collect();
        let (queue, thread, waiting) = (Some(queue), Some(thread), VecDeque::new());
        Self { plan, gates, queue, waiting, outbox, thread, missed: 0 }
    }

    fn report(&mut self, board: usize, at: Moment, report: &Report, is_command: bool) {
        let Report { stamp, latency, values } = report;
        let (stamp, latency) = (*stamp, *latency);
        let taken = at.unix.saturating_sub(latency.unwrap_or_default());
        let Some(on) = self.plan.boards.get(board) else { return };
        let Some(gates) = self.gates.get_mut(board) else { return };
        let mut passing = Vec::new();
        for (index, value) in values {
            let (Some(route), Some(gate)) = (on.routes.get(*index), gates.get_mut(*index)) else {
                continue;
            };
            if route.is_left_out && !route.is_in_message {
                continue;
            }
            let value = value.clone();
            if gate.passes(at.run, route.period) {
                gate.waiting = None;
                passing.push((*index, value));
            } else {
                gate.waiting = Some(Waiting { taken, stamp, latency, is_command, value });
            }
        }
        if !passing.is_empty() {
            let values = Values { board, taken, stamp, latency, is_command, values: passing };
            self.send(Event::Values(values));
        }
    }

    /// The values that had to wait and may pass now.
    fn let_pass(&mut self, now: Duration) {
        let mut due = Vec::new();
        for (board, (on, gates)) in self.plan.boards.iter().zip(&mut self.gates).enumerate() {
            for (index, (route, gate)) in on.routes.iter().zip(gates).enumerate() {
                if gate.waiting.is_some()
                    && gate.passes(now, route.period)
                    && let Some(one) = gate.waiting.take()
                {
                    let Waiting { taken, stamp, latency, is_command, value } = one;
                    let values = vec![(index, value)];
                    due.push(Values { board, taken, stamp, latency, is_command, values });
                }
            }
        }
        due.into_iter().for_each(|values| self.send(Event::Values(values)));
    }

    /// Hands an event over. Values that find no room are lost, everything else waits for it.
    fn send(&mut self, event: Event) {
        self.send_waiting();
        let Some(queue) = &self.queue else { return };
        let is_value = matches!(event, Event::Values(_));
        if !is_value && !self.waiting.is_empty() {
            return self.wait(event);
        }
        match queue.try_send(event) {
            Ok(()) | Err(TrySendError::Disconnected(_)) => {}
            Err(TrySendError::Full(_)) if is_value => self.missed += 1,
            Err(TrySendError::Full(event)) => self.wait(event),
        }
    }

    fn wait(&mut self, event: Event) {
        if self.waiting.len() == WAITING_MAX {
            self.waiting.pop_front();
        }
        self.waiting.push_back(event);
    }

    fn send_waiting(&mut self) {
        let Some(queue) = &self.queue else { return };
        while let Some(event) = self.waiting.pop_front() {
            if let Err(TrySendError::Full(event)) = queue.try_send(event) {
                return self.waiting.push_front(event);
            }
        }
    }
}

impl Output for Relay {
    fn take(&mut self, news: &News<'_>) {
        let board = news.board;
        match news.what {
            What::Report(report) => self.report(board, news.at, report, false),
            What::Command { device, value } => {
                let values = vec![(device, value.to_vec())];
                let report = Report { stamp: None, latency: None, values };
                self.report(board, news.at, &report, true);
            }
            What::Online => self.send(Event::Presence { board, away: None }),
            What::Offline(why) => self.send(Event::Presence { board, away: Some(why.to_owned()) }),
            What::Health(health) => {
                let (at, health) = (news.at.unix, health.clone());
                self.send(Event::Health { board, at, health });
            }
            What::Received(_) | What::Sent(_) => {}
        }
    }

    fn look(&mut self, now: Moment) -> Vec<Wish> {
        self.send_waiting();
        self.let_pass(now.run);
        self.outbox.take()
    }

    fn close(&mut self, _now: Moment) -> Vec<Wish> {
        self.send_waiting();
        self.queue = None;
        if let Some(thread) = self.thread.take() {
            let mut waited = Duration::ZERO;
            while !thread.is_finished() && waited < CLOSES_WITHIN {
                std::thread::sleep(POLL);
                waited += POLL;
            }
        }
        if self.missed > 0 {
            self.outbox.note(&format!("{} reports did not fit its queue", self.missed));
        }
        self.outbox.take()
    }
}
