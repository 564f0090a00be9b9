//! Hostile text, followed to its readers: names, labels, cells and paths go in, and the real
//! consumer (compilers, Make, `CMake`, a browser, parsers of Markdown, CSV, JSON, Prolog, a
//! terminal) must see text and nothing else. Generated Rust is not compiled here.
#![expect(
    clippy::indexing_slicing,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test touches files, and a panic is its failure"
)]

mod browser;
mod build;
mod compilers;
mod corpus;
mod names;
mod parsers;
mod prolog;
mod terminal;
