//! The judge: it compares every value that a board reports with the world.
//!
//! A value that arrives was measured a little earlier; between measurement and arrival it is rounded, coded and
//! filtered. So it must lie in the range that the world had in a span of time, give or take the rounding. Span and
//! rounding are known for each device from its kind, its cycle and its filters. A value out of range, or one that does
//! not come at all, is a finding, and the worst one of each device is kept. Other findings are a device that reports
//! faster or more slowly than the file says, and a fault that the board itself counts for a device with which nothing
//! is wrong.

mod age;
mod counted;
mod filtered;
mod findings;
mod health;
mod load;
mod pace;
mod pressed;
mod sensor;
mod silence;
mod tolerance;
mod words;

use sensedsl_job::{BoardJob, JobDevice, Owner};
use sensedsl_wire::{Direction, Health, Scalar};

use crate::bench::Bench;
use crate::truth::Subject;
pub use findings::{DeviceFindings, Disagreement, Finding};
use health::SilentDeviceJudge;
use load::Load;
use sensor::SensorJudge;

/// The least number of reports for a verdict on how often a board reports.
const REPORTS_MIN: u64 = 100;

/// Compares reports with the world.
#[derive(Clone, Debug)]
pub struct Judge {
    devices: Vec<SensorJudge>,
    /// The actuators, whose health is all that is judged here.
    others: Vec<SilentDeviceJudge>,
    board: String,
    /// The identifiers of the board's devices, in order.
    ids: Vec<u8>,
    /// The board's name; `None` if something in the world disturbs the board.
    undisturbed: Option<String>,
    /// The number of reports received.
    received: u64,
    /// The times of the first and the last report.
    first_ns: Option<u64>,
    last_ns: u64,
    /// The shortest time from one report to the next.
    reporter_ns: u64,
    load: Load,
}

impl Judge {
    /// The judge of a board on its bench.
    #[must_use]
    pub fn new(job: &BoardJob<'_>, bench: &Bench) -> Self {
        let find = |subject: &Subject| job.devices.iter().find(|one| one.index == subject.device);
        // What code sets is the user's: the world says nothing of it.
        let is_codes = |one: &JobDevice<'_>| one.device.kind.code().is_some();
        let sensor = |subject: &Subject| {
            let one = find(subject).filter(|one| !is_codes(one))?;
            Some(SensorJudge::new(job, bench, one, subject))
        };
        let devices = bench.subjects().iter().filter_map(sensor).collect();
        let others = job.devices.iter().enumerate().filter(|(index, one)| {
            one.device.direction == Direction::Actuator
                && !is_codes(one)
                && job.owner(*index) == Owner::Host
        });
        let name = job.board.name.value.clone();
        let mut ids: Vec<u8> = job.devices.iter().map(|one| one.device.id.value).collect();
        ids.sort_unstable();
        Self {
            devices,
            board: name.clone(),
            ids,
            others: others.map(|(_, one)| SilentDeviceJudge::new(job, bench, one)).collect(),
            undisturbed: (!bench.is_disturbed()).then_some(name),
            received: 0,
            first_ns: None,
            last_ns: 0,
            reporter_ns: pace::reporter_ns(job),
            load: Load::default(),
        }
    }

    /// A report has arrived.
    pub fn take(&mut self, now_ns: u64, values: &[(u8, Vec<Scalar>)]) {
        self.received += 1;
        self.last_ns = now_ns;
        let first_ns = *self.first_ns.get_or_insert(now_ns);
        for (id, elements) in values {
            if let Some(sensor) = self.devices.iter_mut().find(|one| one.subject.id == *id) {
                sensor.take(now_ns, first_ns, elements);
            }
        }
    }

    /// Takes the time for which the board's processor has worked, if it is known.
    pub fn worked(&mut self, now_ns: u64, worked_ns: Option<u64>) {
        if let Some(worked_ns) = worked_ns {
            self.load.take(now_ns, worked_ns);
        }
    }

    /// The board has answered its host, with a hello or a health report, instead of sending a report that was due.
    pub fn answered(&mut self) {
        for sensor in &mut self.devices {
            sensor.answered();
        }
    }

    /// Takes the time at which the host last set each actuator, by identifier.
    pub fn reported(&mut self, reported: &[(u8, u64)]) {
        for (id, at_ns) in reported {
            if let Some(other) = self.others.iter_mut().find(|one| one.id == *id) {
                other.reported_ns = Some(*at_ns);
            }
        }
    }

    /// The number of reports received.
    #[must_use]
    pub const fn received(&self) -> u64 {
        self.received
    }

    /// The board has reported its own health and that of its devices, after this many reports.
    pub fn health(&mut self, now_ns: u64, health: &Health, received: u64) {
        if let Some(board) = self.undisturbed.clone() {
            let what = health::board_differs(health, now_ns, received);
            let load = self.load.differs(health).filter(|_| what.is_none());
            for what in what.into_iter().chain(load) {
                self.say_of_board(now_ns, &board, what);
            }
        }
        if let Some(what) = self.rows_differ(health) {
            let board = self.board.clone();
            self.say_of_board(now_ns, &board, what);
        }
        for row in &health.devices {
            if let Some(sensor) = self.devices.iter_mut().find(|one| one.subject.id == row.id) {
                sensor.health(now_ns, row);
            }
            if let Some(other) = self.others.iter_mut().find(|one| one.id == row.id) {
                other.health(now_ns, row);
            }
        }
    }

    /// The error in the list of devices that the board reports: each of its own must be there once, and no others.
    fn rows_differ(&self, health: &Health) -> Option<String> {
        let mut ids: Vec<u8> = health.devices.iter().map(|row| row.id).collect();
        ids.sort_unstable();
        let reported =
            |ids: &[u8]| ids.iter().map(u8::to_string).collect::<Vec<String>>().join(", ");
        (ids != self.ids).then(|| {
            format!(
                "it speaks of the devices {}, and not of {}",
                reported(&ids),
                reported(&self.ids)
            )
        })
    }

    /// The board was asked for its health and did not answer.
    pub fn no_health(&mut self, now_ns: u64, board: &str) {
        self.say_of_board(now_ns, board, "nothing, though it was asked".to_owned());
    }

    /// The board has handled the return of its host wrongly.
    pub fn comes_back(&mut self, now_ns: u64, what: String) {
        let mut judged = DeviceFindings::new(self.board.clone(), None);
        judged.note(Some(Disagreement {
            at_ns: now_ns,
            finding: Finding::Transfer(what),
            off: 200_000.0,
        }));
        self.others.push(SilentDeviceJudge { id: 0, judged, is_well: false, reported_ns: None });
    }

    /// The board has treated parts on buses in ways that their drivers do not describe.
    pub fn transfers(&mut self, now_ns: u64, odd: &[(String, String)]) {
        for (part, what) in odd {
            let mut judged = DeviceFindings::new(part.clone(), None);
            let finding = Finding::Transfer(what.clone());
            judged.note(Some(Disagreement { at_ns: now_ns, finding, off: 50.0 }));
            self.others.push(SilentDeviceJudge {
                id: 0,
                judged,
                is_well: false,
                reported_ns: None,
            });
        }
    }

    fn say_of_board(&mut self, now_ns: u64, board: &str, what: String) {
        let mut judged = DeviceFindings::new(board.to_owned(), None);
        judged.note(Some(health::wrong(now_ns, what)));
        self.others.push(SilentDeviceJudge { id: 0, judged, is_well: false, reported_ns: None });
    }

    /// The finding if the board sends more than one report in each cycle of its reporter.
    fn hurries(&self) -> Option<Disagreement> {
        let between = self.received.checked_sub(1).filter(|between| *between >= REPORTS_MIN)?;
        let got_ns = self.last_ns.saturating_sub(self.first_ns?) / between;
        let expected_ns = (self.reporter_ns, self.reporter_ns);
        (got_ns < self.reporter_ns - self.reporter_ns / 20).then_some(Disagreement {
            at_ns: self.last_ns,
            finding: Finding::Pace { expected_ns, got_ns },
            off: 1_000.0,
        })
    }

    /// Ends the run and returns the findings.
    #[must_use]
    pub fn finish(mut self, now_ns: u64) -> Vec<DeviceFindings> {
        if let Some(wrong) = self.hurries() {
            let mut judged = DeviceFindings::new(self.board.clone(), None);
            judged.note(Some(wrong));
            self.others.push(SilentDeviceJudge {
                id: 0,
                judged,
                is_well: false,
                reported_ns: None,
            });
        }
        for sensor in &mut self.devices {
            sensor.finish(now_ns);
        }
        let others = self.others.into_iter().map(|one| one.judged);
        let sensors = self.devices.into_iter().map(|one| one.judged);
        sensors.chain(others.filter(|one| one.wrong > 0)).collect()
    }
}
