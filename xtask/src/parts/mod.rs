//! `cargo xtask parts`: makes the parts table of `crates/parts` from packages of public registries.
//!
//! Cargo and pip fetch the packages, in the versions given here, into `parts-sources` in the target
//! folder; the result is `crates/parts/data/parts.bin`. `--check` compares instead of writing: if
//! the packages cannot be fetched it prints `SKIPPED`, unless `SENSEDSL_REQUIRE_TOOLS=1`.
//! `--compare FOLDER` compares the table with ST's open pin data.

mod avr;
mod build;
mod compare;
mod esp;
mod imxrt;
pub(crate) mod metapac;
mod modm;
mod nrf;
mod sam;
pub(crate) mod sources;

use std::path::Path;

use anyhow::{Result, bail, ensure};
use sensedsl_parts::format;

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let check = match arguments {
        [] => false,
        [flag] if flag == "--check" => true,
        [flag, folder] if flag == "--compare" => return compare::run(&root, Path::new(folder)),
        _ => bail!("cargo xtask parts [--check | --compare FOLDER]"),
    };
    let sources = match sources::fetch(&root) {
        Err(error) if check && !sources::required() => {
            return super::say(&format!("SKIPPED: the sources cannot be fetched: {error:#}\n"));
        }
        fetched => fetched?,
    };
    let chips = metapac::read(&sources.metapac)?;
    let devices = modm::read(&sources.modm.join("stm32"))?;
    let others = build::Others {
        avrs: avr::read(&sources.avr)?,
        esps: esp::read(&sources.esp)?,
        nrfs: nrf::read(&sources.modm.join("nrf"))?,
        imxrt: imxrt::read(&sources.teensy, &sources.imxrt)?,
        sams: sam::read(&sources.modm.join("sam"))?,
    };
    let (data, summary) = build::build(&chips, &devices, &others)?;
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
