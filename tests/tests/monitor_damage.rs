//! `monitor` and a million frames of which many are damaged: the counters are those of the damage, no undamaged frame is
//! lost, and no wrong value comes beyond what the checksum's bits allow.

use sensedsl_host::Board;
use sensedsl_tests::{Random, TempDir, is_exhaustive, is_thorough, read, sensedsl};
use sensedsl_wire::{Scalar, Stamp, encode_hello, encode_stamped_report};
use serde_json::Value;

const ROBOT: &str = "board Rover on NUCLEO_F446RE {
    sensor Turns returns int32 { id = 18; type = encoder; }
    sensor Light returns uint16 { id = 17; type = analog; }
    link { stamp = true; checksum = crc16; }
}";

/// What was sent, and what a right host makes of it.
#[derive(Default)]
struct Sent {
    bytes: Vec<u8>,
    /// The numbers of the frames that arrive as they were sent.
    whole: Vec<i64>,
    /// The bytes that belong to whole frames, greetings among them.
    good_bytes: usize,
    greetings: usize,
    damaged: usize,
}

fn stream(board: &Board, count: usize, random: &mut Random) -> Sent {
    let mut sent = Sent::default();
    let hello = encode_hello(&board.schema);
    let greet = |sent: &mut Sent| {
        sent.bytes.extend(&hello);
        sent.good_bytes += hello.len();
        sent.greetings += 1;
    };
    greet(&mut sent);
    for number in 0..count {
        let value = i64::try_from(number).unwrap();
        let values = [
            (18, vec![Scalar::Signed(value)]),
            (17, vec![Scalar::Unsigned(u64::try_from(random.below(4_096)).unwrap())]),
        ];
        let stamp = Stamp { time_us: u32::try_from(number * 100).unwrap(), counter: number as u8 };
        let frame = encode_stamped_report(&board.schema, stamp, &values).unwrap();
        match random.below(100) {
            // Bytes that nobody sent.
            0..2 => {
                let garbage = (0..1 + random.below(24)).map(|_| random.below(256) as u8);
                sent.bytes.extend(garbage.collect::<Vec<_>>());
            }
            // A bit, or a few, are another.
            2..5 => {
                let mut other = frame.clone();
                for _ in 0..1 + random.below(3) {
                    let at = random.below(other.len());
                    other[at] ^= 1 << random.below(8);
                }
                if other != frame {
                    sent.bytes.extend(&other);
                    sent.damaged += 1;
                    continue;
                }
            }
            // The link was cut in the middle, and the board greets again.
            5 => {
                sent.bytes.extend(&frame[..random.below(frame.len())]);
                sent.damaged += 1;
                greet(&mut sent);
                continue;
            }
            _ => {}
        }
        sent.bytes.extend(&frame);
        sent.good_bytes += frame.len();
        sent.whole.push(value);
    }
    sent
}

#[test]
fn counters_are_those_of_the_damage() {
    let scratch = TempDir::new("monitor-damage");
    let file = scratch.write("robot.sense", ROBOT);
    let out = scratch.join("out");
    let generate = sensedsl(["generate", "--quiet", "--without", "firmware", "-o"]);
    let _ = generate.arg(&out).arg(&file).run().exits(0);
    let board = Board::all_of_json(&read(&out.join("schema.json"))).unwrap().remove(0);
    let count = match (is_exhaustive(), is_thorough()) {
        (true, _) => 1_000_000,
        (_, true) => 100_000,
        _ => 10_000,
    };
    let sent = stream(&board, count, &mut Random::new(1_000_000));
    let frames = scratch.write("frames", &sent.bytes);
    let ran = sensedsl(["monitor", "--format", "ndjson"]).arg(&frames).arg(&file).run().exits(0);
    let mut whole = sent.whole.iter().peekable();
    let mut wrong = 0;
    for line in ran.stdout.lines().filter(|line| line.contains("\"Turns\"")) {
        let object: Value = serde_json::from_str(line).unwrap();
        if whole.next_if(|number| object["raw"] == **number).is_none() {
            wrong += 1;
        }
    }
    assert_eq!(whole.next(), None, "an undamaged frame is lost");
    // Of 65,536 damaged frames that still look like one, a checksum of 16 bits lets one pass.
    let most = 6 + sent.damaged / 10_000;
    assert!(sent.damaged > count / 50 && wrong <= most, "{wrong} of {}", sent.damaged);
    if wrong == 0 {
        let (kept, dropped) =
            (sent.whole.len() + sent.greetings, sent.bytes.len() - sent.good_bytes);
        let counts = format!("{kept} frames, {dropped} bytes dropped");
        assert!(ran.stderr.contains(&counts), "{counts}: {}", ran.stderr);
    }
}
