//! From a design's text to the files of its firmware.

use sensedsl_diagnostics::{Diagnostic, Severity};
use sensedsl_files::FileEntry;
use sensedsl_generate::host::HOSTS;
use sensedsl_generate::{Selection, project};
use sensedsl_model::NoFiles;
use sensedsl_session::{Ask, On, Workspace};

use super::super::facts::Folder;

/// The result for a design.
pub(super) enum Made {
    /// The firmware of each board by name, and the number of the hosts' files.
    Firmware(Vec<(String, Folder)>, usize),
    /// The codes of the reasons why there is no wiring.
    NoWiring(Vec<&'static str>),
    /// The codes of the gaps in firmware.
    Refused(Vec<&'static str>),
}

/// Solves and generates, for the boards of the text.
pub(super) fn make(text: &str) -> Made {
    let mut workspace = Workspace::default();
    workspace.open("stub.sense", text);
    let snapshot = workspace.snapshot("stub.sense", On::default(), &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let Some((design, wiring)) = answer.wired() else {
        return Made::NoWiring(errors(&answer.diagnostics));
    };
    let made = project("stub", design, wiring, &Selection { firmware: true, hosts: HOSTS });
    if !made.gaps.is_empty() {
        return Made::Refused(errors(&made.gaps));
    }
    let mut boards: Vec<(String, Folder)> = Vec::new();
    let mut host_files = 0;
    for (path, entry) in made.files.iter() {
        host_files += usize::from(path.starts_with("host/"));
        let Some((board, path)) =
            path.strip_prefix("firmware/").and_then(|path| path.split_once('/'))
        else {
            continue;
        };
        let text = text_of(entry);
        match boards.iter_mut().find(|(name, _)| name == board) {
            Some((_, folder)) => {
                let _ = folder.insert(path.to_owned(), text);
            }
            None => boards.push((board.to_owned(), Folder::from([(path.to_owned(), text)]))),
        }
    }
    Made::Firmware(boards, host_files)
}

/// The codes of the reasons why a design has no firmware; empty if it has.
pub(crate) fn codes(text: &str) -> Vec<&'static str> {
    match make(text) {
        Made::Firmware(..) => Vec::new(),
        Made::NoWiring(codes) | Made::Refused(codes) => codes,
    }
}

fn text_of(entry: &FileEntry) -> String {
    String::from_utf8(entry.bytes.clone()).unwrap()
}

fn errors(diagnostics: &[Diagnostic]) -> Vec<&'static str> {
    let errors = diagnostics.iter().filter(|one| one.severity == Severity::Error);
    let mut codes: Vec<_> = errors.map(|one| one.code.info().code).collect();
    codes.sort_unstable();
    codes.dedup();
    codes
}
