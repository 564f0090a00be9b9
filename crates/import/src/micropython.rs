//! A board of `MicroPython` in: `pins.csv`, which names pins, and `mpconfigboard.h` beside it, which
//! says what is on them; a `.sense` file and the table of the MCU's pins out.
//!
//! The pins are those that the board brings out. Its LEDs and its button become devices; buses that
//! the header names are what a program finds there by default, and stay free.

use std::collections::BTreeMap;

use sensedsl_board::pin::PinName;
use sensedsl_diagnostics::{FileId, Span};
use sensedsl_model::ReadError;

use crate::log::Log;
use crate::project::pads::{Define, Wires, defines, lines, pad};
use crate::project::{Project, Using, Wire, chip, program};
use crate::source::{Source, Texts};
use crate::tabular::has_head;

/// The prefix of all names that say what is on a board.
const PREFIX: &str = "MICROPY_HW_";
/// The greatest number of LEDs that the header names.
const LEDS_MAX: usize = 8;

/// Whether a text is a list of labels and pins, `LED_RED,PA13`, and not a table with a head.
pub(crate) fn is_list(text: &str) -> bool {
    let rows = text.lines().map(str::trim).filter(|line| is_row(line)).take(8);
    let (named, others): (Vec<&str>, Vec<&str>) =
        rows.partition(|line| row(line).is_some_and(|(_, pin)| is_named(pin)));
    named.len() > others.len() && (others.is_empty() || !has_head(text))
}

/// Imports a board.
pub(crate) fn import(source: &Source<'_>, log: &mut Log) -> Texts {
    let (file, text) = log.text(source.name, source.bytes);
    let whole = Span::new(file, 0..0);
    let labels = labels(file, &text, log);
    if log.has_errors() {
        return Texts::default();
    }
    if labels.is_empty() {
        log.no_pins(whole, "no line has a label and a pin");
        return Texts::default();
    }
    let board = Board::read(source, whole, log);
    let names = labels.iter().map(|(pin, (label, _))| (pin.clone(), label.clone())).collect();
    let project = Project {
        name: board.name.clone().unwrap_or_else(|| folder(source.name).to_owned()),
        mcu: board.mcu(&labels),
        wires: board.wires(&labels, log).into_vec(),
        console: board.console.clone(),
        usb_device: board.is_on("ENABLE_USB"),
        labels: names,
        is_list: true,
        ..Project::default()
    };
    program::made(&project, source, whole, log)
}

/// What is printed beside a pin, and its place.
type Labels = BTreeMap<PinName, (String, Span)>;

fn is_row(line: &str) -> bool {
    !line.is_empty() && !line.starts_with('#')
}

/// The label and the pin of a line. A hyphen hides a name from programs.
fn row(line: &str) -> Option<(&str, &str)> {
    let (label, pin) = line.split_once(',')?;
    let bare = |cell: &'_ str| -> bool { !cell.contains([',', ';', '"']) };
    (bare(label) && bare(pin)).then_some((shown(label), shown(pin)))
}

fn shown(cell: &str) -> &str {
    cell.trim().trim_start_matches('-').trim()
}

/// Whether a cell names a pin, or what the board has in place of one (`EXT_GPIO0`).
fn is_named(pin: &str) -> bool {
    pad(pin).is_some() || pin.contains("GPIO")
}

fn labels(file: FileId, text: &str, log: &mut Log) -> Labels {
    let mut labels = Labels::new();
    for (line, start) in lines(text).filter(|(line, _)| is_row(line.trim())) {
        let span = Span::new(file, start..start + line.len());
        let named = row(line).and_then(|(label, pin)| Some((label, pad(pin)?)));
        let Some((label, pin)) = named else {
            let what = format!("`{}` is not a label and a pin of the MCU", line.trim());
            log.dropped(span, "", &what);
            continue;
        };
        let says_more = !label.is_empty() && pad(label).as_ref() != Some(&pin);
        let entry = labels.entry(pin).or_insert_with(|| (String::new(), span));
        if says_more && (entry.0.is_empty() || is_light(label)) {
            *entry = (label.to_owned(), span);
        }
    }
    labels
}

/// Whether a label is that of an LED.
fn is_light(label: &str) -> bool {
    label.to_ascii_uppercase().starts_with("LED")
}

/// The folder of a file, which has the board's name.
fn folder(path: &str) -> &str {
    let mut parts = path.rsplit(['/', '\\']);
    let stem = parts.next().and_then(|name| name.split('.').next());
    parts.next().filter(|name| !name.is_empty()).or(stem).unwrap_or_default()
}

/// What the files beside the list say.
#[derive(Default)]
struct Board {
    name: Option<String>,
    header: BTreeMap<String, Define>,
    /// The text of the build files.
    build: String,
    console: Option<String>,
}

impl Board {
    fn read(source: &Source<'_>, whole: Span, log: &mut Log) -> Self {
        let mut board = Self::default();
        for path in ["mpconfigboard.h", "mpconfigboard.mk", "mpconfigboard.cmake"] {
            let bytes = match (source.beside)(path) {
                Ok(bytes) => bytes,
                Err(ReadError::Missing) => continue,
                Err(unread) => {
                    log.refused(whole, path, &unread);
                    continue;
                }
            };
            let (file, text) = log.text(path, &bytes);
            if path.ends_with(".h") {
                let of_board = defines(file, &text)
                    .into_iter()
                    .filter_map(|one| Some((one.name.strip_prefix(PREFIX)?.to_owned(), one)));
                board.header.extend(of_board);
            } else {
                board.build.push_str(&text);
            }
        }
        if board.header.is_empty() {
            let what = "`mpconfigboard.h` is not beside the file: the MCU, LEDs and the link to a \
                        host are missing";
            log.dropped(whole, "", what);
        }
        board.name = board.value("BOARD_NAME").map(|name| name.trim_matches('"').to_owned());
        board.console = board.repl();
        board
    }

    fn value(&self, name: &str) -> Option<&str> {
        self.header.get(name).map(|one| one.value.as_str()).filter(|value| !value.is_empty())
    }

    fn is_on(&self, name: &str) -> bool {
        self.value(name) == Some("1")
    }

    /// The MCU: by its name in the header, by the headers of the build, or by its pins.
    fn mcu(&self, labels: &Labels) -> Option<String> {
        if let Some(name) = self.value("MCU_NAME") {
            return Some(name.trim_matches('"').to_owned());
        }
        let lines = || self.build.lines().map(str::trim).filter(|line| !line.starts_with('#'));
        let stated = lines().find_map(|line| {
            let (key, value) = line.split_once('=')?;
            (key.trim() == "CMSIS_MCU").then(|| value.trim().to_owned())
        });
        let is_rp = labels.keys().any(|pin| pin.as_str().starts_with("GP"));
        let by_pins = || {
            let says = |word: &str| lines().any(|line| line.to_ascii_lowercase().contains(word));
            let is_second = says("rp2350") || says("pico2") || says("pico_platform rp2350");
            let wide = says("pico_num_gpios 48");
            Some(
                if wide {
                    "RP2350B"
                } else if is_second {
                    "RP2350A"
                } else {
                    "RP2040"
                }
                .to_owned(),
            )
        };
        stated.or_else(|| by_pins().filter(|_| is_rp))
    }

    /// The serial port of the prompt: `PYB_UART_2` is USART2 or UART2.
    fn repl(&self) -> Option<String> {
        let number = self.value("UART_REPL")?.strip_prefix("PYB_UART_")?;
        let sheet = chip::widest(self.value("MCU_NAME")?.trim_matches('"'))?;
        let tx = pad(self.value(&format!("UART{number}_TX"))?)?;
        let (_, usages) = sheet.pin(&tx)?;
        let ends = [format!("USART{number}"), format!("UART{number}")];
        let has = |unit: &String| usages.iter().any(|(usage, _)| *usage == format!("{unit}_TX"));
        ends.into_iter().find(has)
    }

    /// The uses of pins that are certain.
    fn wires(&self, labels: &Labels, log: &mut Log) -> Wires {
        let mut wires = Wires::default();
        let label = |pin: &PinName| {
            labels.get(pin).map(|(label, _)| label.clone()).filter(|label| !label.is_empty())
        };
        let mut add = |key: &str, using: Using, pull, name: &str, log: &mut Log| {
            let Some(define) = self.header.get(key) else { return };
            let Some(pin) = pad(&define.value) else { return };
            let label = label(&pin).filter(|_| using.signal().is_none());
            let label = label.or_else(|| (!name.is_empty()).then(|| name.to_owned()));
            wires.add(Wire { pin, label, using, pull, span: define.span }, log);
        };
        for at in 1..=LEDS_MAX {
            add(&format!("LED{at}"), Using::Output(false), None, &format!("LED{at}"), log);
        }
        let edge = match self.value("USRSW_EXTI_MODE") {
            Some("GPIO_MODE_IT_RISING") => "rising",
            Some("GPIO_MODE_IT_RISING_FALLING") => "both",
            Some(_) | None => "falling",
        };
        let pull = match self.value("USRSW_PULL") {
            Some("GPIO_PULLUP") => Some("up"),
            Some("GPIO_PULLDOWN") => Some("down"),
            Some(_) | None => None,
        };
        add("USRSW_PIN", Using::Interrupt(edge), pull, "SW", log);
        if let Some(unit) = &self.console {
            let number = unit.trim_start_matches(|c: char| c.is_ascii_alphabetic());
            for end in ["TX", "RX"] {
                let signal = Using::Signal(format!("{unit}_{end}"));
                add(&format!("UART{number}_{end}"), signal, None, "", log);
            }
        }
        let is_rp = |pin: &PinName| pin.as_str().starts_with("GP");
        for (pin, (name, span)) in labels {
            let using = if self.is_on("ENABLE_SDCARD") && name.starts_with("SD_") {
                Using::Signal("SDIO".into())
            } else if is_rp(pin) && is_light(name) {
                Using::Output(false)
            } else {
                continue;
            };
            if !wires.has(pin) {
                let label = Some(name.clone());
                wires.add(Wire { pin: pin.clone(), label, using, pull: None, span: *span }, log);
            }
        }
        wires
    }
}
