//! What `--watch` holds a run to: the rules of a file's tests, whatever the board's world is.

use std::path::Path;
use std::time::Duration;

use anyhow::{Result, bail};
use sensedsl_diagnostics::codes::e0537_no_tests::no_tests;
use sensedsl_host::{Board, Moment, News, What};
use sensedsl_model::design::{Design, DeviceIndex};
use sensedsl_session::has_errors;
use sensedsl_twin::trial::{Broken, RuleVerdict, RunningRules};

use crate::cli::{MonitorArgs, On};
use crate::commands::input;
use crate::status::{Reported, Status};
use crate::terminal::Terminal;

/// The design whose rules are watched.
pub(super) struct Requirements(Design);

impl Requirements {
    /// Reads the file; what is wrong with it was told.
    pub(super) fn read(path: &Path, args: &MonitorArgs, terminal: &Terminal) -> Result<Self> {
        let on = On { board: None, target: None, reach: args.reach.clone() };
        let snapshot = input::load(path, &on);
        let diagnostics = snapshot.diagnostics();
        let sound = snapshot.sound().filter(|_| !has_errors(diagnostics));
        let Some(sound) = sound else {
            terminal.diagnostics(diagnostics, snapshot.sources())?;
            bail!(Reported(Status::Wrong));
        };
        if sound.design.tests.is_empty() {
            let why = no_tests(input::place(sound.design));
            terminal.diagnostics(&[why], snapshot.sources())?;
            bail!(Reported(Status::Wrong));
        }
        Ok(Self(sound.design.clone()))
    }

    /// The rules, over the boards that are watched.
    pub(super) fn rules(&self, boards: Vec<Board>) -> Rules<'_> {
        let is_there = |device: DeviceIndex| {
            let name = self.0.device(device).map(|one| one.name.value.as_str());
            boards
                .iter()
                .flat_map(|board| &board.devices)
                .any(|one| Some(one.name.as_str()) == name)
        };
        let running = RunningRules::new(&self.0, &is_there);
        Rules { design: &self.0, running, boards, is_broken: false }
    }
}

/// The rules of a run.
pub(super) struct Rules<'a> {
    design: &'a Design,
    running: RunningRules<'a>,
    boards: Vec<Board>,
    is_broken: bool,
}

impl Rules<'_> {
    /// What is said at the beginning: which rules nobody can watch.
    pub(super) fn begin(&self) -> Vec<String> {
        let unseen = self.running.unseen();
        unseen
            .iter()
            .map(|(rule, name)| format!("not watched: {rule} (no report has {name})"))
            .collect()
    }

    /// Whether a rule asks for the states of devices.
    pub(super) fn asks_for_health(&self) -> bool {
        self.running.asks_for_health()
    }

    pub(super) fn take(&mut self, news: &News<'_>) {
        let Some(board) = self.boards.get(news.board) else { return };
        let design = self.design;
        let find = |place: usize| {
            let own = board.devices.get(place)?;
            let index = design.devices.iter().position(|one| one.name.value == own.name)?;
            Some((DeviceIndex(index), own))
        };
        let at_ns = nanoseconds(news.at.run);
        match news.what {
            What::Report(report) => {
                for (place, value) in &report.values {
                    let Some((device, own)) = find(*place) else { continue };
                    let shown = |element: usize| Some(own.shown(*value.get(element)?));
                    self.running.value(device, at_ns, &shown);
                }
            }
            What::Command { device: place, value } => {
                if let Some((device, own)) = find(place) {
                    let shown = |element: usize| Some(own.shown(*value.get(element)?));
                    self.running.value(device, at_ns, &shown);
                }
            }
            What::Health(health) => {
                for one in &health.devices {
                    let place = board.devices.iter().position(|own| own.id == one.id);
                    if let Some((device, _)) = place.and_then(find) {
                        self.running.health(device, at_ns, one.status);
                    }
                }
            }
            What::Received(_) | What::Sent(_) | What::Online | What::Offline(_) => {}
        }
    }

    /// What has been broken since the last look, for people.
    pub(super) fn look(&mut self, now: Moment, is_end: bool) -> Vec<String> {
        let broken = self.running.look(nanoseconds(now.run), is_end);
        self.is_broken |= !broken.is_empty();
        broken.iter().map(words).collect()
    }

    /// What is said at the end.
    pub(super) fn summary(&self) -> Vec<String> {
        let (watched, broken) = self.running.counts();
        let plural = |count: usize, word: &str| match count {
            1 => format!("1 {word}"),
            many => format!("{many} {word}s"),
        };
        let mut all = vec![format!("{} watched, {} broken", plural(watched, "rule"), broken.len())];
        all.extend(broken.iter().map(|(rule, count)| {
            let times = usize::try_from(*count).unwrap_or(usize::MAX);
            format!("  {rule}: {}", plural(times, "time"))
        }));
        all
    }

    /// How the program ends where it would have ended well.
    pub(super) fn status(&self, status: Status) -> Status {
        if self.is_broken && status == Status::Done { Status::Wrong } else { status }
    }
}

fn nanoseconds(run: Duration) -> u64 {
    u64::try_from(run.as_nanos()).unwrap_or(u64::MAX)
}

/// A broken rule in one line.
fn words(one: &Broken) -> String {
    let RuleVerdict::Violated { first, .. } = &one.judged.verdict else { return one.rule.clone() };
    let margin = one.judged.margin.as_ref().map(|margin| format!(" ({margin})"));
    let seconds = Duration::from_nanos(first.at_ns).as_secs_f64();
    let (test, rule, margin) = (&one.test, &one.rule, margin.unwrap_or_default());
    format!("BROKEN {test}: {rule}{margin}; at {seconds:.3} s: {}", first.words())
}
