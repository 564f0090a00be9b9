//! One board that is watched: its link, its session, its clock, and what is known of its devices.
//!
//! In: bytes and the time. Out: what happened, in its order, for outputs and people; bytes to the board.

use std::time::Duration;

use sensedsl_host::{
    Board, BoardClock, CommandError, Counts, Device, DeviceStats, Event, Faults, Moment, Report,
    Session, State, keep_alive,
};
use sensedsl_record::Past;
use sensedsl_wire::{Direction, Health, Scalar, Stamp};

use super::source::{BAUD, Source};
use crate::cli::MonitorArgs;

/// The time after which a device that is back and cannot be opened is told.
const TOLD_AFTER: Duration = Duration::from_secs(2);

/// How often health is asked for that is only shown: a board of many devices has a long answer.
const SHOWN_HEALTH_EVERY: Duration = Duration::from_secs(2);

/// What happened on a link.
pub(super) enum Happening {
    Received(Vec<u8>),
    Sent(Vec<u8>),
    Online,
    Offline(String),
    Report(Report),
    Command(usize, Vec<Scalar>),
    Health(Health),
    /// Something for people.
    Say(String),
    /// It is another board: its hash and the differences.
    Other(u32, Vec<String>),
    /// The device was opened again.
    Opened,
    /// Nothing more comes.
    Ended {
        is_lost: bool,
    },
}

/// The last value of a device, and when it came or was sent.
pub(super) type Latest = Option<(Duration, Vec<Scalar>)>;

/// A board that is watched.
pub(super) struct Link<'a> {
    pub(super) board: &'a Board,
    pub(super) session: Session<'a>,
    pub(super) stats: Vec<DeviceStats>,
    pub(super) latest: Vec<Latest>,
    pub(super) clock: BoardClock,
    pub(super) health: Option<Health>,
    pub(super) source: Source,
    pub(super) opening: u32,
    pub(super) is_over: bool,
    args: &'a MonitorArgs,
    /// The counts of sessions before this one.
    before: Counts,
    happened: Vec<Happening>,
    events: Vec<Event>,
    /// When a frame was sent last.
    sent: Duration,
    /// What holds: the frame that set each actuator, and its value.
    held: Vec<(usize, Vec<u8>, Vec<Scalar>)>,
    /// What was asked for before the board had time to say who it is.
    early: Vec<(String, String)>,
    is_late: bool,
    faults: Faults,
    trouble: Option<String>,
    is_met: bool,
    health_every: Option<Duration>,
    /// Whether other boards are watched as well: what is said then says of which one.
    is_one_of_several: bool,
}

impl<'a> Link<'a> {
    pub(super) fn new(args: &'a MonitorArgs, board: &'a Board, source: Source) -> Self {
        let session = if source.is_recording() {
            Session::recording(board)
        } else {
            Session::new(board, Duration::ZERO)
        };
        let count = board.devices.len();
        let mut link = Self {
            board,
            session,
            stats: vec![DeviceStats::default(); count],
            latest: vec![None; count],
            clock: BoardClock::default(),
            health: None,
            source,
            opening: 0,
            is_over: false,
            args,
            before: Counts::default(),
            happened: Vec::new(),
            events: Vec::new(),
            sent: Duration::ZERO,
            held: Vec::new(),
            early: Vec::new(),
            is_late: false,
            faults: Faults::new(board),
            trouble: None,
            is_met: false,
            health_every: super::sinks::health_s(args).map(Duration::from_secs_f64),
            is_one_of_several: false,
        };
        link.ask_for_health();
        link
    }

    /// What happened since the last call.
    pub(super) fn happened(&mut self) -> Vec<Happening> {
        std::mem::take(&mut self.happened)
    }

    /// What was counted in all sessions.
    pub(super) fn counts(&self) -> Counts {
        let mut counts = self.session.counts();
        counts += self.before;
        counts
    }

    /// The cycle of a device.
    pub(super) fn cycle(&self, device: usize) -> Option<Duration> {
        let cycle_ms = self.board.devices.get(device)?.cycle_ms?;
        Some(Duration::from_millis(cycle_ms.into()))
    }

    /// Says from now on which board is meant.
    pub(super) fn name_board(&mut self) {
        self.is_one_of_several = true;
    }

    /// A device's name, with that of its board where others are watched as well.
    fn name(&self, device: usize) -> String {
        let own = self.board.devices.get(device).map_or("", |device| device.name.as_str());
        if self.is_one_of_several { format!("{}/{own}", self.board.name) } else { own.to_owned() }
    }

    fn say(&mut self, text: String) {
        self.happened.push(Happening::Say(text));
    }

    /// Says something of the link itself.
    fn say_of_link(&mut self, text: &str) {
        let name = &self.board.name;
        self.say(if self.is_one_of_several { format!("{name}: {text}") } else { text.to_owned() });
    }

    /// Asks for health because it is shown, although the arguments do not.
    pub(super) fn show_health(&mut self) {
        self.health_every = Some(SHOWN_HEALTH_EVERY);
        self.ask_for_health();
    }

    fn ask_for_health(&mut self) {
        if let Some(every) = self.health_every {
            self.session.health_every(every);
        }
    }

    /// Takes bytes that came.
    pub(super) fn feed(&mut self, bytes: Vec<u8>, at: Moment) {
        if bytes.is_empty() {
            return;
        }
        let events = &mut self.events;
        self.session.feed(&bytes, at.run, &mut |event| events.push(event));
        self.happened.push(Happening::Received(bytes));
        self.take_events(at.run);
    }

    /// Takes what a record says of the past.
    pub(super) fn replay(&mut self, what: Past, at: Moment) {
        match what {
            Past::Received(bytes) => self.feed(bytes, at),
            Past::Sent(bytes) => {
                self.clock.asked(at.run);
                self.happened.push(Happening::Sent(bytes));
            }
            Past::Value { device, value, .. } => {
                let is_sent = |one: &Device| one.direction == Direction::Actuator;
                // What sensors reported is among the bytes.
                if self.board.devices.get(device).is_some_and(is_sent) {
                    self.set(device, value, at.run);
                }
            }
            Past::Event(event) => {
                if let Some(why) = event.get("why").and_then(|why| why.as_str()) {
                    self.interrupt();
                    self.before += self.session.counts();
                    self.session = Session::recording(self.board);
                    self.happened.push(Happening::Offline(why.to_owned()));
                }
            }
            // It is among the bytes as well.
            Past::Health(_) => {}
        }
    }

    /// Sends what is due, notices what does not come, and finds a device again.
    pub(super) fn turn(&mut self, now: Duration) {
        if self.is_over {
            return;
        }
        self.find_again(now);
        if matches!(self.source, Source::Away(_)) {
            return;
        }
        let bytes = self.session.to_send(now);
        let is_question = !bytes.is_empty() && self.session.state() != State::Comparing;
        let bytes = if bytes.is_empty() { self.keep_alive(now) } else { bytes };
        if is_question {
            self.clock.asked(now);
        }
        self.send(bytes, now);
        let events = &mut self.events;
        self.session.look(now, &mut |event| events.push(event));
        self.take_events(now);
    }

    /// Sends; a device that does not take it is gone.
    fn send(&mut self, bytes: Vec<u8>, now: Duration) {
        if bytes.is_empty() {
            return;
        }
        self.sent = now;
        if self.source.write(&bytes) {
            self.happened.push(Happening::Sent(bytes));
        } else {
            self.lose();
        }
    }

    /// A question that keeps actuators from their failsafe while something was set.
    fn keep_alive(&self, now: Duration) -> Vec<u8> {
        if self.held.is_empty() {
            return Vec::new();
        }
        let quiet = now.saturating_sub(self.sent);
        keep_alive(self.board, self.session.state(), quiet).unwrap_or_default()
    }

    fn take_events(&mut self, now: Duration) {
        for event in std::mem::take(&mut self.events) {
            self.take(event, now);
        }
    }

    fn take(&mut self, event: Event, now: Duration) {
        match event {
            Event::Values(stamp, values) => self.report(stamp, values, now),
            Event::Matched => self.matched(now),
            Event::Unverified => {
                self.say_of_link("no hello before the first value: nobody knows whether this recording is of this design");
            }
            Event::Unanswered => {
                self.say_of_link(self.unanswered());
                self.is_late = true;
                self.early(now);
            }
            Event::Silent(time) => {
                self.interrupt();
                let text = format!("{} says nothing for {}; asking it again", self.board.name, span(time));
                self.happened.push(Happening::Offline("it says nothing".to_owned()));
                self.say(text);
            }
            Event::Overdue(index, time) => {
                let expected = span(self.cycle(index).unwrap_or_default());
                let text = format!("{}: no value for {} (expected every {expected})", self.name(index), span(time));
                self.say(text);
            }
            Event::Again(index, time) => {
                self.say(format!("{}: values again after {}", self.name(index), span(time)));
            }
            Event::Health(health) => {
                self.clock.answered(now);
                self.worry(&health);
                self.happened.push(Happening::Health(health.clone()));
                self.health = Some(health);
            }
            Event::OtherHealth(version) => self.say(format!(
                "{} tells its health in version {version}, which is not known here: flash the board again",
                self.board.name
            )),
            Event::Other { hash, differences } => {
                self.is_over = true;
                self.happened.push(Happening::Other(hash, differences));
            }
        }
    }

    fn matched(&mut self, now: Duration) {
        self.clock.answered(now);
        if !self.is_met {
            self.say(format!("{}: firmware and design agree", self.board.name));
        }
        self.is_met = true;
        self.happened.push(Happening::Online);
        for (index, frame, value) in self.held.clone() {
            self.send(frame, now);
            self.set(index, value, now);
            self.say(format!("set {}", self.name(index)));
        }
        self.early(now);
    }

    fn report(&mut self, stamp: Option<Stamp>, values: Vec<(usize, Vec<Scalar>)>, now: Duration) {
        // Nobody knows when the bytes of a plain recording came.
        let is_playing = matches!(self.source, Source::Recording(_));
        let latency =
            stamp.filter(|_| !is_playing).map(|stamp| self.clock.stamped(stamp.time_us, now));
        for (index, value) in &values {
            let cycle = self.cycle(*index);
            if let Some(stats) = self.stats.get_mut(*index) {
                stats.add(now, latency, stamp.map(|stamp| stamp.time_us), cycle);
            }
            if let Some(latest) = self.latest.get_mut(*index) {
                *latest = Some((now, value.clone()));
            }
        }
        self.happened.push(Happening::Report(Report { stamp, latency, values }));
    }

    fn unanswered(&self) -> &'static str {
        let counts = self.session.counts();
        if counts.bytes == 0 {
            "nothing comes: does the board run firmware of this design? asking again"
        } else if counts.frames > 0 {
            "frames come, but the board does not say which firmware it runs; asking again"
        } else {
            "what comes are no frames: is the rate right (`--baud`)? asking again"
        }
    }

    /// Says what is wrong, once.
    fn worry(&mut self, health: &Health) {
        if self.args.health.is_some() {
            return;
        }
        for fault in self.faults.news(self.board, health) {
            self.say(fault);
        }
    }

    fn interrupt(&mut self) {
        self.stats.iter_mut().for_each(DeviceStats::interrupt);
        self.clock.restart();
    }

    /// The device is gone.
    pub(super) fn lose(&mut self) {
        let baud = self.args.baud.or(self.board.baud).unwrap_or(BAUD);
        let Some(path) = self.source.lose(baud) else { return };
        self.interrupt();
        self.happened.push(Happening::Offline("the device is gone".to_owned()));
        if self.args.no_reconnect {
            self.say_of_link(&format!("lost {path}: the device is gone"));
            self.end(true);
        } else {
            self.say_of_link(&format!("lost {path}: the device is gone; waiting for it"));
        }
    }

    /// Nothing more comes.
    pub(super) fn end(&mut self, is_lost: bool) {
        self.is_over = true;
        self.happened.push(Happening::Ended { is_lost });
    }

    fn find_again(&mut self, now: Duration) {
        let since = match &self.source {
            Source::Away(away) => away.since,
            Source::Port(_) | Source::Recording(_) | Source::Simulated(_) | Source::Replayed => {
                return;
            }
        };
        match self.source.find_again() {
            Ok(Some((path, after))) => {
                self.before += self.session.counts();
                self.session = Session::new(self.board, now);
                self.ask_for_health();
                self.trouble = None;
                self.opening += 1;
                self.happened.push(Happening::Opened);
                self.say_of_link(&format!("back on {path} after {}", span(after)));
            }
            Ok(None) => {}
            // Rights are given a moment after the device appears.
            Err(why) => {
                let why = why.to_string();
                if since.elapsed() > TOLD_AFTER && self.trouble.as_ref() != Some(&why) {
                    self.say_of_link(&format!("the device is back, but {why}"));
                    self.trouble = Some(why);
                }
            }
        }
    }

    /// What is set as soon as the board is there.
    pub(super) fn prepare(&mut self, name: &str, text: &str) -> Result<(), CommandError> {
        let (frame, index, value) = self.board.command(name, text)?;
        self.hold(index, frame, value);
        Ok(())
    }

    fn hold(&mut self, index: usize, frame: Vec<u8>, value: Vec<Scalar>) {
        self.held.retain(|(held, ..)| *held != index);
        self.held.push((index, frame, value));
    }

    /// What was asked for early is done now, or told that it is not.
    fn early(&mut self, now: Duration) {
        for (name, text) in std::mem::take(&mut self.early) {
            self.command(&name, &text, now);
        }
    }

    /// Sets an actuator, and says what became of it. A board that was not met yet is given the time to answer.
    pub(super) fn command(&mut self, name: &str, text: &str, now: Duration) {
        let (frame, index, value) = match self.board.command(name, text) {
            Ok(command) => command,
            Err(why) => return self.say_of_link(&format!("not sent: {name} {text}: {why}")),
        };
        let shown =
            self.board.devices.get(index).map_or_else(String::new, |device| device.text(&value));
        let said = format!("{} = {shown}", self.name(index));
        if self.source.is_recording() {
            return self.say(format!("not sent: {said}: a recording takes no commands"));
        }
        if self.session.state() != State::Matched {
            if self.is_met || self.is_late {
                return self.say(format!("not sent: {said}: the board is not there"));
            }
            return self.early.push((name.to_owned(), text.to_owned()));
        }
        self.send(frame.clone(), now);
        self.hold(index, frame, value.clone());
        self.set(index, value, now);
        self.say(format!("sent: {said}"));
    }

    fn set(&mut self, index: usize, value: Vec<Scalar>, now: Duration) {
        if let (Some(stats), Some(latest)) = (self.stats.get_mut(index), self.latest.get_mut(index))
        {
            stats.add(now, None, None, None);
            *latest = Some((now, value.clone()));
        }
        self.happened.push(Happening::Command(index, value));
    }

    /// The actuator of that name, if the board has one.
    pub(super) fn has_actuator(&self, name: &str) -> bool {
        let is_it = |one: &Device| one.direction == Direction::Actuator && one.name == name;
        self.board.devices.iter().any(is_it)
    }
}

/// A time for people.
pub(super) fn span(time: Duration) -> String {
    if time < Duration::from_secs(1) {
        format!("{} ms", time.as_millis())
    } else {
        format!("{:.1} s", time.as_secs_f64())
    }
}
