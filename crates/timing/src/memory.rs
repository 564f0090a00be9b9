//! Memory: whether the values, buffers and stacks of a board fit. Otherwise only the linker would
//! refuse a program that does not.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0626_memory_full::memory_full;
use sensedsl_model::design::Design;
use sensedsl_model::kind::{Interface, Kind};
use sensedsl_wire::{Direction, ScalarType};

use crate::context::{Context, Wired};
use crate::converters::depth;
use crate::strips;

/// Kernel, drivers, shell, and the stacks for startup and interrupts, with a reserve: 5 to 6 KiB
/// are used.
const BASE_BYTES: u64 = 8 * 1_024;
/// A thread with its stack.
const THREAD_BYTES: u64 = 1_152;
/// What the runtime stores for a device besides its value.
const DEVICE_BYTES: u64 = 128;
/// A sample of a converter.
const SAMPLE_BYTES: u64 = 2;
/// Frames to the board that are stored: one that is arriving, and those in which it is looked for.
const FRAMES_TO_BOARD: u64 = 4;

/// Reports a board that cannot hold what it is asked to.
pub(crate) fn full(design: &Design, context: &Context<'_>) -> Option<Diagnostic> {
    let ram_bytes = context.system()?.ram_bytes?;
    let needed = needed_bytes(design, context);
    if needed <= u64::from(ram_bytes) {
        return None;
    }
    let greedy = context
        .devices
        .iter()
        .max_by_key(|wired| own_bytes(&wired.device.kind, wired.device.value.value))?;
    let (name, span) = (&greedy.device.name.value, greedy.device.name.span);
    let (needed, there) = (needed.div_ceil(1_024), ram_bytes / 1_024);
    Some(memory_full(span, &context.board.name.value, name, needed, there))
}

fn own_bytes(kind: &Kind, value: sensedsl_wire::ValueType) -> u64 {
    let elements = value.count() as u64;
    let value = value.size_bytes() as u64;
    let buffers = match kind.interface() {
        Interface::Analog(analog) => u64::from(analog.samples) * SAMPLE_BYTES,
        Interface::I2c(i2c) => value + u64::from(i2c.length_bytes),
        // A frame of pulses is several times as large as the colours in it.
        Interface::Spi(spi) => {
            value + strips::usual_bytes(kind, elements).unwrap_or(spi.length_bytes.into())
        }
        Interface::OneWire(own) => value + u64::from(own.answer_bytes()),
        Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Digital(_)
        | Interface::Uart(_)
        | Interface::Pwm(_)
        | Interface::Dac(_)
        | Interface::Can(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => 0,
    };
    value + buffers
}

fn needed_bytes(design: &Design, context: &Context<'_>) -> u64 {
    let indices: Vec<_> = context.devices.iter().map(|wired| wired.index).collect();
    let schema = design.schema(context.wiring.board, &indices);
    let word = ScalarType::Float64.size_bytes();
    let value = |bytes: usize| bytes.next_multiple_of(word) as u64;
    let values = schema.items.iter().map(|item| value(item.value.size_bytes()));
    let frames = schema.frame_bytes_max(Direction::Sensor) as u64
        + FRAMES_TO_BOARD * schema.frame_bytes_max(Direction::Actuator) as u64;
    let largest = values.clone().max().unwrap_or(0);
    let groups = context.classes(|wired| Some(wired.device.kind.analog()?.samples));
    let samples = groups.values().map(|sensors| {
        let rows = u64::from(depth(sensors.iter().map(|(_, samples)| *samples)));
        rows * sensors.len() as u64 * SAMPLE_BYTES
    });
    let on_bus = |wired: &Wired<'_>| {
        let own = match wired.device.kind.interface() {
            Interface::I2c(i2c) => i2c.start.len() as u64 + u64::from(i2c.length_bytes),
            Interface::Spi(spi) => u64::from(spi.length_bytes),
            Interface::Analog(_)
            | Interface::Icu(_)
            | Interface::Encoder(_)
            | Interface::Digital(_)
            | Interface::Uart(_)
            | Interface::Pwm(_)
            | Interface::Dac(_)
            | Interface::Can(_)
            | Interface::OneWire(_)
            | Interface::Stepper(_)
            | Interface::Code(_) => return None,
        };
        Some(strips::sent(context, wired).unwrap_or(own) + 1 + largest)
    };
    let classes = context.classes(on_bus);
    let work =
        classes.values().map(|devices| devices.iter().map(|(_, bytes)| *bytes).max().unwrap_or(0));
    let threads = (groups.len() + classes.len() + 1) as u64;
    BASE_BYTES
        + threads * THREAD_BYTES
        + context.devices.len() as u64 * DEVICE_BYTES
        + values.sum::<u64>()
        + 2 * largest
        + frames
        + samples.sum::<u64>()
        + work.sum::<u64>()
}
