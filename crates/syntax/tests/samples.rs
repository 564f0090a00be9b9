//! Whole files with everything in the language: they are read without a mistake, their layout does
//! not change, and no mutation of them breaks what holds for every text.
#![expect(clippy::disallowed_methods, reason = "a long run is asked for in the environment")]
#![cfg(test)]

mod invariants;

use std::thread;

const SAMPLES: [(&str, &str); 5] = [
    ("line_follower", include_str!("samples/line_follower.sense")),
    ("quadcopter", include_str!("samples/quadcopter.sense")),
    ("gearmotor", include_str!("samples/gearmotor.sense")),
    ("thermostat", include_str!("samples/thermostat.sense")),
    ("fig2", include_str!("../../../examples/fig2.sense")),
];

#[test]
fn samples_are_read_and_laid_out() {
    for (name, text) in SAMPLES {
        assert_eq!(sensedsl_syntax::parse(text).errors(), &[], "{name}");
        assert_eq!(sensedsl_syntax::format(text).as_deref(), Ok(text), "{name}");
        // On as few lines as comments allow.
        let joined: Vec<&str> = text.lines().map(str::trim).collect();
        let squeezed = joined.join(if text.contains("//") { "\n" } else { " " });
        assert_eq!(sensedsl_syntax::format(&squeezed).as_deref(), Ok(text), "{name}");
    }
}

/// Pieces that mean something in some place.
const HEADS: &[&str] = &[
    "chip C {",
    "connection c for i2c {",
    "reading r returns int16[3] {",
    "const N = 4;",
    "driver d {",
    "command w accepts bool {",
    "sensor S returns uint8 {",
    "board B {",
    "controller K every 5 ms {",
    "test T {",
    "always A in 0 .. 1 and not B;",
    "when A < 1 then B == 2 within 5 ms;",
    "prefer a = 1;",
    "id = 1;",
];
const MARKS: &[&str] = &[
    "..", "...", ".", "*", "/", "(", ")", "+", "-", "[", "]", "{", "}", "=", ";", ",", "//", "/*",
    "*/", "\"", "'", "#", ":", "\n", " ", "1..5", "3 V..5 V", "1.", ".5", "A-5", "-N", "(1 + 2)",
    "0x", "8N1", "ms", " kOhm", "\u{b5}", "\u{2026}", "\u{201c}", "é", "**", "->", "+=", "for",
    "returns",
];

/// Small numbers from a seed, the same on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        usize::try_from((mixed ^ (mixed >> 31)) % (limit.max(1) as u64)).unwrap()
    }
}

/// The items of all samples, which are shorter than whole files and just as correct.
fn items() -> Vec<&'static str> {
    let mut items = Vec::new();
    for (_, text) in SAMPLES {
        let ends = text.match_indices(";\n").chain(text.match_indices("\n}\n"));
        let mut ends: Vec<usize> = ends.map(|(at, end)| at + end.len()).collect();
        ends.retain(|&end| text[end..].chars().next().is_none_or(|next| !" }".contains(next)));
        ends.sort_unstable();
        let starts = std::iter::once(0).chain(ends.iter().copied());
        items.extend(starts.zip(&ends).map(|(start, &end)| &text[start..end]));
    }
    items
}

/// What may replace a space, and what a digit, without being a mistake.
const SPACES: &[&str] = &["\n", " /* x */ ", " // x\n", "\n\n\n", "\t", "\r\n", "/*\n x*/"];
const VALUES: &[&str] =
    &["(1 + 2)", "N", "-N", "1 * 2", "- 3 / 4", "(5)", "[1..2, 3]", "1..N", "+-1", "0x1F"];

fn mutation(number: u64, items: &[&str]) -> String {
    let mut random = Random(number.wrapping_mul(0xD134_2543_DE82_EF95));
    let mut text: Vec<char> = items[random.below(items.len())].chars().collect();
    let gentle = random.below(2) == 0;
    let pieces = [HEADS, MARKS].concat();
    for _ in 0..=random.below(4) {
        let at = random.below(text.len() + 1);
        let end = (at + random.below(16)).min(text.len());
        let next = |wanted: fn(char) -> bool| {
            text.iter().skip(at).position(|&found| wanted(found)).map(|offset| at + offset)
        };
        match random.below(5) {
            0 | 1 if gentle => {
                let Some(at) = next(|found| found == ' ') else { continue };
                drop(text.splice(at..=at, SPACES[random.below(SPACES.len())].chars()));
            }
            _ if gentle => {
                let Some(at) = next(|found| found == '=') else { continue };
                let value = VALUES[random.below(VALUES.len())];
                let Some(length) = text[at..].iter().position(|&found| found == ';') else {
                    continue;
                };
                drop(text.splice(at + 1..at + length, value.chars()));
            }
            0 => drop(text.drain(at..end)),
            1 => {
                let copy: Vec<char> = text[at..end].to_vec();
                let to = random.below(text.len() + 1);
                drop(text.splice(to..to, copy));
            }
            2 | 3 => drop(text.splice(at..at, pieces[random.below(pieces.len())].chars())),
            _ => drop(text.splice(at..end, pieces[random.below(pieces.len())].chars())),
        }
    }
    text.into_iter().collect()
}

/// Set `SENSEDSL_MUTATIONS=1000000` for a long run, with `--release`.
#[test]
fn mutated_samples() {
    let wanted = std::env::var("SENSEDSL_MUTATIONS");
    let count: u64 = wanted.map_or(2_000, |number| number.parse().expect("a number"));
    let items = items();
    let threads = thread::available_parallelism().map_or(1, usize::from) as u64;
    let laid_out: usize = thread::scope(|scope| {
        let items = &items;
        let run = move |first: u64| {
            let numbers = (first..count).step_by(usize::try_from(threads).unwrap());
            let check = |number: u64| {
                let text = mutation(number, items);
                if let Err(wrong) = invariants::check(&text) {
                    panic!("mutation {number}: {wrong}\n{text}");
                }
                sensedsl_syntax::format(&text).is_ok()
            };
            numbers.filter(|&number| check(number)).count()
        };
        let started: Vec<_> = (0..threads).map(|first| scope.spawn(move || run(first))).collect();
        started.into_iter().map(|thread| thread.join().unwrap()).sum()
    });
    // Enough of them are correct that the layout is tested as well.
    assert!(laid_out > usize::try_from(count).unwrap() / 4, "{laid_out} of {count}");
    println!("{count} mutations, {laid_out} laid out");
}
