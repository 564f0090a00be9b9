//! The boards of a fleet: designs with their worlds by a seed in, and what each value must be at which time.
//!
//! A design has identifiers for 254 devices, so that a thousand boards are several *groups*, a design and a monitor
//! each. Their boards and devices have the same names: only the prefix of the keys tells them apart.

use crate::mutants::Chance;

/// The values of a board.
pub(super) const VALUES: usize = 4;
/// The most boards in a group: an identifier for each device.
const GROUP_MAX: usize = 254 / VALUES;
/// How fast the analog values of all boards move, in codes of the converter a second.
const CODES_A_SECOND: f64 = 10.0;
/// For how long they do so: a converter of twelve bits has no room for more.
pub(super) const LASTS_S: u64 = 300;
/// The most codes at which they begin.
const START_MAX: usize = 1_000;
/// The boards that are drawn.
const MCUS: [&str; 8] = [
    "NUCLEO_F767ZI",
    "STM32F4DiscoveryBoard",
    "NUCLEO_F446RE",
    "NUCLEO_F411RE",
    "NUCLEO_G474RE",
    "NUCLEO_L476RG",
    "NUCLEO_H743ZI",
    "Pico",
];

/// Some boards with one monitor.
pub(super) struct Group {
    /// The first words of its keys, and the name of its files.
    pub(super) name: String,
    pub(super) design: String,
    pub(super) world: String,
    pub(super) boards: usize,
    /// Each key below its prefix, and what it carries.
    pub(super) keys: Vec<(String, Course)>,
}

/// What a device measures.
#[derive(Clone, Copy, Debug)]
pub(super) enum Course {
    /// One more each time: which values are missing can be seen in the values.
    Counts,
    /// A quantity that begins there, and grows or shrinks by so much a second.
    Moves { start: f64, a_second: f64 },
}

impl Course {
    /// Whether that is the value at a board's time, with values so many times a second: a value is at most a period old.
    pub(super) fn is_at(self, value: f64, at_s: f64, rate_hz: f64) -> bool {
        let (expected, tolerance) = match self {
            Self::Counts => (at_s * rate_hz, 1.5),
            Self::Moves { start, a_second } => {
                (start + at_s * a_second, 2.0 + a_second.abs() / rate_hz)
            }
        };
        (value - expected).abs() <= tolerance
    }
}

/// So many boards in groups, each with [`VALUES`] values so many times a second.
pub(super) fn groups(boards: usize, rate_hz: u32, seed: u64) -> Vec<Group> {
    let count = boards.div_ceil(GROUP_MAX);
    let sizes = (0..count).map(|at| boards / count + usize::from(at < boards % count));
    sizes
        .enumerate()
        .map(|(at, size)| group(at, size, rate_hz, &mut Chance::of(seed, at)))
        .collect()
}

fn group(at: usize, boards: usize, rate_hz: u32, chance: &mut Chance) -> Group {
    let (mut design, mut world, mut keys) = (String::new(), "[devices]\n".to_owned(), Vec::new());
    let delay_ms = 1_000 / rate_hz.max(1);
    for number in 1..=boards {
        let board = format!("B{number:02}");
        let mcu = MCUS.get(chance.below(MCUS.len())).copied().unwrap_or_default();
        let id = (number - 1) * VALUES;
        design.push_str(&format!(
            "board {board} on {mcu} {{\n    \
             sensor Count{number:02} returns uint32 {{ id = {}; type = icu; }}\n    \
             sensor Turns{number:02} returns int32 {{ id = {}; type = encoder; }}\n    \
             sensor Level{number:02} returns uint16 {{ id = {}; type = analog; delay = {delay_ms} ms; }}\n    \
             sensor Light{number:02} returns uint16 {{ id = {}; type = analog; delay = {delay_ms} ms; }}\n    \
             link {{ stamp = true; checksum = crc16; }}\n}}\n",
            id + 1, id + 2, id + 3, id + 4
        ));
        for name in ["Count", "Turns"] {
            world.push_str(&format!("{name}{number:02} = {{ rate = {rate_hz} }}\n"));
            keys.push((format!("{board}/{name}{number:02}"), Course::Counts));
        }
        let codes = CODES_A_SECOND * LASTS_S as f64;
        let low = chance.below(START_MAX) as f64;
        let high = chance.below(START_MAX) as f64 + codes;
        for (name, start, end) in [("Level", low, low + codes), ("Light", high, high - codes)] {
            let ramp = format!("{{ ramp = [{start}, {end}], over = \"{LASTS_S} s\" }}");
            world.push_str(&format!("{name}{number:02} = {ramp}\n"));
            let a_second = (end - start) / LASTS_S as f64;
            keys.push((format!("{board}/{name}{number:02}"), Course::Moves { start, a_second }));
        }
    }
    Group { name: format!("fleet/g{:02}", at + 1), design, world, boards, keys }
}
