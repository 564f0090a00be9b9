//! The robots that `sensedsl new --template` begins with: a design, the worlds that it is simulated in, and the code of
//! its controller.
//!
//! A name and a board come in; what goes out are the texts, or why the board cannot carry that robot and which ones can.
//! A template is a folder in `templates/projects`, which runs as it is; only the name of its board is exchanged.

use anyhow::{Result, anyhow};
use sensedsl_board::catalog;
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
    /// What is exchanged in all its texts for boards that cannot carry it as it is, tried in this order.
    sizes: &'static [Changes],
}

/// Pairs of a text and what takes its place.
pub(crate) type Changes = &'static [(&'static str, &'static str)];

/// A template on a board.
pub(crate) struct Made {
    /// The design.
    pub(crate) text: String,
    /// The system that its firmware is for; `None` if there is a wiring alone.
    pub(crate) system: Option<&'static str>,
    changes: Changes,
}

impl Made {
    /// Another text of the template, as it is for that board.
    pub(crate) fn adapt(&self, text: &str) -> String {
        changed(text, self.changes)
    }
}

fn changed(text: &str, changes: Changes) -> String {
    changes.iter().fold(text.to_owned(), |text, (from, to)| text.replace(from, to))
}

/// Fewer samples, for converters that take a tenth of a millisecond for each.
const SLOW: Changes = &[(LINE, LINE_SLOW), WIDER];
/// Six sensors instead of eight.
const SIX: Changes = &[
    (LINE, LINE_SLOW),
    WIDER,
    ("uint16[8]", "uint16[6]"),
    ("eight reflectance sensors", "six reflectance sensors"),
    ("SENSORS 8", "SENSORS 6"),
    ("at) - 3.5)", "at) - 2.5)"),
    (
        "(Line[4] - Line[3] + 3*(Line[5] - Line[2]) + 5*(Line[6] - Line[1]) + 7*(Line[7] - Line[0])) / 6000",
        "(Line[3] - Line[2] + 3*(Line[4] - Line[1]) + 5*(Line[5] - Line[0])) / 6000",
    ),
    // The outermost sensor sees the line when that is less far away.
    ("Offset < -25 mm", "Offset < -16 mm"),
];
/// What is measured and computed one after the other comes some milliseconds later.
const WIDER: (&str, &str) = ("abs(Offset) < 9 mm from 1 s", "abs(Offset) < 11 mm from 1 s");
const LINE: &str = "        type = analog;\n        delay = 5 ms;\n";
const LINE_SLOW: &str = "        type = analog;\n        samples = 2;\n        delay = 5 ms;\n";

/// The code of a controller, in each language that a firmware can have.
pub(crate) struct Code {
    c: (&'static str, &'static str),
    sketch: (&'static str, &'static str),
    rust: (&'static str, &'static str),
}

impl Code {
    /// The file in the firmware's folder, and its text: as the firmware of that system is written.
    pub(crate) fn of(&self, system: Option<&str>) -> (&'static str, &'static str) {
        match system.and_then(|system| system.rsplit_once('-')).map(|(system, _)| system) {
            Some("embassy") => self.rust,
            Some("arduino") => self.sketch,
            Some(_) | None => self.c,
        }
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
            sketch: (
                concat!("src/user/", $code, ".c"),
                text!($template, concat!("user/", $code, ".c")),
            ),
            rust: (
                concat!("src/user/", $code, ".rs"),
                text!($template, concat!("src/user/", $code, ".rs")),
            ),
        })
    };
}

macro_rules! templates {
    ($($name:literal: [$($world:literal),+] $($code:literal)? $(, $size:ident)*;)+) => {
        &[$(Template {
            name: $name,
            design: text!($name, "robot.sense"),
            worlds: &[$(($world, text!($name, $world))),+],
            code: code!($name, $($code)?),
            sizes: &[$($size),*],
        }),+]
    };
}

/// Each with its worlds and the identifier of its controller.
const TEMPLATES: &[Template] = templates! {
    "arm": ["bench.toml"] "trace";
    "balancer": ["floor.toml"] "balance";
    "line_follower": ["oval.toml", "oval.svg", "aside.toml", "eight.toml", "eight.svg"] "follow", SLOW, SIX;
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
    pub(crate) fn on(&self, board: &catalog::Entry) -> Result<Made> {
        let whole: Changes = &[];
        let sizes = || std::iter::once(whole).chain(self.sizes.iter().copied());
        for changes in sizes() {
            for system in target::systems_of(board) {
                let text = changed(&self.text(board, Some(system)), changes);
                if starter::is_made(&text, true) {
                    return Ok(Made { text, system: Some(system), changes });
                }
            }
        }
        for changes in sizes() {
            let text = changed(&self.text(board, None), changes);
            if starter::is_made(&text, false) {
                return Ok(Made { text, system: None, changes });
            }
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
