//! The judge: every value that a board reports against what the world did.
//!
//! A value that arrives at some time was measured a little earlier, and between measuring and arriving it is rounded,
//! coded and filtered. So it must lie within what the world was in a span of time, give or take what rounding can do.
//! Both are known for each device from its kind, its cycle and its filters. What is out of it, or does not come at all,
//! is a disagreement, and the worst of each device is kept. So is a device that reports faster or more slowly than the
//! file says, and what the board itself counts of a device with which nothing is wrong.

mod age;
mod counted;
mod filtered;
mod health;
mod load;
mod pace;
mod pressed;
mod sensor;
mod silence;
mod tolerance;
mod words;

use sensedsl_job::BoardJob;
use sensedsl_wire::{Direction, Health, Scalar};

use crate::bench::Bench;
use crate::truth::Subject;
use health::OtherJudge;
use load::Load;
use sensor::SensorJudge;

const MS: u64 = 1_000_000;
const SECOND: u64 = 1_000 * MS;
/// So many reports tell how often a board reports.
const REPORTS_MIN: u64 = 100;

/// Something that disagrees.
#[derive(Clone, Debug, PartialEq)]
pub struct Wrong {
    /// When it was noticed.
    pub at_ns: u64,
    /// What.
    pub finding: Finding,
    /// How far it is off, in tolerances.
    pub off: f64,
}

/// What disagrees, in the device's own unit.
#[derive(Clone, Debug, PartialEq)]
pub enum Finding {
    /// A value is not what the world was.
    Value {
        /// Of which element.
        element: usize,
        /// What it should have been: from, to.
        expected: (f64, f64),
        /// What it was.
        got: f64,
    },
    /// Nothing came for so many seconds.
    Silence(f64),
    /// Reports come too fast or too slowly: nanoseconds from one to the next on average.
    Pace {
        /// What it should have been: from, to.
        expected_ns: (u64, u64),
        /// What it was.
        got_ns: u64,
    },
    /// What counts is told too late: nanoseconds after it has changed, on average.
    Late {
        /// How late it may be.
        most_ns: u64,
        /// How late it was.
        got_ns: u64,
    },
    /// A contact was the other way so often, for a little longer than it must last, and it was never told.
    Unseen {
        /// How often.
        count: u64,
        /// How long it must last.
        lasting_ns: u64,
    },
    /// A count that has not changed is told again after so many nanoseconds.
    Again(u64),
    /// A value that is `invalid` was reported.
    Invalid(f64),
    /// A value was reported that differs from the one before it by less than `change`.
    Unchanged {
        /// The value.
        got: f64,
        /// The one before it.
        before: f64,
    },
    /// What the board says of the device, though nothing in the world is wrong with it.
    Health(String),
    /// What the board does with the part on its bus.
    Transfer(String),
}

/// What was found out about a device.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub quantity: String,
    /// Values that were compared.
    pub reports: u64,
    /// Values during and right after a fault that concerns it; they are not compared.
    pub excused: u64,
    /// Values that disagree, and silences.
    pub wrong: u64,
    /// The worst of them.
    pub worst: Option<Wrong>,
    /// How old a value may be.
    pub age_ns: u64,
    /// From one report to the next, on average; none where too few came.
    pub every_ns: Option<u64>,
}

/// Compares reports with the world.
#[derive(Clone, Debug)]
pub struct Judge {
    devices: Vec<SensorJudge>,
    /// The actuators, of which only their health is known here.
    others: Vec<OtherJudge>,
    board: String,
    /// Its devices, in order.
    ids: Vec<u8>,
    /// The board's name, where nothing in the world disturbs it.
    undisturbed: Option<String>,
    /// Reports that came.
    heard: u64,
    /// When the first of them came, and the last.
    first_ns: Option<u64>,
    last_ns: u64,
    /// From one report to the next at least.
    reporter_ns: u64,
    load: Load,
}

impl Judged {
    fn new(name: String, quantity: Option<String>) -> Self {
        let quantity = quantity.unwrap_or_default();
        Self {
            name,
            quantity,
            reports: 0,
            excused: 0,
            wrong: 0,
            worst: None,
            age_ns: 0,
            every_ns: None,
        }
    }

    /// Counts what disagrees, and keeps the worst.
    fn note(&mut self, wrong: Option<Wrong>) {
        let Some(wrong) = wrong else { return };
        self.wrong += 1;
        if self.worst.as_ref().is_none_or(|worst| worst.off < wrong.off) {
            self.worst = Some(wrong);
        }
    }
}

impl Judge {
    /// The judge of a board on its bench.
    #[must_use]
    pub fn new(job: &BoardJob<'_>, bench: &Bench) -> Self {
        let find = |subject: &Subject| job.devices.iter().find(|one| one.index == subject.device);
        let sensor =
            |subject: &Subject| Some(SensorJudge::new(job, bench, find(subject)?, subject));
        let devices = bench.subjects().iter().filter_map(sensor).collect();
        let others = job.devices.iter().filter(|one| one.device.direction == Direction::Actuator);
        let name = job.board.name.value.clone();
        let mut ids: Vec<u8> = job.devices.iter().map(|one| one.device.id.value).collect();
        ids.sort_unstable();
        Self {
            devices,
            board: name.clone(),
            ids,
            others: others.map(|one| OtherJudge::new(job, bench, one)).collect(),
            undisturbed: (!bench.is_disturbed()).then_some(name),
            heard: 0,
            first_ns: None,
            last_ns: 0,
            reporter_ns: pace::reporter_ns(job),
            load: Load::default(),
        }
    }

    /// A report has arrived.
    pub fn take(&mut self, now_ns: u64, values: &[(u8, Vec<Scalar>)]) {
        self.heard += 1;
        self.last_ns = now_ns;
        let first_ns = *self.first_ns.get_or_insert(now_ns);
        for (id, elements) in values {
            if let Some(sensor) = self.devices.iter_mut().find(|one| one.subject.id == *id) {
                sensor.take(now_ns, first_ns, elements);
            }
        }
    }

    /// For how long the board's processor has worked, where that is known.
    pub fn worked(&mut self, now_ns: u64, worked_ns: Option<u64>) {
        if let Some(worked_ns) = worked_ns {
            self.load.take(now_ns, worked_ns);
        }
    }

    /// The board has answered its host, with a hello or with its health, in place of a report that was due.
    pub fn answered(&mut self) {
        for sensor in &mut self.devices {
            sensor.answered();
        }
    }

    /// When the host has set an actuator last, by its identifier.
    pub fn told(&mut self, told: &[(u8, u64)]) {
        for (id, at_ns) in told {
            if let Some(other) = self.others.iter_mut().find(|one| one.id == *id) {
                other.told_ns = Some(*at_ns);
            }
        }
    }

    /// The board has said how it and its devices are.
    pub fn health(&mut self, now_ns: u64, health: &Health) {
        if let Some(board) = self.undisturbed.clone() {
            let what = health::board_differs(health, now_ns, self.heard);
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

    /// What disagrees of the devices that the board speaks of: each of its own once, and no others.
    fn rows_differ(&self, health: &Health) -> Option<String> {
        let mut ids: Vec<u8> = health.devices.iter().map(|row| row.id).collect();
        ids.sort_unstable();
        let told = |ids: &[u8]| ids.iter().map(u8::to_string).collect::<Vec<String>>().join(", ");
        (ids != self.ids).then(|| {
            format!("it speaks of the devices {}, and not of {}", told(&ids), told(&self.ids))
        })
    }

    /// The board was asked how it is, and did not say it.
    pub fn no_health(&mut self, now_ns: u64, board: &str) {
        self.say_of_board(now_ns, board, "nothing, though it was asked".to_owned());
    }

    /// What the board does with a host that has left and is back.
    pub fn comes_back(&mut self, now_ns: u64, what: String) {
        let mut judged = Judged::new(self.board.clone(), None);
        judged.note(Some(Wrong {
            at_ns: now_ns,
            finding: Finding::Transfer(what),
            off: 200_000.0,
        }));
        self.others.push(OtherJudge { id: 0, judged, is_well: false, told_ns: None });
    }

    /// What the board has done with parts on buses that their drivers do not say.
    pub fn transfers(&mut self, now_ns: u64, odd: &[(String, String)]) {
        for (part, what) in odd {
            let mut judged = Judged::new(part.clone(), None);
            let finding = Finding::Transfer(what.clone());
            judged.note(Some(Wrong { at_ns: now_ns, finding, off: 50.0 }));
            self.others.push(OtherJudge { id: 0, judged, is_well: false, told_ns: None });
        }
    }

    fn say_of_board(&mut self, now_ns: u64, board: &str, what: String) {
        let mut judged = Judged::new(board.to_owned(), None);
        judged.note(Some(health::wrong(now_ns, what)));
        self.others.push(OtherJudge { id: 0, judged, is_well: false, told_ns: None });
    }

    /// Whether the board sends more reports than one in each cycle of its reporter.
    fn hurries(&self) -> Option<Wrong> {
        let between = self.heard.checked_sub(1).filter(|between| *between >= REPORTS_MIN)?;
        let got_ns = self.last_ns.saturating_sub(self.first_ns?) / between;
        let expected_ns = (self.reporter_ns, self.reporter_ns);
        (got_ns < self.reporter_ns - self.reporter_ns / 20).then_some(Wrong {
            at_ns: self.last_ns,
            finding: Finding::Pace { expected_ns, got_ns },
            off: 1_000.0,
        })
    }

    /// The run is over.
    #[must_use]
    pub fn finish(mut self, now_ns: u64) -> Vec<Judged> {
        if let Some(wrong) = self.hurries() {
            let mut judged = Judged::new(self.board.clone(), None);
            judged.note(Some(wrong));
            self.others.push(OtherJudge { id: 0, judged, is_well: false, told_ns: None });
        }
        for sensor in &mut self.devices {
            sensor.finish(now_ns);
        }
        let others = self.others.into_iter().map(|one| one.judged);
        let sensors = self.devices.into_iter().map(|one| one.judged);
        sensors.chain(others.filter(|one| one.wrong > 0)).collect()
    }
}
