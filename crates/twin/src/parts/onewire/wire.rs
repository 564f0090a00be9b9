//! The wire itself: pulses of the board in, pulses of the parts out.

use super::{Part, READ_ROM};
use crate::truth::Subject;

const US: u64 = 1_000;
/// Lengths of the board's pulses on 1-Wire, as data sheets give them.
const RESET_NS: u64 = 480 * US;
const ONE_MOST_NS: u64 = 15 * US;
const ZERO_LEAST_NS: u64 = 60 * US;
const ZERO_MOST_NS: u64 = 120 * US;
/// From the end of a reset to the answer, and its length.
const PRESENCE_AFTER_NS: u64 = 30 * US;
const PRESENCE_NS: u64 = 120 * US;
/// How long a part holds the wire for a zero that is read.
const HOLD_NS: u64 = 30 * US;
/// The pulses of a burst.
const ANSWER_AFTER_NS: u64 = 30 * US;
const ANSWER_NS: u64 = 80 * US;
const BIT_LOW_NS: u64 = 50 * US;
const ZERO_NS: u64 = 26 * US;
const ONE_NS: u64 = 70 * US;
/// How much later a part answers that is late.
const LATE_NS: u64 = 5_000 * US;

const MATCH_ROM: u8 = 0x55;
const SKIP_ROM: u8 = 0xCC;

/// How far a part on 1-Wire has heard.
#[derive(Clone, Debug)]
enum State {
    /// It does not listen until the next reset.
    Deaf,
    /// The bits since the reset, or since the part was called.
    Hears { bits: Vec<bool>, is_called: bool },
    /// The bits that it sends, and whether it hears a command after them.
    Sends { bits: Vec<bool>, at: usize, is_called: bool },
    /// It measures, and says so.
    Measures,
}

/// A wire with the parts on it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Wire {
    pub(crate) parts: Vec<Part>,
    states: Vec<State>,
    /// When the board pulled the wire low, if it does.
    fell_ns: Option<u64>,
    /// From when to when a part pulls the wire low, in order of their begins.
    pulls: Vec<(u64, u64)>,
}

impl Wire {
    /// Puts a part on the wire.
    pub(crate) fn add(&mut self, part: Part) {
        self.parts.push(part);
        self.states.push(State::Deaf);
    }

    /// The level that the parts and the resistor give it.
    pub(crate) fn level(&self, now_ns: u64) -> bool {
        !self.pulls.iter().any(|(from, to)| (*from..*to).contains(&now_ns))
    }

    /// The next change of that level.
    pub(crate) fn next_edge(&self, after_ns: u64) -> Option<(u64, bool)> {
        let ends = self.pulls.iter().flat_map(|(from, to)| [*from, *to]);
        let mut ends: Vec<u64> = ends.filter(|at| *at > after_ns).collect();
        ends.sort_unstable();
        let changes = |at: &u64| self.level(*at) != self.level(at - 1);
        let at = ends.into_iter().find(changes)?;
        Some((at, self.level(at)))
    }

    /// The board pulls the wire low, or releases it.
    pub(crate) fn driven(&mut self, is_low: bool, subjects: &[Subject], now_ns: u64) {
        match (self.fell_ns, is_low) {
            (None, true) => self.falls(now_ns),
            (Some(fell_ns), false) => self.rises(now_ns - fell_ns, subjects, now_ns),
            (None, false) | (Some(_), true) => {}
        }
    }

    fn pull(&mut self, from_ns: u64, length_ns: u64) {
        self.pulls.push((from_ns, from_ns + length_ns));
    }

    fn falls(&mut self, now_ns: u64) {
        self.fell_ns = Some(now_ns);
        self.pulls.retain(|(_, to)| *to > now_ns);
        let mut has_zero = false;
        for (part, state) in self.parts.iter().zip(&mut self.states) {
            if part.ailment.is_gone {
                continue;
            }
            match state {
                State::Sends { bits, at, .. } => {
                    has_zero |= bits.get(*at) == Some(&false);
                    *at += 1;
                }
                State::Measures => has_zero |= part.is_busy(now_ns),
                State::Deaf | State::Hears { .. } => {}
            }
        }
        if has_zero {
            self.pull(now_ns, HOLD_NS);
        }
    }

    fn rises(&mut self, low_ns: u64, subjects: &[Subject], now_ns: u64) {
        self.fell_ns = None;
        let mut pulls = Vec::new();
        for (part, state) in self.parts.iter_mut().zip(&mut self.states) {
            if part.ailment.is_gone {
                *state = State::Deaf;
                continue;
            }
            let late_ns = if part.ailment.is_late { LATE_NS } else { 0 };
            if !part.is_w1() {
                if part.wakes(low_ns, now_ns) {
                    let bytes = part.burst(subjects, now_ns);
                    pulls.extend(burst(&bytes, now_ns + ANSWER_AFTER_NS + late_ns));
                }
            } else if low_ns >= RESET_NS {
                *state = State::Hears { bits: Vec::new(), is_called: false };
                pulls.push((now_ns + PRESENCE_AFTER_NS + late_ns, PRESENCE_NS));
            } else {
                state.slot(part, low_ns, subjects, now_ns);
            }
        }
        pulls.into_iter().for_each(|(from_ns, length_ns)| self.pull(from_ns, length_ns));
    }
}

impl State {
    /// The board has made a slot.
    fn slot(&mut self, part: &mut Part, low_ns: u64, subjects: &[Subject], now_ns: u64) {
        let is_one = low_ns <= ONE_MOST_NS;
        if !is_one && !(ZERO_LEAST_NS..=ZERO_MOST_NS).contains(&low_ns) {
            *self = Self::Deaf;
            return;
        }
        match self {
            Self::Sends { bits, at, is_called } if *at >= bits.len() && *is_called => {
                *self = Self::Hears { bits: Vec::new(), is_called: true };
            }
            Self::Hears { bits, is_called } => {
                bits.push(is_one);
                if bits.len().is_multiple_of(8) {
                    let sent = bytes(bits);
                    *self = if *is_called {
                        Self::commanded(part, &sent, subjects, now_ns)
                    } else {
                        Self::called(part, &sent)
                    }
                    .unwrap_or_else(|| self.clone());
                }
            }
            Self::Deaf | Self::Measures | Self::Sends { .. } => {}
        }
    }

    /// What the bytes after a reset make of it; `None` if more have to come.
    fn called(part: &Part, sent: &[u8]) -> Option<Self> {
        let hears = || Self::Hears { bits: Vec::new(), is_called: true };
        match sent {
            [SKIP_ROM] => Some(hears()),
            [READ_ROM] => Some(Self::Sends { bits: bits(&part.rom), at: 0, is_called: true }),
            [MATCH_ROM] => None,
            [MATCH_ROM, rom @ ..] if rom.len() < part.rom.len() => None,
            [MATCH_ROM, rom @ ..] => Some(if *rom == part.rom { hears() } else { Self::Deaf }),
            _ => Some(Self::Deaf),
        }
    }

    /// What the bytes of a command make of it; `None` if more have to come.
    fn commanded(part: &mut Part, sent: &[u8], subjects: &[Subject], now_ns: u64) -> Option<Self> {
        let answer = part.command(sent, subjects, now_ns);
        if let Some(answer) = answer {
            return Some(Self::Sends { bits: bits(&answer), at: 0, is_called: false });
        }
        (part.began_ns == Some(now_ns)).then_some(Self::Measures)
    }
}

/// The pulses of a burst: from when, and how long.
fn burst(bytes: &[u8], begin_ns: u64) -> Vec<(u64, u64)> {
    let mut pulls = vec![(begin_ns, ANSWER_NS)];
    let mut at_ns = begin_ns + 2 * ANSWER_NS;
    for bit in bytes.iter().flat_map(|byte| (0..8).map(move |bit| byte << bit & 0x80 != 0)) {
        pulls.push((at_ns, BIT_LOW_NS));
        at_ns += BIT_LOW_NS + if bit { ONE_NS } else { ZERO_NS };
    }
    pulls.push((at_ns, BIT_LOW_NS));
    pulls
}

/// The bits of bytes, the lowest first.
fn bits(bytes: &[u8]) -> Vec<bool> {
    bytes.iter().flat_map(|byte| (0..8).map(move |bit| byte >> bit & 1 != 0)).collect()
}

fn bytes(bits: &[bool]) -> Vec<u8> {
    let byte = |bits: &[bool]| bits.iter().rev().fold(0, |byte, bit| byte << 1 | u8::from(*bit));
    bits.chunks(8).map(byte).collect()
}
