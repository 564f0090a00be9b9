//! `cargo xtask mutants`: mistakes drawn by chance, put one at a time into generated firmware and its runtime, built, and
//! run as a user does it: `sensedsl simulate FILE --firmware IMAGE --judge`. Who notices?
//!
//! A number becomes another one, an operator its opposite, two rows of a table change places, a line is left out. Each
//! is one object that is compiled again and a program that is linked again. What the compiler refuses, what leaves the
//! program as it is, what the command notices and what it does not is printed as Markdown.

mod draw;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use anyhow::{Context as _, Result, bail, ensure};

use crate::say;
use draw::{Chance, Site};

const USAGE: &str = "[CHIBIOS=FOLDER] cargo xtask mutants --program SENSEDSL [--design FILE] \
                     [--target chibios|embassy] [--count N] [--seed N] [--seconds N] [--scratch FOLDER]";
/// A program that runs in circles is ended after so many seconds.
const PATIENCE_S: &str = "600";

/// What is asked for.
struct Options {
    program: PathBuf,
    design: PathBuf,
    is_rust: bool,
    count: usize,
    seed: u64,
    seconds: String,
    scratch: PathBuf,
}

impl Options {
    fn read(arguments: &[String]) -> Result<Self> {
        let mut options = Self {
            program: PathBuf::new(),
            design: "examples/all_kinds.sense".into(),
            is_rust: false,
            count: 60,
            seed: 1,
            seconds: "6".to_owned(),
            scratch: "target/mutants".into(),
        };
        let mut words = arguments.iter();
        while let Some(word) = words.next() {
            let next = words.next().context(USAGE)?;
            match word.as_str() {
                "--program" => options.program = Path::new(next).canonicalize()?,
                "--design" => options.design = next.into(),
                "--target" => options.is_rust = next == "embassy",
                "--count" => options.count = next.parse().context(USAGE)?,
                "--seed" => options.seed = next.parse().context(USAGE)?,
                "--seconds" => options.seconds.clone_from(next),
                "--scratch" => options.scratch = next.into(),
                _ => bail!(USAGE),
            }
        }
        ensure!(options.program.is_file(), USAGE);
        options.design = options.design.canonicalize()?;
        Ok(options)
    }

    const fn target(&self) -> &'static str {
        if self.is_rust { "embassy" } else { "chibios" }
    }

    /// The generated folder of the design's first board.
    fn generate(&self) -> Result<PathBuf> {
        std::fs::create_dir_all(&self.scratch)?;
        let folder = self.scratch.canonicalize()?.join(self.target());
        let mut generate = Command::new(&self.program);
        generate.arg("generate").arg(&self.design).args(["--target", self.target(), "-o"]);
        let output = generate.arg(&folder).output()?;
        ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let mut boards = Vec::new();
        for entry in std::fs::read_dir(folder.join("firmware"))? {
            boards.push(entry?.path());
        }
        boards.sort();
        boards.into_iter().next().context("there is no firmware")
    }

    fn build(&self, board: &Path) -> Result<Output> {
        let mut command = if self.is_rust {
            let mut cargo = Command::new("cargo");
            cargo.args(["build", "--release", "--quiet"]);
            cargo
        } else {
            let tree = std::env::var("CHIBIOS").context("CHIBIOS names the tree")?;
            let mut make = Command::new("make");
            make.args(["-j2", "UP_MODE=production", "USE_LTO=no"]).arg(format!("CHIBIOS={tree}"));
            make
        };
        Ok(command.current_dir(board).output()?)
    }

    fn image(&self, board: &Path) -> Result<PathBuf> {
        if !self.is_rust {
            return Ok(board.join("build/production/sense.elf"));
        }
        let folder = board.join("target/thumbv7em-none-eabi/release");
        for entry in std::fs::read_dir(&folder)? {
            let path = entry?.path();
            if path.is_file() && path.extension().is_none() {
                return Ok(path);
            }
        }
        bail!("{} has no program", folder.display())
    }

    /// What is written to the flash.
    fn flash(&self, board: &Path) -> Result<Vec<u8>> {
        let to = board.join("mutant.bin");
        let mut copy = Command::new("arm-none-eabi-objcopy");
        copy.args(["-O", "binary"]).arg(self.image(board)?).arg(&to);
        ensure!(copy.status()?.success(), "objcopy failed");
        Ok(std::fs::read(to)?)
    }

    /// What the command says: nothing where all is well.
    fn judged(&self, board: &Path) -> Result<Option<String>> {
        let mut simulate = Command::new("timeout");
        simulate.arg(PATIENCE_S).arg(&self.program).arg("simulate").arg(&self.design);
        simulate.args(["--target", self.target(), "--judge", "--seconds", &self.seconds]);
        let output = simulate.arg("--firmware").arg(self.image(board)?).output()?;
        if output.status.success() {
            return Ok(None);
        }
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        let errors = text.lines().filter(|line| line.starts_with("error"));
        let mut all: Vec<&str> = errors.collect();
        all.dedup();
        Ok(Some(all.first().map_or_else(|| "it never ended".to_owned(), |one| (*one).to_owned())))
    }

    /// All places: those of generated files, and those of the runtime.
    fn sites(&self, board: &Path) -> Result<[Vec<Site>; 2]> {
        if !self.is_rust {
            let of = |folder: &str| draw::below(&board.join(folder), "c");
            return Ok([of("generated")?, of("uproxy")?]);
        }
        let (runtime, own): (Vec<Site>, Vec<Site>) = draw::below(&board.join("src"), "rs")?
            .into_iter()
            .partition(|one| one.file.starts_with(board.join("src/rt")));
        let shared = draw::below(&board.join("sense-rt/src"), "rs")?;
        Ok([own, runtime.into_iter().chain(shared).collect()])
    }
}

/// What came of a mistake.
fn outcome(options: &Options, board: &Path, site: &Site, right: &[u8]) -> Result<String> {
    let text = std::fs::read_to_string(&site.file)?;
    std::fs::write(&site.file, site.made(&text))?;
    let built = options.build(board);
    let came = (|| {
        let built = built?;
        let said = String::from_utf8_lossy(&built.stderr).into_owned();
        if !built.status.success() || said.contains("warning") {
            return Ok("compiler".to_owned());
        }
        if options.flash(board)? == right {
            return Ok("the same program".to_owned());
        }
        Ok(options.judged(board)?.unwrap_or_else(|| "nobody".to_owned()))
    })();
    std::fs::write(&site.file, text)?;
    came
}

pub(super) fn run(arguments: &[String]) -> Result<()> {
    let options = Options::read(arguments)?;
    let board = options.generate()?;
    let built = options.build(&board)?;
    ensure!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let right = options.flash(&board)?;
    let wrong = options.judged(&board)?;
    ensure!(wrong.is_none(), "a false alarm without a mistake: {}", wrong.unwrap_or_default());
    let groups = options.sites(&board)?;
    let mut chance = Chance(options.seed);
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    say("| mistake | noticed by |\n| --- | --- |\n")?;
    for number in 0..options.count {
        let Some(group) = groups.get(number % groups.len()) else { continue };
        let Some(site) = group.get(chance.below(group.len())) else { continue };
        let text = std::fs::read_to_string(&site.file)?;
        let (told, came) = (site.told(&text), outcome(&options, &board, site, &right)?);
        let place = site.file.strip_prefix(&board).unwrap_or(&site.file).display();
        let class = match came.as_str() {
            "compiler" => "compiler",
            "the same program" => "the same program",
            "nobody" => "nobody",
            _ => "the command",
        };
        *counts.entry(class).or_default() += 1;
        let by = came.replace('|', "\\|");
        say(&format!("| {} at {place}:{}: {told} | {by} |\n", site.sort, site.line))?;
    }
    let all: Vec<String> = counts.iter().map(|(class, count)| format!("{count} {class}")).collect();
    say(&format!("\nOf {} drawn: {}.\n", options.count, all.join(", ")))
}
