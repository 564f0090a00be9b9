//! `cargo xtask parts`: makes the parts table of `crates/parts` from packages of public registries.
//!
//! Cargo and pip fetch the packages in the versions given here into `target/parts-sources`; what
//! comes out is `crates/parts/data/parts.bin`. `--check` compares instead of writing.

mod avr;
mod build;
mod metapac;
mod modm;
mod sources;

use std::path::Path;

use anyhow::{Result, bail, ensure};
use sensedsl_parts::format;

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let check = match arguments {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => bail!("cargo xtask parts [--check]"),
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let sources = sources::fetch(&root.join("target/parts-sources"))?;
    let chips = metapac::read(&sources.metapac)?;
    let devices = modm::read(&sources.modm)?;
    let avrs = avr::read(&sources.avr)?;
    let (data, summary) = build::build(&chips, &devices, &avrs);
    let packed = format::pack(&data);
    ensure!(format::unpack(&packed).as_ref() == Some(&data), "the table does not read back");
    let path = root.join("crates/parts/data/parts.bin");
    if check {
        let stored = sources::read(&path)?;
        ensure!(
            stored == packed,
            "{} is not what its sources give: run `cargo xtask parts`",
            path.display()
        );
    } else {
        sources::write(&path, &packed)?;
    }
    super::say(&format!("{summary}{} bytes packed\n", packed.len()))
}
