//! The firmware of one board, as `generate` wrote it. In: a folder. Out: how its firmware is built.

use std::path::{Path, PathBuf};

use anyhow::Result;
use sensedsl_board::catalog;

use super::arduino::Sketch;
use super::uf2::{self, Family};
use crate::files::{read_if_there, shown};

/// The firmware of one board.
#[derive(Clone, Debug)]
pub(crate) struct Program {
    /// The board's name.
    pub(crate) board: String,
    /// The folder with its Makefile or its `Cargo.toml`.
    pub(crate) folder: PathBuf,
    /// The board's MCU, if it is known.
    pub(crate) mcu: Option<String>,
    /// What makes the board ready to take a program, if it is a board that is known.
    pub(crate) ready: Option<String>,
    /// The tool that builds it.
    pub(crate) build: Build,
}

/// The tool that builds the firmware of a board.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Build {
    /// GNU make, with a tree of ChibiOS.
    Make(Wants),
    /// Cargo.
    Cargo(Project),
    /// `arduino-cli`, or make with the Arduino core.
    Sketch(Sketch),
}

/// A project of Cargo's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Project {
    /// The target triple: `thumbv7em-none-eabihf`.
    pub(crate) triple: String,
    /// The family of the chip in UF2 files, if its boot loader takes them.
    pub(crate) family: Option<&'static Family>,
}

impl Project {
    /// Reads the family from the project's manifest.
    fn new(triple: &str, manifest: &str) -> Self {
        let id = manifest.lines().find_map(|line| line.strip_prefix("uf2-family = 0x"));
        let id = id.and_then(|digits| u32::from_str_radix(digits.trim(), 16).ok());
        Self { triple: triple.to_owned(), family: id.and_then(uf2::family) }
    }
}

impl Build {
    /// Determines the tool from a board's files, whose texts `file` looks up; `None` if there is no firmware.
    pub(crate) fn of(file: &mut dyn FnMut(&str) -> Result<Option<String>>) -> Result<Option<Self>> {
        if let Some(makefile) = file("Makefile")? {
            let sketch = Sketch::of(&makefile).map(Self::Sketch);
            return Ok(Some(sketch.unwrap_or_else(|| Self::Make(Wants::of(&makefile)))));
        }
        let config = file(".cargo/config.toml")?.unwrap_or_default();
        let triple = config.lines().find_map(|line| line.trim().strip_prefix("target = \""));
        let Some(triple) = triple.and_then(|rest| rest.split('"').next()) else { return Ok(None) };
        let manifest = file("Cargo.toml")?.unwrap_or_default();
        Ok(Some(Self::Cargo(Project::new(triple, &manifest))))
    }

    /// The family of the chip in UF2 files, if its boot loader takes them.
    pub(crate) fn family(&self) -> Option<&'static Family> {
        match self {
            Self::Make(_) | Self::Sketch(_) => None,
            Self::Cargo(project) => project.family,
        }
    }

    /// The name of the tool for people.
    pub(crate) fn tool(&self) -> &'static str {
        match self {
            Self::Make(_) => "make",
            Self::Cargo(_) => "cargo",
            Self::Sketch(_) => "the build of the sketch",
        }
    }
}

/// The requirements of a Makefile for the tree.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Wants {
    /// The release: `21.11`.
    pub(crate) version: String,
    /// Files and folders, relative to the tree.
    pub(crate) paths: Vec<String>,
}

impl Wants {
    /// Reads a generated Makefile. The release is in its head; the paths are those that it includes and that its
    /// variables name.
    pub(crate) fn of(makefile: &str) -> Self {
        let version = makefile.split("ChibiOS ").skip(1).map(|rest| {
            rest.chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect::<String>()
        });
        let named = |line: &str| {
            let (before, path) = line.trim().split_once("$(CHIBIOS)/")?;
            let before = before.trim_end();
            let plain = !path.is_empty() && !path.contains(['$', '(', ')', '"', '\\', ' ']);
            let used = before == "include" || before.ends_with('=');
            (plain && used).then(|| path.to_owned())
        };
        Self {
            version: version.into_iter().find(|one| one.contains('.')).unwrap_or_default(),
            paths: makefile.lines().filter_map(named).collect(),
        }
    }
}

/// The firmware in a folder: that of all boards if `generate` wrote the folder, that of one board if the folder is one
/// board's; otherwise empty.
pub(crate) fn in_folder(folder: &Path) -> Result<Vec<Program>> {
    if let Some(program) = program(folder, &mcus(&folder.join("../../assignment.json"))?)? {
        return Ok(vec![program]);
    }
    let mcus = mcus(&folder.join("assignment.json"))?;
    let mut programs = Vec::new();
    let mut folders: Vec<PathBuf> = match std::fs::read_dir(folder.join("firmware")) {
        Ok(entries) => entries.filter_map(|entry| Some(entry.ok()?.path())).collect(),
        Err(_) => Vec::new(),
    };
    folders.sort();
    for folder in folders {
        programs.extend(program(&folder, &mcus)?);
    }
    Ok(programs)
}

/// The firmware of one board, if the folder has it.
fn program(folder: &Path, mcus: &[(String, String)]) -> Result<Option<Program>> {
    let signs = ["generated/sense_hw.c", "src/wiring.rs", "src/sense_hw.c"];
    if !signs.iter().any(|sign| folder.join(sign).is_file()) {
        return Ok(None);
    }
    let mut file = |path: &str| -> Result<Option<String>> {
        let bytes = read_if_there(&folder.join(path))?;
        Ok(bytes.map(|bytes| String::from_utf8_lossy(&bytes).into_owned()))
    };
    let Some(build) = Build::of(&mut file)? else { return Ok(None) };
    // The folder's name may be `.`.
    let named = folder.canonicalize().unwrap_or_else(|_| folder.to_path_buf());
    let board = named.file_name().map_or_else(String::new, shown);
    let mcu = mcus.iter().find(|(name, _)| *name == board).map(|(_, mcu)| mcu.clone());
    let known = catalog::find(&board).and_then(|entry| entry.board().ok());
    let ready = known.and_then(|board| board.ready);
    Ok(Some(Program { board, folder: folder.to_path_buf(), mcu, ready, build }))
}

/// The MCUs of the boards in an answer; empty if there is no answer.
fn mcus(answer: &Path) -> Result<Vec<(String, String)>> {
    let bytes = read_if_there(answer)?.unwrap_or_default();
    let answer: serde_json::Value = serde_json::from_slice(&bytes).unwrap_or_default();
    let boards = answer.get("boards").and_then(serde_json::Value::as_array);
    let text = |board: &serde_json::Value, key: &str| Some(board.get(key)?.as_str()?.to_owned());
    let of = |board: &serde_json::Value| Some((text(board, "name")?, text(board, "mcu")?));
    Ok(boards.into_iter().flatten().filter_map(of).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_project_says_what_builds_it() {
        let of = |name: &'static str, text: &'static str| {
            let mut file = |path: &str| Ok((path == name).then(|| text.to_owned()));
            Build::of(&mut file).unwrap()
        };
        let config = "# A comment.\n[build]\ntarget = \"thumbv6m-none-eabi\"\n";
        let project = |manifest| Project::new("thumbv6m-none-eabi", manifest);
        assert_eq!(of(".cargo/config.toml", config), Some(Build::Cargo(project(""))));
        assert_eq!(of("Makefile", ""), Some(Build::Make(Wants::default())));
        assert_eq!(of("README.md", ""), None);
    }

    #[test]
    fn a_manifest_says_what_uf2_files_call_the_chip() {
        let chip = |manifest| Project::new("", manifest).family.map(|family| family.chip);
        let of_pico = "[package.metadata.sensedsl]\nuf2-family = 0xe48bff56\n";
        assert_eq!(chip(of_pico), Some("RP2040"));
        assert_eq!(chip("uf2-family = 0x0\n"), None);
        assert_eq!(chip("[package]\n"), None);
    }

    #[test]
    fn a_makefile_says_what_it_wants() {
        let text = "# Firmware of X\n#   make CHIBIOS=<ChibiOS 21.11 tree>\n\
                    ifeq ($(wildcard $(CHIBIOS)/os/rt/rt.mk),)\nendif\n\
                    BASE_CFG := $(CHIBIOS)/demos/STM32/D/cfg\n  include $(CHIBIOS)/os/rt/rt.mk\n\
                    include $(RULESPATH)/rules.mk\nUDEFS := -DX=\\\"$(CHIBIOS)/chconf.h\\\"\n";
        let wants = Wants::of(text);
        assert_eq!(wants.version, "21.11");
        assert_eq!(wants.paths, ["demos/STM32/D/cfg", "os/rt/rt.mk"]);
    }
}
