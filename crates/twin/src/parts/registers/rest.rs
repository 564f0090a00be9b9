//! How long a part must be left alone while it is set up. In: its driver's pauses. Out: the first one that was not
//! kept.

use sensedsl_model::protocol::InitStep;

const MS_NS: u64 = 1_000_000;
/// By how much a pause may be too short, in per cent: a driver gives the longest time.
const PERCENT: u64 = 2;
/// The further time by which a pause may be too short: firmware counts from the moment it hands over the last byte,
/// which then takes 90 us on the bus at 100 kHz.
const BYTE_NS: u64 = 100_000;

/// The pause that a part is in.
#[derive(Clone, Debug, Default)]
pub(super) struct Pause {
    /// The start, the length in milliseconds, and the bytes written before it.
    now: Option<(u64, u64, Vec<u8>)>,
    /// The first pause that was not kept, in words.
    broken: Option<String>,
}

impl Pause {
    /// That many setup writes are done: the driver may require a pause after the last one.
    pub(super) fn begin(&mut self, init: &[InitStep], writes: usize, now_ns: u64) {
        self.now = pause(init, writes).map(|(ms, bytes)| (now_ns, ms, bytes.to_vec()));
    }

    /// The board addresses the part.
    pub(super) fn touch(&mut self, now_ns: u64) {
        let Some((since_ns, ms, bytes)) = self.now.take() else { return };
        let waited_ns = now_ns.saturating_sub(since_ns);
        let least_ns = (MS_NS * ms * (100 - PERCENT) / 100).saturating_sub(BYTE_NS);
        if self.broken.is_none() && waited_ns < least_ns {
            let waited = crate::arith::number(waited_ns / 100_000) / 10.0;
            let bytes = super::odd::hex(&bytes);
            self.broken = Some(format!(
                "it is asked {waited:.1} ms after {bytes} is written, and needs {ms} ms"
            ));
        }
    }

    /// The supply was lost: the part is no longer in a pause.
    pub(super) fn again(&self) -> Self {
        Self { now: None, broken: self.broken.clone() }
    }

    /// The first pause that was not kept.
    pub(super) fn broken(&self) -> Option<String> {
        self.broken.clone()
    }
}

/// The pause that the driver requires after that many writes, in milliseconds, and the bytes of the last one.
fn pause(init: &[InitStep], writes: usize) -> Option<(u64, &[u8])> {
    let is_write = |step: &InitStep| matches!(step, InitStep::Write(_));
    let places = init.iter().enumerate().filter(|(_, step)| is_write(step));
    let last = places.map(|(place, _)| place).nth(writes.checked_sub(1)?)?;
    let (write, after) = init.get(last..)?.split_first()?;
    let InitStep::Write(bytes) = write else { return None };
    let waits = after.iter().map_while(|step| match step {
        InitStep::Wait { ms } => Some(u64::from(*ms)),
        InitStep::Write(_) => None,
    });
    let ms = waits.sum();
    (ms > 0).then_some((ms, bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn broken(waited_us: u64) -> Option<String> {
        let init = [
            InitStep::Write(vec![0x0A, 0x80]),
            InitStep::Wait { ms: 6 },
            InitStep::Wait { ms: 4 },
            InitStep::Write(vec![0x0B, 0x01]),
        ];
        let mut rest = Pause::default();
        rest.begin(&init, 1, 5 * MS_NS);
        rest.touch(5 * MS_NS + 1_000 * waited_us);
        rest.begin(&init, 2, 20 * MS_NS);
        rest.touch(20 * MS_NS);
        rest.broken()
    }

    #[test]
    fn a_pause_that_is_left_out_is_told() {
        let reported = broken(200).unwrap();
        assert_eq!(reported, "it is asked 0.2 ms after 0A 80 is written, and needs 10 ms");
        assert!(broken(5_000).is_some());
        assert_eq!(broken(9_900), None);
        assert_eq!(broken(20_000), None);
    }
}
