//! A wiring for people and scripts: tables, JSON, CSV, Markdown, a picture.

pub mod csv;
pub mod diff;
pub mod drivers;
pub mod human;
pub mod json;
pub mod markdown;
mod rows;
pub mod schema;
pub mod svg;

pub use rows::{Row, rows};
