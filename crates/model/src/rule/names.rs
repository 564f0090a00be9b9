//! Which names can be used together once they are spelled as code: names in, reports out.

use crate::spanned::Spanned;
use std::collections::BTreeMap;

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
            let (name, span) = (&name.value, name.span);
            diagnostics.push(e0204_duplicate_name::duplicate_name(span, what, name, *first));
            continue;
        }
        equal.insert(&name.value, name.span);
        match alike.get(&form) {
            Some(first) => diagnostics.push(e0205_clashing_names::clashing_names(
                name.span,
                &name.value,
                &first.value,
                &form.to_uppercase(),
                first.span,
            )),
            None => {
                alike.insert(form, name);
            }
        }
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
