//! Finds the part that a name means.

use sensedsl_board::mcu::normalise;
use sensedsl_diagnostics::nearest;

use crate::listing::{Part, all};
use crate::sheet::Sheet;

/// The result of looking up a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// The part number to continue with: that of the part, or as much of it as was given.
    pub mcu: String,
    /// The parts that the name fits, in natural order; at least one.
    pub parts: Vec<Part>,
    /// The pins that all of them have.
    pub sheet: Sheet,
    /// Whether a wiring may depend on which of them is meant.
    pub ambiguous: bool,
}

impl Found {
    /// A warning about what is not known for certain.
    #[must_use]
    pub fn doubt(&self) -> Option<String> {
        let first = self.parts.first()?;
        if self.ambiguous {
            let names: Vec<String> = self
                .parts
                .iter()
                .map(|part| format!("{} ({})", part.name(), part.package().unwrap_or("unknown")))
                .collect();
            return Some(format!(
                "{} is made in several packages, so only pins that all of them bring out are \
                 offered; one is meant of {}",
                self.mcu,
                names.join(", ")
            ));
        }
        match first.package() {
            None => Some(format!(
                "the package of {} is not known: some of the pins may not be brought out",
                self.mcu
            )),
            Some(package) if !first.has_positions() => {
                let mcu = &self.mcu;
                Some(format!("the places of the pins of {mcu} on its {package} are not known"))
            }
            Some(_) => None,
        }
    }

    /// The package, if the name tells it.
    #[must_use]
    pub fn package(&self) -> Option<&'static str> {
        let mut packages = self.parts.iter().map(Part::package);
        let first = packages.next()??;
        packages.all(|package| package == Some(first)).then_some(first)
    }

    /// The board table as text.
    #[must_use]
    pub fn csv(&self) -> String {
        self.sheet.csv(&self.mcu, self.package())
    }
}

/// The part of a part number. The grade may be missing or `x` (`STM32F407VGT`, `STM32F407VGTx`),
/// and the package as well (`STM32F407VG`): if packages differ, the name means what they have in
/// common. A hyphen may be written `_`, as a name in a file has none (`ATMEGA328P_AU`).
#[must_use]
pub fn find(name: &str) -> Option<Found> {
    let name = normalise(name).replace('_', "-");
    let trimmed = name.strip_suffix("TR").unwrap_or(&name);
    let parts: Vec<Part> = all().filter(|part| trimmed.starts_with(part.base())).collect();
    let whole = parts.iter().find_map(|part| {
        let number = part.numbers().find(|number| same(number, trimmed))?;
        Some((*part, number))
    });
    if let Some((part, number)) = whole {
        let sheet = Sheet::of(part);
        return Some(Found { mcu: number, sheet, parts: vec![part], ambiguous: false });
    }
    let unpacked = parts.iter().find(|part| {
        let code = trimmed.strip_prefix(part.base()).unwrap_or_default();
        part.package().is_none() && is_order_code(code)
    });
    if let Some(part) = unpacked {
        let (sheet, parts) = (Sheet::of(*part), vec![*part]);
        return Some(Found { mcu: trimmed.to_owned(), sheet, parts, ambiguous: false });
    }
    let begun = |part: &&Part| part.numbers().any(|number| starts(&number, trimmed));
    let parts: Vec<Part> = parts.iter().filter(begun).copied().collect();
    let sheets: Vec<Sheet> = parts.iter().map(|part| Sheet::of(*part)).collect();
    let first = sheets.first()?;
    let key = first.key();
    let ambiguous = sheets.iter().any(|sheet| sheet.key() != key);
    let sheet = if sheets.iter().all(|sheet| sheet == first) || (!ambiguous && first.shares()) {
        first.clone()
    } else {
        Sheet::common(&sheets)
    };
    Some(Found { mcu: trimmed.to_owned(), parts, sheet, ambiguous })
}

/// Whether this can follow the base of a part number: a letter for the package, a grade, options
/// (`T6`, `UX`, `I6Q`).
fn is_order_code(code: &str) -> bool {
    let mut letters = code.chars();
    let package = letters.next().is_some_and(|c| c.is_ascii_uppercase());
    let grade = letters.next().is_some_and(|c| c.is_ascii_digit() || c == 'X');
    let options = letters.as_str();
    package && grade && options.len() <= 3 && options.chars().all(|c| c.is_ascii_alphanumeric())
}

/// Whether they are equal, where an `X` in the name stands for a digit: a grade.
fn same(number: &str, name: &str) -> bool {
    number.len() == name.len() && starts(number, name)
}

fn starts(number: &str, name: &str) -> bool {
    let alike = |(a, b): (u8, u8)| a == b || (b == b'X' && a.is_ascii_digit());
    name.len() <= number.len() && number.bytes().zip(name.bytes()).all(alike)
}

/// The part number that a misspelt one is nearest to.
#[must_use]
pub fn nearest_name(name: &str) -> Option<String> {
    let name = normalise(name).replace('_', "-");
    let mut known: Vec<String> = all().map(|part| part.name()).collect();
    known.extend(all().map(|part| part.base().to_owned()));
    known.dedup();
    nearest(&name, known.iter().map(String::as_str)).map(str::to_owned)
}
