//! What is C but no system's: the values of a board and its wire, for firmware and for programs on a computer.
//!
//! In: a schema. Out: `sense_model.[ch]`, the values and their fields as a table, and `sense_codec.c`, straight lines of
//! code from values to payloads and back. They need `runtime/core` and nothing else.

mod schema;

use askama::Template;
use sensedsl_wire::Schema;

use crate::fileset::FileSet;
use crate::print::print;
pub use schema::{Role, SchemaPlan};

/// Declares a template that prints a model.
macro_rules! templates {
    ($($name:ident = $path:literal;)*) => {
        $(
            #[derive(Template)]
            #[template(path = $path, escape = "none")]
            struct $name<'a> {
                board: &'a str,
                s: &'a SchemaPlan,
            }
        )*
    };
}

templates! {
    ModelHeader = "firmware/c/templates/sense_model.h.txt";
    Model = "firmware/c/templates/sense_model.c.txt";
    Codec = "firmware/c/templates/sense_codec.c.txt";
}

/// The files of one end of a board's link.
#[must_use]
pub fn files(board: &str, schema: &Schema, role: Role) -> FileSet {
    render(board, &SchemaPlan::new(schema, role))
}

/// Prints them.
pub(crate) fn render(board: &str, s: &SchemaPlan) -> FileSet {
    let mut files = FileSet::default();
    files.add("sense_model.h", print(&ModelHeader { board, s }));
    files.add("sense_model.c", print(&Model { board, s }));
    files.add("sense_codec.c", print(&Codec { board, s }));
    files
}
