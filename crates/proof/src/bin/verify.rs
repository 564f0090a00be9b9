//! `sensedsl-verify PROOF` (`-` for the standard input): exit status 0 when the certificate proves what it claims, 1 when not,
//! 2 when there is no certificate to be read.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "the binary says the result")]

use sensedsl_proof::budget::BYTES_MAX;
use sensedsl_proof::{read, verify};
use std::ffi::OsStr;
use std::io::Read as _;
use std::process::ExitCode;

/// The text of a file. A pipe or a device may never end, and a file that is far too large is not a
/// certificate.
fn text(path: &OsStr) -> Result<String, String> {
    let refused = |error: std::io::Error| error.to_string();
    let mut text = String::new();
    // One byte more, so that it is seen to be too large.
    let most = BYTES_MAX as u64 + 1;
    if path == "-" {
        std::io::stdin().lock().take(most).read_to_string(&mut text).map_err(refused)?;
        return Ok(text);
    }
    if !std::fs::metadata(path).map_err(refused)?.is_file() {
        return Err("it is a pipe, a device or a folder, not a file".to_owned());
    }
    let file = std::fs::File::open(path).map_err(refused)?;
    file.take(most).read_to_string(&mut text).map_err(refused)?;
    Ok(text)
}

fn main() -> ExitCode {
    let mut arguments = std::env::args_os().skip(1);
    let (Some(path), None) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: sensedsl-verify PROOF|-");
        return ExitCode::from(2);
    };
    let certificate = text(&path).and_then(|text| read(&text).map_err(|error| error.to_string()));
    let certificate = match certificate {
        Ok(certificate) => certificate,
        Err(error) => {
            eprintln!("{}: no certificate: {error}", path.display());
            return ExitCode::from(2);
        }
    };
    match verify(&certificate) {
        Ok(proved) => {
            println!("verified: {proved}");
            ExitCode::SUCCESS
        }
        Err(refuted) => {
            println!("refused: {refuted}");
            ExitCode::FAILURE
        }
    }
}
