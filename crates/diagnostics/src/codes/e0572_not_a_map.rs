//! E0572: the drawing that a world names is not a map.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0572",
    title: "a drawing that is not a map",
    explanation: r#"A map is a drawing in SVG, with lines that sensors see and walls that stop and are measured. What counts has the class
`line` or `wall`; the drawing says how large it is by a `width` or a `height` with a unit:

    <svg xmlns="http://www.w3.org/2000/svg" width="2000mm" viewBox="0 0 2000 1000">
      <path class="line" stroke-width="20" d="M500 200 H1500 A300 300 0 0 1 1500 800 H500 A300 300 0 0 1 500 200 Z"/>
      <rect class="wall" x="10" y="10" width="1980" height="980"/>
    </svg>

Its name is that of a file beside the world.

Way out: mend what the message names. In Inkscape the class is given in the XML editor, or to a whole group."#,
});

/// `why` is a sentence without its end.
pub fn not_a_map(span: Span, file: &str, why: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{file}` is not a map: {why}"))
        .here("this file")
        .help("a map is an SVG whose `width` has a unit, with the classes `line` and `wall`: `sensedsl explain E0572` has one")
}
