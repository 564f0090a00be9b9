//! Words, bit fields, packed bits, BCD, CRCs and medians.

use std::fmt::Write as _;

use sensedsl_tests::{Random, hex};

use super::{SCALARS, Scalar, check, rounds};

/// Codes in the order of the C enumeration; 0 is a plain integer.
const FLOAT: usize = 1;
const BCD: usize = 2;
const PACKED: usize = 3;
const MAGNITUDE: usize = 4;

/// The coding of a value, and its bytes.
#[derive(Debug)]
struct Case {
    code: usize,
    with_crc: bool,
    word_bytes: usize,
    low: u32,
    bits: u32,
    is_signed: bool,
    is_little: bool,
    words: usize,
    scalar: Scalar,
    places: Vec<usize>,
    has_places: bool,
    bytes: Vec<u8>,
}

fn crc8(polynomial: u8, start: u8, bytes: &[u8]) -> u8 {
    // Long division of the message by the polynomial, bit by bit.
    let mut register = start;
    for bit in bytes.iter().flat_map(|byte| (0..8).rev().map(move |at| byte >> at & 1)) {
        let top = register >> 7 ^ bit;
        register = register << 1 ^ if top == 1 { polynomial } else { 0 };
    }
    register
}

fn mask(bits: u32) -> u64 {
    if bits >= 64 { u64::MAX } else { (1 << bits) - 1 }
}

/// Two decimal digits; sometimes a digit above nine.
fn digits(random: &mut Random) -> u8 {
    let limit = if random.below(40) == 0 { 16 } else { 10 };
    (random.below(limit) << 4 | random.below(limit)) as u8
}

impl Case {
    fn random(random: &mut Random) -> Self {
        let code = random.below(5);
        let mut word_bytes = 1 + random.below(8);
        let mut scalar = SCALARS[random.below(SCALARS.len())];
        if code == FLOAT {
            scalar = if random.below(2) == 0 { Scalar::Float32 } else { Scalar::Float64 };
            word_bytes = scalar.bytes();
        }
        let with_crc = code != PACKED && word_bytes.is_multiple_of(2) && random.below(3) == 0;
        let word_bits = 8 * u32::try_from(word_bytes).unwrap();
        let (low, bits) = match code {
            FLOAT => (0, word_bits),
            PACKED => (0, 1 + u32::try_from(random.below(32)).unwrap()),
            _ => {
                let low = u32::try_from(random.below(word_bits as usize)).unwrap();
                (low, 1 + u32::try_from(random.below((word_bits - low) as usize)).unwrap())
            }
        };
        let count = 1 + random.below(9);
        let has_places = random.below(2) == 0;
        let words = if has_places { count + random.below(3) } else { count };
        let mut places: Vec<usize> = (0..words).collect();
        if has_places {
            for at in (1..words).rev() {
                places.swap(at, random.below(at + 1));
            }
            places.truncate(count);
        }
        let size =
            if code == PACKED { (words * bits as usize).div_ceil(8) } else { words * word_bytes };
        let bytes = (0..size)
            .map(|_| match code {
                BCD => digits(random),
                _ => random.next() as u8,
            })
            .collect();
        Self {
            code,
            with_crc,
            word_bytes,
            low,
            bits,
            is_signed: random.below(2) == 0,
            is_little: random.below(2) == 0,
            words,
            scalar,
            places,
            has_places,
            bytes,
        }
    }

    /// The significant bits of a word.
    fn word(&self, at: usize) -> u64 {
        if self.code == PACKED {
            let bit = |at: usize| u64::from(self.bytes[at / 8] >> (at % 8) & 1);
            return (0..self.bits as usize).map(|i| bit(at * self.bits as usize + i) << i).sum();
        }
        let bytes = &self.bytes[at * self.word_bytes..][..self.word_bytes];
        let fold = |word: u64, byte: &u8| word << 8 | u64::from(*byte);
        let word = if self.is_little {
            bytes.iter().rev().fold(0, fold)
        } else {
            bytes.iter().fold(0, fold)
        };
        word >> self.low & mask(self.bits)
    }

    /// The bits of an element in memory; `None` if the word is not a number.
    fn element(&self, at: usize) -> Option<u64> {
        let word = self.word(at);
        match self.code {
            FLOAT => {
                let is_finite = match self.scalar {
                    Scalar::Float32 => f32::from_bits(word as u32).is_finite(),
                    _ => f64::from_bits(word).is_finite(),
                };
                is_finite.then_some(word)
            }
            BCD => Some(self.scalar.store(format!("{word:x}").parse().ok()?)),
            MAGNITUDE => {
                let sign = 1 << (self.bits - 1);
                let magnitude = i128::from(word & (sign - 1));
                Some(self.scalar.store(if word & sign == 0 { magnitude } else { -magnitude }))
            }
            _ => {
                let negative = self.is_signed && word >> (self.bits - 1) == 1;
                let number = i128::from(word) - if negative { 1 << self.bits } else { 0 };
                Some(self.scalar.store(number))
            }
        }
    }

    /// The significant bits of the word that an element is written as.
    fn encoded(&self, element: u64) -> u64 {
        let number = self.scalar.load(element);
        let mask = mask(self.bits);
        match self.code {
            FLOAT => element,
            BCD => {
                let greatest = (0..16).map(|i| (mask >> (4 * i) & 15).min(9) << (4 * i)).sum();
                let digits = u64::from_str_radix(&number.max(0).to_string(), 16);
                digits.ok().filter(|digits| *digits <= mask).unwrap_or(greatest)
            }
            MAGNITUDE => {
                let greatest = i128::from(mask >> 1);
                let magnitude = number.abs().min(greatest) as u64;
                let sign = if number < 0 { mask ^ (mask >> 1) } else { 0 };
                magnitude | sign
            }
            // No float holds a number beyond 64 bits that a word could hold.
            _ if self.is_signed => {
                number.clamp(-(1 << (self.bits - 1)), (1 << (self.bits - 1)) - 1) as u64 & mask
            }
            _ => number.clamp(0, i128::from(mask)) as u64,
        }
    }

    fn encode(&self, elements: &[u64]) -> Vec<u8> {
        let mut bytes = vec![0; self.bytes.len()];
        for (&place, &element) in self.places.iter().zip(elements) {
            let word = self.encoded(element);
            if self.code == PACKED {
                for i in 0..self.bits as usize {
                    let at = place * self.bits as usize + i;
                    bytes[at / 8] |= ((word >> i & 1) << (at % 8)) as u8;
                }
                continue;
            }
            let word = (word << self.low).to_le_bytes();
            let slot = &mut bytes[place * self.word_bytes..][..self.word_bytes];
            slot.copy_from_slice(&word[..self.word_bytes]);
            if !self.is_little {
                slot.reverse();
            }
        }
        self.on_wire(&bytes)
    }

    fn on_wire(&self, bytes: &[u8]) -> Vec<u8> {
        if !self.with_crc {
            return bytes.to_vec();
        }
        let with = |two: &[u8]| [two, &[crc8(0x31, 0xFF, two)]].concat();
        bytes.chunks(2).flat_map(with).collect()
    }

    fn request(&self, wire: &[u8]) -> String {
        let type_index = SCALARS.iter().position(|scalar| *scalar == self.scalar).unwrap();
        let places: Vec<u8> =
            self.places.iter().map(|place| u8::try_from(*place).unwrap()).collect();
        let Self { code, word_bytes, low, bits, .. } = self;
        let words = if self.has_places { self.words } else { 0 };
        format!(
            "value {code} {} {word_bytes} {low} {bits} {} {} {words} {type_index} {} {} {}",
            u8::from(self.with_crc),
            u8::from(self.is_signed),
            u8::from(self.is_little),
            self.places.len(),
            hex(if self.has_places { &places } else { &[] }),
            hex(wire)
        )
    }

    fn answer(&self) -> String {
        let elements: Option<Vec<u64>> = self.places.iter().map(|&at| self.element(at)).collect();
        let Some(elements) = elements else { return "2".to_owned() };
        let mut answer = "1".to_owned();
        for element in &elements {
            let _ = write!(answer, " {element:x}");
        }
        answer.push_str(" :");
        for byte in self.encode(&elements) {
            let _ = write!(answer, " {byte:x}");
        }
        answer
    }
}

#[test]
fn values_are_what_their_bits_say() {
    let mut random = Random::new(31);
    let mut cases = Vec::new();
    let (mut numbers, mut junk) = (0, 0);
    for _ in 0..rounds(12_000) {
        let case = Case::random(&mut random);
        let mut wire = case.on_wire(&case.bytes);
        let mut answer = case.answer();
        match random.below(12) {
            0 => {
                wire.pop();
                answer = "2".to_owned();
            }
            1 if case.with_crc => {
                let at = random.below(wire.len());
                wire[at] ^= 1 << random.below(8);
                answer = "3".to_owned();
            }
            _ => {}
        }
        *if answer == "2" || answer == "3" { &mut junk } else { &mut numbers } += 1;
        cases.push((case.request(&wire), answer));
    }
    assert!(numbers > 8 * junk / 5 && junk > numbers / 50, "{numbers} {junk}");
    check(&cases);
}

#[test]
fn checksums_are_remainders() {
    let mut random = Random::new(32);
    let mut cases = Vec::new();
    for _ in 0..rounds(2_000) {
        let bytes: Vec<u8> = (0..random.below(40)).map(|_| random.next() as u8).collect();
        let (polynomial, start) = (random.next() as u8, random.next() as u8);
        let wanted = crc8(polynomial, start, &bytes);
        cases.push((format!("crc8 {polynomial} {start} {}", hex(&bytes)), format!("{wanted:x}")));
    }
    check(&cases);
}

/// The window sorted by the numbers that the bits represent.
fn sorted(scalar: Scalar, mut window: Vec<u64>) -> Vec<u64> {
    window.sort_by(|&left, &right| match scalar {
        Scalar::Float32 => f32::from_bits(left as u32).total_cmp(&f32::from_bits(right as u32)),
        Scalar::Float64 => f64::from_bits(left).total_cmp(&f64::from_bits(right)),
        _ => scalar.load(left).cmp(&scalar.load(right)),
    });
    window
}

#[test]
fn medians_stand_in_the_middle() {
    let mut random = Random::new(33);
    let mut cases = Vec::new();
    for _ in 0..rounds(2_000) {
        let at = random.below(SCALARS.len());
        let scalar = SCALARS[at];
        let window = 3 + 2 * random.below(7);
        let few = random.below(2) == 0;
        let values: Vec<u64> = (0..random.below(50))
            .map(|_| {
                let bits = random.next() & mask(8 * u32::try_from(scalar.bytes()).unwrap());
                if scalar == Scalar::Bool || few { bits & 1 } else { bits }
            })
            .collect();
        let bytes: Vec<u8> = values
            .iter()
            .flat_map(|value| value.to_le_bytes()[..scalar.bytes()].to_vec())
            .collect();
        let mut answer = "0".to_owned();
        for end in 1..=values.len() {
            let seen = sorted(scalar, values[end.saturating_sub(window)..end].to_vec());
            let _ = write!(answer, " {:x}", seen[(seen.len() - 1) / 2]);
        }
        cases.push((format!("median {window} {at} {}", hex(&bytes)), answer));
    }
    check(&cases);
}
