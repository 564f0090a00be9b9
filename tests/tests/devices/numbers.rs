//! Numbers in text: decimals, degrees and hexadecimal digits.

use sensedsl_tests::{Random, hex};

use super::{SCALARS, Scalar, check, rounds};

const DECIMAL: usize = 1;
const DEGREES: usize = 2;
const HEX: usize = 3;

fn request(format: usize, decimals: usize, at: usize, text: &str, hemisphere: &str) -> String {
    let [text, hemisphere] = [text, hemisphere].map(|text| hex(text.as_bytes()));
    format!("number {format} {decimals} {at} {text} {hemisphere}")
}

fn digits(random: &mut Random, count: usize) -> String {
    (0..count).map(|_| char::from(b'0' + random.below(10) as u8)).collect()
}

/// The digits shifted and rounded as on paper.
fn decimal(text: &str, decimals: usize, scalar: Scalar) -> Option<u64> {
    let (sign, rest) = match text.as_bytes().first()? {
        b'-' => (-1, &text[1..]),
        b'+' => (1, &text[1..]),
        _ => (1, text),
    };
    let (whole, fraction) = rest.split_once('.').unwrap_or((rest, ""));
    let is_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if !is_digits(whole) || !is_digits(fraction) || (whole.is_empty() && fraction.is_empty()) {
        return None;
    }
    if matches!(scalar, Scalar::Float32 | Scalar::Float64) {
        let number = format!("0{whole}.{fraction}0e{decimals}");
        let (single, double) = (number.parse::<f32>().ok()?, number.parse::<f64>().ok()?);
        let sign = sign == -1 && double != 0.0;
        return Some(match scalar {
            Scalar::Float32 => u64::from(if sign { -single } else { single }.to_bits()),
            _ => if sign { -double } else { double }.to_bits(),
        });
    }
    let fraction = format!("{fraction:0<decimals$}");
    let (near, far) = fraction.split_at(decimals);
    let number: i128 = format!("0{whole}{near}").parse().ok()?;
    let round_up = far.as_bytes().first().is_some_and(|digit| *digit >= b'5');
    Some(scalar.store(sign * (number + i128::from(round_up))))
}

#[test]
fn decimals_are_rounded_as_on_paper() {
    let mut random = Random::new(51);
    let mut cases = Vec::new();
    for _ in 0..rounds(6_000) {
        let at = random.below(SCALARS.len());
        let scalar = SCALARS[at];
        let is_float = matches!(scalar, Scalar::Float32 | Scalar::Float64);
        let decimals = random.below(if is_float { 5 } else { 19 });
        let whole = random.below(10);
        let mut text = ["", "-", "+"][random.below(3)].to_owned();
        text += &digits(&mut random, whole);
        if random.below(3) > 0 {
            let fraction = random.below(9);
            text += ".";
            text += &digits(&mut random, fraction);
        }
        if random.below(10) == 0 {
            let at = random.below(text.len() + 1);
            text.insert(at, char::from(b"-.e x"[random.below(5)]));
        }
        let trimmed = text.trim_matches(' ');
        let answer = match decimal(trimmed, decimals, scalar) {
            _ if trimmed.is_empty() => "0".to_owned(),
            Some(bits) => format!("1 {bits:x}"),
            None => "2".to_owned(),
        };
        cases.push((request(DECIMAL, decimals, at, &text, ""), answer));
    }
    check(&cases);
}

#[test]
fn degrees_are_minutes_over_sixty() {
    let mut random = Random::new(52);
    let mut cases = Vec::new();
    let int32 = SCALARS.iter().position(|scalar| *scalar == Scalar::Signed(32)).unwrap();
    for _ in 0..rounds(3_000) {
        let (letter, most) = [("N", 90), ("S", 90), ("E", 180), ("W", 180)][random.below(4)];
        let (degrees, minutes) = (random.below(most + 3), random.below(62));
        let places = random.below(10);
        let fraction = digits(&mut random, places);
        let text = format!("{degrees:02}{minutes:02}.{fraction}");
        let nano: i128 = format!("{fraction:0<9}").parse().unwrap();
        let angle = (degrees * 60 + minutes) as i128 * 1_000_000_000 + nano;
        let is_right = minutes < 60 && angle <= most as i128 * 60_000_000_000;
        let sign = if letter == "S" || letter == "W" { -1 } else { 1 };
        let bits = Scalar::Signed(32).store(sign * ((2 * angle + 6_000) / 12_000));
        let answer = if is_right { format!("1 {bits:x}") } else { "2".to_owned() };
        cases.push((request(DEGREES, 0, int32, &text, letter), answer));
    }
    check(&cases);
}

#[test]
fn hexadecimal_digits_are_read_and_saturate() {
    let mut random = Random::new(53);
    let mut cases = Vec::new();
    for _ in 0..rounds(2_000) {
        let at = 1 + random.below(SCALARS.len() - 3);
        let count = random.below(20);
        let text: String =
            (0..count).map(|_| char::from(b"0123456789abcdefABCDEFg"[random.below(23)])).collect();
        let answer = match u128::from_str_radix(&text, 16) {
            _ if text.is_empty() => "0".to_owned(),
            Ok(number) => {
                let number = i128::try_from(number.min(u128::from(u64::MAX))).unwrap();
                format!("1 {:x}", SCALARS[at].store(number))
            }
            Err(_) => "2".to_owned(),
        };
        cases.push((request(HEX, 0, at, &text, ""), answer));
    }
    check(&cases);
}
