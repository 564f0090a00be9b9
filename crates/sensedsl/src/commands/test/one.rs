//! One test: its boards run one after another in its world, and what they reported is held to its rules.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::Result;
use sensedsl_diagnostics::codes::e0538_test_failed as failed;
use sensedsl_diagnostics::codes::{
    e0534_no_user_code, e0536_user_code_stopped, e0539_board_of_test, e0573_process_failed,
};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_job::BoardJob;
use sensedsl_model::design::{DeviceIndex, Test};
use sensedsl_model::{FileRequest, FileUse, normal_path};
use sensedsl_report::trial_picture::{Course, Scene};
use sensedsl_twin::bench::Bench;
use sensedsl_twin::soft::SoftBoard;
use sensedsl_twin::trial::{
    Culprit, Judged, Recording, RuleVerdict, Stopped, Tested, Trial, add_faults, judge, not_judged,
};

use super::bed::Bed;
use super::bed::Place;
use super::place;
use crate::cli::SimulateArgs;
use crate::commands::simulate::{
    Built, Running, SEED, Words, attach_all, build, usual_code, world,
};
use crate::files::{Disk, shown};

/// How much of a run is drawn before and after a violation, at most.
const AROUND_NS: u64 = 2_000_000_000;

/// The programs of the boards' controllers, each compiled once.
#[derive(Default)]
pub(super) struct Programs(BTreeMap<String, Built>);

/// What came of a test.
pub(super) struct Ran<'a> {
    pub(super) test: &'a Test,
    pub(super) recording: Recording,
    /// For each rule, in their order.
    pub(super) judged: Vec<Judged>,
    /// Why it ended too early.
    pub(super) stopped: Option<Stopped>,
}

impl Ran<'_> {
    pub(super) fn is_passed(&self) -> bool {
        let is_seen = self.judged.iter().any(Judged::is_held);
        let is_good = |one: &Judged| one.is_held() || matches!(one.verdict, RuleVerdict::Unseen(_));
        self.stopped.is_none() && is_seen && self.judged.iter().all(is_good)
    }

    /// Why the test failed: a message for each rule.
    pub(super) fn failures(&self) -> Vec<Diagnostic> {
        if let Some(stopped) = &self.stopped {
            return vec![self.stop(stopped)];
        }
        let rules = self.test.rules.iter().zip(&self.judged);
        rules.filter_map(|(rule, one)| failure(rule.span, one)).collect()
    }

    /// Why the run ended too early.
    pub(super) fn stop(&self, stopped: &Stopped) -> Diagnostic {
        let (at, when) = (self.test.name.span, seconds(stopped.at_ns));
        match &stopped.culprit {
            Culprit::Plant(plant) => {
                e0573_process_failed::process_failed(at, plant, &when, &stopped.why)
            }
            Culprit::Code => e0536_user_code_stopped::user_code_stopped(at, &when, &stopped.why),
            Culprit::Board => e0539_board_of_test::stopped(at, &when, &stopped.why),
        }
    }

    /// The signals around the first moment at which a rule did not hold, or from the beginning.
    pub(super) fn scene(&self, number: usize) -> Option<Scene> {
        let (rule, judged) = (self.test.rules.get(number)?, self.judged.get(number)?);
        let (at_ns, until_ns) = match &judged.verdict {
            RuleVerdict::Violated { first, last } => {
                let until_ns = last.as_ref().map_or(first.at_ns, |last| last.at_ns);
                (Some(first.at_ns), until_ns)
            }
            RuleVerdict::Held
            | RuleVerdict::Open
            | RuleVerdict::Unknown(_)
            | RuleVerdict::Unseen(_) => (None, 0),
        };
        let end_ns = self.test.lasts_ns;
        let from_ns = at_ns.map_or(0, |at_ns| at_ns.saturating_sub(AROUND_NS));
        let to_ns = at_ns.map_or(end_ns, |_| until_ns.saturating_add(AROUND_NS).min(end_ns));
        let mut numbers = Vec::new();
        rule.rule.shape.for_each_signal(&mut |number| {
            if !numbers.contains(&number) {
                numbers.push(number);
            }
        });
        let course = |number: usize| {
            let signal = self.test.signals.get(number)?;
            let samples = &self.recording.trace.signals.get(number)?.samples;
            let samples = samples.iter().map(|(ns, value)| (*ns, signal.unit.shown(*value)));
            let unit = signal.unit.name.clone();
            Some(Course { name: signal.name.clone(), unit, samples: samples.collect() })
        };
        Some(Scene {
            title: self.test.name.value.clone(),
            rule: rule.text.clone(),
            from_ns,
            to_ns,
            marked_ns: at_ns.map(|at_ns| (at_ns, until_ns)),
            courses: numbers.into_iter().filter_map(course).collect(),
        })
    }
}

/// Why a rule failed; none if it held.
pub(super) fn failure(span: Span, one: &Judged) -> Option<Diagnostic> {
    match &one.verdict {
        RuleVerdict::Held | RuleVerdict::Unseen(_) => None,
        RuleVerdict::Unknown(name) => Some(failed::unknown(span, name)),
        RuleVerdict::Open if one.outcome.open == 0 => Some(failed::too_late(span)),
        RuleVerdict::Open => Some(failed::too_short(span)),
        RuleVerdict::Violated { .. } => {
            let (what, values) = violation(one);
            Some(failed::violated(span, &what, &values))
        }
    }
}

/// When a rule was violated and by how much; and the values.
pub(super) fn violation(one: &Judged) -> (String, String) {
    let RuleVerdict::Violated { first, last } = &one.verdict else { return Default::default() };
    let margin = one.margin.as_ref().map(|margin| format!(": {margin}")).unwrap_or_default();
    let what = format!("this did not hold at {}{margin}", seconds(first.at_ns));
    let mut values = format!("at {}: {}", seconds(first.at_ns), first.words());
    if let Some(last) = last.as_ref().filter(|last| !last.values.is_empty()) {
        values.push_str(&format!("; at {}: {}", seconds(last.at_ns), last.words()));
    }
    (what, values)
}

/// A moment for people, in seconds, to the millisecond.
pub(super) fn seconds(ns: u64) -> String {
    let text = format!("{}.{:03}", ns / 1_000_000_000, ns / 1_000_000 % 1_000);
    format!("{text} s")
}

/// Runs a test. None if it could not be run, which was told.
pub(super) fn run<'a>(
    bed: &Bed<'_>,
    test: &'a Test,
    programs: &mut Programs,
) -> Result<Option<Ran<'a>>> {
    // A real board is in its own world.
    let of_world =
        if matches!(bed.place, Place::Port(_)) { Some(None) } else { world_file(bed, test)? };
    let Some(of_world) = of_world else { return Ok(None) };
    let devices = test.devices();
    let is_on = |job: &&BoardJob<'_>| job.devices.iter().any(|one| devices.contains(&one.index));
    let boards: Vec<&BoardJob<'_>> = bed.jobs.iter().filter(is_on).collect();
    let beside: Vec<DeviceIndex> =
        bed.jobs.iter().flat_map(|job| job.devices.iter().map(|one| one.index)).collect();
    let simulation = SimulateArgs {
        file: bed.args.file.clone(),
        world: of_world,
        seed: bed.args.seed.or(test.seed),
        reach: bed.args.reach.clone(),
        ..SimulateArgs::default()
    };
    let mut recording = Recording::new(test);
    let (mut stopped, mut unseen) = (None, Vec::new());
    if let Err(why) = bed.place.suits(test, &boards) {
        bed.terminal.diagnostics(&[*why], bed.sources)?;
        return Ok(None);
    }
    for job in boards {
        let (mut board, of_world) = if let Place::Port(port) = &bed.place {
            match place::port(bed, job, port) {
                Ok(board) => (board, Vec::new()),
                Err(why) => {
                    bed.terminal.diagnostics(&[*why], bed.sources)?;
                    return Ok(None);
                }
            }
        } else {
            let Some(mut surroundings) = world(&simulation, bed.terminal, job, &beside)? else {
                return Ok(None);
            };
            add_faults(&mut surroundings, test, job);
            let seed = simulation.seed.or(surroundings.seed).unwrap_or(SEED);
            let mut bench = Bench::new(job, &surroundings, seed);
            let folder = simulation.world.as_deref().and_then(Path::parent);
            attach_all(&mut bench, &surroundings, folder.unwrap_or_else(|| Path::new("")));
            let board = simulated(bed, test, (job, bench), programs)?;
            let Some(board) = board else { return Ok(None) };
            (board, surroundings.commands)
        };
        let mut host = Trial::new(job, test, &of_world);
        unseen.extend(host.unseen(board.as_ref()));
        stopped = host.run(board.as_mut(), &mut recording);
        if stopped.is_some() {
            break;
        }
    }
    let judged = match stopped {
        Some(_) => not_judged(test),
        None => judge(bed.design, test, &recording.trace, &unseen),
    };
    Ok(Some(Ran { test, recording, judged, stopped }))
}

/// The file with the world of a test, which is beside the file that the test is in.
fn world_file(bed: &Bed<'_>, test: &Test) -> Result<Option<Option<PathBuf>>> {
    let Some(world) = &test.world else { return Ok(Some(None)) };
    let file = bed.sources.name(test.name.span.file);
    let beside = Path::new(file).parent().unwrap_or_else(|| Path::new(""));
    let path = normal_path(&beside.join(&world.value).to_string_lossy());
    let disk = Disk::of(&bed.args.file, &bed.args.reach.allow_outside);
    match disk.bytes(Path::new(&path), FileUse::World) {
        Ok(_) => Ok(Some(Some(PathBuf::from(path)))),
        Err(unread) => {
            let wanted = FileRequest { path: &path, what: FileUse::World, by_user: false };
            let why = unread.diagnostic(world.span, &wanted);
            bed.terminal.diagnostics(&[why], bed.sources)?;
            Ok(None)
        }
    }
}

/// The board in a simulated world. None if there is none, which was told.
fn simulated(
    bed: &Bed<'_>,
    test: &Test,
    (job, bench): (&BoardJob<'_>, Bench),
    programs: &mut Programs,
) -> Result<Option<Box<dyn Tested>>> {
    let Place::Image(path) = &bed.place else {
        let board = soft_board(bed, test, (job, bench), programs)?;
        return Ok(board.map(|board| Box::new(board) as Box<dyn Tested>));
    };
    match place::image(bed, (job, bench), path.as_deref())? {
        Ok(board) => Ok(Some(board)),
        Err(why) => {
            bed.terminal.diagnostics(&[*why], bed.sources)?;
            Ok(None)
        }
    }
}

/// The board in this program, with the code of its controllers. None if it has none, which was told.
fn soft_board(
    bed: &Bed<'_>,
    test: &Test,
    (job, bench): (&BoardJob<'_>, Bench),
    programs: &mut Programs,
) -> Result<Option<SoftBoard>> {
    let board = SoftBoard::new(job, bench);
    let Some(first) = job.controllers.first() else { return Ok(Some(board)) };
    let name = &job.board.name.value;
    let at = bed.design.device(first.controller.device).map_or(test.name.span, |one| one.name.span);
    let refuse = |why: Diagnostic| bed.terminal.diagnostics(&[why], bed.sources);
    let built = match programs.0.get(name) {
        Some(built) => built.clone(),
        None => {
            let folder = folder(bed, name);
            if !folder.is_dir() {
                let file = folder.join("user").join(format!("{}.c", first.ident));
                let own = bed.design.device(first.controller.device);
                let own = own.map_or(first.ident.as_str(), |own| own.name.value.as_str());
                refuse(e0534_no_user_code::no_user_code(at, own, &shown(&file)))?;
                return Ok(None);
            }
            match build(job, &folder, at, Words::Above)? {
                Ok(built) => built,
                Err(why) => {
                    refuse(*why)?;
                    return Ok(None);
                }
            }
        }
    };
    programs.0.insert(name.clone(), built.clone());
    match Running::new(built) {
        Ok(running) => Ok(Some(board.with_code(Box::new(running)))),
        Err(why) => {
            refuse(e0536_user_code_stopped::user_code_stopped(at, "0 s", &why))?;
            Ok(None)
        }
    }
}

/// The folder of a board's firmware.
fn folder(bed: &Bed<'_>, board: &str) -> PathBuf {
    let Some(given) = &bed.args.code else { return usual_code(&bed.args.file, board) };
    let own = given.join(board);
    if own.is_dir() { own } else { given.clone() }
}
