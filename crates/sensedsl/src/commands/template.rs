//! The robots that `sensedsl new --template` begins with: a design, the worlds that it is simulated in, and the code of
//! its controller.
//!
//! A name and a board come in; what goes out are the texts, or why the board cannot carry that robot and which ones can.
//! A template is a folder in `templates/projects`, which runs as it is; only the name of its board is exchanged.

use anyhow::{Result, anyhow};
use sensedsl_board::{catalog, profile};
use sensedsl_generate::target;

use super::starter;

/// A robot to begin with.
pub(crate) struct Template {
    /// As people ask for it.
    pub(crate) name: &'static str,
    design: &'static str,
    /// The worlds and their maps, the first of them the one to begin with.
    pub(crate) worlds: &'static [(&'static str, &'static str)],
    /// The code of its controller, if it has one.
    pub(crate) code: Option<Code>,
}

/// The code of a controller, in each language that a firmware can have.
pub(crate) struct Code {
    c: (&'static str, &'static str),
    rust: (&'static str, &'static str),
}

impl Code {
    /// The file in the firmware's folder, and its text: as the firmware of that system is written.
    pub(crate) fn of(&self, system: Option<&str>) -> (&'static str, &'static str) {
        let is_c = system.is_none_or(|system| {
            system == profile::full_name(profile::DEFAULT).unwrap_or_default()
        });
        if is_c { self.c } else { self.rust }
    }
}

/// A text of a template's folder.
macro_rules! text {
    ($template:literal, $file:expr) => {
        include_str!(concat!("../../templates/projects/", $template, "/", $file))
    };
}

macro_rules! code {
    ($template:literal,) => {
        None
    };
    ($template:literal, $code:literal) => {
        Some(Code {
            c: (concat!("user/", $code, ".c"), text!($template, concat!("user/", $code, ".c"))),
            rust: (
                concat!("src/user/", $code, ".rs"),
                text!($template, concat!("src/user/", $code, ".rs")),
            ),
        })
    };
}

macro_rules! templates {
    ($($name:literal: [$($world:literal),+] $($code:literal)?;)+) => {
        &[$(Template {
            name: $name,
            design: text!($name, "robot.sense"),
            worlds: &[$(($world, text!($name, $world))),+],
            code: code!($name, $($code)?),
        }),+]
    };
}

/// Each with its worlds and the identifier of its controller.
const TEMPLATES: &[Template] = templates! {
    "arm": ["bench.toml"] "trace";
    "balancer": ["floor.toml"] "balance";
    "line_follower": ["oval.toml", "oval.svg", "aside.toml", "eight.toml", "eight.svg"] "follow";
    "quadcopter": ["world.toml"];
    "rover": ["corridor.toml", "corridor.svg"] "stop";
    "thermostat": ["oven.toml"] "hold";
    "weather_station": ["world.toml"];
};

/// How the line begins that names the board.
const HEAD: &str = "board Robot on ";

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

    /// The design with another board in the place of its own.
    fn text(&self, board: &catalog::Entry, system: Option<&str>) -> String {
        let target = system.map_or(String::new(), |system| starter::target_line(board, system));
        let head = format!("{HEAD}{} {{\n{target}", board.name.replace('-', "_"));
        let is_head = |line: &str| line.starts_with(HEAD);
        let lines = self.design.split_inclusive('\n');
        lines.map(|line| if is_head(line) { head.as_str() } else { line }).collect()
    }
}
