//! The timers: time base, compare, PWM, and the registers of all modes. Inputs are in `capture.rs`.
//!
//! A counter is only computed when it is read; between changes of its settings it is a linear function of time.

use super::capture::Inputs;
use super::mcu::Mcu;
use super::registers::merge;
use super::wires::{NEVER, Wires, periods_in, periods_ns};
use sensedsl_surroundings::TimerOutput;

/// Bits of SR and DIER.
const UPDATE: u32 = 1;
const TRIGGER: u32 = 1 << 6;

/// The hardware variant of a timer.
#[derive(Clone, Copy, Debug, Default)]
struct Variant {
    /// The timer's number: `3` is TIM3.
    number: u8,
    channels: u8,
    is_wide: bool,
    /// The number of channels that have complements. With any, there is a switch for all outputs.
    complements: usize,
    is_on_apb2: bool,
    /// The interrupts for update, for trigger, and for capture and compare; `holder` identifies the timer among those
    /// that share them.
    irqs: [u16; 3],
    holder: u8,
}

impl Variant {
    fn new(index: usize, mcu: &Mcu) -> Self {
        let number = u8::try_from(index + 1).unwrap_or(1);
        let name = format!("TIM{number}");
        let shape = mcu.shape(&name);
        Self {
            number,
            channels: match shape {
                "TIM_1CH" | "TIM_1CH_CMP" => 1,
                "TIM_2CH" | "TIM_2CH_CMP" => 2,
                "TIM_ADV" | "TIM_GP16" | "TIM_GP32" => 4,
                _ => 0,
            },
            is_wide: shape == "TIM_GP32",
            complements: match shape {
                "TIM_ADV" => 3,
                "TIM_1CH_CMP" | "TIM_2CH_CMP" => 1,
                _ => 0,
            },
            is_on_apb2: mcu.is_on_apb2(&name),
            irqs: ["UP", "TRG", "CC"].map(|signal| mcu.irq(&name, signal)),
            // The small timers share the lines of TIM1 and TIM8.
            holder: u8::from(number > 8),
        }
    }
}

/// A timer.
#[derive(Debug, Default)]
pub(super) struct Timer {
    variant: Variant,
    pub cr1: u32,
    cr2: u32,
    pub smcr: u32,
    dier: u32,
    sr: u32,
    pub ccmr: [u32; 2],
    pub ccer: u32,
    psc: u32,
    arr: u32,
    rcr: u32,
    ccr: [u32; 4],
    bdtr: u32,
    other: [u32; 3],
    /// The prescaler in use: a new one takes effect at the next update.
    prescaler: u64,
    /// The count at the base time, from which it goes on.
    base_count: u64,
    base_ns: u64,
    hz: u64,
    /// The count, from the base on, up to which flags have been raised.
    seen: u64,
    next: u64,
    pub inputs: Inputs,
    /// Period and width for each channel, and for its complement.
    waveforms: [[(u64, u64); 2]; 4],
    /// The DMA requests that were not served yet, with a bit for the update and for each channel.
    asking: u32,
}

impl Timer {
    pub(super) fn new(index: usize, mcu: &Mcu) -> Self {
        let variant = Variant::new(index, mcu);
        let arr = if variant.is_wide { u32::MAX } else { 0xFFFF };
        Self {
            variant,
            arr,
            prescaler: 1,
            // The first write sets it.
            hz: 1,
            next: NEVER,
            inputs: Inputs::new(variant.number),
            ..Self::default()
        }
    }

    fn limit(&self) -> u64 {
        u64::from(self.arr) + 1
    }

    /// Whether the counter is driven by time and not by edges. A period of 0 blocks it.
    fn runs(&self) -> bool {
        self.cr1 & 1 != 0 && self.arr != 0 && !matches!(self.smcr & 7, 1..=3 | 7)
    }

    /// The count from the base on, not wrapped.
    fn total(&self, now: u64) -> u64 {
        if !self.runs() {
            return self.base_count;
        }
        self.base_count + periods_in(now.saturating_sub(self.base_ns), self.hz) / self.prescaler
    }

    /// The time at which the count is `total`.
    fn when(&self, total: u64) -> u64 {
        let ticks = total.saturating_sub(self.base_count).saturating_mul(self.prescaler);
        self.base_ns.saturating_add(periods_ns(ticks, self.hz))
    }

    pub(super) fn count(&self, now: u64) -> u32 {
        let count = self.total(now) % self.limit();
        let is_down = self.cr1 >> 4 & 1 == 1 && self.runs();
        let count = if is_down { u64::from(self.arr) - count } else { count };
        u32::try_from(count).unwrap_or(u32::MAX)
    }

    /// Goes on from a count at a given time.
    pub(super) fn rebase(&mut self, count: u64, at: u64) {
        self.base_count = count % self.limit();
        self.base_ns = at;
        self.seen = self.base_count;
    }

    /// Counts an edge, up or down.
    pub(super) fn step(&mut self, is_up: bool, at: u64) {
        let limit = self.limit();
        let count = (self.base_count + if is_up { 1 } else { limit - 1 }) % limit;
        let has_wrapped = count == if is_up { 0 } else { limit - 1 };
        self.rebase(count, at);
        if has_wrapped {
            self.update();
        }
        for channel in 0..usize::from(self.variant.channels) {
            if self.compares(channel) && u64::from(self.ccr[channel]) == count {
                self.raise_channel(channel);
            }
        }
    }

    fn update(&mut self) {
        self.sr |= UPDATE;
        if self.dier >> 8 & 1 == 1 {
            self.asking |= 1;
        }
    }

    fn raise_channel(&mut self, channel: usize) {
        self.sr |= 2 << channel;
        if self.dier >> (9 + channel) & 1 == 1 {
            self.asking |= 2 << channel;
        }
    }

    /// Takes the counter into a channel's register.
    pub(super) fn capture(&mut self, channel: usize, at: u64) {
        if self.sr >> (1 + channel) & 1 == 1 {
            self.sr |= 0x200 << channel;
        }
        // An edge that coincides with a tick of the counter captures the count before it.
        self.ccr[channel] = self.count(at.saturating_sub(1));
        self.raise_channel(channel);
    }

    /// Resets the counter at an edge (reset mode of the slave controller).
    pub(super) fn restart(&mut self, at: u64) {
        self.rebase(0, at);
        self.sr |= TRIGGER;
        if self.cr1 & 4 == 0 {
            self.update();
        }
    }

    fn compares(&self, channel: usize) -> bool {
        channel < usize::from(self.variant.channels) && self.selection(channel) == 0
    }

    /// The use of a channel: 0 is an output, 1 an input from its own wire, 2 from its neighbour's, 3 from the trigger.
    pub(super) fn selection(&self, channel: usize) -> u32 {
        self.ccmr[channel / 2] >> (8 * (channel % 2)) & 3
    }

    pub(super) fn deadline(&self) -> u64 {
        self.next.min(self.inputs.next_ns)
    }

    /// Raises the flags for everything that has happened up to `now`.
    pub(super) fn catch_up(&mut self, now: u64, wires: &mut Wires) {
        let (limit, total) = (self.limit(), self.total(now));
        if total <= self.seen {
            return;
        }
        for channel in 0..usize::from(self.variant.channels) {
            let compare = u64::from(self.ccr[channel]);
            if self.compares(channel) && next_match(self.seen, compare, limit) <= total {
                self.raise_channel(channel);
            }
        }
        if total / limit > self.seen / limit && self.cr1 & 2 == 0 {
            let start = self.when(total / limit * limit);
            self.update();
            self.prescaler = u64::from(self.psc) + 1;
            if self.cr2 >> 4 & 7 == 2 {
                wires.triggers |= 1 << (self.variant.number - 1);
            }
            if self.cr1 & 8 != 0 {
                self.single_pulses(now, wires);
                self.cr1 &= !1;
                self.rebase(0, now);
                return;
            }
            // The new period starts where the last one ended.
            self.rebase(0, start);
            self.seen = total % limit;
            return;
        }
        self.seen = total;
    }

    pub(super) fn advance(&mut self, wires: &mut Wires) {
        while self.inputs.next_ns <= wires.now {
            let at = self.inputs.next_ns;
            self.catch_up(at, wires);
            self.take_edges(at, wires);
        }
        self.catch_up(wires.now, wires);
        self.settle(wires);
    }

    /// Finds the next event, and updates the interrupt lines.
    pub(super) fn settle(&mut self, wires: &mut Wires) {
        self.next = self.next_event();
        let held = self.sr & self.dier;
        let [update, trigger, channels] = self.variant.irqs;
        let lines = [(update, UPDATE), (trigger, TRIGGER), (channels, 0x1E)];
        for (at, (irq, _)) in lines.iter().enumerate() {
            // Each of several causes on one line counts.
            let causes = lines.iter().filter(|(other, _)| other == irq).map(|(_, bits)| bits);
            let is_first = lines[..at].iter().all(|(other, _)| other != irq);
            if is_first {
                let bits = causes.fold(0, |all, bits| all | bits);
                wires.interrupt(*irq, self.variant.holder, held & bits != 0);
            }
        }
    }

    fn next_event(&self) -> u64 {
        if !self.runs() {
            return NEVER;
        }
        let limit = self.limit();
        let wanted = self.dier | self.dier >> 8;
        let mut next = NEVER;
        let triggers = self.cr2 >> 4 & 7 == 2;
        if wanted & UPDATE != 0 || triggers || self.cr1 & 8 != 0 {
            next = self.when((self.seen / limit + 1) * limit);
        }
        for channel in 0..usize::from(self.variant.channels) {
            if wanted >> (1 + channel) & 1 == 1 && self.compares(channel) {
                let total = next_match(self.seen, u64::from(self.ccr[channel]), limit);
                if total != NEVER {
                    next = next.min(self.when(total));
                }
            }
        }
        next
    }

    pub(super) fn asks(&self, channel: usize) -> bool {
        self.asking >> channel & 1 == 1
    }

    pub(super) fn was_served(&mut self, channel: usize) {
        self.asking &= !(1 << channel);
    }

    pub(super) fn read(&mut self, offset: u32, wires: &mut Wires) -> u32 {
        self.advance(wires);
        let value = match offset {
            0x00 => self.cr1,
            0x04 => self.cr2,
            0x08 => self.smcr,
            0x0C => self.dier,
            0x10 => self.sr,
            0x18 => self.ccmr[0],
            0x1C => self.ccmr[1],
            0x20 => self.ccer,
            0x24 => self.count(wires.now),
            0x28 => self.psc,
            0x2C => self.arr,
            0x30 => self.rcr,
            0x34..=0x40 => {
                let channel = ((offset - 0x34) / 4) as usize;
                // Reading a captured value acknowledges it.
                if self.selection(channel) != 0 {
                    self.sr &= !(2 << channel);
                }
                self.ccr[channel]
            }
            0x44 => self.bdtr,
            0x48..=0x50 => self.other[((offset - 0x48) / 4) as usize],
            _ => 0,
        };
        self.settle(wires);
        value
    }

    pub(super) fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        self.advance(wires);
        let now = wires.now;
        let count = self.total(now) % self.limit();
        let mut goes_on = true;
        let put = |old: &mut u32| *old = merge(*old, value, mask);
        match offset {
            0x00 => put(&mut self.cr1),
            0x04 => put(&mut self.cr2),
            0x08 => put(&mut self.smcr),
            0x0C => put(&mut self.dier),
            0x10 => self.sr &= value | !mask,
            0x14 => {
                goes_on = false;
                self.generate(value & mask, wires);
            }
            0x18 => put(&mut self.ccmr[0]),
            0x1C => put(&mut self.ccmr[1]),
            0x20 => put(&mut self.ccer),
            0x24 => {
                goes_on = false;
                self.rebase(u64::from(value & mask), now);
            }
            0x28 => put(&mut self.psc),
            0x2C => put(&mut self.arr),
            0x30 => put(&mut self.rcr),
            0x34..=0x40 => put(&mut self.ccr[((offset - 0x34) / 4) as usize]),
            0x44 => put(&mut self.bdtr),
            0x48..=0x50 => put(&mut self.other[((offset - 0x48) / 4) as usize]),
            _ => {}
        }
        let clocks = wires.clocks;
        let hz = if self.variant.is_on_apb2 { clocks.timers2 } else { clocks.timers1 };
        if goes_on && (hz != self.hz || matches!(offset, 0x00 | 0x08 | 0x2C)) {
            self.hz = hz;
            self.rebase(count, now);
        }
        self.hz = hz;
        if matches!(offset, 0x00 | 0x08 | 0x18 | 0x1C | 0x20) {
            self.look_for_edges(wires);
        }
        self.settle(wires);
        self.report_waveforms(wires);
    }

    /// Generates events for the program.
    fn generate(&mut self, bits: u32, wires: &mut Wires) {
        if bits & 1 != 0 {
            self.prescaler = u64::from(self.psc) + 1;
            self.rebase(0, wires.now);
            if self.cr1 & 4 == 0 {
                self.update();
            }
            if self.cr2 >> 4 & 7 == 2 {
                wires.triggers |= 1 << (self.variant.number - 1);
            }
        }
        for channel in 0..usize::from(self.variant.channels) {
            if bits >> (1 + channel) & 1 == 1 {
                self.raise_channel(channel);
            }
        }
    }

    /// A period after which the counter stops ends: each output that was on for the end of it has made one pulse.
    fn single_pulses(&self, now: u64, wires: &mut Wires) {
        for channel in 0..usize::from(self.variant.channels) {
            let (period, width) = self.shape(channel, false);
            if width > 0 && width < period {
                let timer = self.variant.number;
                let number = u8::try_from(channel + 1).unwrap_or(0);
                let output = TimerOutput { timer, channel: number, is_complement: false };
                let from = now.saturating_sub(width);
                wires.world(|world, _| world.pulse(output, from, width));
            }
        }
    }

    fn report_waveforms(&mut self, wires: &mut Wires) {
        for channel in 0..usize::from(self.variant.channels) {
            for is_complement in [false, true] {
                let waveform = self.waveform(channel, is_complement);
                if waveform != self.waveforms[channel][usize::from(is_complement)] {
                    self.waveforms[channel][usize::from(is_complement)] = waveform;
                    let timer = self.variant.number;
                    let number = u8::try_from(channel + 1).unwrap_or(0);
                    let output = TimerOutput { timer, channel: number, is_complement };
                    let (period, width) = waveform;
                    wires.world(|world, now| world.pwm(output, period, width, now));
                }
            }
        }
    }

    /// Period and width of the pulses that an output makes again and again; those that are made one by one are told as
    /// they end.
    fn waveform(&self, channel: usize, is_complement: bool) -> (u64, u64) {
        if self.cr1 & 8 != 0 { (0, 0) } else { self.shape(channel, is_complement) }
    }

    /// Period and width, in nanoseconds, of the output of a channel or its complement. A complement that is on alone
    /// follows the channel; next to an active channel, it is inverted (RM0090, table 97).
    fn shape(&self, channel: usize, is_complement: bool) -> (u64, u64) {
        if is_complement && channel >= self.variant.complements {
            return (0, 0);
        }
        let mode = self.ccmr[channel / 2] >> (4 + 8 * (channel % 2)) & 7;
        let own = self.ccer >> (4 * channel) & 15;
        let (bits, is_against) =
            if is_complement { (own >> 2, own & 1 == 1) } else { (own, false) };
        let is_on = bits & 1 == 1 && self.cr1 & 1 != 0;
        let main = self.variant.complements == 0 || self.bdtr >> 15 & 1 == 1;
        if !is_on || !main || !self.compares(channel) || !matches!(mode, 6 | 7) {
            return (0, 0);
        }
        let scale = u64::from(self.psc) + 1;
        // A counter that goes up and down takes twice as long.
        let both = if self.cr1 >> 5 & 3 == 0 { 1 } else { 2 };
        let ticks = u64::from(self.ccr[channel]).min(self.limit());
        let is_inverted = (mode == 7) ^ (bits >> 1 & 1 == 1) ^ is_against;
        let high = if is_inverted { self.limit() - ticks } else { ticks };
        let ns = |ticks: u64| periods_ns(ticks * scale * both, self.hz);
        (ns(self.limit()), ns(high))
    }
}

/// The first count after `seen` at which a counter that wraps at `limit` is at `compare`.
fn next_match(seen: u64, compare: u64, limit: u64) -> u64 {
    if compare >= limit {
        return NEVER;
    }
    let base = seen / limit * limit + compare;
    if base > seen { base } else { base + limit }
}
