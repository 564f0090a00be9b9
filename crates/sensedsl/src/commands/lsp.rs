//! `sensedsl lsp`: the language server on the standard input and output.
//!
//! One thread reads messages, one writes them, and this one answers. Whatever waits ends a search that is under way: its
//! answer would be about a text that has changed.

use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result};
use lsp_server::{Connection, Message};
use sensedsl_lsp::{Folders, Server};
use sensedsl_model::Files;
use sensedsl_session::Patience;
use sensedsl_wiring::Cancel;

use super::input::BEST_MAX;
use crate::files::Disk;
use crate::status::Status;

/// How long a search for the answer to a request may take.
const ANSWER_MAX: Duration = Duration::from_millis(500);

/// The machine's files: each design sees those of its own folder.
struct Machine;

impl Folders for Machine {
    fn files_of(&self, path: &str) -> Box<dyn Files + '_> {
        Box::new(Disk::of(Path::new(path), &[]))
    }
}

pub(crate) fn run() -> Result<Status> {
    let (connection, threads) = Connection::stdio();
    let properly = serve(&connection);
    // The thread that writes ends once nobody can send it anything.
    drop(connection);
    threads.join().context("the editor closed the connection")?;
    Ok(if properly { Status::Done } else { Status::Wrong })
}

/// Answers until the editor ends the session, or goes; whether it said so before.
fn serve(connection: &Connection) -> bool {
    let mut server = Server::new(Machine);
    loop {
        if server.is_dirty() && connection.receiver.is_empty() {
            settle(&mut server, connection);
        }
        let Ok(message) = connection.receiver.recv() else { return false };
        let late = until(ANSWER_MAX);
        let answers = server.handle(message, Cancel::when(&late));
        if !send(connection, answers) {
            return false;
        }
        if let Some(properly) = server.exited() {
            return properly;
        }
    }
}

/// Looks for wirings until a message comes.
fn settle(server: &mut Server<Machine>, connection: &Connection) {
    let late = until(BEST_MAX);
    let is_over = || !connection.receiver.is_empty();
    let (late, stop) = (Cancel::when(&late), Cancel::when(&is_over));
    let told = server.settle(Patience { late, stop });
    send(connection, told);
}

fn until(limit: Duration) -> impl Fn() -> bool {
    let end = Instant::now() + limit;
    move || Instant::now() >= end
}

/// Whether the editor is still there.
fn send(connection: &Connection, messages: Vec<Message>) -> bool {
    messages.into_iter().all(|message| connection.sender.send(message).is_ok())
}
