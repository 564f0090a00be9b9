//! The firmware of one board, as `generate` wrote it: a folder in, what it builds from out.

use std::path::{Path, PathBuf};

use anyhow::Result;

use crate::files::read_if_there;

/// The firmware of one board.
#[derive(Clone, Debug)]
pub(crate) struct Program {
    /// The board's name.
    pub(crate) board: String,
    /// Where its Makefile is.
    pub(crate) folder: PathBuf,
    /// The board's MCU, where that is known.
    pub(crate) mcu: Option<String>,
    /// What the Makefile wants of the tree.
    pub(crate) wants: Wants,
}

/// What a Makefile wants of the tree.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Wants {
    /// The release: `21.11`.
    pub(crate) version: String,
    /// Files and folders, relative to the tree.
    pub(crate) paths: Vec<String>,
}

impl Wants {
    /// Reads a generated Makefile. The release stands in its head; the paths are what it includes and
    /// what its variables name.
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

/// The firmware in a folder: of all boards where it is what `generate` wrote, of one where it is that
/// of a board; none otherwise.
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

/// The firmware of one board, where the folder is one.
fn program(folder: &Path, mcus: &[(String, String)]) -> Result<Option<Program>> {
    if !folder.join("generated").is_dir() {
        return Ok(None);
    }
    let Some(makefile) = read_if_there(&folder.join("Makefile"))? else { return Ok(None) };
    // The folder may be called `.`.
    let named = folder.canonicalize().unwrap_or_else(|_| folder.to_path_buf());
    let board = named.file_name().map_or_else(String::new, |name| name.display().to_string());
    let mcu = mcus.iter().find(|(name, _)| *name == board).map(|(_, mcu)| mcu.clone());
    let wants = Wants::of(&String::from_utf8_lossy(&makefile));
    Ok(Some(Program { board, folder: folder.to_path_buf(), mcu, wants }))
}

/// The MCUs of the boards of an answer; none where there is no answer.
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
