//! A board that a page talks to: simulated here, or a real one whose bytes the page carries.
//!
//! Both have the same host, so that a page shows them in the same way. Only one is there at a time; a worker that is
//! ended frees it with everything that it needed.

mod calls;
mod info;
mod robot;
mod seen;

use std::time::Duration;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_host::{Board, Session};
use sensedsl_job::{BoardJob, jobs};
use sensedsl_report::schema::schema;
use sensedsl_twin::bench::Bench;
use sensedsl_twin::soft::UserCode;
use sensedsl_twin::world::World;
use serde_json::{Value, json};

pub use self::calls::ServedBoard;
pub(crate) use self::calls::{BoardCall, with};
use self::robot::Robot;
use self::seen::Watch;
use crate::request::Request;

/// A board and its host.
pub(crate) struct Live {
    board: &'static Board,
    session: Session<'static>,
    watch: Watch,
    /// None for a real board.
    robot: Option<Robot>,
    /// What is to be sent to a real board beside the host's own questions.
    outbox: Vec<u8>,
    now: Duration,
}

/// What is wanted of a design.
pub(crate) struct Wanted<'a> {
    pub(crate) of: &'a Request,
    /// The board's name in the design; the first one if none is given.
    pub(crate) name: Option<&'a str>,
    pub(crate) around: Around<'a>,
    pub(crate) outside: Option<&'a dyn Outside>,
}

/// What is around a board.
#[derive(Clone, Copy)]
pub(crate) enum Around<'a> {
    /// It is a real one.
    Nothing,
    /// It is simulated in a world: that of one of the files, or the usual one.
    World(Option<&'a str>),
}

/// What a page by itself has not: programs of the computer that serves it.
pub trait Outside {
    /// The code of a board's controllers, built and started; `None` where there is none. `design` is the path of the
    /// design among the page's files.
    ///
    /// # Errors
    /// What is wrong with it.
    fn code(
        &self,
        design: &str,
        job: &BoardJob<'_>,
    ) -> Result<Option<Box<dyn UserCode>>, Box<Diagnostic>>;

    /// Starts the programs of a world. `path` is that of the world among the page's files.
    fn attach(&self, bench: &mut Bench, world: &World, path: &str);
}

impl Live {
    /// A board of a design, and what a page is told of it.
    pub(crate) fn start(wanted: &Wanted<'_>) -> (Value, Option<Self>) {
        let mut live = None;
        let mut wrong = Vec::new();
        let mut unknown = None;
        let mut told = wanted.of.of_wiring("robot", |design, wiring, reported| {
            let all: Vec<BoardJob<'_>> = jobs(design, wiring).collect();
            let named =
                |job: &&BoardJob<'_>| wanted.name.is_none_or(|name| job.board.name.value == name);
            let Some(job) = all.iter().find(named) else {
                unknown = wanted.name;
                return None;
            };
            let text = schema(design, wiring).to_string();
            let boards = Board::all_of_json(&text).ok()?;
            let board = boards.into_iter().find(|one| one.name == job.board.name.value)?;
            // Whoever ends the worker frees it.
            let board: &'static Board = Box::leak(Box::new(board));
            let mut robot = None;
            if let Around::World(world) = wanted.around {
                let around = (world, wanted.outside);
                let (made, of_world) = Robot::new(job, wanted.of, around, reported);
                wrong = of_world;
                robot = Some(made?);
            }
            let mut info = info::info(&all, job, board);
            if let (Some(robot), Some(fields)) = (&robot, info.as_object_mut()) {
                fields.insert("maps".to_owned(), robot.maps(job));
                fields.insert("has_code".to_owned(), robot.has_code.into());
                fields.insert("stand_ins".to_owned(), robot.stand_ins.clone().into());
            }
            let mut watch = Watch::new(board);
            for plant in robot.iter().flat_map(|robot| &robot.idle) {
                let what = "a page runs no programs, so its sensors stay as they are";
                watch.note("warning", format!("{plant}: {what}; `sensedsl studio` runs it"));
            }
            live = Some(Self {
                board,
                session: Session::new(board, Duration::ZERO),
                watch,
                robot,
                outbox: Vec::new(),
                now: Duration::ZERO,
            });
            Some(info)
        });
        if let (Some(name), Some(fields)) = (unknown, told.as_object_mut()) {
            let error = format!("the design has no board {name} with devices");
            fields.insert("error".to_owned(), error.into());
        }
        if let Some(all) = told.get_mut("diagnostics").and_then(Value::as_array_mut) {
            all.append(&mut wrong);
        }
        (told, live)
    }

    /// Runs the simulated board up to a virtual time, and tells what its host has seen.
    pub(crate) fn run(&mut self, until_ms: f64) -> Value {
        let until_ms = milliseconds(until_ms);
        let Some(robot) = &mut self.robot else {
            return json!({ "error": "no board is simulated" });
        };
        while robot.now_ms() < until_ms {
            let now = Duration::from_millis(robot.now_ms());
            let sent = self.session.to_send(now);
            robot.write(&sent);
            robot.write(&self.watch.keep_alive(&self.session, now, !sent.is_empty()));
            let bytes = robot.step();
            let now = Duration::from_millis(robot.now_ms());
            let watch = &mut self.watch;
            self.session.feed(&bytes, now, &mut |event| watch.take(event, now));
            self.session.look(now, &mut |event| watch.take(event, now));
            self.now = now;
        }
        for what in robot.stopped() {
            self.watch.note("error", what);
        }
        let outputs = robot.outputs(self.board);
        let mut seen = self.watch.seen(&self.session, self.now);
        if let Some(fields) = seen.as_object_mut() {
            fields.insert("outputs".to_owned(), outputs);
            fields.insert("poses".to_owned(), json!(robot.poses()));
            fields.insert("figures".to_owned(), robot.figures().into());
        }
        seen
    }

    /// Holds a quantity of the simulated world, or gives it back.
    pub(crate) fn steer(&mut self, device: &str, element: usize, shown: Option<f64>) -> Value {
        let Some(robot) = &mut self.robot else {
            return json!({ "error": "no board is simulated" });
        };
        if robot.steer(device, element, shown) {
            Value::Null
        } else {
            json!({ "error": format!("{device} is not a sensor of this board") })
        }
    }

    /// The link to a real board was opened.
    pub(crate) fn opened(&mut self, now_ms: f64) {
        self.now = Duration::from_millis(milliseconds(now_ms));
        self.session = Session::new(self.board, self.now);
        self.session.health_every(seen::HEALTH_EVERY);
        self.watch.reopened();
        self.outbox.clear();
    }

    /// Bytes from a real board, and what the host has seen.
    pub(crate) fn feed(&mut self, bytes: &[u8], now_ms: f64) -> Value {
        let now = Duration::from_millis(milliseconds(now_ms));
        let watch = &mut self.watch;
        self.session.feed(bytes, now, &mut |event| watch.take(event, now));
        self.session.look(now, &mut |event| watch.take(event, now));
        self.now = now;
        if self.watch.has_just_matched() {
            // What somebody had set is set again on a board that has come back.
            self.outbox.extend(self.watch.held());
        }
        self.watch.seen(&self.session, now)
    }

    /// The bytes that a real board must get now.
    pub(crate) fn due(&mut self, now_ms: f64) -> Vec<u8> {
        let now = Duration::from_millis(milliseconds(now_ms));
        let mut bytes = self.session.to_send(now);
        bytes.append(&mut self.outbox);
        bytes.extend(self.watch.keep_alive(&self.session, now, !bytes.is_empty()));
        bytes
    }

    /// Sets an actuator to what somebody typed.
    pub(crate) fn set(&mut self, device: &str, value: &str) -> Value {
        match self.board.command(device, value) {
            Ok((frame, index, value)) => {
                let text = self.board.devices.get(index).map(|one| one.shown_text(&value));
                self.watch.hold(index, frame.clone());
                match &mut self.robot {
                    Some(robot) => robot.write(&frame),
                    None => self.outbox.extend(frame),
                }
                json!({ "error": null, "text": text })
            }
            Err(why) => json!({ "error": why.to_string(), "text": null }),
        }
    }
}

/// A time that a page gives; it never goes back.
fn milliseconds(given: f64) -> u64 {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at least 0")]
    let whole = given.max(0.0) as u64;
    whole
}
