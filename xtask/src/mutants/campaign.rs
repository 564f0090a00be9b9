//! The mistakes of a campaign, one after another in several threads: each thread takes the next mistake whose design no
//! other thread is using.

use std::collections::{BTreeSet, VecDeque};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, MutexGuard, PoisonError};

use anyhow::{Context as _, Result, ensure};

use super::Options;
use super::draw::Chance;
use super::subject::{Subject, target};
use crate::say;

/// A design for a target: not examined yet, unsuitable, or ready.
enum Slot<'a> {
    New,
    LeftOut,
    Ready(Box<Subject<'a>>),
}

/// The state that all threads share.
struct Campaign<'a> {
    options: &'a Options,
    pairs: Vec<(&'a Path, bool)>,
    slots: Vec<Mutex<Slot<'a>>>,
    left: Mutex<VecDeque<usize>>,
    into: Mutex<std::fs::File>,
}

fn lock<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}

pub(super) fn run(options: &Options) -> Result<()> {
    let done = done(options)?;
    let pairs = options.pairs();
    ensure!(!pairs.is_empty(), "there are no designs");
    let slots = pairs.iter().map(|_| Mutex::new(Slot::New)).collect();
    let left = (0..options.count).filter(|number| !done.contains(number)).collect();
    let into = std::fs::File::options().create(true).append(true).open(&options.into)?;
    let campaign =
        Campaign { options, pairs, slots, left: Mutex::new(left), into: Mutex::new(into) };
    std::thread::scope(|scope| {
        let work = |job| {
            scope.spawn({
                let campaign = &campaign;
                move || campaign.work(job)
            })
        };
        let threads: Vec<_> = (0..options.jobs.max(1)).map(work).collect();
        let mut results = threads.into_iter().map(|thread| match thread.join() {
            Ok(result) => result,
            Err(_) => Err(anyhow::anyhow!("a thread has ended")),
        });
        results.find(Result::is_err).unwrap_or(Ok(()))
    })
}

/// The numbers of the mistakes in the file; those that must be done again are removed from it.
fn done(options: &Options) -> Result<BTreeSet<usize>> {
    let Ok(text) = std::fs::read_to_string(&options.into) else { return Ok(BTreeSet::new()) };
    let is_kept = |line: &&str| options.only.as_ref().is_none_or(|word| !line.contains(word));
    let kept: Vec<&str> = text.lines().filter(is_kept).collect();
    std::fs::write(&options.into, kept.iter().map(|line| format!("{line}\n")).collect::<String>())?;
    let number = |line: &&str| line.split('\t').next()?.parse().ok();
    Ok(kept.iter().filter_map(number).collect())
}

impl<'a> Campaign<'a> {
    fn work(&self, job: usize) -> Result<()> {
        let folder = embassy_folder(job)?;
        while let Some((number, mut slot)) = self.next() {
            let (design, is_rust) =
                self.pairs.get(number % self.pairs.len()).context("no design")?;
            if matches!(*slot, Slot::New) {
                *slot = match Subject::new(&self.options.settings, design, *is_rust, &folder) {
                    Ok(subject) => Slot::Ready(Box::new(subject)),
                    Err(why) => {
                        let name = format!("{}, {}", design.display(), target(*is_rust));
                        say(&format!("{name} is left out: {why:#}\n"))?;
                        Slot::LeftOut
                    }
                };
            }
            if let Slot::Ready(subject) = &*slot {
                self.one(number, subject, &folder)?;
            }
        }
        Ok(())
    }

    /// The next mistake, with its design; `None` if there are no more.
    fn next(&self) -> Option<(usize, MutexGuard<'_, Slot<'a>>)> {
        loop {
            {
                let mut left = lock(&self.left);
                if left.is_empty() {
                    return None;
                }
                let free = left.iter().enumerate().find_map(|(place, number)| {
                    let slot = self.slots.get(number % self.slots.len())?.try_lock().ok()?;
                    Some((place, *number, slot))
                });
                if let Some((place, number, slot)) = free {
                    let _ = left.remove(place);
                    return Some((number, slot));
                }
            }
            std::thread::sleep(std::time::Duration::from_millis(200));
        }
    }

    /// One mistake, independent of those done before it.
    fn one(&self, number: usize, subject: &Subject<'_>, folder: &Path) -> Result<()> {
        let mut chance = Chance::of(self.options.seed, number);
        let [generated, runtime] = &subject.groups;
        let is_runtime = (number / self.pairs.len()) % 2 == 1;
        let group = if is_runtime { runtime } else { generated };
        let Some(site) = group.get(chance.below(group.len())) else { return Ok(()) };
        let text = std::fs::read_to_string(&site.file)?;
        let (class, messages) = subject.outcome(site, folder)?;
        let place = site.file.strip_prefix(&subject.board).unwrap_or(&site.file).display();
        let place = format!("{place}:{}", site.line);
        let (target, reported) = (target(subject.is_rust), site.reported(&text));
        let number = number.to_string();
        let cells =
            [&number, target, &subject.name, site.sort, &place, &reported, &class, &messages];
        let line = cells.map(|cell| cell.replace(['\t', '\n'], " ")).join("\t");
        Ok(writeln!(lock(&self.into), "{line}")?)
    }
}

/// The folder in which a thread builds Rust projects. Everything they share is copied from the first thread's.
fn embassy_folder(job: usize) -> Result<PathBuf> {
    let first = PathBuf::from("target/embassy-build");
    if job == 0 {
        std::fs::create_dir_all(&first)?;
        return Ok(first.canonicalize()?);
    }
    let own = PathBuf::from(format!("target/embassy-build-{job}"));
    if first.is_dir() && !own.is_dir() {
        let copied = Command::new("cp").arg("-a").args([&first, &own]).status()?;
        ensure!(copied.success(), "{} was not copied", first.display());
    }
    std::fs::create_dir_all(&own)?;
    Ok(own.canonicalize()?)
}
