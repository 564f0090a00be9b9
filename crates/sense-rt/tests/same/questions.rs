//! Questions with random numbers, near the ends of ranges more often than elsewhere.

use sense_rt::Scalar;
use sensedsl_tests::{Random, hex};

use super::answer::SCALARS;

/// The first words of the answers that carry a result.
pub(crate) const WORDS: &str = "ratio store magnitude decode encode compose parse formula \
    decay apply captured see drive count turn element advance cycle";

/// A random number: unrestricted, small, near a power of two, or near the end of the range.
fn number(random: &mut Random) -> u64 {
    let wide = random.next();
    match random.below(5) {
        0 => wide,
        1 => wide % 300,
        2 => wide >> random.below(64),
        3 => (1_u64 << random.below(64)).wrapping_add(wide % 5).wrapping_sub(2),
        _ => u64::MAX.wrapping_sub(wide % 4),
    }
}

fn bytes(random: &mut Random, count: usize) -> Vec<u8> {
    let style = random.below(4);
    let one = |random: &mut Random| match style {
        0 => [0, 0xFF, 0x80, 0x7F][random.below(4)],
        1 => random.below(10) as u8 * 16 + random.below(10) as u8,
        _ => random.next() as u8,
    };
    (0..count).map(|_| one(random)).collect()
}

fn scalar(random: &mut Random) -> usize {
    random.below(SCALARS.len())
}

/// The bits of an element: floating-point numbers of all sizes, including NaN and infinity.
fn element(random: &mut Random, scalar: usize) -> u64 {
    let wide = number(random);
    let one = SCALARS[scalar];
    let is_near = random.below(3) > 0;
    if one == Scalar::Bool {
        wide % 2
    } else if one == Scalar::Float32 && is_near {
        u64::from(((random.below(200_000) as f32 - 100_000.0) / 8.0).to_bits())
    } else if one == Scalar::Float64 && is_near {
        ((random.below(200_000) as f64 - 100_000.0) / 8.0).to_bits()
    } else {
        wide & (u64::MAX >> (64 - 8 * one.bytes()))
    }
}

fn elements(random: &mut Random, scalar: usize, count: usize) -> String {
    (0..count).map(|_| format!(" {:x}", element(random, scalar))).collect()
}

/// What the language allows, and a little more: a coding, the number of its words, and the bytes
/// that they take.
fn coding(random: &mut Random, scalar: usize, count: usize) -> (String, usize) {
    let code = random.below(5);
    let size = SCALARS[scalar].bytes();
    let word_bytes = if code == 1 && random.below(8) > 0 { size } else { 1 + random.below(8) };
    let has_elements = random.below(4) == 0;
    let words = if has_elements { count + random.below(4) } else { 0 };
    let order: Vec<u8> = (0..count).map(|_| random.below(words.max(1)) as u8).collect();
    let all = if has_elements { words } else { count };
    let (low, mut bits) = match code {
        1 => (0, 0),
        3 => (0, 1 + random.below(32)),
        _ => (random.below(3) * random.below(8 * word_bytes), random.below(9 * word_bytes)),
    };
    if code == 2 {
        bits &= !3;
    }
    let crc = code != 3 && (word_bytes * all).is_multiple_of(2) && random.below(4) == 0;
    let data = if code == 3 { (all * bits).div_ceil(8) } else { word_bytes * all };
    let wire = if crc { data + data / 2 } else { data };
    let order = hex(if has_elements { &order } else { &[] });
    let (signed, little) = (random.below(2), random.below(2));
    let text = format!(
        "{order} {words} {code} {} {word_bytes} {low} {bits} {signed} {little}",
        u8::from(crc)
    );
    (text, wire)
}

/// How colours or letters are sent.
fn shown(random: &mut Random) -> String {
    let code = 5 + random.below(3);
    let colours = if code == 7 { 0 } else { 1 + random.below(4) };
    let order: Vec<u8> = (0..colours).map(|_| random.below(4) as u8).collect();
    let bits = 1 + random.below(8);
    let (short, long) = (random.below(bits + 1), random.below(bits + 1));
    format!("{} {colours} {code} 0 {long} {short} {bits} 0 0", hex(&order))
}

/// Bytes with a CRC-8 after every two, usually right.
fn with_crc(random: &mut Random, count: usize) -> Vec<u8> {
    let mut all = bytes(random, count);
    if random.below(4) > 0 {
        for three in all.chunks_exact_mut(3) {
            three[2] = sense_rt::crc8(0x31, 0xFF, &three[..2]);
        }
    }
    all
}

fn text(random: &mut Random) -> Vec<u8> {
    let count = random.below(24);
    let digit = |random: &mut Random| b'0' + random.below(10) as u8;
    let mut all: Vec<u8> = (0..count).map(|_| digit(random)).collect();
    if random.below(2) == 0 {
        all.insert(random.below(all.len() + 1), b'.');
    }
    match random.below(6) {
        0 => all.insert(0, b'-'),
        1 => all.insert(0, b'+'),
        2 => all.insert(random.below(all.len() + 1), b' '),
        3 => all.insert(random.below(all.len() + 1), *random.pick(b"aF,x-:").unwrap()),
        _ => {}
    }
    all
}

fn degrees(random: &mut Random) -> Vec<u8> {
    let (degrees, minutes) = (random.below(200), random.below(70));
    let digits = "123456789012"[..random.below(12)].to_owned();
    format!("{degrees:02}{minutes:02}.{digits}").into_bytes()
}

fn numbers(random: &mut Random, all: &mut Vec<String>) {
    let one = scalar(random);
    let (up, down) = (number(random), number(random));
    all.push(format!("ratio {one} {} {up} {down}", random.below(2)));
    all.push(format!("ratio {one} {} {} {}", random.below(2), up % 100_000, down % 1000));
    all.push(format!("store {one} {:x}", number(random)));
    let (least, greatest) = (random.below(65_536), random.below(65_536));
    all.push(format!("magnitude {one} {least} {greatest}{}", elements(random, one, 1)));
    all.push(format!(
        "decay {} {}",
        number(random) as u32,
        number(random) as u32 >> random.below(32)
    ));
}

fn codings(random: &mut Random, all: &mut Vec<String>) {
    let (one, count) = (scalar(random), 1 + random.below(5));
    let (how, size) = coding(random, one, count);
    let given = size.saturating_sub(usize::from(random.below(9) == 0));
    all.push(format!("decode {one} {count} {how} {}", hex(&with_crc(random, given))));
    all.push(format!("encode {one} {count} {how}{}", elements(random, one, count)));
    let how_shown = shown(random);
    all.push(format!("encode {one} {count} {how_shown}{}", elements(random, one, count)));
    let (start, end) = (random.below(4), random.below(3));
    let (start, end) = (hex(&bytes(random, start)), hex(&bytes(random, end)));
    let (sum, from, behind) = (random.below(15), random.below(5), random.below(3));
    let behind = hex(&bytes(random, behind));
    let as_text = (random.below(4), *random.pick(&[0, 44, 32]).unwrap(), random.below(19));
    let (format, separator, decimals) = if random.below(2) == 0 { (0, 0, 0) } else { as_text };
    let values = elements(random, one, count);
    all.push(format!(
        "compose {one} {count} {how} {start} {behind} {end} {format} {separator} {decimals} {sum} {from}{values}"
    ));
    let (first, way) = (text(random), random.below(3));
    let place = *random.pick(&["4e", "53", "45", "57", "204e", "-", "5858"]).unwrap();
    let first = if way == 1 && random.below(4) > 0 { degrees(random) } else { first };
    all.push(format!("parse {way} {one} {} {} {place}", random.below(20), hex(&first)));
}

/// The calibration of a working part, and random ones.
fn formulas(random: &mut Random, all: &mut Vec<String>) {
    const SOUND: [u8; 32] = [
        0x70, 0x6B, 0x43, 0x67, 0x18, 0xFC, 0x7D, 0x8E, 0x43, 0xD6, 0xD0, 0x0B, 0x27, 0x0B, 0x8C,
        0x00, 0xF9, 0xFF, 0x8C, 0x3C, 0xF8, 0xC6, 0x70, 0x17, 0x4B, 0x6C, 0x01, 0x00, 0x13, 0x29,
        0x03, 0x1E,
    ];
    let which = random.below(5);
    let mut calibration = SOUND.to_vec();
    if random.below(3) == 0 {
        let at = random.below(32);
        calibration[at] = random.next() as u8;
    } else if random.below(6) == 0 {
        calibration = bytes(random, 32);
    }
    let raw = match which {
        0 | 1 if random.below(5) > 0 => {
            let near = |random: &mut Random| 0x40 + random.below(0x60) as u8;
            (0..8).map(|_| near(random)).collect()
        }
        4 if random.below(5) > 0 => load_cell(random),
        2 => (random.below(4100) as u16).to_be_bytes().to_vec(),
        _ => bytes(random, 8),
    };
    let (time, gain) = ([13, 101, 402, 50][random.below(4)], [1, 16, 16, 2][random.below(4)]);
    let parameters = match which {
        3 => format!("{time} {gain} 0"),
        _ => format!(
            "{} {} {}",
            random.below(20_002),
            number(random) as u32 % 100_000_002,
            random.below(1 << 20)
        ),
    };
    all.push(format!("formula {which} {parameters} {} {}", hex(&calibration), hex(&raw)));
}

/// What an HX711 answers, ready or not.
fn load_cell(random: &mut Random) -> Vec<u8> {
    let code = random.next() as u32;
    let mut all = vec![if random.below(6) > 0 { 0 } else { 1 }];
    all.extend((0..6).map(|at| {
        let pairs = (0..4).map(|bit| ((code >> (23 - 4 * at - bit) & 1) * 3) << (6 - 2 * bit));
        pairs.sum::<u32>() as u8
    }));
    all.push(if random.below(6) > 0 { 0xFF } else { 0xFE });
    all
}

fn filters(random: &mut Random, all: &mut Vec<String>) {
    let (one, count) = (scalar(random), 1 + random.below(4));
    let real = SCALARS[one].is_real();
    let median = [0, 0, 3, 5, 15][random.below(5)];
    let smooth = [0, 5, 100, 4000][random.below(4)];
    let change = if SCALARS[one] == Scalar::Float32 {
        u64::from((random.below(1000) as f32).to_bits())
    } else if SCALARS[one] == Scalar::Float64 {
        (random.below(1000) as f64).to_bits()
    } else {
        number(random) >> random.below(64)
    };
    let (has_change, beat) = (random.below(2), [0, 50, 1000][random.below(3)]);
    let ranges = if random.below(3) == 0 { random.below(3) } else { 0 };
    let ends = elements(random, one, 2 * ranges);
    let wide = u8::from(real && random.below(5) > 0);
    all.push(format!(
        "filter {one} {count} {wide} {median} {smooth} {has_change} {change:x} {beat} {ranges}{ends}"
    ));
    let mut now_ms = number(random) as u32;
    let mut values = elements(random, one, count);
    for _ in 0..12 {
        if random.below(3) > 0 {
            values = elements(random, one, count);
        }
        all.push(format!("apply {now_ms}{values}"));
        now_ms = now_ms.wrapping_add(random.below(300) as u32);
    }
}

fn pins(random: &mut Random, all: &mut Vec<String>) {
    let silent = random.below(300);
    all.push(format!("capture {} {} {silent}", random.below(5), 1 + random.below(1_000_000)));
    let (one, mut now) = (scalar(random), number(random) as u32);
    for _ in 0..10 {
        let ticks = number(random) as u32;
        all.push(format!("captured {} {ticks} {now} {one} {}", random.below(6), random.below(2)));
        now = now.wrapping_add(random.below(500) as u32);
    }
    all.push(format!("contact {} {}", random.below(3) * random.below(30), random.below(3)));
    for _ in 0..16 {
        all.push(format!("see {} {} {now}", random.below(4), random.below(2)));
        now = now.wrapping_add(random.below(20) as u32);
    }
    all.push(format!("bridge {} {}", random.below(3), random.below(20_000)));
    for _ in 0..6 {
        all.push(format!("drive {one}{}", elements(random, one, 1)));
    }
    all.push(format!("count {}", random.below(65_536)));
    all.push(format!("element {} {}", random.below(8), random.below(2)));
    turns(random, all);
}

/// Values that come about as often as their cycle, across the end of the clock, too.
fn turns(random: &mut Random, all: &mut Vec<String>) {
    let cycle_ms = [0, 1, 3, 20, 1_000, u32::MAX][random.below(6)];
    let mut now_ms = number(random) as u32;
    for _ in 0..6 {
        all.push(format!("turn {cycle_ms} {now_ms}"));
        let apart_ms = (cycle_ms / 4).wrapping_mul(random.below(9) as u32);
        now_ms = now_ms.wrapping_add(apart_ms).wrapping_add(random.below(3) as u32);
    }
}

/// A host's stream: requests, values, noise, incomplete frames.
fn stream(random: &mut Random, checksum: usize) -> Vec<u8> {
    let mut all = Vec::new();
    for _ in 0..random.below(4) {
        let mut payload = match random.below(5) {
            0 => vec![0],
            1 => vec![0, 1],
            2 => [&[33], &bytes(random, 2)[..]].concat(),
            3 => vec![34, random.below(3) as u8, 1],
            _ => [&[34, 1, 0, 33], &bytes(random, 2)[..]].concat(),
        };
        let sum = match checksum {
            0 => Vec::new(),
            1 => sense_rt::crc16(&payload).to_be_bytes().to_vec(),
            _ => sense_rt::crc32(&payload).to_be_bytes().to_vec(),
        };
        if !sum.is_empty() {
            payload.push(255);
            payload.extend(sum);
        }
        let mut frame = format!("{}:", payload.len()).into_bytes();
        frame.extend(&payload);
        frame.push(b',');
        match random.below(6) {
            0 => frame.truncate(random.below(frame.len())),
            1 => frame.insert(0, *random.pick(b"?1:,").unwrap()),
            2 => {
                let at = random.below(frame.len());
                frame[at] ^= 1 << random.below(8);
            }
            _ => {}
        }
        all.extend(frame);
    }
    all
}

fn links(random: &mut Random, all: &mut Vec<String>) {
    const SIZES: [(usize, usize); 3] = [(0, 2), (1, 40), (4, 4)];
    let (stamp, checksum) = (random.below(2), random.below(3));
    let (cycle, silence) = (5 + random.below(20), random.below(2) * 60);
    all.push(format!("reporter {stamp} {checksum} {cycle} {silence}"));
    let mut now_us = 0_u64;
    let speed = random.below(80);
    for _ in 0..60 {
        let now_ms = (now_us / 1000) as u32;
        for (index, size) in SIZES {
            if random.below(3) == 0 {
                all.push(format!("put {index} {}", hex(&bytes(random, size))));
                all.push(format!("note {index} 1 {now_ms}"));
            }
        }
        if random.below(6) == 0 {
            all.push(format!("note {} {} {now_ms}", random.below(5), random.below(9)));
        }
        let is_open = random.below(20) > 0;
        // All that is written, nothing, or half of it.
        let accepts = [1, 2, 2].get(random.below(40)).copied().unwrap_or(0);
        let room = if random.below(3) == 0 { 64 } else { random.below(speed + 1).min(64) };
        let paused = u8::from(random.below(30) == 0);
        let bytes = hex(&stream(random, checksum));
        let open = u8::from(is_open);
        all.push(format!("cycle {now_us} {open} {accepts} {room} {paused} 1 {bytes}"));
        now_us += (cycle * 1000 + random.below(900)) as u64;
        if random.below(80) == 0 {
            now_us += number(random) >> 20;
        }
    }
}

/// Targets of all sizes and at all moments, most of them in reach.
fn motors(random: &mut Random, all: &mut Vec<String>) {
    let below = |random: &mut Random, most: usize| (1 + random.below(most)) >> random.below(16);
    let (ticks, speed) = (below(random, 4_000_000).max(1_000), below(random, 500_000).max(1));
    let (acceleration, is_velocity) = (below(random, 10_000_000).max(1), random.below(2));
    all.push(format!("motor {ticks} {speed} {acceleration} {is_velocity}"));
    for _ in 0..12 {
        let (one, near) = (scalar(random), random.below(400) as i32 - 200);
        match random.below(4) {
            0 => all.push(format!("target {one}{}", elements(random, one, 1))),
            1 => all.push("halt".to_owned()),
            _ => all.push(format!("target 6 {:x}", near.cast_unsigned())),
        }
        for _ in 0..random.below(120) {
            all.push("advance".to_owned());
        }
    }
}

/// A round of questions of all kinds.
pub(crate) fn round(random: &mut Random) -> Vec<String> {
    let mut all = Vec::new();
    for _ in 0..100 {
        numbers(random, &mut all);
        codings(random, &mut all);
        formulas(random, &mut all);
    }
    for _ in 0..20 {
        filters(random, &mut all);
        pins(random, &mut all);
        motors(random, &mut all);
    }
    for _ in 0..4 {
        links(random, &mut all);
    }
    all
}
