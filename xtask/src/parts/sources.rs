//! The packages that the parts table is made from, fetched by their ordinary clients.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, ensure};

/// Pins, signals and alternate functions of STM32.
const METAPAC: (&str, &str) = ("stm32-metapac", "21.0.0");
/// ATDF files of the AVRs.
const AVR: (&str, &str) = ("avr-device", "0.9.0");
/// Pins and signals of ESP32.
const ESP: (&str, &str) = ("esp-metadata-generated", "0.5.3");
/// Pins and signals of i.MX RT1062, on the boards that lead them out.
const TEENSY: (&str, &str) = ("teensy4-pins", "0.4.0");
/// Inputs of the converters of i.MX RT1062.
const IMXRT: (&str, &str) = ("imxrt-iomuxc", "0.3.2");
/// Packages and positions of STM32; all of nRF52 and SAM D.
const MODM: (&str, &str) = ("modm-devices", "0.13.1");

/// Folders of the unpacked packages.
pub(crate) struct Sources {
    pub(crate) metapac: PathBuf,
    pub(crate) avr: PathBuf,
    pub(crate) esp: PathBuf,
    pub(crate) teensy: PathBuf,
    pub(crate) imxrt: PathBuf,
    /// The folders of the families.
    pub(crate) modm: PathBuf,
}

/// Whether a missing tool or package is a failure.
pub(crate) fn required() -> bool {
    std::env::var_os("SENSEDSL_REQUIRE_TOOLS").is_some_and(|value| value == "1")
}

/// Fetches the packages that are missing into the target folder.
pub(crate) fn fetch(root: &Path) -> Result<Sources> {
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| "target".into(), PathBuf::from);
    let folder = &root.join(target).join("parts-sources");
    let vendor = folder.join("vendor");
    let crate_folder = |(name, _): (&str, &str)| vendor.join(name);
    let python = folder.join(format!("{}-{}", MODM.0, MODM.1));
    let crates = [METAPAC, AVR, ESP, TEENSY, IMXRT];
    if crates.iter().any(|of| !crate_folder(*of).exists()) {
        std::fs::create_dir_all(folder.join("src"))?;
        write(&folder.join("src/lib.rs"), b"")?;
        let dependency = |(name, version): (&str, &str)| {
            format!("{name} = {{ version = \"={version}\", default-features = false }}\n")
        };
        let manifest = format!(
            "[package]\nname = \"parts-sources\"\nedition = \"2024\"\n\n[workspace]\n\n\
             [dependencies]\n{}",
            crates.map(dependency).concat()
        );
        write(&folder.join("Cargo.toml"), manifest.as_bytes())?;
        call(Command::new("cargo").args(["vendor", "--quiet"]).arg(&vendor).current_dir(folder))?;
    }
    if !python.exists() {
        let wanted = format!("{}=={}", MODM.0, MODM.1);
        let pip = ["-m", "pip", "install", "--quiet", "--no-deps", "--target"];
        call(Command::new("python3").args(pip).arg(&python).arg(wanted))?;
    }
    Ok(Sources {
        metapac: crate_folder(METAPAC).join("src/chips"),
        avr: crate_folder(AVR).join("vendor"),
        esp: crate_folder(ESP).join("src"),
        teensy: crate_folder(TEENSY).join("src"),
        imxrt: crate_folder(IMXRT).join("src"),
        modm: python.join("modm_devices/resources/devices"),
    })
}

fn call(command: &mut Command) -> Result<()> {
    let status = command.status().with_context(|| format!("{command:?}"))?;
    ensure!(status.success(), "{command:?}: {status}");
    Ok(())
}

/// The bytes of a file.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).with_context(|| path.display().to_string())
}

/// The text of a file.
pub(crate) fn text(path: &Path) -> Result<String> {
    std::fs::read_to_string(path).with_context(|| path.display().to_string())
}

/// Writes a file.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    std::fs::write(path, bytes).with_context(|| path.display().to_string())
}

/// Writes a file, or compares it; returns whether it is as it would be written.
pub(crate) fn is_fresh(path: &Path, text: &str, is_check: bool) -> Result<bool> {
    if !is_check {
        write(path, text.as_bytes())?;
    }
    Ok(std::fs::read_to_string(path).is_ok_and(|there| there == text))
}

/// The entries of a folder, by name.
pub(crate) fn entries(folder: &Path) -> Result<Vec<PathBuf>> {
    let read = std::fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let mut paths: Vec<PathBuf> =
        read.map(|entry| entry.map(|entry| entry.path())).collect::<Result<_, _>>()?;
    paths.sort();
    Ok(paths)
}
