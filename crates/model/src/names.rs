//! Which names may stand beside each other once they are spelled as code.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{
    e0204_duplicate_name, e0205_clashing_names, e0221_identifier_reserved,
};

use crate::design::Spanned;

/// Longest name: C compilers tell at least that many letters apart.
const LETTERS_MAX: usize = 63;

/// Names that some operating systems do not let folders have.
const RESERVED_FOLDERS: &[&str] = &["aux", "con", "nul", "prn"];

/// Reports names that are too long, equal, or equal but for case and underscores. `what` is
/// "board", "device" or "driver".
pub(crate) fn check(what: &str, names: &[&Spanned<String>], diagnostics: &mut Vec<Diagnostic>) {
    for (at, name) in names.iter().enumerate() {
        if let Some(why) = unusable(what, &name.value) {
            diagnostics.push(e0221_identifier_reserved::identifier_reserved(
                name.span,
                &name.value,
                why,
            ));
        }
        let earlier = || names.iter().take(at);
        if let Some(first) = earlier().find(|first| first.value == name.value) {
            let (name, span) = (&name.value, name.span);
            diagnostics.push(e0204_duplicate_name::duplicate_name(span, what, name, first.span));
        } else if let Some(first) =
            earlier().find(|first| folded(&first.value) == folded(&name.value))
        {
            diagnostics.push(e0205_clashing_names::clashing_names(
                name.span,
                &name.value,
                &first.value,
                &folded(&name.value).to_uppercase(),
                first.span,
            ));
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
    let folder = what == "board" && RESERVED_FOLDERS.contains(&name.to_lowercase().as_str());
    folder.then_some("no folder can have it on Windows")
}

/// What is left of a name when neither case nor underscores count.
fn folded(name: &str) -> String {
    name.chars().filter(|&c| c != '_').flat_map(char::to_lowercase).collect()
}
