//! `sensedsl-verify PROOF [--for FILE…]`: exits with status 0 if the certificate proves what it
//! claims and is of those files, 1 if not, and 2 if something cannot be read. `-` is the standard
//! input.
#![expect(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "the binary reads files and says the result"
)]

use sensedsl_proof::budget::BYTES_MAX;
use sensedsl_proof::format::Certificate;
use sensedsl_proof::subject::{compare, sha256};
use sensedsl_proof::{Refuted, read, verify};
use std::ffi::{OsStr, OsString};
use std::io::Read as _;
use std::process::ExitCode;

/// The content of a file. A pipe or a device may never end, and a file that is far too large is
/// neither a certificate nor part of a design.
fn bytes(path: &OsStr) -> Result<Vec<u8>, String> {
    let refused = |error: std::io::Error| error.to_string();
    let mut bytes = Vec::new();
    // One byte more than allowed, to see whether it is too large.
    let most = BYTES_MAX as u64 + 1;
    let length = if path == "-" {
        std::io::stdin().lock().take(most).read_to_end(&mut bytes)
    } else if std::fs::metadata(path).map_err(refused)?.is_file() {
        let file = std::fs::File::open(path).map_err(refused)?;
        file.take(most).read_to_end(&mut bytes)
    } else {
        return Err("it is a pipe, a device or a folder, not a file".to_owned());
    };
    let length = length.map_err(refused)?;
    if length > BYTES_MAX {
        return Err(format!("it has more than {} MiB", BYTES_MAX >> 20));
    }
    Ok(bytes)
}

fn certificate(path: &OsStr) -> Result<Certificate, String> {
    let text = String::from_utf8(bytes(path)?).map_err(|error| error.to_string())?;
    read(&text).map_err(|error| error.to_string())
}

/// The certificate's path, and the files that it should be of.
fn arguments() -> Option<(OsString, Option<Vec<OsString>>)> {
    let mut arguments = std::env::args_os().skip(1);
    let proof = arguments.next().filter(|first| first != "--for" && first != "--help")?;
    match arguments.next() {
        None => Some((proof, None)),
        Some(word) => {
            let files: Vec<OsString> = arguments.collect();
            (word == "--for" && !files.is_empty()).then_some((proof, Some(files)))
        }
    }
}

/// The result in words.
fn judge(certificate: &Certificate, files: Option<&[(String, String)]>) -> Result<String, Refuted> {
    let proved = verify(certificate)?;
    let subject = &certificate.subject;
    let compared = files.map_or_else(|| Ok(subject.unseen()), |files| compare(subject, files))?;
    Ok(format!("{proved}\n{compared}"))
}

fn main() -> ExitCode {
    let Some((path, files)) = arguments() else {
        eprintln!("usage: sensedsl-verify PROOF|- [--for FILE...]");
        return ExitCode::from(2);
    };
    let certificate = match certificate(&path) {
        Ok(certificate) => certificate,
        Err(error) => {
            eprintln!("{}: not a certificate: {error}", path.display());
            return ExitCode::from(2);
        }
    };
    let mut given = Vec::new();
    for path in files.iter().flatten() {
        match bytes(path) {
            Ok(bytes) => given.push((path.to_string_lossy().into_owned(), sha256(&bytes))),
            Err(error) => {
                eprintln!("{}: {error}", path.display());
                return ExitCode::from(2);
            }
        }
    }
    match judge(&certificate, files.is_some().then_some(&given)) {
        Ok(found) => {
            println!("verified: {found}");
            ExitCode::SUCCESS
        }
        Err(refuted) => {
            println!("refused: {refuted}");
            ExitCode::FAILURE
        }
    }
}
