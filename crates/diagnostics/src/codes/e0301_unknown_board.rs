//! E0301: no such board.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0301",
    title: "no such board",
    explanation: r#"`board NAME on BOARD` takes a built-in board or part, or a table beside the file between quotes.
Without `on`, the board's own name must be a built-in one, or `--board TABLE` must name a table.
`sensedsl boards` lists what is built in.

Way out: correct the name, or say which table is meant."#,
});

/// The name is of a board that people own, of the family `what`, and that is not built in yet.
pub fn board_not_yet(span: Span, name: &str, what: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{name}` is not supported yet"))
        .here(format!("{what} boards are not built in"))
        .help("take a board that `sensedsl boards` lists; or name a table of its pins with `on \"table.csv\"`, which gives wiring, sheet and picture without firmware (docs/board-tables.md)")
}

/// `meant` is the nearest built-in board or part, shown as a file has to spell it. `is_own` is true if the block has no
/// `on`, so that its own name was looked up.
pub fn unknown_board(span: Span, name: &str, meant: Option<&str>, is_own: bool) -> Diagnostic {
    let diagnostic =
        Diagnostic::new(CODE, span, format!("there is no built-in board or part `{name}`"));
    match meant.map(|meant| meant.replace('-', "_")) {
        Some(meant) => diagnostic
            .here(format!("did you mean `{meant}`?"))
            .help(format!("write `{meant}`, or name a table: `on \"table.csv\"` or `--board table.csv`"))
            .one_of([meant.as_str()]),
        None if is_own => diagnostic
            .here("a name of your own needs a board")
            .help(format!("write `board {name} on BOARD {{`, where `sensedsl boards` and `sensedsl parts --list` list what BOARD can be; or name a table of your own: `on \"table.csv\"`")),
        None => diagnostic
            .help("`sensedsl boards` and `sensedsl parts --list` list what is supported; for another MCU name a table of its pins with `on \"table.csv\"` or `--board table.csv`, which gives the wiring without firmware"),
    }
}
