//! The compiler, and the macros that describe an MCU to it.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use sensedsl_board::catalog;
use sensedsl_board::profile::{self, Target, TargetProfile};
use sensedsl_firmware_chibios::{Facts, Names};
use sensedsl_tests::{has, root};

use super::super::facts::Folder;
use super::super::tools::scratch;
use super::same::key;

/// The firmware of one board, and the macros for its MCU.
pub(super) struct Firmware {
    pub(super) title: String,
    pub(super) macros: Vec<String>,
    pub(super) files: Folder,
}

/// Both builds that a Makefile offers.
pub(super) const MODES: [&str; 2] = ["development", "production"];

/// The profile of an MCU, if there is one.
pub(crate) fn profile_of(mcu: &str) -> Option<TargetProfile> {
    match profile::find(profile::DEFAULT, mcu) {
        Ok(Target::Profile(profile)) => Some((*profile).clone()),
        Ok(Target::None) | Err(_) => None,
    }
}

/// The number in a driver's version: 3 for `ADCv3` and for `SPIv3/driver_v2`, 0 if there is none.
fn version(name: &str) -> u32 {
    let name = name.split('/').next().unwrap();
    name.rsplit('v').next().and_then(|number| number.parse().ok()).unwrap_or_default()
}

/// The macros that describe an MCU to the stubs.
fn macros(board: &catalog::Board, profile: &TargetProfile) -> Vec<String> {
    let drivers = Names::of(profile).unwrap().drivers;
    let family = profile.family.trim_start_matches("STM32");
    let versions = [
        // STM32F1 has its own converter driver, whose groups are those of version 2.
        ("ADC", if family == "F1" { 2 } else { version(&drivers.adc) }),
        ("I2C", version(&drivers.i2c)),
        ("SPI", version(&drivers.spi)),
        ("GPIO", version(&drivers.gpio)),
        ("USART", version(&drivers.serial)),
        ("WINDOWED", u32::from(!["F1", "F2", "F4", "L1"].contains(&family))),
        ("CORTEX", if ["F0", "G0", "L0"].contains(&family) { 0 } else { 4 }),
    ];
    let versions = versions.iter().map(|(name, number)| format!("-DSTUB_{name}={number}"));
    let mut macros: Vec<String> = versions.collect();
    macros.push(format!("-DSTUB_{family}"));
    if drivers.can.starts_with("FDCAN") {
        macros.push("-DSTUB_FDCAN".to_owned());
    }
    let chibios = Facts::of(board).unwrap().unwrap();
    macros.push(format!("-D{}", chibios.mcuconf));
    macros.extend(chibios.clocks_hz.iter().map(|(name, hz)| format!("-D{name}={hz}U")));
    macros
}

/// The macros for a board, given its name in a file.
pub(crate) fn macros_of(name: &str) -> Vec<String> {
    let entry = catalog::find(name).unwrap();
    macros(&entry.board().unwrap(), &profile_of(entry.mcu).unwrap())
}

/// The compiler; preferably that of the MCU, because its `long` has 32 bits.
fn compiler() -> Option<&'static str> {
    ["arm-none-eabi-gcc", "cc"].into_iter().find(|tool| has(tool))
}

/// Whether there is a compiler.
pub(super) fn is_here() -> bool {
    compiler().is_some()
}

/// Our own C files; the core is compiled separately (`firmware::core`).
pub(crate) fn sources(files: &Folder) -> Vec<&str> {
    let ours = ["generated/", "uproxy/chibios/", "user/"];
    let sources = files.keys().map(String::as_str).filter(|path| path.ends_with(".c"));
    sources.filter(move |path| ours.iter().any(|folder| path.starts_with(folder))).collect()
}

/// The output of the compiler for files in a board's folder; empty if there are no complaints.
pub(crate) fn compile(folder: &Path, macros: &[String], mode: &str, sources: &[&str]) -> String {
    let name = compiler().unwrap();
    let mut compiler = Command::new(name);
    compiler.current_dir(folder).args(["-fsyntax-only", "-std=gnu11", "-O0", "-Werror"]);
    compiler.args(["-Wall", "-Wextra", "-Wundef", "-Wstrict-prototypes", "-Wconversion"]);
    if name != "cc" {
        let is_small = macros.iter().any(|one| one == "-DSTUB_CORTEX=0");
        compiler.args(["-mthumb", if is_small { "-mcpu=cortex-m0" } else { "-mcpu=cortex-m4" }]);
    }
    compiler.args(["-Icfg", "-Igenerated", "-Iuser", "-Iuproxy/core", "-Iuproxy/chibios", "-I"]);
    compiler.arg(root().join("tests/firmware/stubs"));
    for one in ["CHCONF", "HALCONF", "MCUCONF"] {
        compiler.arg(format!("-DUP_BASE_{one}=\"conf.h\""));
    }
    compiler.arg(format!("-DUP_SHELL={}", u8::from(mode == "development")));
    // Defined here so that `#if X == TRUE` has a meaning before the headers define them.
    compiler.args(["-DTRUE=1", "-DFALSE=0"]).args(macros).args(sources);
    let output = compiler.output().unwrap();
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Runs the compiler on all firmwares, on all processors, in both modes; returns its output, and
/// the number of files it has read.
pub(super) fn compile_all(name: &str, all: &[Firmware]) -> (Vec<String>, usize) {
    static SEEN: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
    let place = scratch(&format!("stubs/{name}"));
    let (next, read) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let reported = Mutex::new(Vec::new());
    let work = || {
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            let Some(one) = all.get(at) else { return };
            let folder = place.join(at.to_string());
            write(&folder, &one.files);
            for mode in MODES {
                let keys = sources(&one.files).into_iter().map(|path| (path, key(one, mode, path)));
                let keys: Vec<_> = {
                    let seen = SEEN.lock().unwrap();
                    keys.filter(|(_, key)| !seen.contains(key)).collect()
                };
                if keys.is_empty() {
                    continue;
                }
                let paths: Vec<&str> = keys.iter().map(|(path, _)| *path).collect();
                let words = compile(&folder, &one.macros, mode, &paths);
                let _ = read.fetch_add(paths.len(), Ordering::Relaxed);
                if words.is_empty() {
                    SEEN.lock().unwrap().extend(keys.into_iter().map(|(_, key)| key));
                } else {
                    reported.lock().unwrap().push(format!("{} {mode}:\n{words}", one.title));
                }
            }
        }
    };
    let threads = std::thread::available_parallelism().map_or(2, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            let _ = scope.spawn(work);
        }
    });
    let mut reported = reported.into_inner().unwrap();
    reported.sort();
    (reported, read.into_inner())
}

pub(super) fn write(folder: &Path, files: &Folder) {
    let folders: BTreeSet<_> = files.keys().filter_map(|path| path.rsplit_once('/')).collect();
    for (name, _) in folders {
        std::fs::create_dir_all(folder.join(name)).unwrap();
    }
    for (path, text) in files.iter().filter(|(path, _)| path.ends_with(['c', 'h'])) {
        std::fs::write(folder.join(path), text).unwrap();
    }
}
