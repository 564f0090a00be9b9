//! `cargo xtask mutants`: mistakes drawn by chance, put one at a time into generated firmware and its runtime, built, and
//! run as a user does it: `sensedsl simulate FILE --firmware IMAGE --judge`. Who notices?
//!
//! A number becomes another one, an operator its opposite, two rows of a table change places, a line is left out. Each
//! is one object that is compiled again and a program that is linked again. Images are kept in the scratch folder, so that
//! another judge needs no compiler; `--build` makes nothing but images. Each mistake is a line of a file that grows
//! (`--into`), of which `--page` makes Markdown.

mod draw;
mod page;
mod subject;

use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail, ensure};

use crate::say;
use draw::Chance;
use subject::{Settings, Subject, target};

const USAGE: &str = "[CHIBIOS=FOLDER] cargo xtask mutants --program SENSEDSL [--design FILE]... \
                     [--target chibios|embassy] [--count N] [--seed N] [--seconds N] [--scratch FOLDER] \
                     [--into FILE] [--build], or --page FILE";
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

/// What is asked for.
struct Options {
    settings: Settings,
    designs: Vec<PathBuf>,
    /// Whether it is Rust; none for both.
    is_rust: Option<bool>,
    count: usize,
    seed: u64,
    into: PathBuf,
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
    let pairs = options.pairs();
    let mut subjects: Vec<Option<Option<Subject<'_>>>> = pairs.iter().map(|_| None).collect();
    let mut chance = Chance(options.seed);
    let mut into = std::fs::File::options().create(true).append(true).open(&options.into)?;
    for number in 0..options.count {
        let turn = number % pairs.len().max(1);
        let (Some((design, is_rust)), Some(slot)) = (pairs.get(turn), subjects.get_mut(turn))
        else {
            continue;
        };
        let subject = match slot {
            Some(subject) => subject,
            None => {
                let made = Subject::new(&options.settings, design, *is_rust);
                if let Err(why) = &made {
                    say(&format!("{} is left out: {why:#}\n", design.display()))?;
                }
                slot.insert(made.ok())
            }
        };
        let Some(subject) = subject else { continue };
        let [generated, runtime] = &subject.groups;
        let is_runtime = (number / pairs.len().max(1)) % 2 == 1;
        let group = if is_runtime { runtime } else { generated };
        let Some(site) = group.get(chance.below(group.len())) else { continue };
        let text = std::fs::read_to_string(&site.file)?;
        let (class, said) = subject.outcome(site)?;
        let place = site.file.strip_prefix(&subject.board).unwrap_or(&site.file).display();
        let place = format!("{place}:{}", site.line);
        let (target, told) = (target(subject.is_rust), site.told(&text));
        let cells = [target, &subject.name, site.sort, &place, &told, &class, &said];
        writeln!(into, "{}", cells.map(|cell| cell.replace('\t', " ")).join("\t"))?;
    }
    say(&page::page(&std::fs::read_to_string(&options.into)?))
}
