//! E0216: no such driver.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0216",
    title: "no such driver",
    explanation: r#"`driver = NAME;` takes over a protocol: a `driver NAME for KIND { … }` of this file, of a file brought in
by `use`, or of the library that ships with the tool. A part may also be called what else people call it (`GY_521`).

Way out: correct the spelling, take a part of the same sort (the message names some where there are any), look for one
with `sensedsl drivers --search WORD`, or write the driver: `sensedsl drivers --new NAME` prints one to begin with, and
`docs/driver-language.md` says what can stand in it."#,
});

/// `meant` is the driver whose name was misspelled, `similar` those of the same family or sort, `new` the name that a
/// driver of the user's own could have.
pub fn unknown_driver(
    span: Span,
    name: &str,
    (meant, similar): (Option<&str>, &[&str]),
    new: &str,
) -> Diagnostic {
    let diagnostic = Diagnostic::new(CODE, span, format!("there is no driver `{name}`"));
    let begin = format!("`sensedsl drivers --new {new}` begins one (docs/driver-language.md)");
    if let Some(known) = meant {
        return diagnostic.meant(meant).help(format!(
            "write `{known}` (`sensedsl drivers {known}` shows it; `sensedsl drivers` lists all), or write your own: \
             {begin}"
        ));
    }
    match similar {
        [] => diagnostic.help(format!(
            "`sensedsl drivers --search WORD` looks for a part that measures the same, such as `temperature`; or write \
             your own: {begin}, or bring one in with `use`"
        )),
        [first, ..] => {
            let names: Vec<String> = similar.iter().map(|one| format!("`{one}`")).collect();
            diagnostic.help(format!(
                "of the same sort: {} (`sensedsl drivers {first}` shows one; another part has other registers); or write \
                 your own: {begin}",
                names.join(", ")
            ))
        }
    }
}
