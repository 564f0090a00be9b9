//! `sensedsl-verify PROOF`: exit status 0 when the certificate proves what it claims, 1 when not,
//! 2 when there is no certificate to be read.
#![expect(
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "the binary reads the file and says the result"
)]

use sensedsl_proof::{read, verify};
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut arguments = std::env::args_os().skip(1);
    let (Some(path), None) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: sensedsl-verify PROOF");
        return ExitCode::from(2);
    };
    let text = std::fs::read_to_string(&path).map_err(|error| error.to_string());
    let certificate = text.and_then(|text| read(&text).map_err(|error| error.to_string()));
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
