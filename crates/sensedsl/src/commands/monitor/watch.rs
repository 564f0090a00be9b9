//! The loop of `monitor`: bytes in, values and notes out, commands back.

use std::io::BufRead as _;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use anyhow::Result;
use sensedsl_diagnostics::codes::e0558_other_firmware::other_firmware;
use sensedsl_host::port::Port;
use sensedsl_host::{Board, Counts, Event, Session, State};
use sensedsl_wire::{
    Decoder, Direction, Event as Received, Health, Scalar, Status as HealthStatus,
    encode_hello_request,
};

use super::BAUD;
use super::show::{self, Show};
use super::source::{Input, Source};
use super::subject::Subject;
use crate::cli::{MonitorArgs, MonitorFormat};
use crate::commands::deadline::interruption;
use crate::status::Status;
use crate::terminal::Terminal;

/// The interval at which the table is refreshed.
const REFRESH: Duration = Duration::from_millis(200);
/// How long the loop waits for bytes.
const WAIT: Duration = Duration::from_millis(20);
/// How long a board may take to say who it is.
const ANSWERS_WITHIN: Duration = Duration::from_millis(1_500);
/// The time after which a device that is back and cannot be opened is told.
const TOLD_AFTER: Duration = Duration::from_secs(2);

/// A board that is watched.
pub(super) struct Watch<'a> {
    args: &'a MonitorArgs,
    terminal: &'a Terminal,
    subject: &'a Subject,
    board: &'a Board,
    source: Source,
    session: Session<'a>,
    show: Show<'a>,
    format: MonitorFormat,
    began: Instant,
    /// The counts of sessions before this one.
    before: Counts,
    events: Vec<Event>,
    /// When a frame was sent last.
    sent: Duration,
    /// What holds: the frame that set each actuator.
    held: Vec<(usize, Vec<u8>)>,
    worries: Vec<Option<HealthStatus>>,
    trouble: Option<String>,
    is_met: bool,
}

impl<'a> Watch<'a> {
    pub(super) fn new(
        args: &'a MonitorArgs,
        terminal: &'a Terminal,
        subject: &'a Subject,
        board: &'a Board,
        source: Source,
    ) -> Self {
        let usual = if terminal.is_watched() { MonitorFormat::Table } else { MonitorFormat::Lines };
        let format = args.format.unwrap_or(usual);
        let session = if source.is_recording() {
            Session::recording(board)
        } else {
            Session::new(board, Duration::ZERO)
        };
        let mut watch = Self {
            args,
            terminal,
            subject,
            board,
            source,
            session,
            show: Show::new(board, format),
            format,
            began: Instant::now(),
            before: Counts::default(),
            events: Vec::new(),
            sent: Duration::ZERO,
            held: Vec::new(),
            worries: vec![None; board.devices.len()],
            trouble: None,
            is_met: false,
        };
        watch.ask_for_health();
        watch
    }

    fn ask_for_health(&mut self) {
        if let Some(seconds) = self.args.health {
            self.session.health_every(Duration::from_secs_f64(seconds));
        }
    }

    /// Watches until it is stopped, the recording is over, or the board turns out to be another one.
    pub(super) fn run(mut self) -> Result<Status> {
        for (name, text) in &self.args.set {
            self.prepare(name, text)?;
        }
        let stop = interruption()?;
        let typed = self.listen();
        let mut shown = Instant::now();
        let end = self.args.seconds.map(Duration::from_secs_f64);
        let status = loop {
            let now = self.began.elapsed();
            if stop.load(Ordering::Relaxed) || end.is_some_and(|end| now >= end) {
                break Status::Done;
            }
            if let Some(status) = self.turn(now)? {
                break status;
            }
            while let Some(line) = typed.as_ref().and_then(|typed| typed.try_recv().ok()) {
                self.typed(&line)?;
            }
            if self.format == MonitorFormat::Table
                && self.terminal.is_watched()
                && shown.elapsed() >= REFRESH
            {
                shown = Instant::now();
                let text =
                    self.show.refreshed(self.began.elapsed(), &self.session, self.terminal.size());
                self.terminal.result(&text)?;
            }
        };
        self.finish(status)
    }

    /// One turn of the loop; the status if it is the last one.
    fn turn(&mut self, now: Duration) -> Result<Option<Status>> {
        let bytes = self.session.to_send(now);
        let bytes = if bytes.is_empty() { self.keep_alive(now) } else { bytes };
        if !self.send(&bytes, now) {
            return self.lose();
        }
        self.find_again()?;
        match self.source.read(WAIT)? {
            Input::Over => return Ok(Some(self.status())),
            Input::Gone => return self.lose(),
            Input::Bytes(bytes) => {
                let now = self.began.elapsed();
                let events = &mut self.events;
                self.session.feed(&bytes, now, &mut |event| events.push(event));
            }
        }
        if !matches!(self.source, Source::Away(_)) {
            let now = self.began.elapsed();
            let events = &mut self.events;
            self.session.look(now, &mut |event| events.push(event));
        }
        for event in std::mem::take(&mut self.events) {
            if let Some(status) = self.take(event)? {
                return Ok(Some(status));
            }
        }
        Ok(None)
    }

    /// Sends; false if the device is gone.
    fn send(&mut self, bytes: &[u8], now: Duration) -> bool {
        if !bytes.is_empty() {
            self.sent = now;
        }
        self.source.write(bytes)
    }

    /// A question that keeps actuators from their failsafe while something was set.
    fn keep_alive(&self, now: Duration) -> Vec<u8> {
        let Some(silence) = self.board.silence_ms.filter(|_| !self.held.is_empty()) else {
            return Vec::new();
        };
        // Several frames may be lost on the way.
        let is_time =
            now.saturating_sub(self.sent) >= Duration::from_millis(u64::from(silence) / 4);
        let is_there = self.session.state() == State::Matched;
        if is_time && is_there { encode_hello_request(&self.board.schema) } else { Vec::new() }
    }

    fn take(&mut self, event: Event) -> Result<Option<Status>> {
        let now = self.began.elapsed();
        let name = |index: usize| {
            self.board.devices.get(index).map_or_else(String::new, |device| device.name.clone())
        };
        match event {
            Event::Values(stamp, values) => {
                let printed = values.into_iter().map(|(index, value)| self.show.take(now, index, value, stamp));
                let printed: String = printed.collect();
                if !printed.is_empty() {
                    self.terminal.result(&printed)?;
                }
            }
            Event::Matched => {
                if !self.is_met {
                    self.say(&format!("{}: firmware and design agree", self.board.name))?;
                }
                self.is_met = true;
                for (index, frame) in self.held.clone() {
                    self.send(&frame, now);
                    self.say(&format!("set {}", name(index)))?;
                }
            }
            Event::Unverified => {
                self.say("no hello before the first value: nobody knows whether this recording is of this design")?;
            }
            Event::Unanswered => self.say(self.unanswered())?,
            Event::Silent(time) => {
                self.say(&format!("{} says nothing for {}; asking it again", self.board.name, span(time)))?;
            }
            Event::Overdue(index, time) => {
                let expected = self.board.devices.get(index).and_then(|device| device.cycle_ms).unwrap_or_default();
                let expected = span(Duration::from_millis(expected.into()));
                self.say(&format!("{}: no value for {} (expected every {expected})", name(index), span(time)))?;
            }
            Event::Again(index, time) => {
                self.say(&format!("{}: values again after {}", name(index), span(time)))?;
            }
            Event::Health(health) => self.health(&health)?,
            Event::OtherHealth(version) => self.say(&format!(
                "{} tells its health in version {version}, which is not known here: flash the board again",
                self.board.name
            ))?,
            Event::Other { hash, differences } => {
                let own = self.board.schema.hash();
                let why = other_firmware(self.subject.at, &self.board.name, (own, hash), &differences);
                self.terminal.diagnostics(&[why], &self.subject.sources)?;
                return Ok(Some(Status::Wrong));
            }
        }
        Ok(None)
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

    /// Says something for people.
    fn say(&mut self, what: &str) -> Result<()> {
        self.show.interrupted();
        Ok(self.terminal.aside(what)?)
    }

    /// Prints health if it was asked for; otherwise says only what is wrong, once.
    fn health(&mut self, health: &Health) -> Result<()> {
        if self.args.health.is_some() {
            let text = show::health(self.board, health);
            self.show.interrupted();
            return Ok(eprint_lines(self.terminal, &text)?);
        }
        for (index, one) in health.devices.iter().enumerate() {
            let (Some(device), Some(worry)) =
                (self.board.devices.get(index), self.worries.get_mut(index))
            else {
                continue;
            };
            let is_bad = matches!(one.status, HealthStatus::Failed | HealthStatus::Stale);
            let last = std::mem::replace(worry, Some(one.status).filter(|_| is_bad));
            if is_bad && last != Some(one.status) {
                let causes = show::causes(one.causes.counts());
                let causes = if causes.is_empty() { causes } else { format!(" ({causes})") };
                self.show.interrupted();
                self.terminal.aside(&format!(
                    "{}: {}{causes}",
                    device.name,
                    show::status(one.status)
                ))?;
            }
        }
        Ok(())
    }

    fn lose(&mut self) -> Result<Option<Status>> {
        let baud = self.args.baud.or(self.board.baud).unwrap_or(BAUD);
        let Some(path) = self.source.lose(baud) else { return Ok(None) };
        if self.args.no_reconnect {
            self.say(&format!("lost {path}: the device is gone"))?;
            return Ok(Some(Status::Wrong));
        }
        self.say(&format!("lost {path}: the device is gone; waiting for it"))?;
        Ok(None)
    }

    fn find_again(&mut self) -> Result<()> {
        let since = match &self.source {
            Source::Away(away) => away.since,
            Source::Port(_) | Source::Recording(_) | Source::Simulated(_) => return Ok(()),
        };
        match self.source.find_again() {
            Ok(Some((path, after))) => {
                self.before += self.session.counts();
                self.session = Session::new(self.board, self.began.elapsed());
                self.ask_for_health();
                self.trouble = None;
                self.say(&format!("back on {path} after {}", span(after)))?;
            }
            Ok(None) => {}
            // Rights are given a moment after the device appears.
            Err(why) => {
                let why = why.to_string();
                if since.elapsed() > TOLD_AFTER && self.trouble.as_ref() != Some(&why) {
                    self.say(&format!("the device is back, but {why}"))?;
                    self.trouble = Some(why);
                }
            }
        }
        Ok(())
    }

    /// What is set as soon as the board is there.
    fn prepare(&mut self, name: &str, text: &str) -> Result<()> {
        match self.board.command(name, text) {
            Ok((frame, index, _)) => {
                self.held.retain(|(held, _)| *held != index);
                self.held.push((index, frame));
                Ok(())
            }
            Err(why) => anyhow::bail!("--set {name}={text}: {why}"),
        }
    }

    /// A line that somebody typed: an actuator's name and its value.
    fn typed(&mut self, line: &str) -> Result<()> {
        let line = line.trim();
        let Some((name, text)) = line.split_once(|c: char| c.is_whitespace() || c == '=') else {
            if !line.is_empty() {
                self.say(&format!(
                    "not sent: `{line}`: write the name of an actuator and its value"
                ))?;
            }
            return Ok(());
        };
        match self.board.command(name, text.trim_start_matches(['=', ' '])) {
            Ok((frame, index, value)) => self.set(index, frame, value),
            Err(why) => self.say(&format!("not sent: {line}: {why}")),
        }
    }

    fn set(&mut self, index: usize, frame: Vec<u8>, value: Vec<Scalar>) -> Result<()> {
        let now = self.began.elapsed();
        let Some(device) = self.board.devices.get(index) else { return Ok(()) };
        let text = format!("{} = {}", device.name, device.text(&value));
        if self.session.state() != State::Matched {
            return self.say(&format!("not sent: {text}: the board is not there"));
        }
        self.send(&frame, now);
        self.held.retain(|(held, _)| *held != index);
        self.held.push((index, frame));
        if self.format == MonitorFormat::Table {
            let _ = self.show.take(now, index, value, None);
        }
        self.say(&format!("sent: {text}"))
    }

    /// Lines of the standard input, unless it is the recording, or people would type into the table.
    fn listen(&self) -> Option<Receiver<String>> {
        let is_taken = self.args.device.as_deref() == Some("-");
        let has_actuators =
            self.board.devices.iter().any(|one| one.direction == Direction::Actuator);
        if is_taken || !has_actuators || self.format == MonitorFormat::Table {
            return None;
        }
        let (sender, receiver): (Sender<String>, _) = channel();
        // It ends with the program: nothing can take a thread away from a read.
        let _ = std::thread::spawn(move || {
            for line in std::io::stdin().lock().lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    return;
                }
            }
        });
        Some(receiver)
    }

    fn status(&self) -> Status {
        if self.session.state() == State::Refused { Status::Wrong } else { Status::Done }
    }

    /// Prints the last table and the counts.
    fn finish(mut self, status: Status) -> Result<Status> {
        if self.format == MonitorFormat::Table {
            let text = self.show.last(self.began.elapsed(), &self.session);
            self.terminal.result(&text)?;
        }
        let mut counts = self.session.counts();
        counts += self.before;
        let lost = if self.board.schema.stamp {
            format!(", {} reports lost", counts.lost)
        } else {
            String::new()
        };
        self.terminal.aside(&format!(
            "{} frames, {} bytes dropped{lost}",
            counts.frames, counts.dropped_bytes
        ))?;
        Ok(status)
    }
}

fn eprint_lines(terminal: &Terminal, text: &str) -> std::io::Result<()> {
    text.lines().try_for_each(|line| terminal.aside(line))
}

/// A time for people.
fn span(time: Duration) -> String {
    if time < Duration::from_secs(1) {
        format!("{} ms", time.as_millis())
    } else {
        format!("{:.1} s", time.as_secs_f64())
    }
}

/// Which of some boards is behind a port; otherwise why none is.
pub(super) fn who<'b>(mut port: Port, boards: &[&'b Board]) -> Result<(&'b Board, Port), String> {
    let began = Instant::now();
    let mut decoders: Vec<(&Board, Decoder<'_>)> = boards
        .iter()
        .map(|board| (*board, Decoder::new(&board.schema, Direction::Sensor)))
        .collect();
    let mut asked: Option<Instant> = None;
    let (mut bytes_seen, mut other) = (0, None);
    while began.elapsed() < ANSWERS_WITHIN {
        if asked.is_none_or(|asked| asked.elapsed() >= Duration::from_millis(250)) {
            asked = Some(Instant::now());
            for board in boards {
                port.write(&encode_hello_request(&board.schema))
                    .map_err(|error| error.to_string())?;
            }
        }
        let bytes = port.read(WAIT).map_err(|error| error.to_string())?;
        bytes_seen += bytes.len();
        for (board, decoder) in &mut decoders {
            let mut hash = None;
            decoder.feed(&bytes, |event| {
                if let Received::Hello(said) = event {
                    hash = Some(said);
                }
            });
            match hash {
                Some(hash) if hash == board.schema.hash() => return Ok((board, port)),
                Some(hash) => other = Some(hash),
                None => {}
            }
        }
    }
    Err(match other {
        Some(hash) => format!("it runs the firmware of another design (0x{hash:08x})"),
        None if bytes_seen == 0 => "nothing comes from it".to_owned(),
        None => "what comes from it are no frames of this design".to_owned(),
    })
}
