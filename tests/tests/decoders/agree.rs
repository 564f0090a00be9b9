//! All decoders agree with each other and with the definition, however a stream is cut.

use sensedsl_tests::{Random, few, is_thorough};
use sensedsl_wire::{Checksum, Direction, ScalarType, Schema};

use super::program::{Answer, Input, Program, rust, schema_bytes};
use super::streams::{frame, hard_schemas, hard_stream, overlapping_walks, schema, wide_schema};
use super::{OTHERS, naive, scratch, tools};

/// The number of rounds; the variable is for long runs.
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
    for checksum in Checksum::ALL {
        for schema in hard_schemas(checksum) {
            for round in 0..rounds {
                let direction =
                    if round % 4 == 3 { Direction::Actuator } else { Direction::Sensor };
                let depth = random.below(4);
                let stream = hard_stream(&mut random, &schema, direction, 9, depth);
                check(&schema, direction, &stream, &cuts(&mut random));
            }
        }
        let schema = wide_schema(checksum);
        for _ in 0..rounds {
            let parts = 1 + random.below(3);
            let stream: Vec<u8> =
                (0..parts).flat_map(|_| overlapping_walks(&mut random, &schema)).collect();
            check(&schema, Direction::Sensor, &stream, &cuts(&mut random));
        }
    }
}

#[test]
fn rust_says_what_the_definition_says() {
    let (mut frames, mut streams) = (0, 0);
    cases(1, rounds(if is_thorough() { 120 } else { 3 }), |schema, direction, stream, pieces| {
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
    for (folder, more) in few(&BUILDS, 1) {
        c_and_cpp_agree(folder, more);
    }
}

/// The configurations of the C decoder, the default first. Its buffer is one frame here: the
/// minimum that it works with.
const BUILDS: [(&str, &[&str]); 4] = [
    ("agree", &["-DDECODERS_C_FRAMES=1"]),
    ("agree-more", &["-DDECODERS_C_FRAMES=1", "-DUP_DECODER_WALKS=3U"]),
    ("agree-plain", &["-DDECODERS_C_FRAMES=1", "-DDECODERS_C_MEMO=0"]),
    ("agree-none", &["-DDECODERS_C_FRAMES=1", "-DUP_DECODER_WALKS=0U"]),
];

fn c_and_cpp_agree(folder: &str, more: &[&str]) {
    let flags = ["-O1", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];
    let mut program = Program::build(&scratch(folder), &[&flags, more].concat());
    cases(2, rounds(if is_thorough() { 25 } else { 2 }), |schema, direction, stream, pieces| {
        let wanted = naive::decode(schema, direction, stream);
        let schema_bytes = schema_bytes(schema, direction);
        for who in OTHERS {
            for pieces in [&[0][..], &[1], pieces] {
                let answer = program.say(who, Input { schema: &schema_bytes, stream, pieces });
                assert_eq!(answer, wanted, "{who} {schema:?} {stream:02x?} {pieces:?}");
            }
        }
    });
}

/// A frame with a wrong checksum whose value contains two frames: one with a right checksum,
/// although one of its bools is 2, and a good one.
fn bools_within_a_failed_frame(checksum: Checksum) -> (Schema, Vec<u8>) {
    let schema = schema(checksum, &[(b'a', ScalarType::Uint8, 400), (1, ScalarType::Bool, 100)]);
    let mut bools = [[1].as_slice(), &[0; 100]].concat();
    let good = frame(&schema, &bools);
    bools[50] = 2;
    let mut value = [frame(&schema, &bools), good].concat();
    value.resize(400, 7);
    let mut stream = frame(&schema, &[b"a", &value[..]].concat());
    let crc = stream.len() - 2;
    stream[crc] ^= 1;
    (schema, stream)
}

/// All decoders must agree with the definition on the streams: at once, byte by byte and in pieces.
fn all_agree(folder: &str, schema: &Schema, streams: &[Vec<u8>]) {
    let bytes = schema_bytes(schema, Direction::Sensor);
    let has_tools = tools(&["gcc", "g++"]);
    let mut program =
        has_tools.then(|| Program::build(&scratch(folder), &["-O0", "-DDECODERS_C_FRAMES=1"]));
    for stream in streams {
        let wanted = naive::decode(schema, Direction::Sensor, stream);
        for pieces in [0, 1, 64] {
            let answer = rust(schema, Direction::Sensor, stream, &[pieces]);
            assert_eq!(answer, wanted, "{pieces} {stream:02x?}");
            for who in OTHERS {
                if let Some(program) = &mut program {
                    let answer =
                        program.say(who, Input { schema: &bytes, stream, pieces: &[pieces] });
                    assert_eq!(answer, wanted, "{who} {pieces} {stream:02x?}");
                }
            }
        }
    }
}

#[test]
fn sums_excuse_no_value() {
    for (checksum, folder) in [(Checksum::Crc16, "sums"), (Checksum::Crc32, "sums-crc32")] {
        let (schema, stream) = bools_within_a_failed_frame(checksum);
        assert!(naive::decode(&schema, Direction::Sensor, &stream).contains(&b'R'));
        all_agree(folder, &schema, &[stream]);
    }
}

/// A frame of `first` and all of `chain`, within two frames that fail after it. The first of the
/// two only walks; the second leaves leaps over the chain, and the inner frame meets these.
fn frame_over_leaps(schema: &Schema, first: u8, chain: &[u8]) -> Vec<u8> {
    let mut payload = vec![first, 0];
    payload.extend(chain.iter().flat_map(|&id| [id, 0]));
    let inner = frame(schema, &payload);
    let second = frame(schema, &[b"b", &inner[..]].concat());
    frame(schema, &[b"a", &second[..]].concat())
}

#[test]
fn leaps_excuse_no_repeat() {
    // The chain has neither the fresh identifier nor `a` or `b`; each leap has some of each quarter
    // of all identifiers.
    let (chain, fresh): (Vec<u8>, u8) =
        ((0..49_u16).map(|at| (1 + at * 10 % 49 * 5) as u8).collect(), 2);
    let folders = ["leaps", "leaps-crc16", "leaps-crc32"];
    for (checksum, folder) in Checksum::ALL.into_iter().zip(folders) {
        // The values of `a` and `b` end where the chain starts.
        let mut items = vec![(b'a', ScalarType::Uint8, 11), (b'b', ScalarType::Uint8, 6)];
        items.extend(chain.iter().chain([&fresh]).map(|&id| (id, ScalarType::Uint8, 1)));
        let schema = schema(checksum, &items);
        let good = frame_over_leaps(&schema, fresh, &chain);
        assert!(naive::decode(&schema, Direction::Sensor, &good).contains(&b'R'));
        // Repeats each identifier of the chain, so that the repeat is at every position within a
        // leap.
        let mut streams: Vec<Vec<u8>> =
            chain.iter().map(|&first| frame_over_leaps(&schema, first, &chain)).collect();
        // Also repeats each of them after the leaps.
        let (_, others) = chain.split_last().unwrap();
        let again = others.iter().map(|&last| [others, &[last]].concat());
        streams.extend(again.map(|chain| frame_over_leaps(&schema, fresh, &chain)));
        for stream in &streams {
            let nothing = Answer::default().end(0, stream.len() as u64);
            assert_eq!(naive::decode(&schema, Direction::Sensor, stream), nothing);
        }
        streams.push(good);
        all_agree(folder, &schema, &streams);
    }
}

/// The identifiers on two paths through the same bytes: one path takes a byte as an identifier and
/// the next as its value; the other path is offset by one byte.
const WAYS: (std::ops::Range<u8>, std::ops::Range<u8>) = (150..168, 170..187);

fn schema_of_ways() -> Schema {
    // The values of `a` and `b` end where the paths start.
    let mut items = vec![(b'a', ScalarType::Uint8, 8), (b'b', ScalarType::Uint8, 5)];
    let others = WAYS.0.chain(WAYS.1).chain([b',', b'f', 200]);
    items.extend(others.map(|id| (id, ScalarType::Uint8, 1)));
    schema(Checksum::None, &items)
}

#[test]
fn one_walk_does_not_stand_for_another() {
    let schema = schema_of_ways();
    // `a` takes the first path and `b` the second, each until its length ends within an item; `f`
    // is a frame that continues on the second path, up to an identifier of the first.
    let mut bytes: Vec<u8> = WAYS.0.zip(WAYS.1.chain(*b",")).flat_map(<[u8; 2]>::from).collect();
    assert_eq!(bytes.pop(), Some(b','), "{bytes:?}");
    let ends_a = bytes.len();
    bytes.extend([b',', 0, 200, b',']);
    let ends_b = bytes.len() - 1;
    bytes.extend([150, 0, b',']);
    let [a, b, f] = [("a", 1 + 8, ends_a), ("b", 1 + 4, ends_b), ("f", 1, bytes.len() - 1)]
        .map(|(id, head, end)| format!("{}:{id}", head + end).into_bytes());
    let stream = [a, b, f, bytes].concat();
    assert!(naive::decode(&schema, Direction::Sensor, &stream).contains(&b'R'));
    all_agree("walks", &schema, &[stream]);
}

#[test]
fn what_stands_behind_a_frame_is_not_in_it() {
    // After the frame of `f`, the path of `a` continues over the comma and another `f`, and leads
    // to no frame.
    let schema = schema_of_ways();
    let items: Vec<u8> = WAYS.0.flat_map(|id| [id, 0]).collect();
    let inner = frame(&schema, &[b"f\0", &items[..]].concat());
    let (head, way) = inner.split_at(inner.iter().position(|&byte| byte == b'f').unwrap() + 2);
    // The value of `a` is the bytes before the path.
    let mut value = vec![7; 8 - head.len()];
    value.extend(head);
    let outer = frame(&schema, &[b"a", &value[..], way, b"\0f\0\x03\0"].concat());
    assert!(naive::decode(&schema, Direction::Sensor, &outer).contains(&b'R'));
    all_agree("behind", &schema, &[outer]);
}

/// Nanoseconds per byte for a stream in which a candidate starts every few bytes, is right up to
/// its last byte, and fails there.
fn ns_per_byte(program: &mut Program, who: &str, payload_bytes: u16, bytes: usize) -> f64 {
    let schema = schema(Checksum::None, &[(b'a', ScalarType::Uint8, payload_bytes - 1)]);
    let mut value = format!("{payload_bytes}:a").repeat(usize::from(payload_bytes)).into_bytes();
    value.truncate(usize::from(payload_bytes) - 1);
    let mut nearly = frame(&schema, &[b"a", &value[..]].concat());
    if let Some(comma) = nearly.last_mut() {
        *comma = b';';
    }
    let stream = nearly.repeat(bytes.div_ceil(nearly.len()));
    let schema = schema_bytes(&schema, Direction::Sensor);
    // The minimum of several runs: other programs can only increase the time.
    let input = Input { schema: &schema, stream: &stream, pieces: &[64] };
    let times = (0..5).map(|_| program.time(who, 1, input));
    times.min().unwrap() as f64 / stream.len() as f64
}

#[test]
fn time_is_linear_whatever_the_length_of_a_frame() {
    if !tools(&["gcc", "g++"]) {
        return;
    }
    let mut program = Program::build(&scratch("linear"), &["-O2", "-DDECODERS_C_FRAMES=2"]);
    for who in ["c", "cpp"] {
        let base = ns_per_byte(&mut program, who, 100, 200_000);
        for (payload_bytes, bytes) in [(100, 800_000), (1000, 200_000), (9999, 200_000)] {
            let ns = ns_per_byte(&mut program, who, payload_bytes, bytes);
            println!("{who}, {payload_bytes} B frames, {bytes} B: {ns:.1} ns a byte");
            assert!(ns < 5.0 * base, "{who}: {ns} ns a byte, {base} with short frames");
        }
    }
}
