//! Chips: from a block and the driver it names to a part with connections and values.
//!
//! What one value needs can be given in several places. From nearest to farthest: the device, the
//! chip, the chip's `connection` block, the driver's reading or command, the driver's connection,
//! the driver. The nearest wins.

pub(crate) mod check;
mod reader;
mod sockets;
mod values;

use sensedsl_diagnostics::codes::{
    e0201_unknown_property, e0217_driver_of_other_kind, e0220_impossible_type, e0229_wrong_driver,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span};
use sensedsl_syntax::ast::{self, AstNode as _, Property};
use sensedsl_wire::{Direction, ValueType};

use crate::design::protocol::{Coding, Protocol};
use crate::design::{BoardIndex, Connection, ConnectionIndex, Device, DeviceIndex, Part};
use crate::driver::known::Known;
use crate::driver::{Driver, bounds, module};
use crate::fields::{Fields, name_or_text};
use crate::kind::uart::Uart;
use crate::kind::uart::exchange::ADDRESS;
use crate::kind::{Kind, KindName, Values};
use crate::part::block::{Next, ReadPart};
use crate::part::coding::{self, FILTER, PROTOCOL};
use crate::part::ids::ID_MAX;
use crate::part::properties::{self, COMMON_PROPERTIES, PRESENTATION};
use crate::part::{stranger, words};
use crate::rule;
use crate::spanned::{Spanned, named, span};
use crate::value::Evaluator;
use reader::{ChipReader, DriverValue};
use sockets::Socket;
use values::RequestedValue;

/// The properties of a chip, besides those of its connections.
pub(crate) const CHIP: &[&str] = &["driver", "id", "delay", "prio", "group", "side", "header"];
/// The properties of a chip's devices.
pub(crate) const OF_DEVICE: &[&str] =
    &["id", "delay", "prio", "group", "reading", "failsafe", "initial"];
/// The properties that a chip says of its wires.
pub(crate) const PLACED: &[&str] = &["unit", "level", "divider"];

/// Reads a chip; none when too little of it is understood.
pub(crate) fn read(
    (file, next): (FileId, Next),
    node: &ast::Chip,
    board: Option<BoardIndex>,
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<ReadPart> {
    let name = named(file, &node.name()?);
    let rest = (known.constants, &mut *diagnostics);
    let (mut wishes, mut allows) = rule::of_device(file, node.rules(), node.range(), rest);
    for device in node.devices() {
        let rest = (known.constants, &mut *diagnostics);
        let (more, others) = rule::of_device(file, device.rules(), device.range(), rest);
        wishes.extend(more);
        allows.extend(others);
    }
    let reported = (known.constants, &mut *diagnostics);
    let owner = format!("the chip `{}`", name.value);
    let mut fields = Fields::new(node.properties(), file, &owner, name.span, reported);
    let Some(wanted) = fields.name("driver", "the name of a driver") else {
        if !fields.has("driver") {
            fields.missing("driver", "driver = mpu6050;");
        }
        return None;
    };
    let first_id = fields.integer("id", 1..=254).and_then(|id| u8::try_from(id.value).ok());
    drop(fields);
    let driver = known.drivers.find(&wanted, diagnostics)?;
    let properties: Vec<Property> = node.properties().collect();
    let block = span(file, node.range());
    let protocol = protocol(file, driver, &properties, known, diagnostics);
    let (given, mut sockets) = values_and_sockets(driver, known, diagnostics)?;
    let whole = ChipReader { file, next, name, block, driver, known, properties, protocol, given };
    sockets::describe(&mut sockets, &whole, node.connections().collect(), diagnostics);
    whole.check_properties(&sockets, CHIP, diagnostics);
    for device in node.devices() {
        whole.check_device(&device, &sockets, diagnostics);
    }
    let asked: Vec<RequestedValue> = if node.devices().next().is_some() {
        let devices = node.devices();
        devices.filter_map(|one| values::stated(&whole, &one, diagnostics)).collect()
    } else {
        values::all(&whole, diagnostics)
    };
    let devices = whole.devices(asked, first_id, &mut sockets, diagnostics);
    let connections = whole.connections(&devices, &sockets, board, &wishes, diagnostics);
    whole.part(board, allows, devices, connections)
}

/// Reads a device whose driver names several values: a chip of which one value is wanted.
pub(crate) fn of_device(
    (file, next): (FileId, Next),
    node: &ast::Device,
    driver: &Driver,
    board: Option<BoardIndex>,
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<ReadPart> {
    let name = named(file, &node.name()?);
    let rest = (known.constants, &mut *diagnostics);
    let (wishes, allows) = rule::of_device(file, node.rules(), node.range(), rest);
    let block = span(file, node.range());
    let of_value = |one: &Property| {
        let name = one.name().map(|name| name.text().to_owned()).unwrap_or_default();
        let name = name.as_str();
        OF_DEVICE.contains(&name) || PRESENTATION.contains(&name) || FILTER.contains(&name)
    };
    let properties: Vec<Property> = node.properties().filter(|one| !of_value(one)).collect();
    let protocol = protocol(file, driver, &properties, known, diagnostics);
    let (given, mut sockets) = values_and_sockets(driver, known, diagnostics)?;
    let whole = ChipReader { file, next, name, block, driver, known, properties, protocol, given };
    whole.check_type(diagnostics);
    let own: Vec<&str> = CHIP.iter().chain(&["type"]).copied().collect();
    whole.check_properties(&sockets, &own, diagnostics);
    let mut asked = values::stated(&whole, node, diagnostics)?;
    asked.own.retain(of_value);
    let devices = whole.devices(vec![asked], None, &mut sockets, diagnostics);
    let connections = whole.connections(&devices, &sockets, board, &wishes, diagnostics);
    whole.part(board, allows, devices, connections)
}

/// A driver's values, and the connections that it has for them.
fn values_and_sockets(
    driver: &Driver,
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<(Vec<DriverValue>, Vec<Socket>)> {
    let mut sockets = sockets::of_driver(driver, diagnostics)?;
    let names: Vec<Option<&str>> = sockets.iter().map(|one| one.name.as_deref()).collect();
    let given = values::given(driver, &names, (known.constants, diagnostics));
    for number in given.iter().flat_map(|one| &one.via) {
        if let Some(socket) = sockets.get_mut(*number) {
            socket.is_of_a_value = true;
        }
    }
    Some((given, sockets))
}

/// How the chip is started, according to the driver; the chip can override it.
fn protocol(
    file: FileId,
    driver: &Driver,
    properties: &[Property],
    known: Known<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Protocol {
    // What `init` says may have the part's address in it, and the checksum of its messages behind it.
    let of_protocol = |one: &Property| {
        one.name().is_some_and(|name| {
            PROTOCOL.contains(&name.text()) || matches!(name.text(), ADDRESS | "checksum_from")
        })
    };
    let at = span(driver.file, driver.node.range());
    let own = properties.iter().filter(|one| of_protocol(one)).cloned();
    let reported = (known.constants, diagnostics);
    let mut fields = Fields::new(own, file, "a driver", at, reported);
    fields.drivers_follow();
    let connections: Vec<_> = driver.node.connections().collect();
    // Each of several connections has an address of its own.
    let is_alone = connections.len() == 1;
    let blocks = connections.iter().flat_map(|one| one.properties().collect::<Vec<_>>());
    let blocks = blocks
        .filter(|one| is_alone || one.name().is_some_and(|name| PROTOCOL.contains(&name.text())));
    let all = driver.node.properties().chain(blocks);
    fields.inherit(all.filter(of_protocol), driver.file);
    coding::protocol(&mut fields)
}

impl ChipReader<'_> {
    /// Reports properties of the chip that none of its parts has.
    fn check_properties(
        &self,
        sockets: &[Socket],
        own: &[&str],
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let kinds: Vec<KindName> = sockets.iter().map(|socket| socket.kind).collect();
        let of_kinds = kinds.iter().flat_map(|kind| kind.spec().properties).copied();
        let wires = sockets.iter().filter_map(|socket| socket.name.as_deref());
        let is_for = |one: &&&str| kinds.iter().any(|kind| stranger::is_for(one, *kind));
        let own = own.iter().chain(PROTOCOL.iter().filter(is_for)).chain(PLACED).copied();
        let known: Vec<&str> = of_kinds.chain(own).chain(wires).collect();
        for property in &self.properties {
            let Some(name) = property.name() else { continue };
            if !known.contains(&name.text()) {
                let at = span(self.file, name.range());
                let of = format!("a chip of `{}`", self.driver.name.value);
                diagnostics.push(stranger::report((name.text(), at), &of, &kinds, &known));
            }
        }
    }

    /// Reports properties of a device of the chip that are not its own.
    fn check_device(
        &self,
        node: &ast::Device,
        sockets: &[Socket],
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let own = || OF_DEVICE.iter().chain(PRESENTATION).chain(FILTER).copied();
        for property in node.properties() {
            let Some(name) = property.name().filter(|name| own().all(|one| one != name.text()))
            else {
                continue;
            };
            let at = span(self.file, name.range());
            let of_chip = COMMON_PROPERTIES.contains(&name.text())
                || sockets.iter().any(|one| one.kind.spec().properties.contains(&name.text()));
            diagnostics.push(if of_chip {
                let (property, chip) = (name.text(), &self.name.value);
                e0201_unknown_property::property_of_chip(at, property, chip)
            } else {
                let meant = stranger::meant(name.text(), own());
                let of = "a device of a chip";
                e0201_unknown_property::unknown_property(at, name.text(), of, meant)
            });
        }
    }

    /// Reports a `type` that differs from the driver's.
    fn check_type(&self, diagnostics: &mut Vec<Diagnostic>) {
        let is_type = |one: &&Property| one.name().is_some_and(|name| name.text() == "type");
        let Some(value) = self.properties.iter().find(is_type).and_then(Property::value) else {
            return;
        };
        let (file, constants) = (self.file, self.known.constants);
        let found = Evaluator::new(file, constants, diagnostics).value(&value);
        let written = name_or_text(&found).unwrap_or_default();
        let of_driver = self.driver.kind.map(KindName::name);
        if of_driver != Some(written.as_str()) {
            let (at, name) = (span(file, value.range()), &self.driver.name.value);
            let wrong = e0217_driver_of_other_kind::driver_of_other_kind;
            let its = self.driver.what();
            diagnostics.push(wrong(at, name, &its, &written, Some(at)));
        }
    }

    /// Reports a value that ends after the message it is in.
    fn outside(
        &self,
        (kind, coding): (&Kind, &Coding),
        main: &Socket,
        given: &DriverValue,
        at: Span,
    ) -> Option<Diagnostic> {
        kind.uart().filter(|_| given.direction == Direction::Sensor)?;
        let (whole, ..) = main.read(self, &mut Vec::new());
        let name = format!("`{}` of `{}`", given.name, self.driver.name.value);
        words::outside((at, &name), (kind, coding), &whole)
    }

    /// The requested values as devices. Marks their connections as used.
    fn devices(
        &self,
        asked: Vec<RequestedValue>,
        first_id: Option<u8>,
        sockets: &mut [Socket],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<Device> {
        for (asked, index) in asked.iter().zip((self.next.device.0..).map(DeviceIndex)) {
            for number in &asked.given.via {
                if let Some(socket) = sockets.get_mut(*number) {
                    socket.take(index, &asked.given);
                }
            }
        }
        for socket in sockets.iter_mut().filter(|socket| !socket.is_of_a_value) {
            socket.is_used = true;
        }
        let mut devices = Vec::new();
        for (asked, at) in asked.into_iter().zip(0_u8..) {
            let id = first_id.and_then(|first| first.checked_add(at)).filter(|id| *id <= ID_MAX);
            devices.extend(self.device(&asked, id, sockets, diagnostics));
        }
        devices
    }

    fn device(
        &self,
        asked: &RequestedValue,
        id: Option<u8>,
        sockets: &[Socket],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Device> {
        let RequestedValue { name, block, own, value, given } = asked;
        let direction = given.direction;
        let main = sockets.get(*given.via.first()?)?;
        let reported = (self.known.constants, &mut *diagnostics);
        let owner = format!("`{}`", name.value);
        let mut fields = Fields::new(own.iter().cloned(), self.file, &owner, name.span, reported);
        // On a bus, each value has its own register. Other wires are the same for all values, and
        // the `min` of a pwm output is not that of the value.
        let is_bus = main.kind.spec().values == Values::Any;
        let of_wires = |one: &Property| {
            let name = one.name().map(|name| name.text().to_owned()).unwrap_or_default();
            main.kind.spec().properties.contains(&name.as_str())
        };
        // The bytes of a message are not those of a value in it.
        let of_part = |one: &Property| {
            let of_part = main.kind.spec().of_part;
            one.name().is_some_and(|name| of_part.contains(&name.text()))
        };
        let of_value = |one: &Property| if is_bus { !of_part(one) } else { !of_wires(one) };
        fields.inherit(self.properties_for(main.kind).filter(of_value), self.file);
        fields.inherit(main.block_properties().filter(of_value), self.file);
        fields.drivers_follow();
        fields.inherit(given.properties.iter().cloned(), self.driver.file);
        fields.inherit(main.driver_properties().filter(of_value), self.driver.file);
        fields.inherit(values::shared(self.driver).filter(of_value), self.driver.file);
        fields.set_reading(&given.name);
        fields.set_register_bytes(self.protocol.register_bytes);
        fields.set_addresses(bounds::of(Some(self.driver), self.known).addresses);
        let of_bus = is_bus.then(|| main.kind.read(&mut fields, direction, given.value));
        let own = properties::own(&mut fields);
        let formula = self.protocol.formula.filter(|_| values::is_computed(given));
        let mut coding = coding::coding(&mut fields, given.value, formula);
        coding.reading = Some(given.name.clone());
        let kind = (main.kind, of_bus.as_ref());
        coding::commanded(&mut fields, &mut coding, direction, value.value, kind);
        let level = properties::level(&mut fields);
        let bare = fields.take_bare();
        drop(fields);
        let kind = of_bus.unwrap_or_else(|| main.read(self, diagnostics).0);
        let mut shown = properties::divided(own.shown, &kind, level.as_ref());
        shown.bare = bare;
        if let Err(message) = words::check(&kind, &coding, value.value, &self.protocol) {
            let driver = &self.driver.name.value;
            let message = format!("`{}` of `{driver}`: {message}", given.name);
            diagnostics.push(e0229_wrong_driver::wrong_driver(name.span, &message));
        }
        diagnostics.extend(self.outside((&kind, &coding), main, given, name.span));
        self.accept(&kind, value, given, diagnostics);
        let id = own.id.or(id.map(|value| Spanned { value, span: name.span }));
        // Unused connections are not among the part's connections.
        let place =
            |wanted: &usize| sockets.iter().take(*wanted).filter(|socket| socket.is_used).count();
        let numbers = given.via.iter().map(|wanted| self.next.connection.0 + place(wanted));
        let connections = numbers.map(ConnectionIndex).collect();
        let delay_ms = properties::delay_ms(own.delay_ms, &kind);
        Some(Device {
            part: self.next.part,
            name: name.clone(),
            block: *block,
            id: id.unwrap_or(Spanned { value: 0, span: name.span }),
            direction,
            value: *value,
            delay_ms,
            kind,
            kind_span: name.span,
            delay_span: own.delay_span,
            prio: own.prio,
            prio_span: own.prio_span,
            group: own.group,
            shown,
            coding,
            filter: own.filter,
            connections,
        })
    }

    /// Reports an array that has the wires of only one number.
    fn accept(
        &self,
        kind: &Kind,
        value: &Spanned<ValueType>,
        given: &DriverValue,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let has_wires = kind.name().spec().values.wires(value.value).is_some();
        if has_wires && !kind.is_train() && given.via.len() == 1 {
            let what = format!("a value of `{}`", self.driver.name.value);
            let can = "one number: an array of wires is a sensor or an actuator by itself";
            let found = value.value.to_string();
            let report = e0220_impossible_type::impossible_type(value.span, &what, &found, can);
            diagnostics.push(report);
        }
    }

    /// The wires of the connections in use, in the driver's order.
    fn connections(
        &self,
        devices: &[Device],
        sockets: &[Socket],
        board: Option<BoardIndex>,
        wishes: &[crate::design::Preference],
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<Connection> {
        if devices.is_empty() {
            return Vec::new();
        }
        let used = sockets.iter().filter(|socket| socket.is_used);
        used.map(|socket| {
            let (kind, placement, level) = socket.read(self, diagnostics);
            // Each answer has an end of its own.
            let speaks = devices.iter().any(|one| {
                let is_sensor = one.direction == Direction::Sensor;
                is_sensor && one.kind.uart().is_some_and(|own| own.exchange.request.is_empty())
            });
            let has_values = !self.given.is_empty() && speaks;
            if has_values && kind.uart().is_some_and(Uart::is_endless) {
                let message = "a message needs a `length`, or an `end`";
                let at = self.driver.name.span;
                diagnostics.push(e0229_wrong_driver::wrong_driver(at, message));
            }
            Connection {
                part: self.next.part,
                name: socket.name.clone(),
                element: None,
                device: socket.device.unwrap_or(self.next.device),
                kind,
                direction: socket.direction,
                board,
                placement,
                wishes: wishes.to_vec(),
                level,
            }
        })
        .collect()
    }

    fn part(
        self,
        board: Option<BoardIndex>,
        allows: Vec<crate::design::Allow>,
        devices: Vec<Device>,
        connections: Vec<Connection>,
    ) -> Option<ReadPart> {
        if devices.is_empty() {
            return None;
        }
        let (name, block) = (self.name, self.block);
        let driver = Some(self.driver.name.value.clone());
        let bounds = bounds::of(Some(self.driver), self.known);
        let module = module::of(Some(self.driver), self.known);
        let chip = Some(self.protocol);
        let part = Part { name, block, board, driver, allows, chip, bounds, module };
        Some(ReadPart { part, devices, connections, controller: None })
    }
}
