//! E0811: a DBC file has no such node.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0811",
    title: "a DBC file has no such node",
    explanation: r#"`--node` names the node of the bus whose place the board takes: what that node sends becomes actuators, and what it
receives sensors. The nodes are in the line `BU_:` of the file.

Way out: take one of the names in the message, or leave `--node` out: then everything on the bus becomes a sensor."#,
});

/// `node` is the node asked for, `nodes` has the names of all.
pub fn dbc_no_node(span: Span, node: &str, nodes: &[String]) -> Diagnostic {
    let help = if nodes.is_empty() {
        "the file names no nodes: leave `--node` out".to_owned()
    } else {
        format!("its nodes are {}", nodes.join(", "))
    };
    Diagnostic::new(CODE, span, format!("there is no node `{node}` in the file")).help(help)
}
