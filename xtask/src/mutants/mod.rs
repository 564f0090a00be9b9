//! `cargo xtask mutants`: mistakes are drawn at random and put into generated firmware and its runtime, one at a time.
//! The firmware is built and run as a user would: `sensedsl simulate FILE --firmware IMAGE --judge`. Which mistakes are
//! noticed?
//!
//! A number is replaced by another one, an operator by its opposite, two rows of a table are exchanged, a line is left
//! out. Each mistake takes one object to compile and a program to link. Images are kept in the scratch folder, so that
//! another judge needs no compiler; `--build` only makes images. Each mistake is a line in a file that grows
//! (`--into`), from which `--page` makes Markdown. A mistake that is already in the file is not done again, so a
//! campaign that was stopped continues with the same call. `--only WORD` removes the lines with that word, and does
//! them again. `--least PERCENT` fails if fewer of the mistakes that change anything are noticed.

mod campaign;
mod draw;
mod page;
mod same;
mod subject;

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail, ensure};

use crate::say;
pub(crate) use draw::Chance;
use subject::Settings;

const USAGE: &str = "[CHIBIOS=FOLDER] cargo xtask mutants --program SENSEDSL [--design FILE]... \
                     [--target chibios|embassy] [--count N] [--seed N] [--seconds N] [--scratch FOLDER] \
                     [--into FILE] [--jobs N] [--only WORD] [--least PERCENT] [--build], or --page FILE";
const EXAMPLES: [&str; 8] = [
    "all_kinds",
    "fig2",
    "miniature_car",
    "line_follower",
    "quadcopter",
    "arm",
    "greenhouse",
    "rover",
];

/// The options of a call.
struct Options {
    settings: Settings,
    designs: Vec<PathBuf>,
    /// Whether the firmware is in Rust; `None` for both.
    is_rust: Option<bool>,
    count: usize,
    seed: u64,
    into: PathBuf,
    jobs: usize,
    /// The word of the lines in the file that are done again.
    only: Option<String>,
    /// The least percentage that must be noticed.
    least: usize,
}

impl Options {
    fn read(arguments: &[String]) -> Result<Self> {
        let settings = Settings {
            program: PathBuf::new(),
            seconds: "6".to_owned(),
            scratch: "target/mutants".into(),
            is_building: false,
        };
        let mut options = Self {
            settings,
            designs: Vec::new(),
            is_rust: None,
            count: 60,
            seed: 1,
            into: "target/mutants/drawn.tsv".into(),
            jobs: 2,
            only: None,
            least: 0,
        };
        let mut words = arguments.iter();
        while let Some(word) = words.next() {
            if word == "--build" {
                options.settings.is_building = true;
                continue;
            }
            let next = words.next().context(USAGE)?;
            match word.as_str() {
                "--program" => options.settings.program = Path::new(next).canonicalize()?,
                "--design" => options.designs.push(next.into()),
                "--target" => options.is_rust = Some(next == "embassy"),
                "--count" => options.count = next.parse().context(USAGE)?,
                "--seed" => options.seed = next.parse().context(USAGE)?,
                "--seconds" => options.settings.seconds.clone_from(next),
                "--scratch" => options.settings.scratch = next.into(),
                "--into" => options.into = next.into(),
                "--jobs" => options.jobs = next.parse().context(USAGE)?,
                "--least" => options.least = next.parse().context(USAGE)?,
                "--only" => options.only = Some(next.clone()),
                _ => bail!(USAGE),
            }
        }
        ensure!(options.settings.program.is_file(), USAGE);
        std::fs::create_dir_all(&options.settings.scratch)?;
        options.settings.scratch = options.settings.scratch.canonicalize()?;
        if options.designs.is_empty() {
            let file = |name: &&str| PathBuf::from(format!("examples/{name}.sense"));
            options.designs = EXAMPLES.iter().map(file).collect();
        }
        Ok(options)
    }

    /// All designs for all targets.
    fn pairs(&self) -> Vec<(&Path, bool)> {
        let both = self.designs.iter().flat_map(|design| [(design, false), (design, true)]);
        both.filter(|(_, is_rust)| self.is_rust.is_none_or(|wanted| wanted == *is_rust))
            .map(|(design, is_rust)| (design.as_path(), is_rust))
            .collect()
    }
}

pub(super) fn run(arguments: &[String]) -> Result<()> {
    if let [word, file] = arguments
        && word == "--page"
    {
        return say(&page::page(&std::fs::read_to_string(file)?));
    }
    let options = Options::read(arguments)?;
    campaign::run(&options)?;
    let lines = std::fs::read_to_string(&options.into)?;
    say(&page::page(&lines))?;
    let share = page::share(&lines);
    ensure!(share >= options.least, "{share} % are noticed, and not {} %", options.least);
    Ok(())
}
