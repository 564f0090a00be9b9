//! The loop of `monitor`: bytes of all links in, news out to people and outputs, commands back.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::e0558_other_firmware::other_firmware;
use sensedsl_host::{Moment, News, Output, What, Wish};
use sensedsl_record::Ending;
use sensedsl_record::summary::Summing;
use sensedsl_sinks::Config;
use sensedsl_wire::Direction;

use super::face::{Ask, Face};
use super::link::{Happening, Link};
use super::outputs::outputs;
use super::replay::Replay;
use super::rules::Rules;
use super::source::{Heard, Input, Source};
use super::subject::Subject;
use crate::cli::{MonitorArgs, MonitorFormat};
use crate::commands::convert::text;
use crate::commands::deadline::ending;
use crate::files::no_record;
use crate::status::Status;
use crate::terminal::Terminal;

/// How long the loop waits for something to happen; a board in this program is asked more often.
const WAIT: Duration = Duration::from_millis(20);
const SIMULATED_WAIT: Duration = Duration::from_millis(1);
/// How often what is due is looked for, at least.
const LOOK_EVERY: Duration = Duration::from_millis(20);
/// How many messages of threads wait for the loop: a recording is not read faster than it is shown.
const WAITING_MAX: usize = 256;

/// All boards that are watched, and who is told of them.
pub(super) struct Watch<'a> {
    args: &'a MonitorArgs,
    terminal: &'a Terminal,
    subject: &'a Subject,
    links: Vec<Link<'a>>,
    face: Box<dyn Face + 'a>,
    config: Config,
    outputs: Vec<Box<dyn Output>>,
    to_loop: SyncSender<Heard>,
    heard: Receiver<Heard>,
    began: Instant,
    began_unix: Duration,
    looked: Option<Instant>,
    status: Option<Status>,
    summing: Option<Summing<'a>>,
    replay: Option<Replay>,
    /// What the run is held to.
    pub(super) rules: Option<Rules<'a>>,
    /// Where a record that is played has got to.
    past: Option<Moment>,
}

impl<'a> Watch<'a> {
    pub(super) fn new(
        args: &'a MonitorArgs,
        terminal: &'a Terminal,
        subject: &'a Subject,
        links: Vec<Link<'a>>,
        face: Box<dyn Face + 'a>,
        replay: Option<Replay>,
        config: Config,
    ) -> Self {
        let (to_loop, heard) = sync_channel(WAITING_MAX);
        Self {
            args,
            terminal,
            subject,
            links,
            face,
            config,
            outputs: Vec::new(),
            to_loop,
            heard,
            began: Instant::now(),
            began_unix: SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default(),
            looked: None,
            status: None,
            summing: None,
            past: replay.as_ref().map(|replay| replay.begin),
            replay,
            rules: None,
        }
    }

    fn moment(&self, at: Instant) -> Moment {
        let run = at.saturating_duration_since(self.began);
        Moment { run, unix: self.began_unix + run }
    }

    /// When it began, to all that are told: values are as old in a record as on the screen.
    fn begin(&self) -> Moment {
        let live = Moment { run: Duration::ZERO, unix: self.began_unix };
        self.replay.as_ref().map_or(live, |replay| replay.begin)
    }

    fn now(&self) -> Moment {
        self.past.unwrap_or_else(|| self.moment(Instant::now()))
    }

    /// Watches until it is stopped, all recordings are over, or a board turns out to be another one.
    pub(super) fn run(mut self) -> Result<Status> {
        let begin = self.begin();
        if self.args.summary {
            self.summing = Some(Summing::new(self.links.iter().map(|link| link.board), begin));
        }
        self.outputs = outputs(self.args, &self.config, self.subject, &self.links, begin)?;
        for (name, text) in &self.args.set {
            self.prepare(name, text)?;
        }
        for (index, link) in self.links.iter_mut().enumerate() {
            link.source.listen(index, link.opening, &self.to_loop)?;
        }
        if let Some(replay) = self.replay.take() {
            replay.play(self.args.speed, self.to_loop.clone());
        }
        for line in self.rules.iter().flat_map(Rules::begin) {
            self.face.say(&line)?;
        }
        let stop = ending(self.face.has_terminal())?;
        self.listen();
        let result = self.turns(&stop);
        // The terminal is given back whatever happened.
        let now = self.now();
        let closed = self.face.close(now, &self.links);
        let status = result?;
        closed?;
        self.finish(now)?;
        Ok(self.rules.as_ref().map_or(status, |rules| rules.status(status)))
    }

    fn turns(&mut self, stop: &AtomicBool) -> Result<Status> {
        let end = self.args.seconds.map(Duration::from_secs_f64);
        let is_simulated =
            self.links.iter().any(|link| matches!(link.source, Source::Simulated(_)));
        let wait = if is_simulated { SIMULATED_WAIT } else { WAIT };
        loop {
            if stop.load(Ordering::Relaxed) || end.is_some_and(|end| self.began.elapsed() >= end) {
                return Ok(Status::Done);
            }
            self.look()?;
            match self.heard.recv_timeout(wait) {
                Ok(heard) => self.hear(heard)?,
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {}
            }
            self.ask_simulated()?;
            if let Some(status) = self.status {
                return Ok(status);
            }
        }
    }

    /// What is due, whether or not something came.
    fn look(&mut self) -> Result<()> {
        if self.looked.is_some_and(|looked| looked.elapsed() < LOOK_EVERY) {
            return Ok(());
        }
        self.looked = Some(Instant::now());
        let now = self.now();
        for index in 0..self.links.len() {
            if let Some(link) = self.links.get_mut(index) {
                link.turn(now.run);
            }
            self.tell(index, now)?;
        }
        for ask in self.face.look(now, &self.links)? {
            match ask {
                Ask::Set { name, text } => self.set(&name, &text)?,
                Ask::Quit => self.status = Some(Status::Done),
            }
        }
        for line in self.rules.iter_mut().flat_map(|rules| rules.look(now, false)) {
            self.face.say(&line)?;
        }
        let wishes: Vec<Wish> =
            self.outputs.iter_mut().flat_map(|output| output.look(now)).collect();
        self.grant(wishes)
    }

    fn hear(&mut self, heard: Heard) -> Result<()> {
        let (index, opening, what) = match heard {
            Heard::Line(line) => return self.typed(&line),
            Heard::Past { link, at, what } => {
                self.past = Some(at);
                if let Some(link) = self.links.get_mut(link) {
                    link.replay(what, at);
                }
                return self.tell(link, at);
            }
            Heard::PastOver(end) => return self.past_over(end),
            Heard::Of { link, opening, what } => (link, opening, what),
        };
        let mut at = self.now();
        let moment = |instant| self.moment(instant);
        let when = match &what {
            Input::Bytes(instant, _) => Some(moment(*instant)),
            Input::Over(_) | Input::Gone => None,
        };
        at = when.unwrap_or(at);
        let Some(link) =
            self.links.get_mut(index).filter(|link| link.opening == opening && !link.is_over)
        else {
            return Ok(());
        };
        match what {
            Input::Bytes(_, bytes) => link.feed(bytes, at),
            Input::Gone => link.lose(),
            Input::Over(error) => {
                link.end(false);
                if let Some(error) = error {
                    bail!("the recording cannot be read any more: {error}");
                }
            }
        }
        self.tell(index, at)
    }

    fn past_over(&mut self, end: Result<Ending, String>) -> Result<()> {
        match end {
            Ok(Ending::Whole) => self.over()?,
            Ok(Ending::Cut) => {
                self.face.say("the record was cut off: this is all up to its last whole chunk")?;
                self.over()?;
            }
            Err(why) => {
                let at = self.args.record_file().unwrap_or(Path::new(""));
                bail!(no_record(at, &why));
            }
        }
        Ok(())
    }

    fn ask_simulated(&mut self) -> Result<()> {
        for index in 0..self.links.len() {
            let at = self.now();
            let Some(link) = self.links.get_mut(index) else { continue };
            let Source::Simulated(board) = &mut link.source else { continue };
            let bytes = board.read();
            if !bytes.is_empty() {
                link.feed(bytes, at);
                self.tell(index, at)?;
            }
        }
        Ok(())
    }

    /// Tells everybody what happened on a link.
    fn tell(&mut self, index: usize, at: Moment) -> Result<()> {
        let Some(link) = self.links.get_mut(index) else { return Ok(()) };
        for happening in link.happened() {
            let what = match &happening {
                Happening::Received(bytes) => What::Received(bytes),
                Happening::Sent(bytes) => What::Sent(bytes),
                Happening::Online => What::Online,
                Happening::Offline(why) => What::Offline(why),
                Happening::Report(report) => What::Report(report),
                Happening::Command(device, value) => What::Command { device: *device, value },
                Happening::Health(health) => What::Health(health),
                Happening::Say(text) => {
                    self.face.say(text)?;
                    continue;
                }
                Happening::Other(hash, differences) => {
                    self.refuse(index, *hash, differences)?;
                    continue;
                }
                Happening::Opened => {
                    if let Some(link) = self.links.get_mut(index) {
                        link.source.listen(index, link.opening, &self.to_loop)?;
                    }
                    continue;
                }
                Happening::Ended { is_lost } => {
                    self.ended(*is_lost)?;
                    continue;
                }
            };
            let news = News { board: index, at, what };
            self.face.take(&news, &self.links)?;
            self.outputs.iter_mut().for_each(|output| output.take(&news));
            if let Some(summing) = &mut self.summing {
                summing.take(&news);
            }
            if let Some(rules) = &mut self.rules {
                rules.take(&news);
            }
        }
        Ok(())
    }

    fn refuse(&mut self, index: usize, hash: u32, differences: &[String]) -> Result<()> {
        let Some(link) = self.links.get(index) else { return Ok(()) };
        let own = link.board.schema.hash();
        let why = other_firmware(self.subject.at, &link.board.name, (own, hash), differences);
        let now = self.now();
        self.face.close(now, &self.links)?;
        self.terminal.diagnostics(&[why], &self.subject.sources)?;
        self.status = Some(Status::Wrong);
        Ok(())
    }

    fn ended(&mut self, is_lost: bool) -> Result<()> {
        if is_lost {
            self.status = Some(Status::Wrong);
        } else if self.links.iter().all(|link| link.is_over) {
            self.over()?;
        }
        Ok(())
    }

    /// Nothing more comes: what is on a screen stays until people have seen it.
    fn over(&mut self) -> Result<()> {
        if self.face.has_terminal() {
            return self.face.say("that is the end of the recording; q ends");
        }
        self.status = Some(Status::Done);
        Ok(())
    }

    fn grant(&mut self, wishes: Vec<Wish>) -> Result<()> {
        for wish in wishes {
            match wish {
                Wish::Set { board, name, text } => self.set_on(board, &name, &text)?,
                Wish::Trouble { what, help } => self.face.say(&format!("{what}; {help}"))?,
                Wish::Note(text) => self.face.say(&text)?,
            }
        }
        Ok(())
    }

    /// The board that a name is of, and the name on it: `Servo`, or `Rover/Servo` where several boards have one.
    fn place<'n>(&self, name: &'n str) -> Result<(usize, &'n str), String> {
        if let Some((board, name)) = name.split_once('/') {
            let found = self.links.iter().position(|link| link.board.name == board);
            return found
                .map(|index| (index, name))
                .ok_or_else(|| format!("no board `{board}` is watched"));
        }
        let mut having = self.links.iter().enumerate().filter(|(_, link)| link.has_actuator(name));
        match (having.next(), having.next()) {
            (Some((index, _)), None) => Ok((index, name)),
            (None, _) => Ok((0, name)),
            (Some((_, one)), Some((_, other))) => {
                let (one, other) = (&one.board.name, &other.board.name);
                Err(format!("several boards have it: write `{one}/{name}` or `{other}/{name}`"))
            }
        }
    }

    /// What is set as soon as the board is there.
    fn prepare(&mut self, name: &str, text: &str) -> Result<()> {
        let place = self.place(name);
        let done = match place {
            Ok((index, name)) => self
                .links
                .get_mut(index)
                .map_or(Ok(()), |link| link.prepare(name, text))
                .map_err(|why| why.to_string()),
            Err(why) => Err(why),
        };
        done.map_err(|why| anyhow::anyhow!("--set {name}={text}: {why}"))
    }

    fn set(&mut self, name: &str, text: &str) -> Result<()> {
        match self.place(name) {
            Ok((index, name)) => self.set_on(index, name, text),
            Err(why) => self.face.say(&format!("not sent: {name} {text}: {why}")),
        }
    }

    fn set_on(&mut self, index: usize, name: &str, text: &str) -> Result<()> {
        let now = self.now();
        let Some(link) = self.links.get_mut(index) else { return Ok(()) };
        link.command(name, text, now.run);
        self.tell(index, now)
    }

    /// A line that somebody typed: an actuator's name and its value.
    fn typed(&mut self, line: &str) -> Result<()> {
        let line = line.trim();
        match line.split_once(|c: char| c.is_whitespace() || c == '=') {
            Some((name, text)) => self.set(name, text.trim_start_matches(['=', ' '])),
            None if line.is_empty() => Ok(()),
            None => self
                .face
                .say(&format!("not sent: `{line}`: write the name of an actuator and its value")),
        }
    }

    /// Lines of the standard input, unless it is the recording, or a screen reads keys.
    fn listen(&self) {
        let is_taken = self.args.device.as_deref() == Some("-");
        let all = self.links.iter().flat_map(|link| &link.board.devices);
        let has_actuators = all.into_iter().any(|one| one.direction == Direction::Actuator);
        let is_table = self.args.format == Some(MonitorFormat::Table);
        if is_taken || !has_actuators || is_table || self.face.has_terminal() {
            return;
        }
        let to_loop = self.to_loop.clone();
        // It ends with the program: nothing can take a thread away from a read.
        let _ = std::thread::spawn(move || {
            for line in std::io::stdin().lines().map_while(Result::ok) {
                if to_loop.send(Heard::Line(line)).is_err() {
                    return;
                }
            }
        });
    }

    /// Closes the outputs and prints the counts.
    fn finish(&mut self, now: Moment) -> Result<()> {
        for output in &mut self.outputs {
            for wish in output.close(now) {
                match wish {
                    Wish::Trouble { what, help } => {
                        self.terminal.aside(&format!("{what}; {help}"))?;
                    }
                    Wish::Note(text) => self.terminal.aside(&text)?,
                    Wish::Set { .. } => {}
                }
            }
        }
        if let Some(rules) = &mut self.rules {
            let broken = rules.look(now, true);
            for line in broken.into_iter().chain(rules.summary()) {
                self.terminal.aside(&line)?;
            }
        }
        if let Some(summing) = self.summing.take() {
            for line in text(&summing.done()).lines() {
                self.terminal.aside(line)?;
            }
            return Ok(());
        }
        for link in &self.links {
            let counts = link.counts();
            let lost = if link.board.schema.stamp {
                format!(", {} reports lost", counts.lost)
            } else {
                String::new()
            };
            let name =
                if self.links.len() > 1 { format!("{}: ", link.board.name) } else { String::new() };
            self.terminal.aside(&format!(
                "{name}{} frames, {} bytes dropped{lost}",
                counts.frames, counts.dropped_bytes
            ))?;
        }
        Ok(())
    }
}
