//! All parts: the shipped table and the rules as one list.

use std::sync::OnceLock;

use crate::format::{Layout, PartData};
use crate::rp;
use crate::shipped::data;

/// A part: one die in one package. Its part numbers differ only in grade.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part(pub(crate) Origin);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    Table(&'static PartData),
    Rule(&'static rp::Chip),
}

/// All parts, by name.
pub fn all() -> impl Iterator<Item = Part> {
    static PARTS: OnceLock<Vec<Part>> = OnceLock::new();
    let sorted = || {
        let table = data().parts.iter().map(|part| Part(Origin::Table(part)));
        let rules = rp::CHIPS.iter().map(|chip| Part(Origin::Rule(chip)));
        let mut parts: Vec<Part> = table.chain(rules).collect();
        parts.sort_by_cached_key(Part::name);
        parts
    };
    PARTS.get_or_init(sorted).iter().copied()
}

impl Part {
    /// The number of the part, with its plainest grade.
    #[must_use]
    pub fn name(&self) -> String {
        self.numbers().next().unwrap_or_default()
    }

    /// All its part numbers.
    pub fn numbers(&self) -> impl Iterator<Item = String> + use<> {
        let base = self.base();
        let codes: Vec<&'static str> = match self.0 {
            Origin::Table(part) => {
                let codes = part.codes.iter().filter_map(|code| data().codes.get(*code));
                codes.map(String::as_str).collect()
            }
            Origin::Rule(_) => vec![""],
        };
        codes.into_iter().map(move |code| format!("{base}{code}"))
    }

    /// The number without package and grade.
    #[must_use]
    pub fn base(&self) -> &'static str {
        match self.0 {
            Origin::Table(part) => &part.base,
            Origin::Rule(chip) => chip.name,
        }
    }

    /// The package, if it is known.
    #[must_use]
    pub fn package(&self) -> Option<&'static str> {
        match self.0 {
            Origin::Table(_) => data().packages.get(self.layout()?.package).map(String::as_str),
            Origin::Rule(chip) => Some(chip.package),
        }
    }

    /// The number of contacts of the package, from its name: 100 for `LQFP100`.
    #[must_use]
    pub fn contacts(&self) -> Option<u32> {
        let package = self.package()?;
        let digits = |c: char| c.is_ascii_digit();
        let start = package.find(digits)?;
        let tail = package.get(start..)?;
        tail.split(|c| !digits(c)).next()?.parse().ok()
    }

    /// Its processor cores, the more powerful first: `Cortex-M7`, `Cortex-M4`.
    pub fn cores(&self) -> impl Iterator<Item = &'static str> + use<> {
        let core = match self.0 {
            Origin::Table(part) => data().cores.get(part.core).map_or("", String::as_str),
            Origin::Rule(chip) => chip.core,
        };
        core.split(" + ")
    }

    /// Bytes of flash in it; `None` if the flash is a separate chip.
    #[must_use]
    pub fn flash_bytes(&self) -> Option<usize> {
        match self.0 {
            Origin::Table(part) => Some(part.flash_bytes).filter(|bytes| *bytes > 0),
            Origin::Rule(_) => None,
        }
    }

    /// Bytes of RAM in it, without that of its backup domain.
    #[must_use]
    pub fn ram_bytes(&self) -> usize {
        match self.0 {
            Origin::Table(part) => part.ram_bytes,
            Origin::Rule(chip) => chip.ram_bytes,
        }
    }

    /// Whether the position of each pin on the package is known.
    #[must_use]
    pub fn has_positions(&self) -> bool {
        self.layout().is_some()
    }

    pub(crate) fn layout(&self) -> Option<&'static Layout> {
        match self.0 {
            Origin::Table(part) => data().layouts.get(part.layout?),
            Origin::Rule(_) => None,
        }
    }
}
