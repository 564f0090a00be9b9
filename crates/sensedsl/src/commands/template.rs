//! The robots that `sensedsl new --template` begins with: a design, and a world that it is simulated in.
//!
//! A name and a board come in; what goes out is the two texts, or why the board cannot carry that robot and which ones
//! can. A template is two files in `templates/projects`; `BOARD` in its design stands for the board.

use anyhow::{Result, anyhow};
use sensedsl_board::catalog;
use sensedsl_generate::target;

use super::starter;

/// A robot to begin with.
pub(crate) struct Template {
    /// As people ask for it.
    pub(crate) name: &'static str,
    design: &'static str,
    pub(crate) world: &'static str,
}

macro_rules! templates {
    ($($name:literal),+) => {
        &[$(Template {
            name: $name,
            design: include_str!(concat!("../../templates/projects/", $name, ".sense")),
            world: include_str!(concat!("../../templates/projects/", $name, ".toml")),
        }),+]
    };
}

const TEMPLATES: &[Template] =
    templates!["arm", "line_follower", "quadcopter", "rover", "weather_station"];

/// Boards that are proposed where another one is too small: common ones, with firmware.
const PROPOSED: &[&str] =
    &["NUCLEO-F401RE", "NUCLEO-F446RE", "STM32F407G-DISC1", "NUCLEO-H563ZI", "RASPBERRYPI-PICO"];

/// The names of all templates, for whoever completes or misspells one.
pub(crate) fn names() -> Vec<&'static str> {
    TEMPLATES.iter().map(|one| one.name).collect()
}

/// The template of that name.
///
/// # Errors
///
/// There is none; the text says which there are.
pub(crate) fn find(name: &str) -> Result<&'static Template> {
    TEMPLATES
        .iter()
        .find(|one| one.name == name)
        .ok_or_else(|| anyhow!("there is no template {name}: take one of {}", names().join(", ")))
}

impl Template {
    /// The design for that board, and the system that its firmware is for: `None` if there is a wiring alone.
    ///
    /// # Errors
    ///
    /// The board has no wiring for it; the text names boards that have one.
    pub(crate) fn on(&self, board: &catalog::Entry) -> Result<(String, Option<&'static str>)> {
        for system in target::systems_of(board) {
            let text = self.text(board, Some(system));
            if starter::is_made(&text, true) {
                return Ok((text, Some(system)));
            }
        }
        let text = self.text(board, None);
        if starter::is_made(&text, false) {
            return Ok((text, None));
        }
        let fitting: Vec<_> = PROPOSED
            .iter()
            .filter_map(|name| catalog::find(name))
            .filter(|one| one.name != board.name && starter::is_made(&self.text(one, None), false))
            .map(|one| one.name)
            .collect();
        Err(anyhow!(
            "{} cannot carry the template {}: too many of its pins or units are missing. Take another board, such as \
             `--board {}`, or a smaller robot: `sensedsl new DIR --board {}`",
            board.name,
            self.name,
            fitting.join("`, `--board "),
            board.name
        ))
    }

    fn text(&self, board: &catalog::Entry, system: Option<&str>) -> String {
        let head = format!("board Robot on {} {{\n", board.name.replace('-', "_"));
        let target = system.map_or(String::new(), |system| starter::target_line(board, system));
        self.design.replace("board Robot on BOARD {\n", &format!("{head}{target}"))
    }
}
