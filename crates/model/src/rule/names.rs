//! Which names can be used together once they are spelled as code: names in, reports out.

use crate::spanned::Spanned;
use std::collections::{BTreeMap, BTreeSet};

use sensedsl_diagnostics::codes::{
    e0204_duplicate_name, e0205_clashing_names, e0221_identifier_reserved,
};
use sensedsl_diagnostics::{Diagnostic, Span};

/// The longest name; C compilers distinguish at least that many letters.
const LETTERS_MAX: usize = 63;

/// Names that Windows forbids for files and folders, whatever follows after a dot. Ports also have
/// a number: `COM1`, `LPT9`. The rest of Windows' list is not made of letters and digits.
const DEVICES_OF_WINDOWS: &[&str] = &["aux", "con", "nul", "prn"];
const PORTS_OF_WINDOWS: &[&str] = &["com", "lpt"];

/// Reports names that are too long, equal, or equal except for case and underscores. `what` is
/// "board", "device" or "driver".
pub(crate) fn check(what: &str, names: &[&Spanned<String>], diagnostics: &mut Vec<Diagnostic>) {
    let mut equal: BTreeMap<&str, Span> = BTreeMap::new();
    let mut alike: BTreeMap<String, &Spanned<String>> = BTreeMap::new();
    let mut free = FreeNames::new(names);
    for name in names {
        if let Some(why) = unusable(what, &name.value) {
            diagnostics.push(e0221_identifier_reserved::identifier_reserved(
                name.span,
                &name.value,
                why,
            ));
        }
        let form = folded(&name.value);
        if let Some(first) = equal.get(name.value.as_str()) {
            // A board may be called after the built-in one that it is.
            let free = free.like(name).filter(|_| what != "board");
            let span = name.span;
            let (name, free) = (&name.value, free.as_deref());
            diagnostics.push(e0204_duplicate_name::duplicate_name(span, what, name, *first, free));
            continue;
        }
        equal.insert(&name.value, name.span);
        match alike.get(&form) {
            Some(first) => diagnostics.push(e0205_clashing_names::clashing_names(
                name.span,
                (&name.value, &first.value),
                &form.to_uppercase(),
                first.span,
                free.like(name).as_deref(),
            )),
            None => {
                alike.insert(form, name);
            }
        }
    }
}

/// The names that are not in use yet.
struct FreeNames<'names> {
    names: &'names [&'names Spanned<String>],
    /// In their [`folded`] form; made when the first name is asked for.
    taken: BTreeSet<String>,
    /// The numbers found so far. All below them are in use, so that the search goes on there.
    found: BTreeMap<&'names str, usize>,
}

impl<'names> FreeNames<'names> {
    fn new(names: &'names [&'names Spanned<String>]) -> Self {
        Self { names, taken: BTreeSet::new(), found: BTreeMap::new() }
    }

    /// The name with a number that makes it different from all others; none if it is not written in the file, but
    /// composed of the names of a chip and a reading.
    fn like(&mut self, name: &'names Spanned<String>) -> Option<String> {
        if name.span.range().len() != name.value.len() {
            return None;
        }
        if self.taken.is_empty() {
            self.taken = self.names.iter().map(|one| folded(&one.value)).collect();
        }
        let from = self.found.get(name.value.as_str()).copied().unwrap_or(2);
        let numbered = |number| format!("{}{number}", name.value);
        let number = (from..=self.names.len() + 2)
            .find(|&number| !self.taken.contains(&folded(&numbered(number))))?;
        self.found.insert(&name.value, number);
        Some(numbered(number)).filter(|one| one.len() <= LETTERS_MAX)
    }
}

fn unusable(what: &str, name: &str) -> Option<&'static str> {
    if name.len() > LETTERS_MAX {
        return Some("it is longer than 63 letters");
    }
    if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        return Some("it does not begin with a letter");
    }
    let is_reserved = what == "board" && is_reserved_on_windows(name);
    is_reserved.then_some("no file or folder can have it on Windows")
}

fn is_reserved_on_windows(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    let stem = name.strip_suffix(|c: char| c.is_ascii_digit());
    DEVICES_OF_WINDOWS.contains(&name.as_str())
        || stem.is_some_and(|stem| PORTS_OF_WINDOWS.contains(&stem))
}

/// A name without case, hyphens and underscores.
pub(crate) fn folded(name: &str) -> String {
    name.chars().filter(|&c| c != '_' && c != '-').flat_map(char::to_lowercase).collect()
}
