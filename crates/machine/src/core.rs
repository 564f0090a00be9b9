//! The core with its memory, and the loop in which it and the chip take turns.

use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rsemu::core::error::BusError;
use rsemu::core::space::{
    AddressSpace, MemAttrs, MemOps, MemResult, RamStore, Region, UnassignedPolicy,
};
use rsemu::cpu::arm::v7m::sys::Exception;
use rsemu::cpu::arm::v7m::{ArmV7m, Config};

use super::Settings;
use super::chip::Chip;
use super::line::Line;
use super::lockup::Lockup;
use super::map::DEBUG_BASE;
use super::mcu::{self, Mcu};
use super::rcc;
use super::transfer::{CCM_BASE, FLASH_BASE, Memory, SRAM_BASE};
use super::wires::{Event, SECOND_NS, Wires};
use sensedsl_surroundings::Surroundings;

/// The address range of the peripherals, up to the core's own.
const PERIPHERALS: u32 = 0x4000_0000;
const PERIPHERALS_BYTES: u64 = 0x2000_0000;
/// The size of the system memory's part that has the unique number and the size of the flash.
const SYSTEM_BYTES: u64 = 0x1000;
/// A core that stands still for so long, without a watchdog, does so for ever.
const PATIENCE_NS: u64 = 3 * SECOND_NS;
/// Bits of the status register: the position in a block of conditional instructions, and the number of the exception
/// being handled.
const BLOCK: u32 = 0x0600_FC00;
const EXCEPTION: u32 = 0x1FF;
/// In a stacked status: set if a padding word aligns the stack.
const ALIGNED: u32 = 1 << 9;
/// The least value of the link register in a handler.
const EXC_RETURN: u32 = 0xFFFF_FFE0;
/// The number of steps between two checks whether the core waits.
const STEPS_BETWEEN_LOOKS: u32 = 8;
/// The number of steps on one instruction that count as a standstill.
const STEPS_OF_A_STAND: usize = 3;

/// The state shared by the loop and the bus.
#[derive(Debug, Default)]
struct Shared {
    /// The number of cycles since power-up.
    cycles: AtomicU64,
    /// The address of the current instruction.
    pc: AtomicU32,
    /// Whether the chip may have something new for the core, or an earlier deadline.
    touched: AtomicBool,
}

/// The peripherals on the core's bus.
struct Bus {
    chip: Arc<Mutex<Chip>>,
    line: Arc<Mutex<Line>>,
    shared: Arc<Shared>,
    base: u32,
}

impl fmt::Debug for Bus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Bus")
    }
}

fn lock<T: ?Sized>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Bus {
    fn with<T>(&self, act: impl FnOnce(&mut Chip) -> Option<T>) -> Result<T, BusError> {
        let mut chip = lock(&self.chip);
        let now = lock(&self.line).ns_at(self.shared.cycles.load(Ordering::Relaxed));
        chip.wires.now = now.max(chip.wires.now);
        chip.pc = self.shared.pc.load(Ordering::Relaxed);
        let result = act(&mut chip).ok_or(BusError::Unassigned)?;
        chip.accessed();
        self.shared.touched.store(true, Ordering::Relaxed);
        Ok(result)
    }
}

impl MemOps for Bus {
    fn read(&self, offset: u64, dst: &mut [u8], attrs: MemAttrs) -> MemResult {
        if attrs.debug {
            return Err(BusError::Unassigned);
        }
        let address = self.base + u32::try_from(offset).unwrap_or(0);
        let size = u32::try_from(dst.len()).unwrap_or(4);
        let value = self.with(|chip| chip.fetch(address, size))?;
        for (slot, byte) in dst.iter_mut().zip(value.to_le_bytes()) {
            *slot = byte;
        }
        Ok(())
    }

    fn write(&self, offset: u64, src: &[u8], attrs: MemAttrs) -> MemResult {
        if attrs.debug {
            return Err(BusError::Unassigned);
        }
        let address = self.base + u32::try_from(offset).unwrap_or(0);
        let value = src.iter().rev().fold(0, |value, byte| value << 8 | u32::from(*byte));
        let size = u32::try_from(src.len()).unwrap_or(4);
        self.with(|chip| chip.put(address, value, size))
    }
}

/// The core, its memory and the chip around it.
pub(super) struct Core {
    cpu: ArmV7m,
    chip: Arc<Mutex<Chip>>,
    line: Arc<Mutex<Line>>,
    shared: Arc<Shared>,
    settings: Settings,
    surroundings: Arc<Mutex<dyn Surroundings>>,
    waited: u64,
    executed: u64,
    /// The address at which it last waited: instructions executed there are not work.
    rests_at: u32,
    lockup: Option<Lockup>,
    /// The address at which the core stands still, and the time since when.
    stands: Option<(u32, u64)>,
    is_off: bool,
}

impl Core {
    pub(super) fn new(settings: Settings, surroundings: Arc<Mutex<dyn Surroundings>>) -> Self {
        let mcu = settings.mcu;
        let memory = Memory::new(mcu);
        let rcc = rcc::new(mcu, settings.crystal_hz);
        let hz = rcc.clocks().core;
        let wires = Wires::new(Arc::clone(&surroundings), settings.link, rcc.clocks(), mcu);
        let chip = Chip::new(wires, memory.clone(), rcc, mcu);
        let chip = Arc::new(Mutex::new(chip));
        let line = Arc::new(Mutex::new(Line { cycles: 0, ns: 0, hz }));
        let shared = Arc::new(Shared::default());
        let space = AddressSpace::new("mcu", 32).with_unassigned(UnassignedPolicy::FAULT);
        map_memory(&space, &memory, mcu);
        for (base, bytes) in [(PERIPHERALS, PERIPHERALS_BYTES), (DEBUG_BASE, 0x400)] {
            let bus = Bus {
                chip: Arc::clone(&chip),
                line: Arc::clone(&line),
                shared: Arc::clone(&shared),
                base,
            };
            map(&space, Region::io("peripherals", bytes, Arc::new(bus)), u64::from(base));
        }
        let core = match mcu.core {
            mcu::Core::M3 => Config::CORTEX_M3,
            mcu::Core::M4F => Config::CORTEX_M4F,
        };
        let cpu = ArmV7m::new(core.with_priority_bits(4));
        cpu.attach_space(Arc::new(space));
        Self {
            cpu,
            chip,
            line,
            shared,
            settings,
            surroundings,
            waited: 0,
            executed: 0,
            rests_at: 0,
            lockup: None,
            stands: None,
            is_off: false,
        }
    }

    pub(super) fn chip(&self) -> MutexGuard<'_, Chip> {
        lock(&self.chip)
    }

    pub(super) fn load(&mut self, flash: &[u8]) {
        *self = Self::new(self.settings, Arc::clone(&self.surroundings));
        let memory = self.chip().memory();
        // The lengths were compared with the size of the flash before.
        let _ = memory.flash.fill(0, memory.flash.len(), 0xFF);
        let _ = memory.flash.write_at(0, flash);
        self.cpu.request_reset();
    }

    pub(super) const fn mcu(&self) -> &'static Mcu {
        self.settings.mcu
    }

    pub(super) fn pc(&self) -> u32 {
        self.cpu.pc()
    }

    pub(super) fn cycles_worked(&self) -> u64 {
        self.shared.cycles.load(Ordering::Relaxed) - self.waited
    }

    pub(super) const fn executed(&self) -> u64 {
        self.executed
    }

    pub(super) fn lockup(&self) -> Option<Lockup> {
        self.lockup.clone()
    }

    pub(super) fn run_until(&mut self, end_ns: u64) {
        loop {
            let limit = self.turn_of_chip(end_ns);
            if self.chip().wires.now >= end_ns {
                return;
            }
            if self.is_off {
                let passed = self.shared.cycles.load(Ordering::Relaxed).max(limit);
                self.waited += passed - self.shared.cycles.swap(passed, Ordering::Relaxed);
            } else {
                self.turn_of_core(limit);
            }
        }
    }

    /// Takes the supply away or gives it back. Memory without power loses its contents.
    pub(super) fn power(&mut self, is_on: bool) {
        if self.is_off != is_on {
            return;
        }
        self.is_off = !is_on;
        let mut chip = lock(&self.chip);
        let memory = chip.memory();
        // The length is the memory's own.
        let _ = memory.sram.fill(0, memory.sram.len(), 0xA5);
        let link = &mut chip.wires.link;
        link.to_mcu.clear();
        chip.reset = Some(super::ResetCause::Power);
    }

    /// Lets the chip handle what is due; returns the cycle at which it must be called again.
    fn turn_of_chip(&mut self, end_ns: u64) -> u64 {
        self.shared.touched.store(false, Ordering::Relaxed);
        let cycles = self.shared.cycles.load(Ordering::Relaxed);
        let mut chip = lock(&self.chip);
        let mut line = lock(&self.line);
        let now = line.ns_at(cycles).max(chip.wires.now);
        chip.wires.now = now;
        if chip.deadline() <= now {
            chip.advance();
        }
        if line.hz != chip.wires.clocks.core || cycles - line.cycles > line.hz {
            *line = Line { cycles, ns: now, hz: chip.wires.clocks.core.max(1) };
        }
        if chip.wires.has_changed_lines() {
            for (irq, level) in chip.wires.take_changed() {
                self.cpu.set_irq(irq, level);
            }
        }
        if self.cpu.reset_requested() {
            self.cpu.clear_reset_request();
            chip.reset = Some(super::ResetCause::Software);
        }
        if let Some(cause) = chip.reset.take() {
            if !self.is_off {
                chip.wires.events.push(Event::Reset { at_ns: now, cause });
            }
            chip.restart(cause);
            for (irq, level) in chip.wires.take_changed() {
                self.cpu.set_irq(irq, level);
            }
            *line = Line { cycles, ns: now, hz: chip.wires.clocks.core };
            (self.lockup, self.stands) = (None, None);
            self.cpu.request_reset();
        }
        line.cycles_at(chip.deadline().min(end_ns))
    }

    fn turn_of_core(&mut self, limit: u64) {
        let mut cycles = self.shared.cycles.load(Ordering::Relaxed);
        let mut steps = 0;
        while cycles < limit && !self.shared.touched.load(Ordering::Relaxed) {
            steps += 1;
            if steps % STEPS_BETWEEN_LOOKS == 0 {
                let pc = self.cpu.pc();
                self.shared.pc.store(pc, Ordering::Relaxed);
                if self.stands_at(pc, &mut cycles) {
                    cycles = self.wait(cycles, limit);
                } else {
                    self.stands = None;
                }
                if self.cpu.reset_requested() {
                    return;
                }
            } else {
                cycles += self.step();
                self.shared.cycles.store(cycles, Ordering::Relaxed);
            }
        }
    }

    /// Whether each of several steps leads back to the same instruction. The last instruction of a handler does so once
    /// if it has interrupted another one at that very instruction.
    fn stands_at(&mut self, pc: u32, cycles: &mut u64) -> bool {
        for _ in 0..STEPS_OF_A_STAND {
            *cycles += self.step();
            self.shared.cycles.store(*cycles, Ordering::Relaxed);
            if self.cpu.pc() != pc || self.shared.touched.load(Ordering::Relaxed) {
                return false;
            }
        }
        true
    }

    /// Executes an instruction, or enters a handler.
    fn step(&mut self) -> u64 {
        let before = self.cpu.xpsr();
        self.executed += u64::from(self.cpu.pc() != self.rests_at);
        let cycles = self.cpu.step();
        if before & BLOCK != 0 {
            self.keep_block(before);
        }
        cycles
    }

    /// Keeps the position in a block of conditional instructions across an exception. rsemu 0.0.7 loses it when it
    /// stacks the status, so that the rest of the block would be executed whatever its condition. It also goes one
    /// instruction too far if a handler returns with a conditional instruction of its own.
    fn keep_block(&self, before: u32) {
        let after = self.cpu.xpsr();
        if after & EXCEPTION == before & EXCEPTION {
            return;
        }
        let is_same = |one: u32, other: u32| (one ^ other) & !(BLOCK | ALIGNED) == 0;
        let chip = lock(&self.chip);
        let link = self.cpu.reg(14);
        let frame = if link & 4 != 0 { self.cpu.psp() } else { self.cpu.msp() };
        let kept = frame.checked_add(28).and_then(|at| chip.memory.word(at));
        if let Some(kept) = kept.filter(|kept| link >= EXC_RETURN && is_same(*kept, before)) {
            chip.memory.put_word(frame + 28, kept | before & BLOCK);
            return;
        }
        let (pc, stack) = (self.cpu.pc(), self.cpu.reg(13));
        // The frame is with or without floating-point registers, and with or without a word that aligns the stack.
        for behind in [4, 8, 76, 80] {
            let kept = stack.checked_sub(behind).and_then(|at| chip.memory.word(at));
            let from = stack.checked_sub(behind + 4).and_then(|at| chip.memory.word(at));
            if let (Some(kept), Some(from)) = (kept, from)
                && from & !1 == pc
                && is_same(kept, after)
            {
                self.cpu.set_xpsr(after & !BLOCK | kept & BLOCK);
                return;
            }
        }
    }

    /// The core stands still on one instruction: only an interrupt can change that, so the time jumps to the next
    /// event.
    fn wait(&mut self, cycles: u64, limit: u64) -> u64 {
        self.note_lockup();
        self.note_standstill();
        self.rests_at = self.cpu.pc();
        let mut jump = limit.saturating_sub(cycles);
        self.cpu.with_sys(|system| {
            if system.syst_csr & 1 == 1 && system.syst_rvr != 0 {
                // The system timer is part of the core.
                jump = jump.min(u64::from(system.syst_cvr).max(1) - 1);
            }
            system.tick_cyccnt(jump);
            let _ = system.tick_systick(jump);
        });
        self.waited += jump;
        let cycles = cycles + jump;
        self.shared.cycles.store(cycles, Ordering::Relaxed);
        cycles
    }

    /// Notes a lockup if nothing has moved the core for long, and no watchdog will.
    fn note_standstill(&mut self) {
        let (pc, now_ns) = (self.cpu.pc(), self.chip().wires.now);
        let since_ns = match self.stands {
            Some((at, since_ns)) if at == pc => since_ns,
            _ => self.stands.insert((pc, now_ns)).1,
        };
        if self.lockup.is_some() || now_ns - since_ns < PATIENCE_NS || self.chip().is_watched() {
            return;
        }
        let seconds = PATIENCE_NS / SECOND_NS;
        let why = if self.cpu.is_asleep() {
            format!("it sleeps, and nothing has woken it for {seconds} s")
        } else {
            format!("it stands on one instruction, and nothing has interrupted it for {seconds} s")
        };
        self.lockup = Some(Lockup { pc, why });
    }

    fn note_lockup(&mut self) {
        if self.lockup.is_some() {
            return;
        }
        let regs = self.cpu.regs();
        let exception = self.cpu.xpsr() & 0x1FF;
        let stands = self.cpu.pc();
        let is_asleep = self.cpu.is_asleep();
        let (why, pc) = if self.cpu.is_locked_up() {
            (format!("a fault in the handler of a fault ({})", self.fault()), stands)
        } else if matches!(exception, 2..=6) {
            let name = ["NMI", "hard fault", "memory fault", "bus fault", "usage fault"]
                [exception as usize - 2];
            (format!("{name} ({})", self.fault()), self.stacked_pc().unwrap_or(stands))
        } else if exception != 0 && !is_asleep {
            (format!("the handler of exception {exception} waits for ever"), stands)
        } else if regs.primask && !is_asleep {
            (
                "it waits for ever with interrupts off, as after a failed check of the kernel"
                    .to_owned(),
                stands,
            )
        } else {
            return;
        };
        self.lockup = Some(Lockup { pc, why });
    }

    /// The address of the instruction that failed, as the exception stacked it. The handler may have lost the
    /// information about the stack that has it: a thread's is the process stack, if it has one, and a handler's is the
    /// main stack.
    fn stacked_pc(&self) -> Option<u32> {
        let of_process = self.framed_pc(self.cpu.psp());
        let of_main = self.framed_pc(self.cpu.msp());
        let active = (1..Exception::COUNT).filter(|number| {
            let number = u16::try_from(*number).unwrap_or(0);
            self.cpu.with_sys(|system| system.is_active(Exception(number)))
        });
        if active.count() > 1 { of_main } else { of_process.or(of_main) }
    }

    /// The program counter in an exception's frame, if there is a frame.
    fn framed_pc(&self, stack: u32) -> Option<u32> {
        let chip = lock(&self.chip);
        let memory = chip.memory();
        let (pc, status) =
            (memory.word(stack.checked_add(24)?)?, memory.word(stack.checked_add(28)?)?);
        (status >> 24 & 1 == 1).then_some(pc)
    }

    fn fault(&self) -> String {
        let (count, address) = self.cpu.bus_faults();
        let status = self.cpu.with_sys(|system| system.cfsr);
        let mut text = format!("CFSR 0x{status:08x}");
        if status & 0xFF00 != 0 && count > 0 {
            text.push_str(&format!(", nothing is at 0x{address:08x}"));
        }
        if status & 0x0001_0000 != 0 {
            text.push_str(", an undefined instruction");
        }
        text
    }
}

fn map(space: &AddressSpace, region: Region, base: u64) {
    // The regions are constants that do not overlap.
    let _ = space.topology().map(region, base);
}

fn map_memory(space: &AddressSpace, memory: &Memory, mcu: &Mcu) {
    // After a reset, the flash is also at 0.
    for base in [0, u64::from(FLASH_BASE)] {
        map(space, Region::ram("flash", Arc::clone(&memory.flash)), base);
    }
    let sram = || Region::ram("sram", Arc::clone(&memory.sram));
    map(space, sram(), u64::from(SRAM_BASE));
    let ccm_bytes = u64::from(mcu.ccm_bytes);
    if mcu.ccm_in_sram {
        let begin = u64::from(mcu.sram_bytes) - ccm_bytes;
        if let Ok(ccm) = Region::alias("ccm", sram(), begin, ccm_bytes) {
            map(space, ccm, u64::from(CCM_BASE));
        }
    } else if ccm_bytes > 0 {
        let ccm = RamStore::new(ccm_bytes);
        map(space, Region::ram("ccm", Arc::new(ccm)), u64::from(CCM_BASE));
    }
    let system = RamStore::new(SYSTEM_BYTES);
    let kibibytes = u16::try_from(mcu.flash_bytes >> 10).unwrap_or(u16::MAX);
    let at = |address: u32| u64::from(address) % SYSTEM_BYTES;
    let _ = system.write_at(at(mcu.number_at()), b"SenseDSL twi");
    let _ = system.write_at(at(mcu.size_at), &kibibytes.to_le_bytes());
    map(space, Region::ram("system", Arc::new(system)), u64::from(mcu.size_at) - at(mcu.size_at));
}
