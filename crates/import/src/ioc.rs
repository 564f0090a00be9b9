//! A project of CubeMX (`.ioc`) in; a `.sense` file with its pins, and the table of those pins,
//! out.
//!
//! The file is a list of `key=value` lines. `PA5.Signal` states what a pin is used for; for a
//! signal that several modes share (`S_TIM3_CH1`, `ADCx_IN1`), a line `SH.<signal>.0` does.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use sensedsl_board::pin::PinName;
use sensedsl_board::signal::{Function, Signal};
use sensedsl_diagnostics::{FileId, Span};

use crate::cubemx::largest;
use crate::log::Log;
use crate::project::{Project, TimerMode, Using, Wire, program};
use crate::source::{Source, Texts};

/// Imports a project.
pub(crate) fn import(source: &Source<'_>, log: &mut Log) -> Texts {
    let (file, text) = log.text(source.name, source.bytes);
    let values = values(&text);
    let whole = Span::new(file, 0..0);
    let value = |key: &str| values.get(key).map(|value| value.text.as_str());
    let Some(mcu) = value("Mcu.UserName").or(value("Mcu.Name")).filter(|mcu| !mcu.is_empty())
    else {
        if !log.has_errors() {
            log.unreadable(whole, source.name, "it names no MCU (`Mcu.Name`)");
        }
        return Texts::default();
    };
    let reader = Reader { file, values: &values };
    let wires = reader.wires(log);
    if wires.is_empty() {
        log.no_pins(whole, "no pin of the project has a signal");
        return Texts::default();
    }
    let name = value("ProjectManager.ProjectName").or(value("board"));
    let stem = source.name.rsplit(['/', '\\']).next().and_then(|name| name.split('.').next());
    let project = Project {
        name: name.or(stem).unwrap_or_default().to_owned(),
        mcu: Some(largest(mcu)),
        wires,
        bauds: reader.bauds(),
        usb_host: reader.is_usb_host(),
        ..Project::default()
    };
    program::made(&project, source, whole, log)
}

/// A value and the place of its line.
struct Value {
    text: String,
    line: std::ops::Range<usize>,
}

type Values = BTreeMap<String, Value>;

fn values(text: &str) -> Values {
    let mut values = Values::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let content = line.trim_end_matches(['\n', '\r']);
        let range = start..start + content.len();
        start += line.len();
        if content.starts_with(['#', '!']) {
            continue;
        }
        if let Some((key, value)) = content.split_once('=') {
            let value = Value { text: plain(value), line: range };
            values.insert(plain(key), value);
        }
    }
    values
}

/// A text without the backslashes that escape special characters in such files.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    let mut chars = text.trim().chars();
    while let Some(c) = chars.next() {
        let next = if c == '\\' { chars.next() } else { Some(c) };
        plain.push(next.unwrap_or(c));
    }
    plain
}

struct Reader<'a> {
    file: FileId,
    values: &'a Values,
}

impl Reader<'_> {
    fn value(&self, key: &str) -> Option<&str> {
        self.values.get(key).map(|value| value.text.as_str())
    }

    /// The pins that have a signal, in natural order.
    fn wires(&self, log: &mut Log) -> Vec<Wire> {
        let mut wires: BTreeMap<PinName, Wire> = BTreeMap::new();
        let mut others: Vec<(&str, Span)> = Vec::new();
        for (key, value) in self.values {
            let Some(spelled) = key.strip_suffix(".Signal") else { continue };
            let span = Span::new(self.file, value.line.clone());
            // Virtual pins stand for peripherals without a pad.
            if spelled.starts_with("VP_") {
                continue;
            }
            let Some(pin) = PinName::parse(spelled).filter(|pin| pin.port().is_some()) else {
                others.push((spelled, span));
                continue;
            };
            let wire = self.wire(spelled, pin.clone(), &value.text, span, log);
            match wires.entry(pin) {
                Entry::Vacant(free) => {
                    free.insert(wire);
                }
                Entry::Occupied(first) => {
                    let what = format!("{} is used twice; the first use counts", first.key());
                    log.doubtful(span, "", &what);
                }
            }
        }
        if let Some((_, first)) = others.first() {
            let names: Vec<&str> = others.iter().map(|(name, _)| *name).collect();
            let what = format!("no pins of a port, left out: {}", names.join(", "));
            log.dropped(*first, "", &what);
        }
        wires.into_values().collect()
    }

    fn wire(&self, spelled: &str, pin: PinName, signal: &str, span: Span, log: &mut Log) -> Wire {
        let of_pin = |key: &str| self.value(&format!("{spelled}.{key}"));
        let pull = of_pin("GPIO_PuPd").or(of_pin("GPIO_Pu")).and_then(|pull| match pull {
            "GPIO_PULLUP" => Some("up"),
            "GPIO_PULLDOWN" => Some("down"),
            _ => None,
        });
        let using = match signal {
            "GPIO_Input" => Using::Input,
            "GPIO_Output" => Using::Output(of_pin("PinState") == Some("GPIO_PIN_SET")),
            _ if signal.starts_with("GPXTI") => {
                let mode = of_pin("GPIO_ModeDefaultEXTI").unwrap_or("GPIO_MODE_IT_RISING");
                Using::Interrupt(match mode.rsplit("GPIO_MODE_").next().unwrap_or_default() {
                    "IT_FALLING" | "EVT_FALLING" => "falling",
                    "IT_RISING_FALLING" | "EVT_RISING_FALLING" => "both",
                    _ => "rising",
                })
            }
            _ => self.signal(spelled, signal, span, log),
        };
        let label = of_pin("GPIO_Label").filter(|label| !label.is_empty()).map(str::to_owned);
        Wire { pin, label, using, pull, span }
    }

    /// What a peripheral's signal is used for.
    fn signal(&self, spelled: &str, signal: &str, span: Span, log: &mut Log) -> Using {
        let shared: Vec<&str> =
            (0..8).map_while(|at| self.value(&format!("SH.{signal}.{at}"))).collect();
        let parts = |shared: &&str| {
            let (name, mode) = shared.split_once(',').unwrap_or((shared, ""));
            (name.to_owned(), mode.to_owned())
        };
        let (name, mode) = match shared.first() {
            Some(first) => parts(first),
            None => {
                let mode = self.value(&format!("{spelled}.Mode")).unwrap_or_default();
                (signal.strip_prefix("S_").unwrap_or(signal).to_owned(), mode.to_owned())
            }
        };
        if let Some(second) = shared.get(1).map(parts).filter(|second| second.0 != name) {
            let what = format!("{spelled} is {name} and {}; {name} is imported", second.0);
            log.doubtful(span, "", &what);
        }
        let name = name.split_whitespace().collect::<Vec<_>>().join("_").replace('@', "_");
        let timer = matches!(Signal::parse(&name).0.function(), Function::Timer { .. });
        if !timer {
            return Using::Signal(name);
        }
        let has = |word: &str| mode.to_ascii_lowercase().contains(word);
        let mode = if has("encoder") {
            TimerMode::Encoder
        } else if has("input") {
            TimerMode::Capture
        } else if has("pwm") || has("output") {
            TimerMode::Output
        } else {
            TimerMode::Unknown
        };
        Using::Timer(name, mode)
    }

    /// Whether a USB unit is a host: `USB_OTG_FS.VirtualMode=Host_Only`.
    fn is_usb_host(&self) -> bool {
        let is_usb = |key: &str| key.starts_with("USB") && key.ends_with(".VirtualMode");
        let is_host = |value: &Value| value.text.to_ascii_lowercase().contains("host");
        self.values.iter().any(|(key, value)| is_usb(key) && is_host(value))
    }

    /// The baud rates: `USART2.BaudRate=115200`.
    fn bauds(&self) -> BTreeMap<String, u32> {
        let baud = |(key, value): (&String, &Value)| {
            let unit = key.strip_suffix(".BaudRate")?;
            Some((unit.to_owned(), value.text.parse().ok()?))
        };
        self.values.iter().filter_map(baud).collect()
    }
}
