//! E0542: a world wants a value that a device cannot have.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0542",
    title: "a value that the device cannot have",
    explanation: r#"The world speaks in the device's own unit: what a host shows, after `scale`, `offset` and `curve`. A text may carry the unit
(`"1500 us"`, `"90 deg/s"`), which is converted where it fits, or a code (`"raw 307"`). Some values cannot be:

- in a unit that the device does not show: `"5 V"` where it shows cm;
- outside of what the type holds: 300 for a `uint8`, -1 for a `uint16`;
- outside of what the hardware can measure: 80 degrees at a probe whose curve ends at 60;
- a count of edges that becomes less: `rate = 25` is 25 edges a second;
- a count of edges that grows faster than `debounce` lets it: with 20 ms, levels that are shorter do not count;
- four values for an array of three.

Way out: write values within the range that the message tells, or give the device a wider type."#,
});

/// A value is outside the device's range, in its own unit.
pub fn out_of_range(span: Span, name: &str, value: &str, range: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` cannot be {value}: it goes from {range}"))
        .here("out of range")
        .help("choose a value in that range, or give the device a wider type")
}

/// A value is not in the device's unit; `why` is the reason, `help` says what to write.
pub fn does_not_fit(span: Span, name: &str, why: &str, help: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}`: {why}")).here("this value").help(help)
}

/// An array has the wrong number of elements.
pub fn wrong_count(span: Span, name: &str, found: usize, wanted: usize) -> Diagnostic {
    let what = format!("`{name}` has {wanted} elements, and there are {found} here");
    Diagnostic::new(CODE, span, what)
        .help(format!("write one value for all of them, or a list of {wanted}"))
}

/// A count of edges decreases.
pub fn falls(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` counts edges, and a count cannot become less"))
        .here("becomes less")
        .help("write for example `{ rate = 25 }` for 25 edges a second")
}

/// The source of the edges would have to turn infinitely fast.
pub fn jumps(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` counts edges, and a count cannot jump"))
        .here("jumps")
        .help("write for example `{ sine = 200, period = \"4 s\" }`, `{ rate = 25 }` or `steps`, which are joined by lines")
}

/// Edges come faster than a contact is debounced; both numbers are edges per second.
pub fn too_fast(span: Span, name: &str, wanted: &str, most: &str) -> Diagnostic {
    let what = format!("`{name}` cannot count {wanted} edges a second: `debounce` lets fewer than {most} through");
    Diagnostic::new(CODE, span, what)
        .here("too fast")
        .help("let it grow more slowly, or shorten `debounce` of the device")
}
