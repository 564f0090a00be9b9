//! ST's open pin data. In: a folder. Out: facts by part number.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, ensure};
use sensedsl_board::remap::Blocks;
use sensedsl_board::signal::Function;
use sensedsl_board::table;
use sensedsl_import::{Format, Importer, ReadError, Source};

use super::super::sources::entries;

/// The prefixes of the peripherals that are compared: those that device kinds need.
const PERIPHERALS: [&str; 11] =
    ["I2C", "FMPI2C", "SPI", "USART", "UART", "LPUART", "TIM", "CAN", "FDCAN", "ADC", "DAC"];

/// An MCU file.
pub(crate) struct Chip {
    pub(crate) numbers: Vec<String>,
    pub(crate) package: String,
    pub(crate) facts: Facts,
}

/// The alternate function of a usage, or its remap blocks; neither if it has none.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Route {
    alternate: Option<u8>,
    blocks: Option<Blocks>,
}

impl Route {
    pub(crate) fn is_known(&self) -> bool {
        self.alternate.is_some() || self.blocks.is_some()
    }
}

impl fmt::Display for Route {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.alternate, self.blocks) {
            (Some(alternate), _) => write!(f, "@{alternate}"),
            (None, Some(blocks)) => write!(f, "#{blocks}"),
            (None, None) => write!(f, "-"),
        }
    }
}

/// The facts in a table.
#[derive(Default)]
pub(crate) struct Facts {
    /// How the pin is switched to a usage, by pin and usage of one unit.
    pub(crate) usages: BTreeMap<(String, String), Route>,
    /// The contact of each pin.
    pub(crate) positions: BTreeMap<String, String>,
}

/// The tables of all MCUs, and the time that making them took.
pub(crate) struct Imported {
    pub(crate) tables: Vec<String>,
    pub(crate) wall: Duration,
    /// The CPU time of all threads, if the system gives it: a busy machine does not change it.
    pub(crate) work: Option<Duration>,
}

/// Imports all MCUs on all cores.
pub(crate) fn import_all(folder: &Path) -> Result<Imported> {
    let folder = folder.join("mcu");
    let mut paths = entries(&folder)?;
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "xml"));
    ensure!(paths.len() > 2_000, "{} has no open pin data of ST's", folder.display());
    let (start, importer) = (Instant::now(), Importer::default());
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let shares: Vec<(Vec<Result<String>>, Option<Duration>)> = thread::scope(|scope| {
        let share = |of: usize| {
            let (paths, importer, folder) = (&paths, &importer, &folder);
            let mine = paths.iter().skip(of).step_by(cores);
            scope.spawn(move || (mine.map(|path| one(importer, folder, path)).collect(), worked()))
        };
        let workers: Vec<_> = (0..cores).map(share).collect();
        workers.into_iter().filter_map(|worker| worker.join().ok()).collect()
    });
    let wall = start.elapsed();
    let work = shares.iter().map(|(_, work)| *work).sum();
    let tables: Vec<String> =
        shares.into_iter().flat_map(|(tables, _)| tables).collect::<Result<_>>()?;
    ensure!(tables.len() == paths.len(), "an import ended early");
    Ok(Imported { tables, wall, work })
}

/// The CPU time of this thread.
fn worked() -> Option<Duration> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}

fn one(importer: &Importer, folder: &Path, path: &Path) -> Result<String> {
    let name = path.display().to_string();
    let bytes = super::super::sources::read(path)?;
    let beside = |path: &str| std::fs::read(folder.join(path)).map_err(|_| ReadError::Missing);
    let imported = importer.import(&Source {
        name: &name,
        bytes: &bytes,
        format: Some(Format::CubeMx),
        sheet: None,
        table: "",
        beside: &beside,
    });
    imported.table.with_context(|| format!("{name} cannot be imported"))
}

/// An imported table as facts.
pub(crate) fn chip(csv: &str) -> Result<Chip> {
    let board = table::load(csv).board;
    let property = |key: &str| {
        let found = board.properties.iter().find(|one| one.key == key);
        found.map(|one| one.value.clone())
    };
    let mcu = property("mcu").unwrap_or_default();
    let numbers = property("parts").unwrap_or(mcu).split(' ').map(str::to_owned).collect();
    Ok(Chip { numbers, package: property("package").unwrap_or_default(), facts: facts(csv)? })
}

/// The facts of a table.
pub(crate) fn facts(csv: &str) -> Result<Facts> {
    let loaded = table::load(csv);
    ensure!(loaded.findings.is_empty(), "a table with a mistake: {:?}", loaded.findings.first());
    let mut facts = Facts::default();
    for pin in &loaded.board.pins {
        let name = pin.name.to_string();
        if let Some(position) = pin.package_position() {
            facts.positions.insert(name.clone(), position.to_owned());
        }
        for usage in &pin.usages {
            for one in single(usage.signal.function(), usage.signal.name()) {
                let route = Route { alternate: usage.alternate, blocks: usage.blocks };
                facts.usages.insert((name.clone(), one), route);
            }
        }
    }
    Ok(facts)
}

/// The usages of single converters for a usage of several; empty for a usage that is not compared.
fn single(function: &Function, name: &str) -> Vec<String> {
    if let Function::Adc { units, channel } = function {
        return units.iter().map(|unit| format!("ADC{unit}_IN{channel}")).collect();
    }
    let (unit, line) = name.split_once('_').unwrap_or((name, ""));
    let stem = unit.trim_end_matches(|c: char| c.is_ascii_digit());
    if line.starts_with("INN") && stem == "ADC" {
        let units = unit.chars().filter(char::is_ascii_digit);
        return units.map(|unit| format!("ADC{unit}_{line}")).collect();
    }
    let compared = PERIPHERALS.contains(&stem) || stem.starts_with("USB");
    if compared { vec![name.to_owned()] } else { Vec::new() }
}
