//! Prints what STM32F4DiscoveryBoard says: `cargo run --example monitor -- [DEVICE | RECORDING]`. Generated: copy it to
//! start a program of your own.

use std::fs::File;
use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;

use sense_fig2::{STM32F4DiscoveryBoard, Error};

fn run(path: Option<&str>) -> Result<(), Error> {
    let mut board = match path {
        None => STM32F4DiscoveryBoard::find()?,
        Some(path) if Path::new(path).is_file() => match File::open(path) {
            Ok(recording) => STM32F4DiscoveryBoard::play(recording),
            Err(error) => return Err(Error::Gone(error.to_string())),
        },
        Some(path) => STM32F4DiscoveryBoard::open(path)?,
    };
    let mut output = std::io::stdout();
    for received in &mut board {
        // Whoever reads this may have enough.
        if writeln!(output, "{}", received?.message).is_err() {
            return Ok(());
        }
    }
    let counts = board.counts();
    eprintln!("{} frames, {} bytes dropped", counts.frames, counts.dropped_bytes);
    Ok(())
}

fn main() -> ExitCode {
    let path = std::env::args().nth(1);
    match run(path.as_deref()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(if matches!(error, Error::OtherFirmware(..)) { 1 } else { 2 })
        }
    }
}
