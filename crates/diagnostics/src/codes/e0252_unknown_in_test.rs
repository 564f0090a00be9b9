//! E0252: a test names something that the design does not have.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0252",
    title: "a test names something unknown",
    explanation: r#"A condition of a test is about the devices of the design, by their names: `Front`, `Line[3]` for one element of an
array, `Follow.overruns` for the late steps of a controller, `age(Front)` for the time since its last value came,
`health(Front)` for its state. The functions are `abs`, `min`, `max`, `age`, `health`, `rising` and `falling`.

Way out: write a name that there is; the message has the nearest one, or all of them."#,
});

fn unknown(span: Span, message: String, near: Option<&str>, help: &str) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, message);
    match near {
        Some(word) => report.meant(near).help(format!("write `{word}`")),
        None => report.here("unknown").help(help),
    }
}

/// Nothing has that name.
pub fn unknown_device(span: Span, name: &str, near: Option<&str>) -> Diagnostic {
    let message = format!("`{name}` is not a device or a constant of this design");
    unknown(span, message, near, "name a sensor or an actuator of the design, or a constant")
}

/// The name is that of a chip with several values.
pub fn chip(span: Span, name: &str, values: &[&str]) -> Diagnostic {
    let list: Vec<String> = values.iter().map(|value| format!("`{value}`")).collect();
    let first = values.first().copied().unwrap_or_default();
    Diagnostic::new(CODE, span, format!("`{name}` is a chip with {} values", values.len()))
        .help(format!("name one of them: {}", list.join(", ")))
        .one_of([first])
}

/// The device has several elements, and the condition needs one number.
pub fn whole_array(span: Span, name: &str, count: usize) -> Diagnostic {
    let last = count.saturating_sub(1);
    Diagnostic::new(CODE, span, format!("`{name}` has {count} elements")).help(format!(
        "name one, `{name}[0]` to `{name}[{last}]`, or take the smallest or greatest: `min({name})`, `max({name})`"
    ))
}

/// The element is beyond the last one.
pub fn no_element(span: Span, name: &str, index: &str, count: usize) -> Diagnostic {
    let last = count.saturating_sub(1);
    Diagnostic::new(CODE, span, format!("`{name}` has no element {index}"))
        .help(format!("its elements are `{name}[0]` to `{name}[{last}]`"))
}

/// The device has one value.
pub fn not_an_array(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` has one value, not several elements"))
        .help(format!("write `{name}` without an index"))
        .one_of([name])
}

/// The index is not a whole constant.
pub fn no_index(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("this is not an index of `{name}`"))
        .help(format!("write a whole number from 0 on, or a constant: `{name}[0]`"))
}

/// No function has that name.
pub fn unknown_function(span: Span, name: &str, near: Option<&str>) -> Diagnostic {
    let help = "the functions are abs, min, max, age, health, rising and falling";
    unknown(span, format!("`{name}` is not a function of tests"), near, help)
}

/// The function takes something else.
pub fn arguments(span: Span, name: &str, takes: &str, example: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` takes {takes}"))
        .help(format!("write it like this: `{example}`"))
}

/// A word after the dot of something that has no such word.
pub fn unknown_word(span: Span, name: &str, word: &str, is_controller: bool) -> Diagnostic {
    let report = Diagnostic::new(CODE, span, format!("`{name}` has nothing called `{word}`"));
    if is_controller {
        report.help(format!("a controller has the number of its late steps: `{name}.overruns`"))
    } else {
        report.help(format!("`.overruns` is for controllers; write `{name}` for its value"))
    }
}

/// A controller where a value is needed.
pub fn controller(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is a controller, not a value"))
        .help(format!("the number of its late steps is `{name}.overruns`"))
        .one_of([format!("{name}.overruns").as_str()])
}

/// The age of something that does not come from the board.
pub fn no_age(span: Span, name: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is an actuator, so no value of it comes"))
        .help("`age(…)` is the time since the last value of a sensor came")
}

/// The state that something is compared with.
pub fn unknown_state(span: Span, all: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, "`health(…)` is compared with a state")
        .help(format!("write `health(Front) == good`; the states are {all}"))
}
