//! What the hardware will not do although the file asks for it: a design in, reports out.

use std::collections::BTreeMap;

use sensedsl_diagnostics::codes::{
    e0241_asked_too_often, e0242_same_rom, e0506_hardware_limit, h0710_motor_goes_on,
    w0601_unused_property, w0602_slower_than_asked, w0603_narrow_type,
};
use sensedsl_diagnostics::{Diagnostic, Span};
use sensedsl_wire::{Direction, ValueType};

use super::{bounds, ranges};
use crate::design::{Design, Device, Transport};
use crate::kind::Interface;
use crate::kind::onewire::Rom;
use crate::part::reach;

/// Bits of one ADC conversion on all profiles; the driver scales wider ones.
const ADC_BITS: u32 = 12;

/// The widest number that the runtime takes from a device, in bytes.
const ELEMENT_BYTES_MAX: usize = 8;

/// Adds the warnings for all devices.
pub(crate) fn run(design: &Design, diagnostics: &mut Vec<Diagnostic>) {
    for device in &design.devices {
        diagnostics.extend(unused_pace(device));
        // The values of a chip are asked together.
        let slow = too_slow(design, device).filter(|one| diagnostics.last() != Some(one));
        diagnostics.extend(slow);
        diagnostics.extend(narrow(device));
        diagnostics.extend(impossible_length(device));
        diagnostics.extend(goes_on(design, device));
    }
    diagnostics.extend(same_rom(design));
    bounds::check(design, diagnostics);
    ranges::check(design, diagnostics);
}

/// Hints at a motor that nothing stops when the host falls silent.
fn goes_on(design: &Design, device: &Device) -> Option<Diagnostic> {
    let board = design.part(device.part)?.board.and_then(|board| design.board(board));
    let is_linked = board.is_none_or(|board| board.link.transport != Transport::None);
    let is_motor = device.direction == Direction::Actuator && device.coding.drive.is_some();
    let name = &device.name;
    let failsafe = device.coding.failsafe.or_else(|| device.kind.failsafe());
    (is_motor && is_linked && failsafe.is_none())
        .then(|| h0710_motor_goes_on::motor_goes_on(name.span, &name.value))
}

/// Warns of a cycle time or priority for a device that the hardware measures on its own.
fn unused_pace(device: &Device) -> Vec<Diagnostic> {
    if !device.kind.measures_itself() {
        return Vec::new();
    }
    let written = [("delay", device.delay_span), ("prio", device.prio_span)];
    let why = if device.kind.stepper().is_some() {
        "a timer makes and counts the steps by itself"
    } else if device.kind.code().is_some() {
        "nothing measures it; the controller that sets it has a cycle and a priority"
    } else {
        "the timer sees every edge by itself"
    };
    let kind = device.kind.name().name();
    let unused = |(name, at): (&str, Option<Span>)| {
        let mut unused = w0601_unused_property::unused_property(at?, name, kind, why);
        // What a chip or a driver says may count for other devices.
        let (block, at) = (device.block, unused.primary.span);
        if at.file != block.file || at.start < block.start || at.end > block.end {
            unused.fixes.clear();
        }
        Some(unused)
    };
    written.into_iter().filter_map(unused).collect()
}

fn too_slow(design: &Design, device: &Device) -> Option<Diagnostic> {
    let (wait_us, wait_span) = match device.kind.interface() {
        Interface::I2c(own) => (own.wait_us, own.wait_span),
        Interface::OneWire(own) => (own.wait_us.max(own.rest_us), own.wait_span),
        Interface::Analog(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Digital(_)
        | Interface::Uart(_)
        | Interface::Spi(_)
        | Interface::Pwm(_)
        | Interface::Dac(_)
        | Interface::Can(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => return None,
    };
    if u64::from(wait_us) <= u64::from(device.delay_ms) * 1_000 {
        return None;
    }
    let must_rest = device.kind.onewire().is_some_and(|own| own.rest_us > 0);
    let at = device.delay_span.or(if must_rest { Some(device.name.span) } else { wait_span })?;
    let needs_ms = wait_us.div_ceil(1_000).to_string();
    let part = design.part(device.part).filter(|_| must_rest);
    let part = part.map_or(&device.name, |part| &part.name);
    let asked = (part.value.as_str(), part.span, device.delay_span);
    let delay_ms = device.delay_ms.to_string();
    let source = wait_span.filter(|wait| *wait != at);
    let report = if must_rest {
        e0241_asked_too_often::asked_too_often
    } else {
        w0602_slower_than_asked::slower_than_asked
    };
    Some(report(at, asked, &needs_ms, &delay_ms, source))
}

/// Reports parts on 1-Wire that have one address: there is one part of each in the world.
fn same_rom(design: &Design) -> Vec<Diagnostic> {
    let mut first: BTreeMap<Rom, (&str, Span)> = BTreeMap::new();
    let mut reports = Vec::new();
    for wires in &design.connections {
        let Some(own) = wires.kind.onewire() else { continue };
        let (Some(rom), Some(part)) = (own.rom, design.part(wires.part)) else { continue };
        let at = own.rom_span.unwrap_or(part.name.span);
        let name = part.name.value.as_str();
        match first.get(&rom) {
            Some((other, before)) => {
                reports.push(e0242_same_rom::same_rom((at, name), (*before, other), &rom.shown()));
            }
            None => {
                first.insert(rom, (name, at));
            }
        }
    }
    reports
}

/// Reports an I2C device whose bytes are not whole elements that a value can hold.
fn impossible_length(device: &Device) -> Option<Diagnostic> {
    let i2c = device.kind.i2c()?;
    if !device.coding.is_plain() {
        return None;
    }
    let value = device.coding.of.unwrap_or(device.value.value);
    let length = usize::from(i2c.length_bytes);
    let element = length.checked_div(value.count()).unwrap_or_default();
    let element_max = match device.direction {
        Direction::Sensor => ELEMENT_BYTES_MAX,
        Direction::Actuator => value.scalar.size_bytes(),
    };
    if element > 0 && element <= element_max && element * value.count() == length {
        return None;
    }
    let name = &device.name.value;
    let message = format!("{length} bytes of {name} do not make a {value}");
    let help = format!("each element takes 1 to {element_max} bytes: change `length` or the type");
    Some(e0506_hardware_limit::hardware_limit(device.value.span, &message, &help))
}

fn narrow(device: &Device) -> Option<Diagnostic> {
    let value = device.value.value;
    if device.kind.name().spec().values.accept(value).is_err() {
        return None;
    }
    if device.coding.reading.is_some() {
        return narrower_than_reading(device);
    }
    let (_, most) = value.scalar.integer_range()?;
    let (bits, wider) = match device.kind.interface() {
        Interface::Analog(_) => (ADC_BITS, like(value, "uint16")),
        Interface::I2c(i2c) if value.length.is_none() => of_bytes(i2c.length_bytes)?,
        // Other bytes are compared with the value's type where their words are read.
        Interface::I2c(_)
        | Interface::Spi(_)
        | Interface::Uart(_)
        | Interface::Can(_)
        | Interface::OneWire(_) => return None,
        Interface::Icu(_) | Interface::Encoder(_) | Interface::Digital(_) => return None,
        Interface::Pwm(_) | Interface::Dac(_) => return None,
        Interface::Stepper(_) | Interface::Code(_) => return None,
    };
    let value_bits = u32::try_from(value.scalar.size_bytes() * 8).ok()?;
    if value_bits >= bits.next_power_of_two() || most.checked_shr(bits).is_some_and(|high| high > 0)
    {
        return None;
    }
    let range = if bits <= MANY_BITS {
        format!("0 to {}", (1_u64 << bits) - 1)
    } else {
        format!("{} bytes", bits / 8)
    };
    let found = value.to_string();
    let holds = Some(wider.as_str()).filter(|wider| !wider.contains(' '));
    Some(w0603_narrow_type::narrow_type(device.value.span, (&found, &range), &wider, holds))
}

/// A type with as many elements as another one.
pub(super) fn like(value: ValueType, scalar: &str) -> String {
    value.length.map_or_else(|| scalar.to_owned(), |length| format!("{scalar}[{length}]"))
}

/// Warns of a value of a chip with fewer bits than its driver's reading.
fn narrower_than_reading(device: &Device) -> Option<Diagnostic> {
    let (own, of) = (device.value.value, device.coding.of?);
    let (of_least, of_most) = of.scalar.integer_range()?;
    let (held, of_type) = (reach::of_type(own.scalar)?, reach::of_type(of.scalar)?);
    // Of a word with fewer `bits` than its type, only what these make comes.
    let part = reach::of_part(&device.kind, &device.coding, of).unwrap_or(of_type);
    if (held.0 <= part.0 && held.1 >= part.1) || device.direction == Direction::Actuator {
        return None;
    }
    let range = if part == of_type {
        format!("{of_least} to {of_most}")
    } else {
        format!("{} to {}", part.0, part.1)
    };
    let found = own.to_string();
    let wider = of.to_string();
    Some(w0603_narrow_type::narrow_type(device.value.span, (&found, &range), &wider, Some(&wider)))
}

/// Ranges of more bits than this are reported in bytes.
const MANY_BITS: u32 = 32;

/// The bits of a register of that many bytes, and a type that holds them: a number if one has that
/// size, otherwise an array, because that many bytes are several numbers.
fn of_bytes(length_bytes: u16) -> Option<(u32, String)> {
    let bits = u32::from(length_bytes) * 8;
    let wider = match length_bytes {
        0 | 1 => return None,
        2 => "uint16".to_owned(),
        3 | 4 => "uint32".to_owned(),
        8 => "uint64".to_owned(),
        even if even % 2 == 0 => format!("an array such as int16[{}]", even / 2),
        odd => format!("an array such as uint8[{odd}]"),
    };
    Some((bits, wider))
}
