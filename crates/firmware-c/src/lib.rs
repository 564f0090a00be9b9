//! The C code that no system decides: the values of a board and its wire, for firmware and for programs on a computer.
//!
//! In: a schema. Out: `sense_model.[ch]`, the values and their fields as a table; `sense_codec.c`, straight-line code
//! from values to payloads and back; and the tables of each part. They need only `crates/firmware-c/runtime`.
//!
//! # Example
//!
//! ```
//! use sensedsl_firmware_c::{Role, files};
//! use sensedsl_wire::{Direction, Item, ScalarType, Schema, ValueType};
//!
//! let light = Item {
//!     id: 17,
//!     name: "Light".to_owned(),
//!     direction: Direction::Sensor,
//!     value: ValueType::scalar(ScalarType::Uint16),
//! };
//! let schema = Schema { items: vec![light], ..Schema::default() };
//! let made = files("Rover", &schema, Role::Board);
//! let header = str::from_utf8(&made.get("sense_model.h").unwrap().bytes).unwrap();
//! assert!(header.contains("uint16_t SENSE_Light;"));
//! ```

pub mod control;
mod fallback;
pub mod runtime;
mod schema;
mod tables;
pub mod words;

use askama::Template;
use sensedsl_wire::Schema;

pub use fallback::FallBackPlan;
pub use schema::{Role, SchemaPlan};
use sensedsl_files::FileSet;
use sensedsl_files::print;
pub use tables::{DmaBuffer, Wiring, tables};

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
    ModelHeader = "templates/sense_model.h.txt";
    Model = "templates/sense_model.c.txt";
    Codec = "templates/sense_codec.c.txt";
}

/// The files of one end of a board's link.
#[must_use]
pub fn files(board: &str, schema: &Schema, role: Role) -> FileSet {
    render(board, &SchemaPlan::new(schema, role))
}

/// Prints the files of a model.
#[must_use]
pub fn render(board: &str, s: &SchemaPlan) -> FileSet {
    let mut files = FileSet::default();
    files.add("sense_model.h", print(&ModelHeader { board, s }));
    files.add("sense_model.c", print(&Model { board, s }));
    files.add("sense_codec.c", print(&Codec { board, s }));
    files
}
