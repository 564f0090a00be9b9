//! A strip of LEDs: levels on its wire in, or bytes with a clock; the colours that its LEDs have out.
//!
//! It knows what the data sheets say of the times on the wire and of the frames, and nothing of how the board makes
//! them: a level lasts as long as it lasts, and whoever sends another shape, order or rest gets other colours, or none.

use sensedsl_job::JobConnection;
use sensedsl_model::kind::encoding::Encoding;

/// Times in picoseconds.
const NS: u64 = 1_000;
/// How far two bytes may be apart for the rounding of times.
const GAP_NS: u64 = 20;
/// The mark and the brightness in the first byte of an LED with a clock.
const MARK: u8 = 0b1110_0000;

/// What an LED takes for a bit: least and most nanoseconds of its high level, and of the low one behind it.
type Bit = [(u64, u64); 2];

/// Worldsemi, data sheet WS2812B; newer ones rest for 280 us.
const WS2812B: Wire =
    Wire { zero: [(250, 550), (700, 1_000)], one: [(650, 950), (300, 600)], rest_ns: 280_000 };
/// Opsco, data sheet SK6812.
const SK6812: Wire =
    Wire { zero: [(150, 450), (750, 1_050)], one: [(450, 750), (450, 750)], rest_ns: 80_000 };

#[derive(Clone, Copy, Debug)]
struct Wire {
    zero: Bit,
    one: Bit,
    rest_ns: u64,
}

/// A frame that has reached the LEDs: their colours; or what is wrong with it.
pub(crate) type Shown = Result<Vec<u8>, String>;

/// A strip.
#[derive(Clone, Debug)]
pub(crate) struct Strip {
    /// The places of the colours in a number, in the order in which the strip takes them.
    colours: Vec<u8>,
    how: How,
}

#[derive(Clone, Debug)]
enum How {
    Wire(Wire, Pulses),
    Clock(Frame),
}

/// What has come on the wire since the last rest.
#[derive(Clone, Debug, Default)]
struct Pulses {
    /// How long the level has been high, and low behind it.
    high_ps: u64,
    low_ps: u64,
    bits: Vec<bool>,
    /// When the last byte ended.
    end_ps: u64,
    wrong: Option<String>,
}

/// What has come with the clock since the last frame.
#[derive(Clone, Debug, Default)]
struct Frame {
    zeros: usize,
    has_started: bool,
    bytes: Vec<u8>,
    leds: Vec<[u8; 4]>,
}

impl Strip {
    /// The strip of a connection; none if it has another part.
    pub(crate) fn of(one: &JobConnection<'_>) -> Option<Self> {
        let spi = one.connection.kind.spi()?;
        let how = match spi.encoding {
            Encoding::Ws2812 => How::Wire(WS2812B, Pulses::default()),
            Encoding::Sk6812 => How::Wire(SK6812, Pulses::default()),
            Encoding::Apa102 => How::Clock(Frame::default()),
            Encoding::Plain | Encoding::Text => return None,
        };
        Some(Self { colours: spi.colours.to_vec(), how })
    }

    /// It has lost its supply.
    pub(crate) fn reset(&mut self) {
        match &mut self.how {
            How::Wire(_, pulses) => *pulses = Pulses::default(),
            How::Clock(frame) => *frame = Frame::default(),
        }
    }

    /// A byte comes with a clock, which a strip on one wire does not see.
    pub(crate) fn clocked(&mut self, byte: u8) -> Option<Shown> {
        let How::Clock(frame) = &mut self.how else { return None };
        let leds = frame.take(byte)?;
        Some(leds.map(|leds| {
            let shown = |[first, colours @ ..]: [u8; 4]| {
                let colours = in_order(&self.colours, &colours);
                [vec![first & !MARK], colours].concat()
            };
            leds.into_iter().flat_map(shown).collect()
        }))
    }

    /// Eight levels come, each of which lasts so many picoseconds. A strip with a clock looks only at its edges.
    pub(crate) fn levels(&mut self, byte: u8, from_ps: u64, bit_ps: u64) -> Option<Shown> {
        let How::Wire(wire, pulses) = &mut self.how else { return None };
        pulses.follow(from_ps);
        let mut bits = None;
        for place in (0..8).rev() {
            bits = pulses.level(*wire, byte >> place & 1 == 1, bit_ps).or(bits);
        }
        pulses.end_ps = from_ps + 8 * bit_ps;
        let colours = &self.colours;
        Some(bits?.and_then(|bits| {
            let bytes: Vec<u8> = bits.chunks(8).map(byte_of).collect();
            if bits.len() % (8 * colours.len().max(1)) != 0 {
                let (found, of) = (bits.len(), 8 * colours.len());
                return Err(format!("{found} bits, which are not LEDs of {of} bits each"));
            }
            Ok(bytes.chunks(colours.len()).flat_map(|led| in_order(colours, led)).collect())
        }))
    }
}

fn byte_of(bits: &[bool]) -> u8 {
    bits.iter().fold(0, |byte, bit| byte << 1 | u8::from(*bit))
}

/// The colours of an LED from the highest place of its number to the lowest: red, green, blue, behind white.
fn in_order(places: &[u8], sent: &[u8]) -> Vec<u8> {
    let mut all: Vec<(u8, u8)> = places.iter().copied().zip(sent.iter().copied()).collect();
    all.sort_by_key(|(place, _)| u8::MAX - place);
    all.into_iter().map(|(_, byte)| byte).collect()
}

impl Pulses {
    /// What the level is between two transfers is nobody's business but between frames.
    fn follow(&mut self, from_ps: u64) {
        let gap_ps = from_ps.saturating_sub(self.end_ps);
        if gap_ps > GAP_NS * NS && (self.high_ps > 0 || !self.bits.is_empty()) {
            let gap_ns = gap_ps / NS;
            self.wrong.get_or_insert(format!("a frame with a gap of {gap_ns} ns in it"));
        }
    }

    /// A level; gives the bits of a frame once the rest behind it is long enough.
    fn level(&mut self, wire: Wire, is_high: bool, ps: u64) -> Option<Result<Vec<bool>, String>> {
        if is_high {
            if self.low_ps > 0 && self.high_ps > 0 {
                self.bit(wire, false);
            }
            if self.low_ps > 0 {
                (self.high_ps, self.low_ps) = (0, 0);
            }
            self.high_ps += ps;
            return None;
        }
        let before_ps = self.low_ps;
        self.low_ps += ps;
        let rest_ps = wire.rest_ns * NS;
        if before_ps >= rest_ps || self.low_ps < rest_ps {
            return None;
        }
        if self.high_ps > 0 {
            self.bit(wire, true);
        }
        self.high_ps = 0;
        let bits = std::mem::take(&mut self.bits);
        match self.wrong.take() {
            Some(wrong) => Some(Err(wrong)),
            None => (!bits.is_empty()).then_some(Ok(bits)),
        }
    }

    /// A pulse is over. The low level of the last one is the rest.
    fn bit(&mut self, wire: Wire, is_last: bool) {
        // The sheets give whole nanoseconds.
        let (high_ns, low_ns) = ((self.high_ps + NS / 2) / NS, (self.low_ps + NS / 2) / NS);
        let is_in = |(least, most): (u64, u64), ns: u64| (least..=most).contains(&ns);
        let is = |[high, low]: Bit| is_in(high, high_ns) && (is_last || is_in(low, low_ns));
        match (is(wire.zero), is(wire.one)) {
            (false, false) => {
                let what = format!("{high_ns} ns high and {low_ns} ns low, neither a 0 nor a 1");
                self.wrong.get_or_insert(what);
            }
            (_, is_one) => self.bits.push(is_one),
        }
    }
}

impl Frame {
    /// Takes a byte; gives the LEDs once the last of them must have its colour. Half a clock an LED goes by until then,
    /// and an SK9822 waits for four more bytes of zeros.
    fn take(&mut self, byte: u8) -> Option<Result<Vec<[u8; 4]>, String>> {
        self.zeros = if byte == 0 { self.zeros + 1 } else { 0 };
        if !self.has_started {
            self.has_started = self.zeros >= 4;
            return None;
        }
        if self.bytes.is_empty() && byte == 0 {
            let needed = 4 + self.leds.len().div_ceil(16);
            let is_over = !self.leds.is_empty() && self.zeros >= needed;
            return is_over.then(|| Ok(std::mem::take(&mut self.leds)));
        }
        if self.bytes.is_empty() && byte & MARK != MARK {
            *self = Self::default();
            return Some(Err(format!("an LED that begins with 0x{byte:02X}, and not with 111")));
        }
        self.bytes.push(byte);
        if let [first, second, third, fourth] = *self.bytes {
            self.leds.push([first, second, third, fourth]);
            self.bytes.clear();
            self.zeros = 0;
        }
        None
    }
}

/// The colours of LEDs that were set to these numbers, as a strip shows them: brightness where it has one, white where
/// it has that, red, green, blue.
pub(crate) fn colours(encoding: Encoding, colours: usize, raw: &[f64]) -> Vec<u8> {
    let led = |raw: &f64| {
        let number = crate::arith::rounded(raw.clamp(0.0, f64::from(u32::MAX))).cast_unsigned();
        let [.., white, red, green, blue] = number.to_be_bytes();
        let first = match (encoding, white & 0x1F) {
            (Encoding::Apa102, 0) => Some(0x1F),
            (Encoding::Apa102, brightness) => Some(brightness),
            (_, _) => (colours > 3).then_some(white),
        };
        first.into_iter().chain([red, green, blue]).collect::<Vec<_>>()
    };
    raw.iter().flat_map(led).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "a test may panic")]

    use super::*;

    /// A strip that is sent pulses of those lengths, each bit of them 100 ns.
    fn sent(pulses: &[(u32, u32)], rest: u32) -> Option<Shown> {
        let how = How::Wire(WS2812B, Pulses::default());
        let mut strip = Strip { colours: vec![1, 2, 0], how };
        let levels = pulses.iter().flat_map(|(high, low)| {
            let high = (0..*high).map(|_| true);
            high.chain((0..*low).map(|_| false))
        });
        let mut bits: Vec<bool> = levels.chain((0..rest).map(|_| false)).collect();
        while !bits.len().is_multiple_of(8) {
            bits.push(false);
        }
        let bytes = bits.chunks(8).map(byte_of).zip(0..);
        let mut shown = None;
        for (byte, at) in bytes {
            shown = strip.levels(byte, at * 800_000, 100_000).or(shown);
        }
        shown
    }

    #[test]
    fn the_times_of_the_levels_decide() {
        // Green 0x80, red 0, blue 0x01.
        let mut pulses = vec![(4, 8); 24];
        pulses[0] = (8, 4);
        pulses[23] = (8, 4);
        assert_eq!(sent(&pulses, 2_800), Some(Ok(vec![0x00, 0x80, 0x01])));
        assert_eq!(sent(&pulses, 2_700), None);
        pulses[3] = (6, 6);
        assert!(sent(&pulses, 2_800).unwrap().unwrap_err().starts_with("600 ns high"));
        pulses[3] = (4, 12);
        assert!(sent(&pulses, 2_800).unwrap().unwrap_err().contains("1200 ns low"));
        assert!(sent(&[(4, 8); 23], 2_800).unwrap().unwrap_err().starts_with("23 bits"));
    }

    #[test]
    fn a_frame_with_a_clock_needs_its_zeros() {
        let sent = |bytes: &[u8]| {
            let how = How::Clock(Frame::default());
            let mut strip = Strip { colours: vec![0, 1, 2], how };
            bytes.iter().fold(None, |shown, byte| strip.clocked(*byte).or(shown))
        };
        let led = [0xFF, 0x30, 0x20, 0x10];
        let frame =
            |start: usize, end: usize| [vec![0; start], led.to_vec(), vec![0; end]].concat();
        assert_eq!(sent(&frame(4, 5)), Some(Ok(vec![31, 0x10, 0x20, 0x30])));
        assert_eq!(sent(&frame(4, 4)), None);
        assert_eq!(sent(&frame(3, 9)), None);
        assert!(sent(&[0, 0, 0, 0, 0x1F, 1, 2, 3]).unwrap().is_err());
        let dark = [0xE1, 0, 0, 0];
        let bytes = [[0; 4].to_vec(), dark.to_vec(), led.to_vec(), vec![0; 5]].concat();
        assert_eq!(sent(&bytes), Some(Ok(vec![1, 0, 0, 0, 31, 0x10, 0x20, 0x30])));
    }
}
