//! From the pins of a project to devices: an analog sensor for each converter input, a serial port
//! for TX and RX of a unit, and so on. If the project does not state something (an address, the
//! frame of a message), the device becomes a comment with that part left open.

mod timers;

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::PinName;
use sensedsl_board::signal::{CanLine, Function, I2cLine, Signal, SpiLine, UartLine, UnitName};

use self::timers::{Decision, decide};
use crate::log::Log;
use crate::project::chip::{Chip, unit_of, unit_taken_by};
use crate::project::{Project, Using, Wire, identifier, one_line};

/// The highest identifier; the lowest is 1.
pub(crate) const IDS_MAX: usize = 254;
/// Words of the language that cannot be names of devices.
pub(crate) const WORDS: [&str; 18] = [
    "use", "spare", "board", "on", "link", "sensor", "actuator", "returns", "accepts", "driver",
    "for", "prefer", "avoid", "reserve", "release", "allow", "true", "false",
];

/// A device as text.
#[derive(Clone, Debug)]
pub(crate) struct Device {
    /// The head: `sensor Front returns uint16`.
    pub(crate) head: String,
    /// The lines of its block.
    pub(crate) properties: Vec<String>,
    /// The pins that it is on.
    pub(crate) pins: Vec<PinName>,
    /// True if something is missing, so that the device is a comment in the file.
    pub(crate) open: bool,
}

/// What a project comes to.
#[derive(Clone, Debug)]
pub(crate) struct Inferred {
    /// The devices, in the order of the pins.
    pub(crate) devices: Vec<Device>,
    /// Buses that further devices may join.
    pub(crate) buses: BTreeSet<String>,
    /// Other units that the project uses for something that is not a device.
    pub(crate) reserved: BTreeSet<String>,
}

/// Infers the devices of a project. The serial port `linked` is the link's.
pub(crate) fn infer(
    project: &Project,
    chip: &Chip,
    linked: Option<&str>,
    log: &mut Log,
) -> Inferred {
    let mut maker = Maker {
        project,
        chip,
        log,
        names: BTreeSet::new(),
        devices: Vec::new(),
        units: Units::new(),
        buses: BTreeSet::new(),
        timers: decide(project, chip),
    };
    let is_linked = |wire: &&Wire| {
        let unit = wire.using.signal().and_then(unit_of);
        unit.is_some() && unit.as_deref() == linked
    };
    let wires = || project.wires.iter().filter(|wire| !is_linked(wire));
    for wire in wires() {
        maker.wire(wire);
    }
    let units = std::mem::take(&mut maker.units);
    for (unit, wires) in &units {
        maker.unit(unit, wires);
    }
    for wire in wires() {
        maker.unused_select(wire, &units);
    }
    let (devices, buses) = (maker.devices, maker.buses);
    let standing = devices.iter().filter(|device| !device.open);
    let served: BTreeSet<&PinName> = standing.flat_map(|device| &device.pins).collect();
    let (of_devices, of_others): (Vec<&Wire>, Vec<&Wire>) =
        wires().partition(|wire| served.contains(&wire.pin));
    let units = |wires: Vec<&Wire>| -> BTreeSet<String> {
        wires.into_iter().filter_map(|wire| unit_taken_by(wire.using.signal()?)).collect()
    };
    let of_devices = units(of_devices);
    let is_left = |unit: &String| !of_devices.contains(unit) && !buses.contains(unit);
    let reserved = units(of_others).into_iter().filter(is_left).collect();
    Inferred { devices, buses, reserved }
}

/// The wires, by role, of each peripheral instance that takes several.
type Units<'a> = BTreeMap<String, BTreeMap<&'static str, &'a Wire>>;

struct Maker<'a, 'l> {
    project: &'a Project,
    chip: &'a Chip,
    log: &'l mut Log,
    /// Names in use, without case and underscores.
    names: BTreeSet<String>,
    devices: Vec<Device>,
    units: Units<'a>,
    /// Buses that are only described: their pins are kept for whoever joins.
    buses: BTreeSet<String>,
    timers: BTreeMap<PinName, Decision>,
}

/// A future device.
struct Plan<'p> {
    /// The wanted name; `name` is used if there is none.
    label: Option<&'p str>,
    name: String,
    /// `sensor` or `actuator`, and its type.
    kind: (&'p str, &'p str),
    properties: Vec<String>,
    wires: Vec<(&'p str, &'p Wire)>,
    open: bool,
}

impl<'a> Maker<'a, '_> {
    fn wire(&mut self, wire: &'a Wire) {
        match &wire.using {
            Using::Input => {
                self.single(wire, "Input", ("sensor", "bool"), vec!["type = digital;".into()]);
            }
            Using::Output(high) => {
                let mut properties = vec!["type = digital;".to_owned()];
                if *high {
                    properties.push("initial = true;".into());
                }
                self.single(wire, "Output", ("actuator", "bool"), properties);
            }
            Using::Interrupt(edge) => {
                let properties = vec!["type = digital;".into(), format!("edge = {edge};")];
                self.single(wire, "Input", ("sensor", "bool"), properties);
            }
            Using::Analog
                if self.chip.can(&wire.pin, |one| matches!(one, Function::Adc { .. })) =>
            {
                self.single(wire, "Analog", ("sensor", "uint16"), vec!["type = analog;".into()]);
            }
            Using::Pulses if self.chip.can(&wire.pin, |one| self.chip.is_output(one)) => {
                self.single(wire, "Pwm", ("actuator", "uint16"), vec!["type = pwm;".into()]);
            }
            Using::Analog => self.incapable(wire, "no input of a converter"),
            Using::Pulses => self.incapable(wire, "no output of a timer that the target drives"),
            Using::Select(_) => {}
            Using::Timer(signal, _) => self.timer(wire, signal),
            Using::Signal(signal) => self.signal(wire, signal),
        }
    }

    /// Adds a device on a single pin.
    fn single(&mut self, wire: &'a Wire, stem: &str, kind: (&str, &str), properties: Vec<String>) {
        let name = format!("{stem}{}", wire.pin);
        let (label, wires) = (wire.label.as_deref(), vec![("pin", wire)]);
        self.push(Plan { label, name, kind, properties, wires, open: false });
    }

    fn timer(&mut self, wire: &'a Wire, spelled: &str) {
        let (signal, _) = Signal::parse(spelled);
        let Function::Timer { unit: timer, .. } = signal.function() else { return };
        let properties = |kind: &str| vec![format!("type = {kind};"), format!("unit = {timer};")];
        match self.timers.get(&wire.pin).cloned() {
            Some(Decision::Capture) => {
                self.single(wire, "Capture", ("sensor", "uint32"), properties("icu"));
            }
            Some(Decision::Pulses) => {
                self.single(wire, "Pwm", ("actuator", "uint16"), properties("pwm"));
            }
            Some(Decision::Encoder(role)) => {
                self.units.entry(timer.to_string()).or_default().insert(role, wire);
            }
            Some(Decision::Reserved(why)) => {
                let what = format!("{spelled} of {} is left out: {why}", wire.pin);
                self.log.dropped(wire.span, "", &what);
            }
            None => {}
        }
    }

    /// Reports a pin that is not known to have what it is used for.
    fn incapable(&mut self, wire: &Wire, why: &str) {
        let label = wire.label.as_deref().unwrap_or("the use");
        let what = format!("{label} of {} is left out: the pin is known as {why}", wire.pin);
        self.log.dropped(wire.span, "", &what);
    }

    /// Reports a signal that no driver of the usual target serves.
    fn undriven(&mut self, wire: &Wire, what: &str) {
        let target = self.chip.profile.as_ref().map_or("the target", |profile| &profile.name);
        let what = format!("{what} is left out: {target} has no driver for it");
        self.log.dropped(wire.span, "", &what);
    }

    fn signal(&mut self, wire: &'a Wire, spelled: &str) {
        let (signal, _) = Signal::parse(spelled);
        let mut of_unit = |unit: &UnitName, role: &'static str| {
            self.units.entry(unit.to_string()).or_default().insert(role, wire);
        };
        match signal.function() {
            function @ (Function::Adc { .. } | Function::Dac { .. })
                if !self.chip.drives(function) =>
            {
                self.undriven(wire, &format!("{spelled} of {}", wire.pin));
            }
            Function::Adc { .. } => {
                self.single(wire, "Analog", ("sensor", "uint16"), vec!["type = analog;".into()]);
            }
            Function::Dac { .. } => {
                self.single(wire, "Dac", ("actuator", "uint16"), vec!["type = dac;".into()]);
            }
            Function::I2c { unit, line: I2cLine::Scl } => of_unit(unit, "scl"),
            Function::I2c { unit, line: I2cLine::Sda } => of_unit(unit, "sda"),
            Function::Uart { unit, line: UartLine::Tx } => of_unit(unit, "tx"),
            Function::Uart { unit, line: UartLine::Rx } => of_unit(unit, "rx"),
            Function::Can { unit, line: CanLine::Tx } => of_unit(unit, "tx"),
            Function::Can { unit, line: CanLine::Rx } => of_unit(unit, "rx"),
            Function::Spi { unit, line: SpiLine::Sck } => of_unit(unit, "sck"),
            Function::Spi { unit, line: SpiLine::Miso } => of_unit(unit, "miso"),
            Function::Spi { unit, line: SpiLine::Mosi } => of_unit(unit, "mosi"),
            Function::Spi { unit, line: SpiLine::Nss } => of_unit(unit, "cs"),
            // Everything else is in the table, as an on-board part.
            Function::Timer { .. } | Function::Pio { .. } | Function::Other => {}
        }
    }

    /// Adds the devices on a peripheral instance that takes several wires.
    fn unit(&mut self, unit: &str, wires: &BTreeMap<&'static str, &'a Wire>) {
        let stem = unit.trim_end_matches(|c: char| c.is_ascii_digit());
        let (needed, kind): (&[&str], &str) = match stem {
            "I2C" => (&["scl", "sda"], "i2c"),
            "SPI" => (&["sck", "miso", "mosi"], "spi"),
            "TIM" => (&["a", "b"], "encoder"),
            "CAN" | "FDCAN" => (&["tx", "rx"], "can"),
            _ => (&["rx"], "uart"),
        };
        let missing: Vec<String> = needed
            .iter()
            .filter(|role| !wires.contains_key(*role))
            .map(|role| role.to_uppercase())
            .collect();
        if let Some((_, wire)) = wires.iter().next().filter(|_| !missing.is_empty()) {
            let what = format!("{unit} is left out: it has no pin for {}", missing.join(", "));
            self.log.dropped(wire.span, "", &what);
            return;
        }
        if kind != "encoder"
            && let Some((_, wire)) = wires.iter().next()
            && let Some(signal) = wire.using.signal()
            && !self.chip.drives(Signal::parse(signal).0.function())
        {
            return self.undriven(wire, unit);
        }
        let roles = ["scl", "sda", "tx", "rx", "sck", "miso", "mosi", "a", "b"];
        let wires_in_order: Vec<(&str, &Wire)> =
            roles.iter().filter_map(|role| Some((*role, *wires.get(role)?))).collect();
        let plan = Plan {
            label: None,
            name: format!("{}Device", camel(unit)),
            kind: ("sensor", "uint8"),
            properties: vec![format!("type = {kind};"), format!("unit = {unit};")],
            wires: wires_in_order,
            open: false,
        };
        match kind {
            "i2c" => self.i2c(unit, plan),
            "spi" => self.spi(unit, plan, wires.get("cs").copied()),
            "encoder" => {
                self.push(Plan {
                    kind: ("sensor", "int32"),
                    name: format!("Encoder{unit}"),
                    ..plan
                });
            }
            "can" => self.left_open(
                unit,
                plan,
                "frame = 0x000; // which?",
                "the frames of CAN messages are",
            ),
            _ => self.uart(unit, plan, wires),
        }
    }

    /// Reports a chip select whose bus is unknown or missing.
    fn unused_select(&mut self, wire: &Wire, units: &Units<'_>) {
        let Using::Select(unit) = &wire.using else { return };
        let what = match unit {
            None => "no device says that it is selected by it".to_owned(),
            Some(unit) if !units.contains_key(unit) => format!("no pin is used for {unit}"),
            Some(_) => return,
        };
        let label = wire.label.as_deref().unwrap_or("a chip select");
        let what = format!("{label} at {} is left out: {what}", wire.pin);
        self.log.dropped(wire.span, "", &what);
    }

    fn uart(&mut self, unit: &str, mut plan: Plan<'_>, wires: &BTreeMap<&'static str, &'a Wire>) {
        if !wires.contains_key("tx") {
            plan.properties.push("tx = none;".into());
        }
        if let Some(baud) =
            self.project.bauds.get(unit).filter(|baud| (300..=10_000_000).contains(*baud))
        {
            plan.properties.push(format!("baud = {baud};"));
        }
        self.push(plan);
    }

    fn i2c(&mut self, unit: &str, plan: Plan<'_>) {
        let known: Vec<_> =
            self.project.addressed.iter().filter(|device| device.unit == unit).collect();
        if known.is_empty() {
            let address = "address = 0x00; // which?";
            return self.left_open(unit, plan, address, "the addresses of I2C devices are");
        }
        let mut first: BTreeMap<u8, &str> = BTreeMap::new();
        for device in known {
            // If firmware looks for several chips at the same address, only one of them is there.
            if let Some(first) = first.get(&device.address) {
                let (name, address) = (&device.name, device.address);
                let what =
                    format!("{name} at 0x{address:02X} of {unit}, where {first} may be instead");
                self.log.dropped(device.span, "", &what);
                continue;
            }
            first.insert(device.address, &device.name);
            let mut properties = plan.properties.clone();
            properties.push(format!("address = 0x{:02X};", device.address));
            self.push(Plan {
                label: Some(&device.name),
                name: plan.name.clone(),
                properties,
                wires: plan.wires.clone(),
                ..plan
            });
        }
    }

    /// Adds a device for each chip select; without any, that pin is left open.
    fn spi(&mut self, unit: &str, mut plan: Plan<'_>, nss: Option<&'a Wire>) {
        let project = self.project;
        let mut selects: Vec<&Wire> = nss.into_iter().collect();
        let of_unit = |wire: &&Wire| matches!(&wire.using, Using::Select(Some(of)) if of == unit);
        selects.extend(project.wires.iter().filter(of_unit));
        if selects.is_empty() {
            return self.left_open(unit, plan, "// cs = ?;", "the chip selects of SPI devices are");
        }
        let shared = std::mem::take(&mut plan.wires);
        for select in selects {
            let mut wires = shared.clone();
            wires.push(("cs", select));
            self.push(Plan {
                label: select.label.as_deref(),
                name: plan.name.clone(),
                properties: plan.properties.clone(),
                wires,
                ..plan
            });
        }
    }

    fn left_open(&mut self, unit: &str, mut plan: Plan<'_>, line: &str, what: &str) {
        let Some(wire) = plan.wires.first().map(|(_, wire)| *wire) else { return };
        let what = format!("{what} not in the project: the device on {unit} is a comment");
        self.log.open(wire.span, &what);
        self.buses.insert(unit.to_owned());
        plan.properties.push(line.into());
        self.push(Plan { open: true, ..plan });
    }

    fn push(&mut self, plan: Plan<'_>) {
        let Some((_, first)) = plan.wires.first() else { return };
        let id = self.devices.len() + 1;
        if id > IDS_MAX {
            let what = format!("{} is left out: a file has at most {IDS_MAX} devices", first.pin);
            self.log.dropped(first.span, "", &what);
            return;
        }
        let name = self.name(plan.label, &plan.name, first);
        let (direction, value) = plan.kind;
        let verb = if direction == "sensor" { "returns" } else { "accepts" };
        let mut properties = vec![format!("id = {id};")];
        properties.extend(plan.properties);
        let pull = plan.wires.iter().find_map(|(role, wire)| wire.pull.filter(|_| *role == "pin"));
        let digital = properties.iter().any(|line| line == "type = digital;");
        if let Some(pull) = pull.filter(|_| digital) {
            properties.push(format!("pull = {pull};"));
        }
        for (role, wire) in &plan.wires {
            let label = wire.label.as_ref().map(|label| format!(" // {}", one_line(label)));
            properties.push(format!("{role} = {};{}", wire.pin, label.unwrap_or_default()));
        }
        let pins = plan.wires.iter().map(|(_, wire)| wire.pin.clone()).collect();
        let head = format!("{direction} {name} {verb} {value}");
        self.devices.push(Device { head, properties, pins, open: plan.open });
    }

    /// A name that no other device has.
    fn name(&mut self, label: Option<&str>, plain: &str, wire: &Wire) -> String {
        let wanted = label.and_then(identifier).unwrap_or_else(|| plain.to_owned());
        let id = self.devices.len() + 1;
        let options = [wanted.clone(), format!("{wanted}_{}", wire.pin), format!("{wanted}_n{id}")];
        for option in options {
            let folded: String = option.chars().filter(|c| *c != '_').collect();
            let word = WORDS.contains(&option.as_str());
            if !word && self.names.insert(folded.to_ascii_lowercase()) {
                return option;
            }
        }
        format!("Device{id}")
    }
}

/// `USART2` as a part of a name: `Usart2`.
fn camel(unit: &str) -> String {
    let (first, rest) = unit.split_at_checked(1).unwrap_or((unit, ""));
    format!("{first}{}", rest.to_ascii_lowercase())
}
