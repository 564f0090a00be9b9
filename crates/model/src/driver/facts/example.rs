//! An example of a part: what is known about it in, a few lines that use it in a typical way out.

use sensedsl_wire::Direction;

use super::{PartFacts, ValueFacts, head_of_device};
use crate::kind::{Interface, Sharing};

/// The board of most examples, because many people have it.
pub const EXAMPLE_BOARD: &str = "NUCLEO_F446RE";
/// The board for a part with inverted wires, which the serial ports of the other board do not
/// support.
const INVERTING_BOARD: &str = "NUCLEO_F303RE";
/// Most lines in an example.
const LINES_MAX: usize = 10;
/// Cycle times of the sensors in examples; the longer ones are for sensors that take longer to
/// measure.
const DELAYS_MS: [u32; 4] = [100, 200, 1_000, 2_000];

/// A board with the part, in the canonical layout and at most ten lines: a chip with its first
/// values, or a device if there is only one.
#[must_use]
pub fn example(part: &PartFacts) -> String {
    example_on(part, example_board(part))
}

/// The part of [`example`] that stands in the board's block, as lines without the block's indentation.
#[must_use]
pub fn snippet(part: &PartFacts) -> String {
    let example = example(part);
    let lines: Vec<&str> = example.lines().collect();
    let inner = lines.get(1..lines.len().saturating_sub(1)).unwrap_or_default();
    let inner = inner.iter().map(|line| line.strip_prefix("    ").unwrap_or(line));
    inner.map(|line| format!("{line}\n")).collect()
}

/// The board for a part's example.
#[must_use]
pub fn example_board(part: &PartFacts) -> &'static str {
    let is_inverted = |one: &ValueFacts| one.kind.uart().is_some_and(|uart| uart.is_inverted);
    let inverts = part.values.iter().any(is_inverted);
    if inverts { INVERTING_BOARD } else { EXAMPLE_BOARD }
}

/// Like [`example`], on another board.
#[must_use]
pub fn example_on(part: &PartFacts, board: &str) -> String {
    let mut lines = vec![format!("board Robot on {board} {{")];
    let mut own = vec![format!("driver = {};", part.name)];
    if let (None, Some(first)) = (part.address, part.addresses.first()) {
        own.push(format!("address = {first:#04X};"));
    }
    own.extend(delay_ms(part).map(|ms| format!("delay = {ms} ms;")));
    let own = own.iter().map(|line| format!("        {line}"));
    let name = camel(&part.name);
    match part.values.as_slice() {
        [only] if only.name.is_none() => {
            lines.push(format!("    {} {{", head_of_device(&name, only.direction, only.value)));
            lines.extend(own);
        }
        values => {
            lines.push(format!("    chip {name} {{"));
            lines.extend(own);
            let room = LINES_MAX.saturating_sub(lines.len() + 2);
            lines.extend(shown(values, room).iter().map(|one| {
                let name = camel(one.name.as_deref().unwrap_or_default());
                format!("        {} {{}}", head_of_device(&name, one.direction, one.value))
            }));
        }
    }
    lines.extend(["    }".to_owned(), "}".to_owned(), String::new()]);
    lines.join("\n")
}

/// The first values, without those that are part of another one, and with at least one in each
/// direction.
fn shown(values: &[ValueFacts], room: usize) -> Vec<&ValueFacts> {
    let mut shown: Vec<&ValueFacts> = Vec::new();
    for value in values {
        if shown.len() < room && !shown.iter().any(|other| holds(other, value)) {
            shown.push(value);
        }
    }
    let is_shown = |way| shown.iter().any(|one| one.direction == way);
    let other = values.iter().find(|one| !is_shown(one.direction));
    if let Some(other) = other {
        shown.truncate(room.saturating_sub(1));
        shown.push(other);
    }
    shown
}

/// Whether the registers of a value are among those of another, longer value.
fn holds(whole: &ValueFacts, part: &ValueFacts) -> bool {
    let place = |one: &ValueFacts| {
        let own = one.kind.register_access().filter(|own| own.address.is_some())?;
        let first = u32::from(own.register?);
        Some((first, first + u32::from(own.length_bytes)))
    };
    let (Some(outer), Some(inner)) = (place(whole), place(part)) else { return false };
    let same_way = whole.direction == part.direction;
    let longer = outer.1 - outer.0 > inner.1 - inner.0;
    same_way && longer && outer.0 <= inner.0 && inner.1 <= outer.1
}

/// A cycle time that suits the part; none if the part sends on its own or is sent to, or if
/// its driver states one.
#[must_use]
pub fn delay_ms(part: &PartFacts) -> Option<u32> {
    let asked = |one: &&ValueFacts| {
        one.direction == Direction::Sensor && !matches!(one.kind.interface(), Interface::Uart(_))
    };
    let asked: Vec<&ValueFacts> = part.values.iter().filter(asked).collect();
    if part.has_own_delay || asked.iter().any(|one| one.kind.measures_itself()) {
        return None;
    }
    // All values on a bus are measured one after the other.
    let times = || asked.iter().map(|one| one.kind.measuring_us().div_ceil(1_000));
    let is_bus = asked.first()?.kind.name().spec().sharing != Sharing::Own;
    let takes: u32 = if is_bus { times().sum() } else { times().max().unwrap_or(0) };
    let rests = asked.iter().filter_map(|one| one.kind.onewire()).map(|own| own.rest_us / 1_000);
    let rests = rests.max().unwrap_or(0);
    let mut delays = DELAYS_MS.into_iter().filter(|delay| *delay >= rests);
    delays.find(|delay| takes.saturating_mul(5) <= delay.saturating_mul(4))
}

/// `magnetic_field` becomes `MagneticField`.
fn camel(name: &str) -> String {
    let words = name.split('_').map(|word| {
        let mut letters = word.chars();
        let first = letters.next().map(|letter| letter.to_ascii_uppercase());
        first.into_iter().chain(letters).collect::<String>()
    });
    words.collect()
}
