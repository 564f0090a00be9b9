//! The cost of damage: wrong values delivered, undamaged frames lost.
//!
//! `SENSEDSL_DAMAGED_FRAMES=1000000 cargo test -p sensedsl-tests decoders::damage -- --nocapture`
//! prints the table of `docs/wire.md`.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use sensedsl_tests::Random;
use sensedsl_wire::{Checksum, Direction, Schema};

use super::program::{Input, Program, rust, schema_bytes};
use super::streams::{fig2, frame};
use super::{OTHERS, scratch, tools};

/// The damage to a frame on its way.
#[derive(Clone, Copy, Debug)]
enum Mode {
    /// One bit is flipped.
    Bit,
    /// Of up to 16 consecutive bits, the first, the last and any of those between are flipped.
    Burst,
    /// Like `Burst`, but with 17 to 64 bits, which is more than a CRC-16 is guaranteed to detect.
    LongBurst,
    /// The end of the frame is missing.
    Torn,
    /// Some bytes are missing.
    Hole,
    /// Some bytes are repeated.
    Duplicate,
}

const MODES: [Mode; 6] =
    [Mode::Bit, Mode::Burst, Mode::LongBurst, Mode::Torn, Mode::Hole, Mode::Duplicate];

fn flip(bytes: &mut [u8], bit: usize) {
    bytes[bit / 8] ^= 0x80 >> (bit % 8);
}

fn damage(random: &mut Random, mode: Mode, bytes: &mut Vec<u8>) {
    let bits = bytes.len() * 8;
    let at = random.below(bytes.len());
    match mode {
        Mode::Bit => flip(bytes, random.below(bits)),
        Mode::Burst | Mode::LongBurst => {
            let length = if matches!(mode, Mode::Burst) {
                2 + random.below(15)
            } else {
                17 + random.below(48)
            };
            let from = random.below(bits - length + 1);
            flip(bytes, from);
            flip(bytes, from + length - 1);
            for bit in from + 1..from + length - 1 {
                if random.below(2) == 1 {
                    flip(bytes, bit);
                }
            }
        }
        Mode::Torn => bytes.truncate(at.max(1)),
        Mode::Hole => {
            let from = 1 + random.below(bytes.len() - 2);
            let to = from + 1 + random.below(bytes.len() - from - 1);
            drop(bytes.drain(from..to));
        }
        Mode::Duplicate => {
            let to = at + 1 + random.below((bytes.len() - at).min(bytes.len() - 1));
            let again = bytes[at..to].to_vec();
            bytes.splice(to..to, again);
        }
    }
}

/// Counts over all frames of a mode.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    damaged: usize,
    undamaged: usize,
    /// Frames delivered that were never sent.
    wrong: usize,
    /// Undamaged frames not delivered.
    lost: usize,
}

/// The frames of an answer by their payloads, without the end.
fn payloads(answer: &[u8]) -> Vec<&[u8]> {
    let mut payloads = Vec::new();
    let mut at = 0;
    while answer[at] != b'E' {
        // Frames that reach a host; the answer has no length for a hello or for health of another
        // version.
        let (start, size) = match answer[at] {
            b'H' => (at, 5),
            b'V' => (at, 2),
            _ => {
                let size = answer[at + 1..at + 5].try_into().unwrap();
                (at + 5, u32::from_be_bytes(size) as usize)
            }
        };
        payloads.push(&answer[start..start + size]);
        at = start + size;
    }
    payloads
}

/// A stream with about as many damaged as undamaged frames, and the answers of all decoders to it.
fn stream(
    random: &mut Random,
    schema: &Schema,
    mode: Mode,
    damaged: usize,
    program: &mut Program,
    counts: &mut Counts,
) {
    let mut stream = Vec::new();
    let mut sent = BTreeMap::new();
    let before = counts.damaged;
    let mut behind = 0;
    // The stream ends with two undamaged frames, so that no decoder waits for more.
    while behind < 2 {
        let mut payload = Vec::new();
        for (id, bytes) in [(17, 2), (18, 2), (19, 1), (20, 4)] {
            payload.push(id);
            payload.extend_from_slice(&random.next().to_be_bytes()[2..2 + bytes]);
        }
        let mut bytes = frame(schema, &payload);
        let is_end = counts.damaged - before == damaged;
        let is_damaged = !is_end && random.below(2) == 1;
        if is_damaged {
            damage(random, mode, &mut bytes);
            counts.damaged += 1;
        } else {
            counts.undamaged += 1;
            behind += usize::from(is_end);
        }
        stream.extend(bytes);
        sent.insert(payload, is_damaged);
    }
    let answer = rust(schema, Direction::Sensor, &stream, &[0]);
    let bytes = schema_bytes(schema, Direction::Sensor);
    let pieces = [1 + random.below(600) as u32, 1 + random.below(40) as u32];
    let input = Input { schema: &bytes, stream: &stream, pieces: &pieces };
    for who in OTHERS {
        assert!(program.say(who, input) == answer, "{who} says otherwise");
    }
    for payload in payloads(&answer) {
        if sent.remove(payload).is_none() {
            counts.wrong += 1;
            if schema.checksum.is_some() {
                let at = stream.windows(payload.len()).position(|window| window == payload);
                let at = at.unwrap_or_default();
                let around = &stream[at.saturating_sub(45)..(at + 60).min(stream.len())];
                println!("{mode:?}: wrong {payload:02x?} in {around:02x?}");
            }
        }
    }
    counts.lost += sent.values().filter(|&&is_damaged| !is_damaged).count();
}

#[test]
fn damage_costs_what_the_documentation_says() {
    if !tools(&["gcc", "g++"]) {
        return;
    }
    let wanted = std::env::var("SENSEDSL_DAMAGED_FRAMES").ok();
    let wanted = wanted.map_or(3000, |text| text.parse().expect("a number of frames"));
    let mut program = Program::build(&scratch("damage"), &["-O2", "-DDECODERS_C_FRAMES=2"]);
    let mut table = String::new();
    for mode in MODES {
        for checksum in Checksum::ALL {
            let schema = fig2(checksum);
            let mut random = Random::new(2014);
            let mut counts = Counts::default();
            while counts.damaged < wanted {
                let damaged = 5000.min(wanted - counts.damaged);
                stream(&mut random, &schema, mode, damaged, &mut program, &mut counts);
            }
            writeln!(table, "{mode:?} {} {counts:?}", checksum.name()).unwrap();
            if checksum.is_some() {
                assert_eq!(counts.lost, 0, "{mode:?}: an undamaged frame is lost");
                let is_promised = !matches!(mode, Mode::LongBurst);
                let most = match checksum {
                    Checksum::Crc32 => 0,
                    _ if is_promised => wanted / 300_000,
                    _ => wanted / 300,
                };
                assert!(counts.wrong <= most, "{mode:?}: {} wrong", counts.wrong);
            }
        }
    }
    println!("{table}");
}
