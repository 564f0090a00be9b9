//! Numbers in base units in, quantities as people write them out: volts, ohms, hertz. And the resistors that divide a
//! voltage, which a message proposes.

/// Millivolts as people write volts: `5 V`, `3.3 V`.
#[must_use]
pub fn shown_mv(mv: u32) -> String {
    let text = format!("{}.{:03}", mv / 1_000, mv % 1_000);
    format!("{} V", text.trim_end_matches('0').trim_end_matches('.'))
}

/// Ohms as people write them: `10 kOhm`, `820 Ohm`.
#[must_use]
pub fn shown_ohm(ohm: u32) -> String {
    if ohm < 1_000 {
        return format!("{ohm} Ohm");
    }
    let text = format!("{}.{:03}", ohm / 1_000, ohm % 1_000);
    format!("{} kOhm", text.trim_end_matches('0').trim_end_matches('.'))
}

/// Microseconds as people write times: `5 ms`, `1.5 s`, `200 us`.
#[must_use]
pub fn shown_us(us: u32) -> String {
    let of = |unit_us: u32, unit: &str| {
        let text = format!("{}.{:03}", us / unit_us, us % unit_us / (unit_us / 1_000));
        format!("{} {unit}", text.trim_end_matches('0').trim_end_matches('.'))
    };
    if us >= 1_000_000 && us.is_multiple_of(1_000) {
        of(1_000_000, "s")
    } else if us >= 1_000 {
        of(1_000, "ms")
    } else {
        format!("{us} us")
    }
}

/// Formats a frequency for people: `400 kHz`.
#[must_use]
pub fn shown_hz(hz: u32) -> String {
    if hz >= 1_000_000 && hz.is_multiple_of(1_000_000) {
        return format!("{} MHz", hz / 1_000_000);
    }
    if hz >= 1_000 && hz.is_multiple_of(1_000) {
        return format!("{} kHz", hz / 1_000);
    }
    format!("{hz} Hz")
}

/// Formats a number for people, with six significant digits.
#[must_use]
pub fn rounded(number: f64) -> String {
    let text = format!("{number:.6e}");
    text.parse::<f64>().map_or(text, |number| format!("{number}"))
}

/// The proposed resistor to ground, in ohms.
const LOWER_OHM: u32 = 10_000;
/// Steps of the E12 series, in tenths.
const E12: [u32; 12] = [10, 12, 15, 18, 22, 27, 33, 39, 47, 56, 68, 82];

/// Resistors of the E12 series, in ohms, from the device to the pin and from the pin to ground,
/// that leave at most `most_mv` of `mv` at the pin.
#[must_use]
pub fn divider(mv: u32, most_mv: u32) -> [u32; 2] {
    let enough = |upper: &u64| {
        let (mv, lower) = (u64::from(mv), u64::from(LOWER_OHM));
        mv * lower <= u64::from(most_mv) * (upper + lower)
    };
    let decades = (2..8).map(|power| 10_u64.pow(power));
    let mut all = decades.flat_map(|decade| E12.map(|step| u64::from(step) * decade / 10));
    let upper = all.find(enough).and_then(|upper| u32::try_from(upper).ok());
    [upper.unwrap_or(u32::MAX), LOWER_OHM]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voltages_are_written_as_people_do() {
        assert_eq!([5_000, 3_300, 12_650, 90].map(shown_mv), ["5 V", "3.3 V", "12.65 V", "0.09 V"]);
    }

    #[test]
    fn frequencies_are_written_in_whole_units() {
        assert_eq!([3_400_000, 2_000_000, 1_234].map(shown_hz), ["3400 kHz", "2 MHz", "1234 Hz"]);
    }

    #[test]
    fn resistances_are_written_as_people_do() {
        assert_eq!(
            [820, 10_000, 5_600, 1].map(shown_ohm),
            ["820 Ohm", "10 kOhm", "5.6 kOhm", "1 Ohm"]
        );
    }

    #[test]
    fn a_divider_leaves_no_more_than_the_supply() {
        let reported = |mv, most| divider(mv, most).map(shown_ohm).join(", ");
        assert_eq!(reported(5_000, 3_300), "5.6 kOhm, 10 kOhm");
        assert_eq!(reported(12_600, 3_300), "33 kOhm, 10 kOhm");
        assert_eq!(reported(3_400, 3_300), "330 Ohm, 10 kOhm");
        for mv in (3_301..60_000).step_by(37) {
            let [upper, lower] = divider(mv, 3_300).map(u64::from);
            let left = u64::from(mv) * lower / (upper + lower);
            assert!(left <= 3_300 && left > 2_400, "{mv}: {left}");
        }
    }
}
