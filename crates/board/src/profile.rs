//! Target profiles: what an operating system's drivers can do on an MCU family.
//!
//! A target name and an MCU go in, the facts of that MCU under that system come out. All facts are
//! data in `targets/`; this module only finds and returns them.

mod entries;
mod file;
mod lookup;
mod rates;
mod types;

use std::sync::OnceLock;

use sensedsl_diagnostics::nearest;

use crate::mcu;
use crate::registry::{TARGETS, Target as Entry};
use file::{File, starts};
pub use rates::{Costs, Cycles, Dividers, I2cTiming};
pub use types::{
    Adc, Adcs, Dac, DacOutput, Dacs, Debug, DmaRequest, Edges, Exception, Exti, ExtiRule, Fallback,
    I2cMode, I2cs, Kernel, Own, Pio, Stream, TargetProfile, Timer, TimerUse, Transport, Unit, Usb,
};
pub(crate) use types::{pin, pins};

/// The target without an operating system: only pins and signals count.
pub const NONE: &str = "none";

/// The default target, if it covers the MCU.
pub const DEFAULT: &str = "chibios";

/// The targets of which the first that covers the MCU is meant if none is named.
const USUAL: [&str; 3] = [DEFAULT, "embassy", "arduino"];

/// The target that a target name and an MCU select.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// `none`: the pure pin model.
    None,
    /// An operating system on an MCU family.
    Profile(Box<TargetProfile>),
}

/// Why there is no profile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoProfile {
    /// No target has that name.
    UnknownTarget {
        /// The known names.
        known: Vec<String>,
        /// The known name that was probably meant.
        nearest: Option<String>,
    },
    /// The target covers other MCUs.
    UnknownMcu {
        /// The full name of the target.
        target: String,
        /// The prefixes of the part numbers that it covers: those of the MCU's family if there are
        /// any, otherwise all families.
        covered: Vec<String>,
    },
    /// A file of `targets/` is damaged; tests rule that out.
    Broken {
        /// The reader's message.
        message: String,
    },
}

/// All names that a target can have.
#[must_use]
pub fn names() -> Vec<String> {
    let mut names = vec![NONE.to_owned(), DEFAULT.to_owned()];
    for entry in TARGETS {
        let system = entry.target.rsplit_once('-').map(|(system, _)| system);
        for name in system.into_iter().chain([entry.target]) {
            if names.iter().all(|known| known != name) {
                names.push(name.to_owned());
            }
        }
    }
    names
}

/// The full name of a target: `chibios` is the newest ChibiOS that has a profile.
#[must_use]
pub fn full_name(target: &str) -> Option<&'static str> {
    let wanted = target.to_ascii_lowercase();
    if wanted == NONE {
        return Some(NONE);
    }
    let versions = TARGETS.iter().map(|entry| entry.target).filter(|name| {
        *name == wanted || name.rsplit_once('-').is_some_and(|(system, _)| system == wanted)
    });
    versions.max_by(|a, b| crate::pin::natural(a, b))
}

/// The part-number prefix under which a target covers an MCU. MCUs with the same prefix have the
/// same profile.
#[must_use]
pub fn covered_by(target: &str, mcu: &str) -> Option<&'static str> {
    let target = full_name(target)?;
    let name = mcu::normalise(mcu);
    let parts = TARGETS.iter().filter(|entry| entry.target == target).flat_map(Entry::parts);
    parts.filter(|part| starts(&name, part)).max_by_key(|part| part.len())
}

/// The target for an MCU if none is named; also [`DEFAULT`] if no target covers the MCU.
#[must_use]
pub fn usual(mcu: &str) -> &'static str {
    USUAL.into_iter().find(|target| covered_by(target, mcu).is_some()).unwrap_or(DEFAULT)
}

/// The file with the profile of an MCU under a target, both by their full names, and its place.
fn entry(target: &str, name: &str) -> Option<(usize, &'static Entry)> {
    let covers = |entry: &Entry| entry.parts().any(|part| starts(name, part));
    let mut all = TARGETS.iter().enumerate();
    all.find(|(_, entry)| entry.target == target && covers(entry))
}

/// What the files say, each read once: editors ask at every letter, and lists of boards for all of them.
static FILES: [OnceLock<Result<Box<File>, String>>; TARGETS.len()] =
    [const { OnceLock::new() }; TARGETS.len()];

/// Finds the profile of an MCU under a target.
///
/// # Errors
///
/// Fails if the target is unknown or has no profile for the MCU.
pub fn find(target: &str, mcu: &str) -> Result<Target, NoProfile> {
    let Some(target) = full_name(target) else {
        let known = names();
        let nearest = nearest(target, known.iter().map(String::as_str)).map(str::to_owned);
        return Err(NoProfile::UnknownTarget { nearest, known });
    };
    if target == NONE {
        return Ok(Target::None);
    }
    let name = mcu::normalise(mcu);
    let Some((place, entry)) = entry(target, &name) else {
        let entries = || TARGETS.iter().filter(|entry| entry.target == target);
        let family = entries().filter(|entry| name.starts_with(entry.family));
        let mut covered: Vec<String> = family.flat_map(Entry::parts).map(str::to_owned).collect();
        if covered.is_empty() {
            covered = entries().map(|entry| entry.family.to_owned()).collect();
            covered.dedup();
        }
        return Err(NoProfile::UnknownMcu { target: target.to_owned(), covered });
    };
    let read = || File::parse(entry.text()).map(Box::new);
    let file = FILES.get(place).map_or_else(read, |file| file.get_or_init(read).clone());
    let found = file.and_then(|file| of_line(*file, &name));
    found.map_err(|message| NoProfile::Broken { message })
}

/// The text of the file with the profile of an MCU under a target.
#[must_use]
pub fn text(target: &str, mcu: &str) -> Option<&'static str> {
    entry(full_name(target)?, &mcu::normalise(mcu)).map(|(_, entry)| entry.text())
}

/// A line of a profile file.
#[derive(Clone, Debug, PartialEq)]
pub struct LineFacts {
    /// The facts.
    pub profile: TargetProfile,
    /// The units that the line lists.
    pub units: Vec<String>,
    /// Units that the registry names but the profile deliberately leaves out.
    pub left_out: Vec<String>,
}

/// All lines of a target's files.
///
/// # Errors
///
/// Fails if a file is damaged; tests rule that out.
pub fn lines(target: &str) -> Result<Vec<LineFacts>, String> {
    let mut all = Vec::new();
    for entry in TARGETS.iter().filter(|entry| Some(entry.target) == full_name(target)) {
        let names = File::parse(entry.text())?.lines().to_vec();
        for line in names {
            let file = File::parse(entry.text())?;
            all.push(LineFacts {
                units: line.units.split_whitespace().map(str::to_owned).collect(),
                left_out: file.left_out(&line).map(str::to_owned).collect(),
                profile: file.into_profile(&line),
            });
        }
    }
    Ok(all)
}

/// The profile of an MCU from the text of a file.
///
/// # Errors
///
/// Fails if the text is not a profile, or has no line for the MCU.
pub fn read(text: &str, mcu: &str) -> Result<Target, String> {
    of_line(File::parse(text)?, &mcu::normalise(mcu))
}

fn of_line(file: File, mcu: &str) -> Result<Target, String> {
    let line = file.line_of(mcu).cloned().ok_or_else(|| format!("no line for {mcu}"))?;
    Ok(Target::Profile(Box::new(file.into_profile(&line))))
}

/// Reads a profile file and lists the mistakes in it.
///
/// # Errors
///
/// Fails if the text is not a profile at all.
pub fn check(text: &str) -> Result<Vec<String>, String> {
    Ok(File::parse(text)?.problems())
}
