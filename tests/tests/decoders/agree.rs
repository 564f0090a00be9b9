//! All decoders say the same, and what the definition says, however a stream is cut.

use sensedsl_tests::Random;
use sensedsl_wire::{Checksum, Direction, Schema};

use crate::program::{Program, rust, schema_bytes};
use crate::streams::{hard_schemas, hard_stream};
use crate::{naive, scratch, tools};

/// How often; the variable is for long runs.
fn rounds(usual: usize) -> usize {
    let wanted = std::env::var("SENSEDSL_DECODER_ROUNDS").ok();
    wanted.map_or(usual, |text| text.parse().expect("SENSEDSL_DECODER_ROUNDS is a number"))
}

fn cuts(random: &mut Random) -> Vec<u32> {
    match random.below(3) {
        0 => vec![0],
        1 => vec![1],
        _ => (0..1 + random.below(6)).map(|_| 1 + random.below(40) as u32).collect(),
    }
}

fn cases(seed: u64, rounds: usize, mut check: impl FnMut(&Schema, Direction, &[u8], &[u32])) {
    let mut random = Random::new(seed);
    for checksum in [Checksum::None, Checksum::Crc16] {
        for schema in hard_schemas(checksum) {
            for round in 0..rounds {
                let direction =
                    if round % 4 == 3 { Direction::Actuator } else { Direction::Sensor };
                let depth = random.below(4);
                let stream = hard_stream(&mut random, &schema, direction, 9, depth);
                check(&schema, direction, &stream, &cuts(&mut random));
            }
        }
    }
}

#[test]
fn rust_says_what_the_definition_says() {
    let (mut frames, mut streams) = (0, 0);
    cases(1, rounds(120), |schema, direction, stream, pieces| {
        let wanted = naive::decode(schema, direction, stream);
        let at_once = rust(schema, direction, stream, &[0]);
        assert_eq!(at_once, wanted, "{schema:?} {direction:?} {stream:02x?}");
        let in_pieces = rust(schema, direction, stream, pieces);
        assert_eq!(in_pieces, wanted, "{schema:?} {direction:?} {stream:02x?} {pieces:?}");
        streams += 1;
        frames += u32::from(wanted.len() > 9);
    });
    assert!(frames > streams / 2, "only {frames} of {streams} streams had a frame");
}

#[test]
fn c_and_cpp_say_what_the_definition_says() {
    if !tools(&["gcc", "g++"]) {
        return;
    }
    // The buffer of the decoder in C is one frame here: the least it works with.
    let flags = ["-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    let flags = [&flags[..], &["-DDECODERS_C_FRAMES=1"]].concat();
    let mut program = Program::build(&scratch("agree"), &flags);
    cases(2, rounds(25), |schema, direction, stream, pieces| {
        let wanted = naive::decode(schema, direction, stream);
        let schema_bytes = schema_bytes(schema, direction);
        for who in ["c", "cpp"] {
            for pieces in [&[0][..], &[1], pieces] {
                let answer = program.say(who, &schema_bytes, stream, pieces);
                assert_eq!(answer, wanted, "{who} {schema:?} {stream:02x?} {pieces:?}");
            }
        }
    });
}
