//! The language server: messages of an editor in, answers out.
//!
//! It does no I/O and uses neither threads nor a clock, so the command-line program and the WebAssembly module are both
//! thin shells around it. A shell gives it messages with [`Server::handle`] and, once none waits, time with [`Server::settle`]; it
//! ends long searches through [`Cancel`](sensedsl_wiring::Cancel).
//!
//! `server.rs` keeps what is open, `analysis.rs` what is known of it, `features/` has a file for each thing that an
//! editor can ask for. What a diagnostic's way out is stands in the file of the diagnostic.

mod analysis;
mod answer;
mod context;
mod documents;
mod edits;
mod features;
mod library;
mod names;
mod place;
mod protocol;
mod server;
mod wires;

pub use lsp_server::{Message, Notification, Request, RequestId, Response};
pub use place::{path_of, uri_of};
pub use server::{Folders, Server};
