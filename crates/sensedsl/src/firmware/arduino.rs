//! What builds sketches: `arduino-cli`, or make with `avr-gcc` and the folder of the Arduino core.

use std::path::{Path, PathBuf};

use sensedsl_diagnostics::codes::{e0516_tool_missing, e0518_no_probe};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_host::port::{Port, usb_ports};

use super::asked;
use super::tools::{Make, gnu_make};
use crate::files::shown;

/// The Arduino IDE's program for the command line, and what it calls the core for AVR.
const CLI: &str = "arduino-cli";
const OWN_CORE: &str = "arduino:avr";

/// Where packages and the Arduino IDE put the core for AVR. A folder of versions ends with a slash.
const PLACES: [&str; 2] =
    ["/usr/share/arduino/hardware/arduino/avr", "/usr/local/share/arduino/hardware/arduino/avr"];
/// The same below the user's folder: the newest version there is taken.
const OF_USER: [&str; 3] = [
    ".arduino15/packages/arduino/hardware/avr",
    "Library/Arduino15/packages/arduino/hardware/avr",
    "AppData/Local/Arduino15/packages/arduino/hardware/avr",
];

/// How avrdude calls the boot loader of MCUs with a USB port of their own, and what starts it.
const WITH_USB: &str = "avr109";
const TOUCH_BAUD: u32 = 1_200;

/// A generated sketch, as its Makefile describes it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Sketch {
    /// The name of the board and of its sketch.
    pub(crate) name: String,
    /// What compiler and programmer call the MCU.
    pub(crate) mcu: String,
    /// What `arduino-cli` calls the board: `arduino:avr:uno`.
    pub(crate) fqbn: String,
    /// How its boot loader takes programs, as avrdude calls it.
    pub(crate) protocol: String,
    /// At how many baud.
    pub(crate) speed: String,
}

impl Sketch {
    /// Reads a Makefile; `None` if it is that of something else.
    pub(crate) fn of(makefile: &str) -> Option<Self> {
        let value = |name: &str| {
            let line =
                makefile.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(" := "));
            line.map(|value| value.trim().to_owned())
        };
        Some(Self {
            name: value("NAME")?,
            mcu: value("MCU")?,
            fqbn: value("FQBN")?,
            protocol: value("PROTOCOL")?,
            speed: value("SPEED")?,
        })
    }

    /// The ELF file that a build makes, below the sketch's folder.
    pub(crate) fn elf(&self) -> PathBuf {
        Path::new("build").join(format!("{}.ino.elf", self.name))
    }
}

/// What builds a sketch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Builder {
    /// `arduino-cli`.
    Cli,
    /// Make, with the folder of the core.
    Make(Make, PathBuf),
}

/// The first that is installed with the core for AVR.
pub(crate) fn builder(at: Span) -> Result<Builder, Box<Diagnostic>> {
    let cores = cores_of_cli();
    if cores.as_ref().is_some_and(|cores| cores.contains(OWN_CORE)) {
        return Ok(Builder::Cli);
    }
    let missing = |tool: &str, what: &str| {
        Err(Box::new(e0516_tool_missing::missing_for_sketch(at, tool, what)))
    };
    let has_cli = cores.is_some();
    let Some(core) = core() else {
        return if has_cli {
            missing(
                "arduino:avr",
                "`arduino-cli core install arduino:avr` installs the Arduino core",
            )
        } else {
            missing("arduino-core-avr", "the Arduino core for AVR is not installed")
        };
    };
    if asked("avr-gcc", &["--version"]).is_none() {
        return missing("avr-gcc", "the compiler for AVR");
    }
    let Some(make) = gnu_make() else {
        return missing("make", "GNU make runs the build");
    };
    Ok(Builder::Make(make, core))
}

/// The folder of the Arduino core for AVR: the one that the variable names, or the first that there is.
pub(crate) fn core() -> Option<PathBuf> {
    let is_core = |folder: &PathBuf| folder.join("cores/arduino/Arduino.h").is_file();
    if let Some(named) = std::env::var_os("ARDUINO_CORE").filter(|value| !value.is_empty()) {
        return Some(PathBuf::from(named)).filter(is_core);
    }
    let home = std::env::var_os("HOME").or_else(|| std::env::var_os("USERPROFILE"));
    let versions =
        home.iter().flat_map(|home| OF_USER.iter().map(|place| Path::new(home).join(place)));
    let newest = versions.filter_map(|folder| {
        let entries = std::fs::read_dir(folder).ok()?;
        let mut all: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        all.sort_by(|a, b| {
            sensedsl_board::pin::natural(&a.to_string_lossy(), &b.to_string_lossy())
        });
        all.pop()
    });
    PLACES.iter().map(PathBuf::from).chain(newest).find(is_core)
}

/// What `arduino-cli` says of its cores; `None` if it is not installed.
fn cores_of_cli() -> Option<String> {
    asked(CLI, &["core", "list"])
}

/// The program that writes sketches to boards.
pub(crate) fn writer(at: Span) -> Result<&'static str, Box<Diagnostic>> {
    if cores_of_cli().is_some_and(|cores| cores.contains(OWN_CORE)) {
        return Ok(CLI);
    }
    if asked("avrdude", &["-?"]).is_none() {
        let what = "it writes programs to boards with an AVR";
        return Err(e0516_tool_missing::missing_for_sketch(at, "avrdude", what).into());
    }
    Ok("avrdude")
}

/// The command that writes a built sketch to the board at a port. A board with a USB port of its own is made ready first:
/// it starts its boot loader when the port is opened at 1200 baud and closed.
pub(crate) fn upload(
    sketch: &Sketch,
    folder: &Path,
    port: Option<&str>,
    at: Span,
) -> Result<Vec<String>, Box<Diagnostic>> {
    let port = match port {
        Some(port) => port.to_owned(),
        None => only_port(at)?,
    };
    let built = folder.join("build");
    if writer(at)? == CLI {
        let (built, folder) = (shown(&built), shown(folder));
        let words = ["arduino-cli", "upload", "--port", &port, "--fqbn", &sketch.fqbn];
        let rest = ["--input-dir", &built, &folder];
        return Ok(words.into_iter().chain(rest).map(str::to_owned).collect());
    }
    if sketch.protocol == WITH_USB {
        // Whether that worked shows when the program is written.
        drop(Port::open(&port, TOUCH_BAUD));
    }
    let hex = shown(folder.join(sketch.elf()).with_extension("hex"));
    let program = format!("flash:w:{hex}:i");
    let words = ["avrdude", "-p", &sketch.mcu, "-c", &sketch.protocol, "-P", &port];
    let rest = ["-b", &sketch.speed, "-D", "-U", &program];
    Ok(words.into_iter().chain(rest).map(str::to_owned).collect())
}

/// The only USB port that has a device.
fn only_port(at: Span) -> Result<String, Box<Diagnostic>> {
    let ports: Vec<String> = usb_ports().into_iter().map(|(name, _)| name).collect();
    match ports.as_slice() {
        [one] => Ok(one.clone()),
        [] => Err(e0518_no_probe::no_port(at).into()),
        several => Err(e0518_no_probe::several_ports(at, &several.join(", ")).into()),
    }
}

#[cfg(test)]
mod tests {
    use super::Sketch;

    #[test]
    fn a_makefile_says_whether_it_is_that_of_a_sketch() {
        let text = "# Sketch\nNAME := Rover\nMCU := atmega328p\nVARIANT := standard\n# What.\n\
                    FQBN := arduino:avr:uno\nPROTOCOL := arduino\nSPEED := 115200\n";
        let sketch = Sketch::of(text).unwrap();
        assert_eq!((sketch.fqbn.as_str(), sketch.speed.as_str()), ("arduino:avr:uno", "115200"));
        assert_eq!(sketch.elf().to_string_lossy(), "build/Rover.ino.elf");
        assert_eq!(Sketch::of("NAME := Rover\n"), None);
    }
}
