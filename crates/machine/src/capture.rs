//! The inputs of timers: captures, encoders, edge counters.

use super::timer::Timer;
use super::wires::{NEVER, Wires};
use sensedsl_surroundings::Pad;

/// The state of a timer's inputs, of which there are two or four.
#[derive(Debug, Default)]
pub(super) struct Inputs {
    names: [String; 4],
    pads: [Option<Pad>; 4],
    levels: [bool; 4],
    edges: [Option<(u64, bool)>; 4],
    /// The number of edges in each channel that its prescaler has swallowed.
    swallowed: [u32; 4],
    pub next_ns: u64,
    version: u64,
}

impl Inputs {
    pub(super) fn new(timer: u8) -> Self {
        Self {
            names: std::array::from_fn(|channel| format!("TIM{timer}_CH{}", channel + 1)),
            pads: [None; 4],
            levels: [false; 4],
            edges: [None; 4],
            swallowed: [0; 4],
            next_ns: NEVER,
            version: 0,
        }
    }

    fn find_next(&mut self) {
        self.next_ns = self.edges.iter().flatten().map(|edge| edge.0).min().unwrap_or(NEVER);
    }
}

impl Timer {
    /// Whether anything in the timer depends on an input.
    fn needs(&self, input: usize) -> bool {
        let own = self.selection(input) == 1;
        let neighbour = self.selection(input ^ 1) == 2;
        let captures = (own && self.ccer >> (4 * input) & 1 == 1)
            || (neighbour && self.ccer >> (4 * (input ^ 1)) & 1 == 1);
        let mode = self.smcr & 7;
        let source = self.smcr >> 4 & 7;
        let controls = match (mode, input) {
            (1..=3, 0 | 1) => true,
            (4..=7, 0) => matches!(source, 4 | 5),
            (4..=7, 1) => source == 6,
            _ => false,
        };
        (captures || controls) && self.cr1 & 1 != 0
    }

    /// Asks the world for the next edges at the inputs that count.
    pub(super) fn look_for_edges(&mut self, wires: &Wires) {
        for input in 0..4 {
            let pad =
                if self.needs(input) { wires.pad_of(&self.inputs.names[input]) } else { None };
            if pad != self.inputs.pads[input]
                && let Some(pad) = pad
            {
                self.inputs.levels[input] = wires.level(pad);
                self.inputs.swallowed[input] = 0;
            }
            self.inputs.pads[input] = pad;
            self.inputs.edges[input] = pad.and_then(|pad| wires.next_edge(pad, wires.now));
        }
        self.inputs.version = wires.version;
        self.inputs.find_next();
    }

    /// Asks again if the world may have changed.
    pub(super) fn review_edges(&mut self, wires: &Wires) {
        let watches = (0..4).any(|input| self.inputs.pads[input].is_some() || self.needs(input));
        if watches && self.inputs.version != wires.version {
            self.look_for_edges(wires);
        }
    }

    /// Handles all edges up to a time.
    pub(super) fn take_edges(&mut self, at: u64, wires: &Wires) {
        for input in 0..4 {
            let Some((when, level)) = self.inputs.edges[input] else { continue };
            if when > at {
                continue;
            }
            self.inputs.edges[input] =
                self.inputs.pads[input].and_then(|pad| wires.next_edge(pad, when));
            if level != self.inputs.levels[input] {
                self.inputs.levels[input] = level;
                self.on_edge(input, level, at);
            }
        }
        self.inputs.find_next();
    }

    fn on_edge(&mut self, input: usize, is_rising: bool, at: u64) {
        match self.smcr & 7 {
            1..=3 if input < 2 => self.turn(input, at),
            7 if self.is_trigger(input, is_rising) => self.step(true, at),
            _ => {}
        }
        // The register takes the count before the slave controller resets it.
        for channel in [input, input ^ 1] {
            let selects = if channel == input { 1 } else { 2 };
            let is_on = self.ccer >> (4 * channel) & 1 == 1;
            if is_on
                && self.selection(channel) == selects
                && self.likes(channel, is_rising)
                && self.divide(channel)
            {
                self.capture(channel, at);
            }
        }
        if self.smcr & 7 == 4 && self.is_trigger(input, is_rising) {
            self.restart(at);
        }
    }

    /// Whether an edge has the polarity that a channel is set to.
    fn likes(&self, channel: usize, is_rising: bool) -> bool {
        match self.ccer >> (4 * channel + 1) & 5 {
            0 => is_rising,
            1 => !is_rising,
            _ => true,
        }
    }

    fn divide(&mut self, channel: usize) -> bool {
        let prescaler = self.ccmr[channel / 2] >> (2 + 8 * (channel % 2)) & 3;
        let swallowed = &mut self.inputs.swallowed[channel];
        *swallowed += 1;
        let is_full = *swallowed >= 1 << prescaler;
        if is_full {
            *swallowed = 0;
        }
        is_full
    }

    fn is_trigger(&self, input: usize, is_rising: bool) -> bool {
        match (self.smcr >> 4 & 7, input) {
            (4, 0) => true,
            (5, 0) => self.likes(0, is_rising),
            (6, 1) => self.likes(1, is_rising),
            _ => false,
        }
    }

    /// A step of an encoder: its direction depends on the level of the other track (table 97 of the manual).
    fn turn(&mut self, input: usize, at: u64) {
        let mode = self.smcr & 7;
        // Mode 1 counts at TI2's edges, mode 2 at TI1's, mode 3 at both.
        if (mode == 1 && input == 0) || (mode == 2 && input == 1) {
            return;
        }
        let is_inverted = |channel: usize| self.ccer >> (4 * channel + 1) & 1 == 1;
        let a = self.inputs.levels[0] != is_inverted(0);
        let b = self.inputs.levels[1] != is_inverted(1);
        let is_up = if input == 0 { a != b } else { a == b };
        self.cr1 = if is_up { self.cr1 & !0x10 } else { self.cr1 | 0x10 };
        self.step(is_up, at);
    }
}
