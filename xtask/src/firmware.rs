//! `cargo xtask firmware --matrix`: builds the firmware of small designs, one for each kind, for every board that a
//! profile covers, with the ChibiOS tree that `CHIBIOS` names.
//!
//! `cells` makes designs and firmware, `build` calls make and reads the results, `table` prints; `rust` does the same
//! for Embassy, as far as a PC can judge it.
//! Everything is built in a scratch folder, one for each board. A cell is a whole program with its own configuration,
//! so its sizes are those of a user's program. Code that many cells share is compiled once; with `ccache`, so is code
//! that many boards share.

mod build;
mod cells;
mod rust;
mod table;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use anyhow::{Context as _, Result, bail, ensure};

use build::{Built, Came};
use cells::{Cell, Made, Notes};

use crate::mutants::Chance;
use crate::say;

const USAGE: &str = "CHIBIOS=FOLDER cargo xtask firmware --matrix [--boards A,B] [--kinds a,b] [--jobs N] \
                     [--scratch FOLDER] [--resume LOG] [--write | --check BOARDS --seed HEX]";

/// The page that a complete run writes.
const PAGE: &str = "docs/firmware-matrix.md";

/// The options of a call.
#[derive(Debug, Default)]
struct Options {
    boards: Option<BTreeSet<String>>,
    kinds: Option<BTreeSet<String>>,
    jobs: usize,
    scratch: Option<PathBuf>,
    /// The output of an earlier run on the same sources: the cells that it has built are not built again.
    resume: Option<PathBuf>,
    write: bool,
    /// How many boards are drawn, whose cells must be those of the page.
    check: Option<usize>,
    /// What they are drawn by.
    seed: u64,
}

impl Options {
    fn read(arguments: &[String]) -> Result<Self> {
        let mut options = Self { jobs: 2, ..Self::default() };
        let mut words = arguments.iter();
        ensure!(words.next().is_some_and(|word| word == "--matrix"), USAGE);
        while let Some(word) = words.next() {
            let mut next = || words.next().context(USAGE);
            let listed = |text: &str| Some(text.split(',').map(str::to_owned).collect());
            match word.as_str() {
                "--boards" => options.boards = listed(next()?),
                "--kinds" => options.kinds = listed(next()?),
                "--jobs" => options.jobs = next()?.parse().context(USAGE)?,
                "--scratch" => options.scratch = Some(next()?.into()),
                "--resume" => options.resume = Some(next()?.into()),
                "--write" => options.write = true,
                "--check" => options.check = Some(next()?.parse().context(USAGE)?),
                "--seed" => options.seed = u64::from_str_radix(next()?, 16).context(USAGE)?,
                _ => bail!(USAGE),
            }
        }
        ensure!(options.jobs > 0, USAGE);
        let is_part = options.boards.is_some() || options.kinds.is_some();
        ensure!(!(options.write && is_part), "--write is for the whole matrix");
        ensure!(options.check.is_none() || !(options.write || is_part), USAGE);
        Ok(options)
    }
}

/// A cell and its result.
struct Done {
    cell: Cell,
    outcome: Outcome,
}

/// The result of a cell.
enum Outcome {
    /// The MCU has no such unit, or the system has no driver for it.
    NotOffered,
    /// The units exist, but not on pins that are free together.
    NoWiring(String),
    Built(Built, Notes),
    /// It is larger than the MCU's memory.
    TooLarge(String),
    /// It was not generated or not built; with the reason.
    Failed(String),
}

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    if let Some((word, rest)) = arguments.split_first()
        && word == "--embassy"
    {
        return rust::run(rest);
    }
    let options = Options::read(arguments)?;
    let tree = std::env::var("CHIBIOS").context("CHIBIOS does not name a ChibiOS tree")?;
    let tree = Path::new(&tree).canonicalize().with_context(|| tree.clone())?;
    let scratch = options.scratch.clone().unwrap_or_else(|| {
        std::env::temp_dir().join(format!("sensedsl-matrix-{}", std::process::id()))
    });
    let mut cells = cells::all(options.boards.as_ref(), options.kinds.as_ref())?;
    if let Some(count) = options.check {
        let boards = cells.iter().map(|cell| cell.board.as_str()).collect();
        let drawn = drawn(&boards, count, options.seed);
        cells.retain(|cell| drawn.contains(&cell.board));
    }
    let earlier = match &options.resume {
        Some(log) => {
            earlier(&std::fs::read_to_string(log).with_context(|| log.display().to_string())?)
        }
        None => Earlier::new(),
    };
    let done = run_all(cells, options.jobs, &tree, &scratch, &earlier);
    if options.scratch.is_none() {
        std::fs::remove_dir_all(&scratch).with_context(|| scratch.display().to_string())?;
    }
    if options.check.is_some() {
        return table::compare(&done);
    }
    let page = table::page(&done)?;
    if options.write {
        std::fs::write(PAGE, &page).context(PAGE)?;
    } else {
        say(&page)?;
    }
    let failed = done.iter().filter(|one| matches!(one.outcome, Outcome::Failed(_))).count();
    ensure!(failed == 0, "{failed} of {} cells failed", done.len());
    Ok(())
}

/// So many boards, drawn by a seed.
pub(crate) fn drawn(boards: &BTreeSet<&str>, count: usize, seed: u64) -> BTreeSet<String> {
    let mut left: Vec<&str> = boards.iter().copied().collect();
    let mut chance = Chance::of(seed, 0);
    let mut one = || (!left.is_empty()).then(|| left.remove(chance.below(left.len())).to_owned());
    (0..count).filter_map(|_| one()).collect()
}

/// The programs that an earlier run has built, by board and kind.
type Earlier = BTreeMap<(String, String), Built>;

/// Reads the output of `tell`. A program with warnings is left out, because its line does not contain them.
fn earlier(log: &str) -> Earlier {
    let built = |line: &str| {
        let (_, cell) = line.split_once(' ')?;
        let (cell, sizes) = cell.split_once(": ")?;
        let (board, kind) = cell.split_once(' ')?;
        Some(((board.to_owned(), kind.to_owned()), Built::from_sizes(sizes)?))
    };
    log.lines().filter_map(built).collect()
}

/// Works on several boards at once; the result is in the order of the cells. The cells of a board are built in one
/// folder, one after another.
fn run_all(
    cells: Vec<Cell>,
    jobs: usize,
    tree: &Path,
    scratch: &Path,
    earlier: &Earlier,
) -> Vec<Done> {
    let numbered: Vec<(usize, &Cell)> = cells.iter().enumerate().collect();
    let boards: Vec<&[(usize, &Cell)]> =
        numbered.chunk_by(|(_, one), (_, next)| one.board == next.board).collect();
    let next = AtomicUsize::new(0);
    let results: Mutex<Vec<(usize, Outcome)>> = Mutex::default();
    let work = || {
        while let Some(board) = boards.get(next.fetch_add(1, Ordering::Relaxed)) {
            for (at, cell) in *board {
                let outcome = outcome(cell, tree, &scratch.join(&cell.board), earlier);
                tell(cell, &outcome, *at, cells.len());
                results.lock().unwrap_or_else(PoisonError::into_inner).push((*at, outcome));
            }
            if let Some((_, cell)) = board.first() {
                // If this fails, the rest is removed with the scratch folder.
                let _ = std::fs::remove_dir_all(scratch.join(&cell.board));
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            let _ = scope.spawn(work);
        }
    });
    let mut results = results.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.sort_by_key(|(at, _)| *at);
    let pair = |(cell, (_, outcome))| Done { cell, outcome };
    cells.into_iter().zip(results).map(pair).collect()
}

fn outcome(cell: &Cell, tree: &Path, folder: &Path, earlier: &Earlier) -> Outcome {
    match cells::make(cell) {
        Made::NotOffered => Outcome::NotOffered,
        Made::NoWiring(why, _) => Outcome::NoWiring(why),
        Made::Refused(why) => Outcome::Failed(why),
        Made::Files(files, notes) => {
            if let Some(built) = earlier.get(&(cell.board.clone(), cell.kind.clone())) {
                return Outcome::Built(built.clone(), notes);
            }
            match build::build(&files, tree, folder) {
                Ok(Came::Built(built)) => Outcome::Built(built, notes),
                Ok(Came::TooLarge(why)) => Outcome::TooLarge(why),
                Err(error) => Outcome::Failed(format!("{error:#}")),
            }
        }
    }
}

/// Prints a line on the standard error, because the whole run takes long.
fn tell(cell: &Cell, outcome: &Outcome, at: usize, all: usize) {
    use std::io::Write as _;
    let what = match outcome {
        Outcome::NotOffered => "not offered".to_owned(),
        Outcome::NoWiring(_) => "no wiring".to_owned(),
        Outcome::Built(built, _) => built.sizes(),
        Outcome::TooLarge(why) => format!("too large: {why}"),
        Outcome::Failed(why) => format!("FAILED: {why}"),
    };
    let (board, kind) = (&cell.board, &cell.kind);
    // There is nowhere to report a failure to report.
    let _ = writeln!(std::io::stderr(), "{}/{all} {board} {kind}: {what}", at + 1);
}
