//! A variant of an Arduino core in. `PeripheralPins.c` has the usages of an STM32's pins, which is a
//! board table; `variant_*.h` and `pins_arduino.h` say what is on a board, which is a `.sense` file
//! and the table of the MCU's pins.

mod pin_maps;

use std::collections::BTreeMap;

use sensedsl_board::catalog;
use sensedsl_board::pin::PinName;
use sensedsl_diagnostics::Span;

use crate::log::Log;
use crate::project::pads::{Define, Wires, defines, pad};
use crate::project::{Project, Using, Wire, chip, program};
use crate::source::{Source, Texts};

/// The number of names that may stand for each other: `LED_BUILTIN` for `LED_GREEN` for `PA5`.
const ALIASES_MAX: usize = 8;
/// The text that each header of a variant has.
const HEADER_WORDS: [&str; 4] = ["NUM_DIGITAL_PINS", "PINS_COUNT", "LED_BUILTIN", "PIN_WIRE0_SDA"];

/// Whether a text belongs to a variant.
pub(crate) fn is_variant(text: &str) -> bool {
    let defined = |line: &str| {
        let name = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("define")?;
        name.split_whitespace().next().filter(|name| HEADER_WORDS.contains(name))?;
        Some(())
    };
    pin_maps::are_in(text) || text.lines().any(|line| defined(line).is_some())
}

/// Imports a file of a variant.
pub(crate) fn import(source: &Source<'_>, log: &mut Log) -> Texts {
    let (file, text) = log.text(source.name, source.bytes);
    let whole = Span::new(file, 0..0);
    if log.has_errors() {
        return Texts::default();
    }
    if pin_maps::are_in(&text) {
        return pin_maps::import(file, &text, log);
    }
    let variant = Variant::new(defines(file, &text), &text);
    let labels = variant.labels();
    let mcu = variant.mcu(source);
    let console = variant.console(mcu.as_deref());
    let wires = variant.wires(console.as_deref(), log);
    if wires.is_empty() && labels.is_empty() {
        log.no_pins(whole, "no `#define` names a pin such as `PA5`");
        return Texts::default();
    }
    let project = Project {
        name: board(source.name).to_owned(),
        mcu,
        wires: wires.into_vec(),
        console,
        is_list: true,
        labels,
        ..Project::default()
    };
    program::made(&project, source, whole, log)
}

/// The name of a board: `variant_NUCLEO_F446RE.h`, or the folder of `pins_arduino.h`.
fn board(path: &str) -> &str {
    let mut parts = path.rsplit(['/', '\\']);
    let stem = parts.next().and_then(|name| name.split('.').next()).unwrap_or_default();
    match stem.strip_prefix("variant_") {
        Some(board) => board,
        None => parts.next().filter(|_| stem == "pins_arduino").unwrap_or(stem),
    }
}

/// The names of a header.
struct Variant {
    defines: BTreeMap<String, Define>,
    /// Whether pins are numbers of an RP chip, and not of the board.
    is_rp: bool,
    is_second: bool,
}

impl Variant {
    fn new(all: Vec<Define>, text: &str) -> Self {
        let mut defines = BTreeMap::new();
        for one in all {
            // The first value is the board's; those behind it are for other cases.
            defines.entry(one.name.clone()).or_insert(one);
        }
        let is_rp = defines.contains_key("PIN_WIRE0_SDA");
        let is_second = text.contains("RP2350") || text.contains("rp2350");
        Self { defines, is_rp, is_second }
    }

    fn value(&self, name: &str) -> Option<&str> {
        self.defines.get(name).map(|one| one.value.as_str())
    }

    /// The pin that a name stands for.
    fn pin(&self, name: &str) -> Option<PinName> {
        let mut name = name;
        for _ in 0..ALIASES_MAX {
            let value = self.value(name)?;
            let number = value.trim_end_matches(['u', 'U']);
            let found = if self.is_rp { pad(&format!("GP{number}")) } else { pad(value) };
            if found.is_some() {
                return found;
            }
            name = value;
        }
        None
    }

    /// The MCU: of an RP chip, of the board of that name, or of the file with its usages.
    fn mcu(&self, source: &Source<'_>) -> Option<String> {
        if self.is_rp {
            return Some(if self.is_second { "RP2350A" } else { "RP2040" }.to_owned());
        }
        let of_board = catalog::find(&board(source.name).replace('_', "-"));
        let beside = || {
            let bytes = (source.beside)("PeripheralPins.c").ok()?;
            pin_maps::mcu(&crate::decode::decode(&bytes)?.text)
        };
        of_board.map(|entry| entry.mcu.to_owned()).or_else(beside)
    }

    /// What is printed beside pins: `#define PA10 2` is D2, `#define PA0 PIN_A0` is A0.
    fn labels(&self) -> BTreeMap<PinName, String> {
        let label = |value: &str| {
            let analog = value.strip_prefix("PIN_A").or_else(|| value.strip_prefix('A'));
            let is_number = |text: &str| text.parse::<u8>().is_ok();
            match analog {
                Some(number) if is_number(number) => Some(format!("A{number}")),
                _ => is_number(value).then(|| format!("D{value}")),
            }
        };
        let labelled = self.defines.values().filter_map(|one| {
            Some((pad(&one.name).filter(|pin| pin.port().is_some())?, label(&one.value)?))
        });
        labelled.collect()
    }

    /// The serial port that is the console: `SERIAL_UART_INSTANCE 2` is USART2 or UART2.
    fn console(&self, mcu: Option<&str>) -> Option<String> {
        let number = self.value("SERIAL_UART_INSTANCE")?.trim_start_matches("SERIAL_UART");
        let sheet = chip::widest(mcu?)?;
        let (_, usages) = sheet.pin(&self.pin("PIN_SERIAL_TX")?)?;
        let has = |unit: &String| usages.iter().any(|(usage, _)| *usage == format!("{unit}_TX"));
        let number = number.trim();
        if number == "101" {
            return Some("LPUART1".to_owned());
        }
        ["USART", "UART"].map(|stem| format!("{stem}{number}")).into_iter().find(has)
    }

    /// LEDs, the button, and the console.
    fn wires(&self, console: Option<&str>, log: &mut Log) -> Wires {
        let mut wires = Wires::default();
        let mut add = |name: &str, using: Using, log: &mut Log| {
            let Some((pin, one)) = self.pin(name).zip(self.defines.get(name)) else { return };
            if wires.has(&pin) {
                return;
            }
            let label = using.signal().is_none().then(|| name.to_owned());
            wires.add(Wire { pin, label, using, pull: None, span: one.span }, log);
        };
        if let Some(unit) = console {
            add("PIN_SERIAL_TX", Using::Signal(format!("{unit}_TX")), log);
            add("PIN_SERIAL_RX", Using::Signal(format!("{unit}_RX")), log);
        }
        for name in self.defines.keys() {
            if name == "USER_BTN" || name == "BTN_BUILTIN" {
                add(name, Using::Input, log);
            } else if name.starts_with("LED") || name == "PIN_LED" {
                add(name, Using::Output(false), log);
            }
        }
        wires
    }
}
