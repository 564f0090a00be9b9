//! Voltages and resistances as people write them.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voltages_are_written_as_people_do() {
        assert_eq!([5_000, 3_300, 12_650, 90].map(shown_mv), ["5 V", "3.3 V", "12.65 V", "0.09 V"]);
    }

    #[test]
    fn resistances_are_written_as_people_do() {
        assert_eq!(
            [820, 10_000, 5_600, 1].map(shown_ohm),
            ["820 Ohm", "10 kOhm", "5.6 kOhm", "1 Ohm"]
        );
    }
}
