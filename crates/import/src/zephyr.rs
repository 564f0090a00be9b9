//! A board or an overlay of Zephyr in, as the source of a device tree; a `.sense` file and the table
//! of the MCU's pins out.
//!
//! `pinctrl-0 = <&usart1_tx_pa9 &usart1_rx_pa10>` says what pins of an STM32 are for, `pinmux` of a
//! pin group does for an RP chip. Nodes of `gpio-leds` and `gpio-keys` are devices, and so are those
//! on I2C and SPI buses.

mod tree;

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::catalog;
use sensedsl_board::pin::PinName;
use sensedsl_board::signal::{Function, Signal};
use sensedsl_diagnostics::{FileId, Span};

use self::tree::{Node, NodeIndex, Tree};
use crate::cubemx::largest;
use crate::includes::Includes;
use crate::log::Log;
use crate::project::pads::{Wires, pad};
use crate::project::{Addressed, Project, TimerMode, Using, Wire, program};
use crate::source::{Source, Texts};

/// Whether a text is a device tree.
pub(crate) fn is_tree(text: &str) -> bool {
    let is_reference = |line: &str| {
        let name = line.strip_prefix('&').and_then(|rest| rest.split_once('{'));
        name.is_some_and(|(name, _)| {
            let name = name.trim();
            !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        })
    };
    let is_root = |line: &str| matches!(line, "/dts-v1/;" | "/ {" | "/{");
    text.lines().map(str::trim).any(|line| is_root(line) || is_reference(line))
}

/// Imports a board.
pub(crate) fn import(source: &Source<'_>, log: &mut Log) -> Texts {
    let (file, text) = log.text(source.name, source.bytes);
    let whole = Span::new(file, 0..0);
    let mut reader = Reader::new(source);
    reader.file(file, &text, "", 0, log);
    if log.has_errors() {
        return Texts::default();
    }
    reader.nodes(log);
    if reader.wires.is_empty() {
        log.no_pins(whole, "no node of the tree that is in use names a pin");
        return Texts::default();
    }
    let stem = source.name.rsplit(['/', '\\']).next().and_then(|name| name.split('.').next());
    let stem = stem.unwrap_or_default();
    let of_board = || catalog::find(&stem.replace('_', "-")).map(|entry| entry.mcu.to_owned());
    let wires = reader.wires.into_vec();
    let project = Project {
        name: stem.to_owned(),
        mcu: reader.mcu.clone().or_else(of_board),
        mcu_span: reader.mcu_span,
        wires,
        bauds: reader.bauds,
        addressed: reader.addressed,
        console: reader.console,
        usb_device: reader.usb_device,
        ..Project::default()
    };
    program::made(&project, source, whole, log)
}

struct Reader<'a> {
    source: &'a Source<'a>,
    tree: Tree,
    includes: Includes,
    /// Files that were looked for already.
    included: BTreeSet<String>,
    mcu: Option<String>,
    mcu_span: Option<Span>,
    wires: Wires,
    bauds: BTreeMap<String, u32>,
    addressed: Vec<Addressed>,
    console: Option<String>,
    usb_device: bool,
    /// The groups of pins that were read.
    groups: BTreeSet<NodeIndex>,
}

impl<'a> Reader<'a> {
    fn new(source: &'a Source<'a>) -> Self {
        Self {
            source,
            tree: Tree::default(),
            includes: Includes::new(),
            included: BTreeSet::new(),
            mcu: None,
            mcu_span: None,
            wires: Wires::default(),
            bauds: BTreeMap::new(),
            addressed: Vec::new(),
            console: None,
            usb_device: false,
            groups: BTreeSet::new(),
        }
    }

    /// Reads a file; those that it includes by a name in quotes come before it.
    fn file(&mut self, file: FileId, text: &str, folder: &str, depth: usize, log: &mut Log) {
        let mut first = Tree::default();
        for (name, is_quoted, span) in first.read(file, text) {
            if is_quoted {
                self.include(&name, folder, (depth, span), log);
            } else if let Some(mcu) = mcu_of(&name) {
                // The file of the package's pins says more than that of the line.
                let says_more = self.mcu.as_ref().is_none_or(|known| known.len() <= mcu.len());
                if says_more || name.ends_with("-pinctrl.dtsi") {
                    (self.mcu, self.mcu_span) = (Some(mcu), Some(span));
                }
            }
        }
        drop(self.tree.read(file, text));
    }

    fn include(&mut self, name: &str, folder: &str, (depth, span): (usize, Span), log: &mut Log) {
        let path = if folder.is_empty() { name.to_owned() } else { format!("{folder}/{name}") };
        if !self.included.insert(path.clone()) {
            return;
        }
        let read = self.includes.read(self.source, &path, (depth, span), log);
        let Some((file, text)) = read else { return };
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder).to_owned();
        self.file(file, &text, &folder, depth + 1, log);
    }

    /// Reads the nodes that are in use.
    fn nodes(&mut self, log: &mut Log) {
        let tree = std::mem::take(&mut self.tree);
        for node in tree.in_use() {
            if let Some((value, span)) = node.placed("pinctrl-0") {
                for name in references(value) {
                    self.pins(&tree, name, span, log);
                }
            }
            match node.value("compatible") {
                Some(kind) if kind.contains("gpio-leds") => self.parts(&tree, node, true, log),
                Some(kind) if kind.contains("gpio-keys") => self.parts(&tree, node, false, log),
                Some(_) | None => {}
            }
            if let Some(unit) = node.head.strip_prefix('&').map(str::to_ascii_uppercase) {
                self.unit(&tree, node, &unit, log);
            }
            if let Some(console) = node.value("zephyr,console") {
                self.usb_device |= console.contains("cdc_acm");
                self.console = references(console).next().map(str::to_ascii_uppercase);
            }
        }
    }

    /// The pins of a state: `usart1_tx_pa9`, or a group with `pinmux`.
    fn pins(&mut self, tree: &Tree, name: &str, span: Span, log: &mut Log) {
        if let Some((signal, pin)) = routed(name) {
            return self.signal(&signal, pin, span, log);
        }
        let Some(group) = tree.labelled(name) else {
            let what = format!("`&{name}` is not a pin of an STM32, nor a group of the file");
            return log.dropped(span, "", &what);
        };
        let mut open = vec![group];
        while let Some(index) = open.pop() {
            let Some(node) = tree.node(index).filter(|_| self.groups.insert(index)) else {
                continue;
            };
            if let Some((value, span)) = node.placed("pinmux") {
                for word in words(value) {
                    if let Some((signal, pin)) = routed(&word.to_ascii_lowercase()) {
                        self.signal(&signal, pin, span, log);
                    }
                }
            }
            open.extend(node.children.iter().rev());
        }
    }

    fn signal(&mut self, signal: &str, pin: PinName, span: Span, log: &mut Log) {
        let is_timer = matches!(Signal::parse(signal).0.function(), Function::Timer { .. });
        let using = if is_timer {
            Using::Timer(signal.to_owned(), TimerMode::Output)
        } else {
            Using::Signal(signal.to_owned())
        };
        self.wires.add(Wire { pin, label: None, using, pull: None, span }, log);
    }

    /// LEDs or keys.
    fn parts(&mut self, tree: &Tree, node: &Node, is_light: bool, log: &mut Log) {
        for part in node.children.iter().filter_map(|child| tree.node(*child)) {
            let Some((value, span)) = part.placed("gpios") else { continue };
            let Some((pin, flags)) = gpios(value).into_iter().next() else { continue };
            let pull = if flags.contains("GPIO_PULL_UP") {
                Some("up")
            } else if flags.contains("GPIO_PULL_DOWN") {
                Some("down")
            } else {
                None
            };
            let using = if is_light { Using::Output(false) } else { Using::Input };
            let label = Some(part.name.clone()).filter(|name| !name.is_empty());
            self.wires.add(Wire { pin, label, using, pull, span }, log);
        }
    }

    /// What the node of a peripheral says besides its pins.
    fn unit(&mut self, tree: &Tree, node: &Node, unit: &str, log: &mut Log) {
        let number = |text: &str| text.trim_matches(['<', '>', ' ']).parse::<u32>().ok();
        if let Some(baud) = node.value("current-speed").and_then(number) {
            self.bauds.insert(unit.to_owned(), baud);
        }
        let parts = || node.children.iter().filter_map(|child| tree.node(*child));
        if unit.starts_with("I2C") {
            let found = parts().filter_map(|part| {
                let (value, span) = part.placed("reg")?;
                let address =
                    u8::try_from(register(value)?).ok().filter(|at| (1..0x80).contains(at))?;
                let (name, unit) = (part.name.clone(), unit.to_owned());
                Some(Addressed { name, unit, address, span })
            });
            self.addressed.extend(found);
        }
        let Some((value, span)) = node.placed("cs-gpios") else { return };
        let numbered = parts().filter_map(|part| Some((register(part.value("reg")?)?, &part.name)));
        let names: BTreeMap<u64, &String> = numbered.collect();
        for ((pin, _), at) in gpios(value).into_iter().zip(0..) {
            let label = names.get(&at).map(|name| (*name).clone());
            let using = Using::Select(Some(unit.to_owned()));
            self.wires.add(Wire { pin, label, using, pull: None, span }, log);
        }
    }
}

/// The MCU of an included file: `st/f4/stm32f446r(c-e)tx-pinctrl.dtsi`, `st/f4/stm32f446Xe.dtsi`.
fn mcu_of(path: &str) -> Option<String> {
    let name = path.rsplit('/').next()?.strip_suffix(".dtsi")?;
    let name = name.strip_suffix("-pinctrl").unwrap_or(name).to_ascii_uppercase();
    let is_known = name.starts_with("STM32") || name == "RP2040" || name.starts_with("RP2350");
    is_known.then(|| largest(if name == "RP2350" { "RP2350A" } else { &name }))
}

/// The words of a value, without its signs.
fn words(value: &str) -> impl Iterator<Item = &str> {
    value
        .split(|c: char| c.is_whitespace() || matches!(c, '<' | '>' | ',' | '(' | ')' | '|'))
        .filter(|word| !word.is_empty())
}

/// What a value refers to: `<&usart1_tx_pa9 &usart1_rx_pa10>`.
fn references(value: &str) -> impl Iterator<Item = &str> {
    words(value).filter_map(|word| word.strip_prefix('&'))
}

/// The signal and the pin of `usart1_tx_pa9` or `uart0_tx_p0`.
fn routed(name: &str) -> Option<(String, PinName)> {
    // Some names end with how the pin is driven: `spi1_sck_remap_pb3` has the pin last as well.
    let (signal, pin) = name.rsplit_once('_')?;
    let digits = pin.strip_prefix('p')?;
    let is_rp = digits.bytes().all(|byte| byte.is_ascii_digit());
    let pin = if is_rp { pad(&format!("GP{digits}"))? } else { pad(pin)? };
    // Where a signal has several pins of one name, the group says which: `tim1_ch1_remap0_pa8`.
    let signal = signal.split("_remap").next().unwrap_or_default();
    Some((signal.to_ascii_uppercase(), pin))
}

/// The pins of `<&gpiob 0 GPIO_ACTIVE_HIGH>, <&gpioc 3 (GPIO_ACTIVE_LOW | GPIO_PULL_UP)>`, with
/// their flags.
fn gpios(value: &str) -> Vec<(PinName, String)> {
    let pin = |cell: &str| {
        let mut words = words(cell);
        let port = words.next()?.strip_prefix("&gpio")?;
        let number = words.next()?;
        let pin = if port.len() == 1 && port != "0" {
            pad(&format!("P{port}{number}"))?
        } else {
            pad(&format!("GP{number}"))?
        };
        Some((pin, words.collect::<Vec<_>>().join(" ")))
    };
    value.split('<').filter_map(pin).collect()
}

/// The first number of `<0x77>` or `<0>`.
fn register(value: &str) -> Option<u64> {
    let number = words(value).next()?;
    match number.strip_prefix("0x") {
        Some(digits) => u64::from_str_radix(digits, 16).ok(),
        None => number.parse().ok(),
    }
}
