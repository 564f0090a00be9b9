//! DBC files of CAN buses: lines in, devices of a `.sense` file out.
//!
//! What a node sends becomes actuators, and what it receives becomes sensors; without a node, every
//! message is received. The reader is the project's own, as for tables: a user who corrects a file
//! needs the line of each mistake.

mod read;
mod write;

use sensedsl_diagnostics::codes::e0811_dbc_no_node;
use sensedsl_diagnostics::{FileId, Span};

use crate::log::Log;
use crate::source::Texts;

/// Imports a DBC file for a node.
pub(crate) fn import(
    file: FileId,
    name: &str,
    text: &str,
    node: Option<&str>,
    log: &mut Log,
) -> Texts {
    let network = read::read(file, name, text, log);
    if log.has_errors() {
        return Texts::default();
    }
    if network.messages.is_empty() {
        log.unreadable(Span::new(file, 0..0), name, "it has no messages (`BO_`)");
        return Texts::default();
    }
    if let Some(node) = node.filter(|node| !network.nodes.iter().any(|one| one == node)) {
        let at = Span::new(file, 0..0);
        log.say(e0811_dbc_no_node::dbc_no_node(at, node, &network.nodes));
        return Texts::default();
    }
    let program = write::program(&network, name, node, log);
    Texts { table: None, program }
}

#[cfg(test)]
mod tests;
