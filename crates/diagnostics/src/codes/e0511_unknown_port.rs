//! E0511: the MCU has no such port.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0511",
    title: "the MCU has no such port",
    explanation: r#"Firmware sets up a pin by its port and its number: `PB7` is pad 7 of port B. This pin's name in the board
table does not have that form, or the MCU has no such port, so there is no telling which pad it is.
`solve` takes any name, because it only needs to tell pins apart.

Way out: write the MCU's own names into the column `Pin` of the table, and names that are printed on
the board into the column `Label`."#,
});

/// `ports` has the letters of the ports that the MCU has.
pub fn unknown_port(span: Span, pin: &str, ports: &str) -> Diagnostic {
    let ports: Vec<String> = ports.chars().map(String::from).collect();
    let message = format!("the firmware cannot tell which pad of the MCU `{pin}` is");
    Diagnostic::new(CODE, span, message)
        .here("not a port and a number of this MCU, such as PB7")
        .help(format!(
            "give the MCU's own name; its ports are {}, each with pads 0 to 15",
            ports.join(", ")
        ))
}
