//! External interrupts of pads, and the port that each line belongs to (SYSCFG).

use super::mcu::Mcu;
use super::registers::merge;
use super::wires::{NEVER, Wires};
use sensedsl_surroundings::Pad;

/// A line, with the pad that it watches.
#[derive(Clone, Copy, Debug, Default)]
struct Line {
    pad: Option<Pad>,
    level: bool,
    edge: Option<(u64, bool)>,
}

/// EXTI and SYSCFG.
#[derive(Debug, Default)]
pub(super) struct Exti {
    /// The interrupt of each line.
    irqs: [u16; 16],
    imr: u32,
    emr: u32,
    rising: u32,
    falling: u32,
    pending: u32,
    pub remap: u32,
    pmc: u32,
    ports: [u32; 4],
    lines: [Line; 16],
    next_ns: u64,
    version: u64,
}

impl Exti {
    pub(super) fn new(mcu: &Mcu) -> Self {
        Self {
            irqs: std::array::from_fn(|line| mcu.irq("EXTI", &format!("EXTI{line}"))),
            next_ns: NEVER,
            ..Self::default()
        }
    }

    pub(super) fn deadline(&self) -> u64 {
        self.next_ns
    }

    /// The pad of a line if its edges count.
    fn watched(&self, line: u8) -> Option<Pad> {
        let port = self.ports[usize::from(line / 4)] >> (4 * u32::from(line % 4)) & 15;
        let counts =
            (self.rising | self.falling) >> line & 1 == 1 && (self.imr | self.emr) >> line & 1 == 1;
        counts.then_some(Pad { port: u8::try_from(port).unwrap_or(0), pin: line })
    }

    fn look(&mut self, wires: &Wires) {
        for number in 0..16_u8 {
            let pad = self.watched(number);
            let line = &mut self.lines[usize::from(number)];
            if line.pad != pad
                && let Some(pad) = pad
            {
                line.level = wires.level(pad);
            }
            line.pad = pad;
            line.edge = pad.and_then(|pad| wires.next_edge(pad, wires.now));
        }
        self.version = wires.version;
        self.find_next();
    }

    fn find_next(&mut self) {
        self.next_ns = self
            .lines
            .iter()
            .filter_map(|line| line.edge)
            .map(|edge| edge.0)
            .min()
            .unwrap_or(NEVER);
    }

    /// Asks the world again if it may have changed, or if one of the MCU's own pads has changed.
    pub(super) fn review(&mut self, wires: &mut Wires) {
        if self.version == wires.version {
            return;
        }
        for number in 0..16 {
            if let Some(pad) = self.lines[number].pad {
                let level = wires.level(pad);
                self.on_level(number, level);
            }
        }
        self.look(wires);
        self.report(wires);
    }

    fn on_level(&mut self, number: usize, level: bool) {
        let line = &mut self.lines[number];
        if line.level == level {
            return;
        }
        line.level = level;
        let wanted = if level { self.rising } else { self.falling };
        self.pending |= wanted & (1 << number);
    }

    pub(super) fn advance(&mut self, wires: &mut Wires) {
        while self.next_ns <= wires.now {
            let at = self.next_ns;
            for number in 0..16 {
                let line = self.lines[number];
                if let (Some(pad), Some((when, level))) = (line.pad, line.edge)
                    && when <= at
                {
                    self.lines[number].edge = wires.next_edge(pad, when);
                    self.on_level(number, level);
                }
            }
            self.find_next();
        }
        self.report(wires);
    }

    fn report(&self, wires: &mut Wires) {
        let held = self.pending & self.imr;
        for (first, irq) in self.irqs.iter().enumerate() {
            // Lines that share an interrupt hold it together.
            if !self.irqs[..first].contains(irq) {
                let mut lines = (0..).zip(&self.irqs).filter(|(_, other)| *other == irq);
                wires.interrupt(*irq, 0, lines.any(|(line, _)| held >> line & 1 == 1));
            }
        }
    }

    pub(super) fn read(&self, offset: u32) -> u32 {
        match offset {
            0x00 => self.imr,
            0x04 => self.emr,
            0x08 => self.rising,
            0x0C => self.falling,
            0x14 => self.pending,
            _ => 0,
        }
    }

    pub(super) fn write(&mut self, offset: u32, value: u32, mask: u32, wires: &mut Wires) {
        let put = |old: &mut u32| *old = merge(*old, value, mask);
        match offset {
            0x00 => put(&mut self.imr),
            0x04 => put(&mut self.emr),
            0x08 => put(&mut self.rising),
            0x0C => put(&mut self.falling),
            0x10 => self.pending |= value & mask & self.imr,
            0x14 => self.pending &= !(value & mask),
            _ => {}
        }
        if offset < 0x10 {
            self.look(wires);
        }
        self.report(wires);
    }

    pub(super) fn read_ports(&self, offset: u32) -> u32 {
        match offset {
            0x00 => self.remap,
            0x04 => self.pmc,
            0x08..=0x14 => self.ports[((offset - 8) / 4) as usize],
            // The compensation cell is ready.
            0x20 => 0x100,
            _ => 0,
        }
    }

    pub(super) fn write_ports(&mut self, offset: u32, value: u32, mask: u32, wires: &Wires) {
        let put = |old: &mut u32| *old = merge(*old, value, mask);
        match offset {
            0x00 => put(&mut self.remap),
            0x04 => put(&mut self.pmc),
            0x08..=0x14 => put(&mut self.ports[((offset - 8) / 4) as usize]),
            _ => {}
        }
        self.look(wires);
    }
}
