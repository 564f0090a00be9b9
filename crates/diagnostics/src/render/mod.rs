//! Diagnostics as text: for people, and for programs.

mod excerpt;
mod github;
mod human;
mod json;
mod sarif;

pub use github::github;
pub use human::human;
pub use json::{json, json_text, json_value};
pub use sarif::sarif;
