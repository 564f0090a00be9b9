//! How long a board waits for a measuring part, compared with the time that the driver gives.

/// The least number of measurements for a verdict.
const TIMES_MIN: u32 = 3;
/// The time that any wait takes in addition: until the board's next millisecond, and for the transfer.
const SLACK_NS: u64 = 5_000_000;
/// The time that each part on a bus may take before this one's turn comes.
const TURN_NS: u64 = 3_000_000;

/// The measurements of a part that a board has taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Waits {
    times: u32,
    /// The shortest delay of any of them, and the length of a measurement according to the driver.
    least: Option<(u64, u64)>,
}

impl Waits {
    /// Takes a measurement of that length, started at the given time and read now.
    pub(crate) fn take(&mut self, wait_ns: u64, began_ns: u64, now_ns: u64) {
        let late_ns = now_ns.saturating_sub(began_ns.saturating_add(wait_ns));
        self.times += 1;
        let least = self.least.filter(|(least_ns, _)| *least_ns <= late_ns);
        self.least = least.or(Some((late_ns, wait_ns)));
    }

    /// The error if each of them was read much too late. The bus is shared by this many parts.
    pub(crate) fn too_long(&self, parts: u64) -> Option<String> {
        let (late_ns, wait_ns) = self.least.filter(|_| self.times >= TIMES_MIN)?;
        let most_ns = SLACK_NS + TURN_NS * parts + wait_ns / 8;
        let ms = |ns: u64| ns / 1_000_000;
        (late_ns > most_ns).then(|| {
            let waited = ms(wait_ns + late_ns);
            format!(
                "it is read {waited} ms after its trigger at the soonest, and measures for {} ms",
                ms(wait_ns)
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: u64 = 1_000_000;

    fn waited(late_ms: &[u64]) -> Waits {
        let mut waits = Waits::default();
        for (place, late_ms) in (0..).zip(late_ms) {
            let began_ns = place * 100 * MS;
            waits.take(65 * MS, began_ns, began_ns + (65 + late_ms) * MS);
        }
        waits
    }

    #[test]
    fn a_wait_that_is_always_too_long_is_told() {
        let reported = waited(&[65, 66, 65]).too_long(2).unwrap();
        assert_eq!(
            reported,
            "it is read 130 ms after its trigger at the soonest, and measures for 65 ms"
        );
        // The other parts had their turn now and then.
        assert_eq!(waited(&[60, 2, 60, 60]).too_long(2), None);
        assert_eq!(waited(&[12, 14, 13]).too_long(2), None);
        assert_eq!(waited(&[65, 65]).too_long(2), None);
    }
}
