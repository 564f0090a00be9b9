//! The colours of a picture, as a style sheet for light and dark pages.
//!
//! A kind is told by its colour and by its letter; free, taken and supply contacts by their shapes.

use std::fmt::Write as _;

use sensedsl_model::kind::{KindName, KindSpec};

/// The inks that a letter on a colour can have.
const WHITE: &str = "#FFFFFF";
const BLACK: &str = "#000000";

/// The colours of a page, by class.
struct Theme {
    page: &'static str,
    board: &'static str,
    /// Lines around boards, boxes and contacts.
    line: &'static str,
    /// Text.
    ink: &'static str,
    /// Text of less importance.
    soft: &'static str,
    /// The inside of a contact that the board has taken.
    taken: &'static str,
    kind: fn(&KindSpec) -> &'static str,
}

const LIGHT: Theme = Theme {
    page: "#FFFFFF",
    board: "#F4F6F8",
    line: "#5B6B7B",
    ink: "#1B2733",
    soft: "#55636F",
    taken: "#C3CBD3",
    kind: |spec| spec.colour,
};

const DARK: Theme = Theme {
    page: "#10161D",
    board: "#1A232D",
    line: "#8FA0B0",
    ink: "#E6EDF3",
    soft: "#A3B1BE",
    taken: "#4A5866",
    kind: |spec| spec.colour_on_dark,
};

/// The letter of a kind.
pub(super) fn letter(kind: &str) -> char {
    KindName::from_name(kind).map_or('?', |kind| kind.spec().letter)
}

/// The style sheet for the kinds of a picture.
pub(super) fn sheet(kinds: &[&str]) -> String {
    let mut out =
        String::from("<style>\n.sd-wire{fill:none;stroke-width:2;stroke-linejoin:round}\n");
    rules(&mut out, &LIGHT, kinds);
    out.push_str("@media (prefers-color-scheme:dark){\n");
    rules(&mut out, &DARK, kinds);
    out.push_str("}\n</style>\n");
    out
}

fn rules(out: &mut String, theme: &Theme, kinds: &[&str]) {
    let Theme { page, board, line, ink, soft, taken, .. } = theme;
    // Writing to a String cannot fail.
    let _ = writeln!(
        out,
        ".sd-page{{fill:{page}}}\n.sd-board{{fill:{board};stroke:{line};stroke-width:1.5}}\n\
         .sd-box{{fill:{page};stroke:{line}}}\n.sd-ink{{fill:{ink}}}\n.sd-soft{{fill:{soft}}}\n\
         .sd-free{{fill:{page};stroke:{line}}}\n.sd-taken{{fill:{taken};stroke:{line}}}\n\
         .sd-line{{fill:none;stroke:{line}}}\n.sd-landmark{{fill:{page};stroke:{taken}}}\n\
         .sd-shared{{fill:none;stroke:{ink};stroke-dasharray:2}}"
    );
    let kinds = kinds.iter().filter_map(|name| KindName::from_name(name));
    for spec in kinds.map(KindName::spec) {
        let (name, colour) = (spec.name, (theme.kind)(spec));
        let _ = writeln!(
            out,
            ".sd-pad-{name}{{fill:{colour};stroke:{line}}}\n.sd-wire-{name}{{stroke:{colour}}}\n\
             .sd-dot-{name}{{fill:{colour}}}\n.sd-on-{name}{{fill:{}}}",
            ink_on(colour)
        );
    }
}

/// The ink that is easier to read on a colour.
fn ink_on(colour: &str) -> &'static str {
    if contrast(WHITE, colour) >= contrast(BLACK, colour) { WHITE } else { BLACK }
}

/// The contrast of two colours, 1 to 21 (WCAG 2).
fn contrast(one: &str, other: &str) -> f64 {
    let (one, other) = (luminance(one), luminance(other));
    (one.max(other) + 0.05) / (one.min(other) + 0.05)
}

/// The relative luminance of a colour (WCAG 2). The curve of sRGB is approximated, because powers
/// differ in their last digits from machine to machine.
fn luminance(colour: &str) -> f64 {
    let linear = |c: f64| c * (c * (c * 0.305_306 + 0.682_171) + 0.012_523);
    let [red, green, blue] = channels(colour).map(linear);
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// Red, green and blue, 0 to 1.
fn channels(colour: &str) -> [f64; 3] {
    [1, 3, 5].map(|at| {
        let digits = colour.get(at..at + 2).unwrap_or_default();
        f64::from(u8::from_str_radix(digits, 16).unwrap_or_default()) / 255.0
    })
}

#[cfg(test)]
#[path = "palette_tests.rs"]
mod tests;
