//! The description of an MCU in XML, from a CubeMX installation or from ST's open pin data, in; its
//! board table out.
//!
//! The file lists packages, pads and signals. The alternate functions are in a second file that it
//! names, `IP/GPIO-<version>_Modes.xml`. Pins that share a pad have the same `Position`. On the F1
//! family, signals do not have alternate functions but belong to remap blocks, of which each
//! peripheral uses one; the column `Note` lists them.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use roxmltree::{Document, Node, ParsingOptions};
use sensedsl_board::pin::PinName;
use sensedsl_board::place::Place;
use sensedsl_board::signal::{Function, Signal};
use sensedsl_diagnostics::{FileId, Span};
use sensedsl_limits::XML_NODES_MAX;
use sensedsl_model::ReadError;

use crate::assemble::{self, Row};
use crate::log::Log;
use crate::package::{Refused as Refusal, check_xml};
use crate::source::{Source, Texts};

/// The alternate functions of the GPIO files read so far, by path. About ninety files serve two
/// thousand MCUs, and reading one takes longer than everything else.
#[derive(Debug, Default)]
pub(crate) struct Cache(Mutex<BTreeMap<String, Arc<Functions>>>);

impl Cache {
    /// The alternate functions in a file next to the source, or why there are none.
    fn functions(
        &self,
        path: &str,
        beside: &dyn Fn(&str) -> Result<Vec<u8>, ReadError>,
    ) -> Result<Arc<Functions>, Refused> {
        if let Some(known) = self.files().get(path) {
            return Ok(Arc::clone(known));
        }
        // Two threads may read the same file at the same time; both get the same result.
        let bytes = beside(path).map_err(Refused::ReadError)?;
        let text = std::str::from_utf8(&bytes).map_err(|error| Refusal::why(&error));
        let document = text.and_then(parse).map_err(Refused::Unreadable)?;
        let found = Arc::new(functions(&document));
        self.files().insert(path.to_owned(), Arc::clone(&found));
        Ok(found)
    }

    fn files(&self) -> MutexGuard<'_, BTreeMap<String, Arc<Functions>>> {
        // What a thread has stored is complete, even if the thread then panicked.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Why there are no alternate functions.
enum Refused {
    ReadError(ReadError),
    Unreadable(Refusal),
}

/// Imports the description of an MCU.
pub(crate) fn import(source: &Source<'_>, cache: &Cache, log: &mut Log) -> Texts {
    let (file, text) = log.text(source.name, source.bytes);
    if log.has_errors() {
        return Texts::default();
    }
    let whole = Span::new(file, 0..0);
    let document = match parse(&text) {
        Ok(document) => document,
        Err(why) => {
            log.not_read(whole, source.name, &why);
            return Texts::default();
        }
    };
    let mcu = document.root_element();
    let reference = mcu.attribute("RefName").unwrap_or_default();
    if !is(&mcu, "Mcu") || reference.is_empty() {
        log.unreadable(whole, source.name, "its root is no `Mcu` with a `RefName`");
        return Texts::default();
    }
    let gpio = mcu.children().find(|node| is(node, "IP") && node.attribute("Name") == Some("GPIO"));
    let Some(version) = gpio.and_then(|gpio| gpio.attribute("Version")) else {
        log.unreadable(whole, source.name, "it names no version of its GPIO");
        return Texts::default();
    };
    let path = format!("IP/GPIO-{version}_Modes.xml");
    let functions = match cache.functions(&path, source.beside) {
        Ok(functions) => functions,
        Err(Refused::ReadError(ReadError::Missing)) => {
            let why = format!("the file `{path}` with its alternate functions is not beside it");
            log.unreadable(whole, source.name, &why);
            return Texts::default();
        }
        Err(Refused::ReadError(unread)) => {
            log.refused(whole, &path, &unread);
            return Texts::default();
        }
        Err(Refused::Unreadable(why)) => {
            log.not_read(whole, &path, &why);
            return Texts::default();
        }
    };
    let reader = Reader { file, functions: &functions };
    let rows = reader.pins(&mcu, log);
    if rows.is_empty() {
        log.no_pins(whole, "the MCU has no general-purpose pin");
        return Texts::default();
    }
    let table = assemble::table(&properties(&mcu), rows, whole, log);
    Texts { table: table.map(|table| table.to_csv()), program: None }
}

/// The properties of the MCU in the table.
fn properties(mcu: &Node<'_, '_>) -> Vec<(&'static str, String)> {
    let reference = mcu.attribute("RefName").unwrap_or_default();
    let mut properties = vec![("mcu", largest(reference))];
    if reference.contains('(') {
        properties.push(("parts", parts(reference).join(" ")));
    }
    let more = [("package", "Package"), ("line", "Line"), ("version", "DBVersion")];
    for (key, attribute) in more {
        let value = mcu.attribute(attribute).unwrap_or_default();
        if !value.is_empty() {
            properties.push((key, value.to_owned()));
        }
    }
    properties
}

fn parse(text: &str) -> Result<Document<'_>, Refusal> {
    check_xml(text, XML_NODES_MAX)?;
    // A document type could only bring in entities, which these files do not use.
    let options = ParsingOptions { allow_dtd: false, ..ParsingOptions::default() };
    Document::parse_with_options(text, options).map_err(|error| Refusal::why(&error))
}

fn is(node: &Node<'_, '_>, name: &str) -> bool {
    node.is_element() && node.tag_name().name() == name
}

/// `STM32F407V(E-G)Tx` stands for one part per flash size.
fn parts(reference: &str) -> Vec<String> {
    let Some((start, rest)) = reference.split_once('(') else { return vec![reference.to_owned()] };
    let Some((sizes, end)) = rest.split_once(')') else { return vec![reference.to_owned()] };
    sizes.split('-').map(|size| format!("{start}{size}{end}")).collect()
}

/// The part with the most flash, which is the last one.
pub(crate) fn largest(reference: &str) -> String {
    parts(reference).pop().unwrap_or_default()
}

/// What the GPIO file states about a pin's signal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Route {
    alternate: Option<u8>,
    /// The remap blocks, on the F1 family, with the register's numbering.
    remaps: Vec<String>,
}

/// The pins of the GPIO file, with the routes of their signals.
type Functions = BTreeMap<PinName, BTreeMap<String, Route>>;

fn functions(modes: &Document<'_>) -> Functions {
    let pins = modes.root_element().children().filter(|node| is(node, "GPIO_Pin"));
    let routes = |pin: Node<'_, '_>| {
        let mut routes = BTreeMap::new();
        for signal in pin.children().filter(|node| is(node, "PinSignal")) {
            let name = signal.attribute("Name").unwrap_or_default();
            routes.entry(name.to_owned()).or_insert_with(|| route(&signal));
        }
        routes
    };
    pins.filter_map(|pin| Some((PinName::parse(pin.attribute("Name")?)?, routes(pin)))).collect()
}

fn route(signal: &Node<'_, '_>) -> Route {
    let mut route = Route::default();
    for child in signal.children().filter(Node::is_element) {
        if is(&child, "RemapBlock") {
            let block = child.attribute("Name").unwrap_or_default();
            route.remaps.extend(remap_block(block));
        } else if child.attribute("Name") == Some("GPIO_AF") {
            let value = child.children().find(|node| is(node, "PossibleValue"));
            let text = value.and_then(|value| value.text()).unwrap_or_default();
            let digits = text.trim().strip_prefix("GPIO_AF").unwrap_or_default();
            let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
            let number = digits.get(..end).and_then(|digits| digits.parse().ok());
            route.alternate = number.filter(|number| *number < 16);
        }
    }
    route
}

/// The register's number for a block such as `TIM3_REMAP1`. The file numbers the blocks
/// consecutively; the register skips some numbers.
fn remap_block(name: &str) -> Option<String> {
    let (unit, number) = name.split_once("_REMAP")?;
    let number: usize = number.parse().ok()?;
    let numbers = match unit {
        "TIM1" | "USART3" => [0, 1, 3, 3],
        "TIM3" | "CAN" | "CAN1" => [0, 2, 3, 3],
        _ => [0, 1, 2, 3],
    };
    numbers.get(number).map(u8::to_string)
}

struct Reader<'m> {
    file: FileId,
    functions: &'m Functions,
}

impl Reader<'_> {
    fn span(&self, node: &Node<'_, '_>) -> Span {
        // Only the opening tag: a pin with all its signals would fill the screen.
        let range = node.range();
        let end = node.first_child().map_or(range.end, |child| child.range().start);
        Span::new(self.file, range.start..end)
    }

    fn pins(&self, mcu: &Node<'_, '_>, log: &mut Log) -> Vec<Row> {
        let mut rows: Vec<Row> = Vec::new();
        let mut others: Vec<(&str, Span)> = Vec::new();
        let mut indices: BTreeMap<PinName, usize> = BTreeMap::new();
        for node in mcu.children().filter(|node| is(node, "Pin")) {
            let spelled = node.attribute("Name").unwrap_or_default();
            let type_of = node.attribute("Type").unwrap_or_default();
            let has_signals = node.children().any(|child| is(&child, "Signal"));
            if !matches!(type_of, "I/O" | "MonoIO") || !has_signals {
                continue;
            }
            let name = PinName::parse(spelled).filter(|name| name.port().is_some());
            let Some(name) = name else {
                others.push((spelled, self.span(&node)));
                continue;
            };
            let row = self.pin(&node, name);
            match indices.get(&row.pin.name).and_then(|at| rows.get_mut(*at)) {
                Some(first) => self.again(&node, first, row, log),
                None => {
                    indices.insert(row.pin.name.clone(), rows.len());
                    rows.push(row);
                }
            }
        }
        if let Some((_, first)) = others.first() {
            let names: Vec<&str> = others.iter().map(|(name, _)| *name).collect();
            let what = match names.as_slice() {
                [one] => format!("`{one}` is not a port pin and is left out"),
                [one, .., last] => {
                    format!(
                        "{} pads are not port pins and are left out: {one} … {last}",
                        names.len()
                    )
                }
                [] => String::new(),
            };
            log.dropped(*first, "", &what);
        }
        rows
    }

    /// A pin that can also be routed to a second pad: both share one row of usages.
    fn again(&self, node: &Node<'_, '_>, first: &mut Row, row: Row, log: &mut Log) {
        let what = format!(
            "{} is on position {} too, by remapping; the table has it on {}",
            row.pin.name,
            row.pin.package_position().unwrap_or("?"),
            first.pin.package_position().unwrap_or("?"),
        );
        log.doubtful(self.span(node), "", &what);
        for usage in row.usages {
            if !first.usages.contains(&usage) {
                first.usages.push(usage);
            }
        }
    }

    fn pin(&self, node: &Node<'_, '_>, name: PinName) -> Row {
        let routes = self.functions.get(&name);
        let mut row = Row::new(name);
        if let Some(position) = node.attribute("Position").map(str::to_owned) {
            row.pin.places.push(Place { position: Some(position), ..Place::default() });
        }
        for signal in node.children().filter(|child| is(child, "Signal")) {
            let signal = signal.attribute("Name").unwrap_or_default();
            if signal == "GPIO" || signal.is_empty() || is_trigger(signal) {
                continue;
            }
            let spelled = spelled(signal);
            let route = routes.and_then(|routes| routes.get(signal));
            let blocks = route.map(|route| &route.remaps).filter(|all| !all.is_empty());
            let blocks = blocks.map_or(String::new(), |all| format!("#{}", all.join("|")));
            let alternate = route.and_then(|route| route.alternate);
            row.usages.push((format!("{spelled}{blocks}"), alternate));
        }
        row
    }
}

/// Whether this is a trigger such as `ADC1_EXTI11`: a converter can be started by the interrupt
/// line with number 11, which any pin with that number has. Like the interrupt itself, this is not
/// a usage of a pin.
fn is_trigger(signal: &str) -> bool {
    let line = signal.split_once("_EXTI").map(|(_, line)| line);
    let numbered = line.is_some_and(|line| line.bytes().all(|byte| byte.is_ascii_digit()));
    numbered && (signal.starts_with("ADC") || signal.starts_with("DAC"))
}

/// A signal as a usage of a table: one word. Some of ST's names would be taken for typing mistakes:
/// a break input becomes `BKIN`, a line of the only converter becomes one of the first converter,
/// and any other gets the prefix `ST_`.
fn spelled(signal: &str) -> String {
    let name = signal.split_whitespace().collect::<Vec<_>>().join("_").replace('@', "_");
    if Signal::parse(&name).1.is_none() {
        return name;
    }
    let (unit, line) = name.split_once('_').unwrap_or((&name, ""));
    let known = match line {
        "BK" | "BRK" => format!("{unit}_BKIN"),
        "BK2" | "BRK2" => format!("{unit}_BKIN2"),
        _ => format!("{unit}1_{line}"),
    };
    let fits = |name: &&String| {
        let (signal, malformed) = Signal::parse(name);
        malformed.is_none() && *signal.function() == Function::Other
    };
    Some(known).filter(|known| fits(&known)).unwrap_or_else(|| format!("ST_{name}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_st_are_no_slips() {
        for (signal, expected) in [
            ("TIM2_CH1", "TIM2_CH1"),
            ("SYS_JTMS-SWDIO", "SYS_JTMS-SWDIO"),
            ("TIM1_BK2", "TIM1_BKIN2"),
            ("DAC_X9", "ST_DAC_X9"),
            ("ADC_IN0b", "ADC1_IN0b"),
            ("ADC_TAMPER", "ST_ADC_TAMPER"),
            ("DEBUG_X Y", "DEBUG_X_Y"),
        ] {
            assert_eq!(spelled(signal), expected);
            assert_eq!(Signal::parse(&spelled(signal)).1, None, "{signal}");
        }
    }

    #[test]
    fn interrupt_lines_are_no_usages() {
        assert!(is_trigger("ADC1_EXTI11") && is_trigger("DAC_EXTI9"));
        assert!(!is_trigger("ADC1_IN11") && !is_trigger("SYS_EXTI1"));
    }

    #[test]
    fn a_reference_stands_for_its_parts() {
        assert_eq!(parts("STM32F407V(E-G)Tx"), ["STM32F407VETx", "STM32F407VGTx"]);
        assert_eq!(largest("STM32G031Y8Yx"), "STM32G031Y8Yx");
    }
}
