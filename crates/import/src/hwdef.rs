//! A board of `ArduPilot` (`hwdef.dat`) in; a `.sense` file with its pins, and the table of those
//! pins, out.
//!
//! A line that begins with a pin states what the pin is for: `PA9 USART1_TX USART1`,
//! `PC2 BATT ADC1`, `PD7 BARO_CS CS`. `include` reads another file, `undef` removes pins, `SPIDEV`
//! assigns chip selects to buses, and the lines of sensors name buses and addresses
//! (`BARO MS5611 I2C:0:0x77`).

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::PinName;
use sensedsl_board::signal::{Function, Signal};
use sensedsl_diagnostics::{FileId, Span};
use sensedsl_limits::{HWDEF_LINES_MAX, HWDEF_MCUS_MAX};

use crate::includes::Includes;
use crate::log::Log;
use crate::project::{self, Addressed, Project, TimerMode, Using, Wire, program};
use crate::source::{Source, Texts};

/// The first words of lines about sensors.
const SENSORS: [&str; 5] = ["IMU", "BARO", "COMPASS", "AIRSPEED", "RANGEFINDER"];

/// Imports a board.
pub(crate) fn import(source: &Source<'_>, log: &mut Log) -> Texts {
    let (file, text) = log.text(source.name, source.bytes);
    let mut reader = Reader::new(source);
    reader.file(file, &text, "", 0, log);
    let whole = Span::new(file, 0..0);
    if log.has_errors() {
        return Texts::default();
    }
    let Some(mcu) = reader.mcu.clone() else {
        log.unreadable(whole, source.name, "no line `MCU` names the MCU");
        return Texts::default();
    };
    if reader.wires.is_empty() {
        log.no_pins(whole, "no line begins with a pin");
        return Texts::default();
    }
    let addressed = reader.addressed(log);
    reader.selects();
    let path = source.name.strip_suffix("/hwdef.dat").unwrap_or(source.name);
    let stem = path.rsplit(['/', '\\']).next().and_then(|name| name.split('.').next());
    let project = Project {
        name: stem.unwrap_or_default().to_owned(),
        mcu: Some(mcu),
        mcu_span: reader.mcu_span,
        flash_bytes: reader.flash_bytes(),
        console: reader.console(),
        wires: reader.wires.into_values().collect(),
        addressed,
        ..Project::default()
    };
    program::made(&project, source, whole, log)
}

/// The input of a converter, by pin and converter.
type Inputs = BTreeMap<(PinName, u8), String>;

/// A line that does not begin with a pin.
struct Line {
    words: Vec<String>,
    span: Span,
}

struct Reader<'a> {
    source: &'a Source<'a>,
    mcu: Option<String>,
    mcu_span: Option<Span>,
    /// Everything that `MCU` lines have named so far, in this file and in the files that it
    /// includes.
    mcus: BTreeSet<String>,
    /// The I2C units, in the order of their numbers.
    orders: Vec<String>,
    wires: BTreeMap<PinName, Wire>,
    /// The lines that do not begin with a pin, by first word and number.
    lines: Lines,
    /// The number of lines so far.
    count: usize,
    /// How many more files may be included.
    includes: Includes,
    /// How many more lines may be read.
    lines_left: usize,
    /// Inputs of converters, by the prefix of their parts' names.
    inputs: BTreeMap<String, Inputs>,
}

/// Lines by their first word and number, so that removing undefined ones needs no search.
type Lines = BTreeMap<String, BTreeMap<usize, Line>>;

impl<'a> Reader<'a> {
    fn new(source: &'a Source<'a>) -> Self {
        Self {
            source,
            mcu: None,
            mcu_span: None,
            mcus: BTreeSet::new(),
            orders: Vec::new(),
            wires: BTreeMap::new(),
            lines: Lines::new(),
            count: 0,
            includes: Includes::new(),
            lines_left: HWDEF_LINES_MAX,
            inputs: BTreeMap::new(),
        }
    }

    /// Reads a file; `folder` is its folder, relative to the source.
    fn file(&mut self, file: FileId, text: &str, folder: &str, depth: usize, log: &mut Log) {
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            let Some(fewer) = self.lines_left.checked_sub(1) else {
                let span = Span::new(file, start..start);
                return log.too_large(span, self.source.name, "lines", HWDEF_LINES_MAX);
            };
            self.lines_left = fewer;
            let content = line.split('#').next().unwrap_or_default().trim_end();
            let span = Span::new(file, start..start + content.len());
            start += line.len();
            let words: Vec<String> = content.split_whitespace().map(str::to_owned).collect();
            let Some(first) = words.first() else { continue };
            let second = words.get(1).map(String::as_str);
            match (first.as_str(), second) {
                ("include", Some(path)) => self.include(path, folder, (depth, span), log),
                ("MCU", Some(family)) => {
                    let name = words.get(2).map_or(family, String::as_str).to_ascii_uppercase();
                    self.mcus.insert(name.clone());
                    // Each MCU is looked for among all parts.
                    if self.mcus.len() > HWDEF_MCUS_MAX {
                        return log.too_large(
                            span,
                            self.source.name,
                            "names of MCUs",
                            HWDEF_MCUS_MAX,
                        );
                    }
                    (self.mcu, self.mcu_span) = (Some(name), Some(span));
                }
                ("I2C_ORDER", Some(_)) => self.orders = words.into_iter().skip(1).collect(),
                ("undef", Some(_)) => self.undefine(&words),
                _ => match PinName::parse(first).filter(|pin| pin.port().is_some()) {
                    Some(pin) => self.pin(pin, &words, span, log),
                    None => {
                        self.count += 1;
                        let same = self.lines.entry(first.clone()).or_default();
                        same.insert(self.count, Line { words, span });
                    }
                },
            }
        }
    }

    fn include(&mut self, path: &str, folder: &str, (depth, span): (usize, Span), log: &mut Log) {
        let path = if folder.is_empty() { path.to_owned() } else { format!("{folder}/{path}") };
        let read = self.includes.read(self.source, &path, (depth, span), log);
        let Some((file, text)) = read else { return };
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder).to_owned();
        self.file(file, &text, &folder, depth + 1, log);
    }

    fn undefine(&mut self, words: &[String]) {
        for word in words.iter().skip(1) {
            if let Some(pin) = PinName::parse(word) {
                self.wires.remove(&pin);
            }
            self.lines.remove(word);
        }
    }

    fn pin(&mut self, pin: PinName, words: &[String], span: Span, log: &mut Log) {
        let word = |at: usize| words.get(at).map(String::as_str).unwrap_or_default();
        let (label, type_of) = (word(1), word(2));
        let has = |wanted: &str| words.iter().skip(2).any(|word| word == wanted);
        if type_of.is_empty() {
            log.dropped(span, "", &format!("the line of {pin} does not say what it is for"));
            return;
        }
        if words.iter().skip(3).any(|word| word.starts_with("ALT(") && word != "ALT(0)") {
            let what = format!("{pin} in another configuration of the board is left out");
            log.dropped(span, "", &what);
            return;
        }
        let pull = if has("PULLUP") {
            Some("up")
        } else if has("PULLDOWN") {
            Some("down")
        } else {
            None
        };
        let timer = matches!(Signal::parse(label).0.function(), Function::Timer { .. });
        let using = match type_of {
            "INPUT" => Using::Input,
            "OUTPUT" => Using::Output(has("HIGH")),
            "CS" => Using::Select(None),
            _ if type_of.starts_with("ADC") => match self.converter_input(&pin, type_of) {
                Some(signal) => Using::Signal(signal),
                None => {
                    let what = format!("which input of {type_of} {pin} is, no built-in table says");
                    log.dropped(span, "", &what);
                    Using::Signal(label.to_owned())
                }
            },
            _ if timer => {
                let mode = if has("RCININT") || has("RCIN") {
                    TimerMode::Capture
                } else if words.iter().any(|word| word.starts_with("PWM(")) || has("ALARM") {
                    TimerMode::Output
                } else {
                    TimerMode::Unknown
                };
                Using::Timer(label.to_owned(), mode)
            }
            _ => Using::Signal(label.to_owned()),
        };
        // A device cannot have the name of a signal.
        let label = (using.signal() != Some(label)).then(|| label.to_owned());
        if self.wires.contains_key(&pin) {
            log.doubtful(span, "", &format!("{pin} is defined again; the last line counts"));
        }
        self.wires.insert(pin.clone(), Wire { pin, label, using, pull, span });
    }

    /// The converter input on a pin, in the parts of the MCU's line or else of its family.
    fn converter_input(&mut self, pin: &PinName, unit: &str) -> Option<String> {
        const FAMILY: usize = "STM32F4".len();
        let unit: u8 = unit.strip_prefix("ADC")?.parse().ok()?;
        let mcu = self.mcu.clone()?;
        // The name of a line contains letters that stand for any: STM32F405xx.
        let line = mcu.trim_end_matches(['x', 'X']);
        let key = (pin.clone(), unit);
        [line, mcu.get(..FAMILY)?].into_iter().find_map(|start| {
            if !self.inputs.contains_key(start) {
                self.inputs.insert(start.to_owned(), inputs(start));
            }
            self.inputs.get(start)?.get(&key).cloned()
        })
    }

    /// The sensors on an I2C bus with a known address.
    fn addressed(&self, log: &mut Log) -> Vec<Addressed> {
        let mut found = Vec::new();
        for Line { words, span } in self.lines_of(&SENSORS) {
            let [kind, name, rest @ ..] = words.as_slice() else { continue };
            for place in rest.iter().filter_map(|word| word.strip_prefix("I2C:")) {
                let (bus, address) = place.split_once(':').unwrap_or((place, ""));
                let unit = bus.parse().ok().and_then(|bus: usize| self.orders.get(bus));
                let digits = address.trim_start_matches("0x").trim_start_matches("0X");
                let address = u8::from_str_radix(digits, 16).ok().filter(|a| (1..0x80).contains(a));
                match (unit, address) {
                    (Some(unit), Some(address)) => {
                        let (name, unit) = (name.clone(), unit.clone());
                        found.push(Addressed { name, unit, address, span: *span });
                    }
                    _ => {
                        let what = format!(
                            "{kind} {name} is left out: `{place}` is not a bus with an address"
                        );
                        log.dropped(*span, "", &what);
                    }
                }
            }
        }
        found
    }

    /// Assigns chip selects to buses, as stated by `SPIDEV name SPI1 DEVID1 NAME_CS …`.
    fn selects(&mut self) {
        let mut by_label: BTreeMap<String, PinName> = BTreeMap::new();
        for wire in self.wires.values() {
            if let Some(label) = &wire.label {
                by_label.entry(label.clone()).or_insert_with(|| wire.pin.clone());
            }
        }
        let lines = self.lines.remove("SPIDEV").unwrap_or_default();
        for Line { words, .. } in lines.values() {
            let [_, name, unit, _, select, ..] = words.as_slice() else { continue };
            let Some(pin) = by_label.get(select).cloned() else { continue };
            if let Some(wire) = self.wires.get_mut(&pin)
                && matches!(wire.using, Using::Select(_))
            {
                wire.using = Using::Select(Some(unit.clone()));
                wire.label = Some(name.clone());
                by_label.remove(select);
                by_label.entry(name.clone()).or_insert(pin);
            }
        }
    }

    /// The value of the last line that begins with the word.
    fn last(&self, word: &str) -> Option<&str> {
        let (_, line) = self.lines.get(word)?.last_key_value()?;
        line.words.get(1).map(String::as_str)
    }

    /// The flash, as stated by `FLASH_SIZE_KB 1024`.
    fn flash_bytes(&self) -> Option<usize> {
        self.last("FLASH_SIZE_KB")?.parse::<usize>().ok()?.checked_mul(1024)
    }

    /// The serial port of `STDOUT_SERIAL SD1`, of which the pins have the whole name.
    fn console(&self) -> Option<String> {
        let number = self.last("STDOUT_SERIAL")?.strip_prefix("SD")?;
        let is_port = |unit: &String| matches!(unit.strip_suffix(number), Some("USART" | "UART"));
        let mut units =
            self.wires.values().filter_map(|wire| project::chip::unit_of(wire.using.signal()?));
        units.find(is_port)
    }

    /// The lines that begin with one of these words, in file order.
    fn lines_of(&self, words: &[&str]) -> impl Iterator<Item = &Line> {
        let lines = words.iter().filter_map(|word| self.lines.get(*word));
        lines.flatten().collect::<BTreeMap<_, _>>().into_values()
    }
}

/// The converter inputs of all parts whose names begin with `start`; if several parts differ, the
/// first one counts.
fn inputs(start: &str) -> Inputs {
    let mut inputs = Inputs::new();
    for part in sensedsl_parts::all().filter(|part| part.base().starts_with(start)) {
        let sheet = sensedsl_parts::Sheet::of(part);
        for (pin, _, usages) in sheet.pins() {
            for (spelled, _) in usages.iter().filter(|(spelled, _)| spelled.contains("ADC")) {
                let (signal, _) = Signal::parse(spelled);
                let Function::Adc { units, channel } = signal.function() else { continue };
                for unit in units {
                    let input = inputs.entry((pin.clone(), *unit));
                    input.or_insert_with(|| format!("ADC{unit}_IN{channel}"));
                }
            }
        }
    }
    inputs
}
