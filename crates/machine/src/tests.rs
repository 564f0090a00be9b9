//! Tests of single devices through their registers, as the manual describes them.

mod f1;
mod g4;

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use f1::RCC_F1;
use rsemu::core::space::RamStore;

use super::chip::Chip;
use super::image::{ImageError, flash_of};
use super::rcc;
use super::transfer::{Memory, SRAM_BASE};
use super::wires::Wires;
use super::{LinkPort, Machine, Mcu, Settings};
use sensedsl_surroundings::{I2cEvent, I2cReply, Pad, Surroundings};

const RCC: u32 = 0x4002_3800;
const US: u64 = 1_000;

/// A world with edges on pads, a voltage everywhere, and a chip at 0x20.
#[derive(Default)]
struct World {
    edges: BTreeMap<Pad, Vec<(u64, bool)>>,
    sent: Vec<(u64, u8)>,
    bus: Vec<I2cEvent>,
    /// The bytes on SPI.
    shifted: Vec<u8>,
    /// The outputs of DACs.
    volts: Vec<(u8, f64)>,
}

impl Surroundings for World {
    fn millivolts(&mut self, _: Pad, _: u64) -> f64 {
        1650.0
    }

    fn level(&mut self, pad: Pad, now_ns: u64) -> Option<bool> {
        let edges = self.edges.get(&pad)?;
        Some(edges.iter().rev().find(|edge| edge.0 <= now_ns).is_some_and(|edge| edge.1))
    }

    fn next_edge(&mut self, pad: Pad, after_ns: u64) -> Option<(u64, bool)> {
        self.edges.get(&pad)?.iter().copied().find(|edge| edge.0 > after_ns)
    }

    fn uart_out(&mut self, _: u8, byte: u8, now_ns: u64) {
        self.sent.push((now_ns, byte));
    }

    fn spi(&mut self, _: u8, out: u8, _: u64) -> u8 {
        self.shifted.push(out);
        !out
    }

    fn dac(&mut self, channel: u8, millivolts: f64, _: u64) {
        self.volts.push((channel, millivolts));
    }

    fn i2c(&mut self, _: u8, event: I2cEvent, _: u64) -> I2cReply {
        self.bus.push(event);
        match event {
            I2cEvent::Start { address: 0x20, .. } | I2cEvent::Write(_) | I2cEvent::Stop => {
                I2cReply::Ack
            }
            I2cEvent::Start { .. } => I2cReply::Nack,
            I2cEvent::Read { .. } => I2cReply::Byte(0xC3),
        }
    }
}

fn f407() -> &'static Mcu {
    Mcu::find("STM32F407VGT6").unwrap()
}

/// A chip without a core.
struct Rig {
    chip: Chip,
    world: Arc<Mutex<World>>,
}

impl Rig {
    /// A chip with all clocks on, at the 16 MHz of a reset.
    fn new(world: World) -> Self {
        let mut rig = Self::of(f407(), world);
        for register in [0x30, 0x34, 0x40, 0x44] {
            rig.put(RCC + register, u32::MAX);
        }
        rig
    }

    /// An STM32F103 with all clocks on, at the 8 MHz of a reset.
    fn f103(world: World) -> Self {
        let mut rig = Self::of(Mcu::find("STM32F103C8T6").unwrap(), world);
        for register in [0x14, 0x18, 0x1C] {
            rig.put(RCC_F1 + register, u32::MAX);
        }
        rig
    }

    fn of(mcu: &'static Mcu, world: World) -> Self {
        let world = Arc::new(Mutex::new(world));
        let memory =
            Memory { flash: Arc::new(RamStore::new(1024)), sram: Arc::new(RamStore::new(1024)) };
        let surroundings = Arc::clone(&world) as Arc<Mutex<dyn Surroundings>>;
        let rcc = rcc::new(mcu, 8_000_000);
        let wires = Wires::new(surroundings, LinkPort::Usb, rcc.clocks(), mcu);
        Self { chip: Chip::new(wires, memory, rcc, mcu), world }
    }

    fn put(&mut self, address: u32, value: u32) {
        self.chip.put(address, value, 4).unwrap();
        self.chip.accessed();
    }

    fn get(&mut self, address: u32) -> u32 {
        let value = self.chip.fetch(address, 4).unwrap();
        self.chip.accessed();
        value
    }

    fn run_until(&mut self, ns: u64) {
        while self.chip.deadline() <= ns {
            self.chip.wires.now = self.chip.deadline().max(self.chip.wires.now);
            self.chip.advance();
        }
        self.chip.wires.now = ns;
    }

    /// Switches a pad to a peripheral.
    fn lead(&mut self, pad: &str, function: u32) {
        let pad = Pad::named(pad).unwrap();
        let (port, pin) = (0x4002_0000 + 0x400 * u32::from(pad.port), u32::from(pad.pin));
        let mode = self.get(port) & !(3 << (2 * pin)) | 2 << (2 * pin);
        self.put(port, mode);
        let register = port + 0x20 + 4 * (pin / 8);
        let functions = self.get(register) | function << (4 * (pin % 8));
        self.put(register, functions);
    }
}

#[test]
fn the_clock_tree_is_what_the_registers_say() {
    let mut rig = Rig::new(World::default());
    assert_eq!(rig.chip.wires.clocks.core, 16_000_000);
    // HSE 8 MHz / 8 * 336 / 2, buses by 4 and by 2.
    rig.put(RCC + 4, 8 | 336 << 6 | 1 << 22);
    rig.put(RCC, 1 | 1 << 16);
    // The PLL is still off, so the switch does not follow.
    rig.put(RCC + 8, 2 | 5 << 10 | 4 << 13);
    assert_eq!(rig.get(RCC + 8) >> 2 & 3, 0);
    rig.put(RCC, 1 | 1 << 16 | 1 << 24);
    rig.put(RCC + 8, 2 | 5 << 10 | 4 << 13);
    assert_eq!(rig.get(RCC + 8) >> 2 & 3, 2);
    let clocks = rig.chip.wires.clocks;
    assert_eq!([clocks.core, clocks.apb1, clocks.apb2], [168_000_000, 42_000_000, 84_000_000]);
    assert_eq!([clocks.timers1, clocks.timers2], [84_000_000, 168_000_000]);
}

#[test]
fn pads_take_bytes_half_words_and_words() {
    let mut rig = Rig::new(World::default());
    let port = 0x4002_0C00;
    rig.put(port, 1 << 24);
    // `palSetPad` and `palClearPad` write half-words like these.
    rig.chip.put(port + 0x18, 1 << 12, 2).unwrap();
    assert_eq!(rig.get(port + 0x14), 1 << 12);
    assert_eq!(rig.get(port + 0x10), 1 << 12);
    rig.chip.put(port + 0x1A, 1 << 12, 2).unwrap();
    assert_eq!(rig.get(port + 0x14), 0);
    rig.chip.put(port + 0x15, 0x10, 1).unwrap();
    assert_eq!(rig.chip.fetch(port + 0x15, 1), Some(0x10));
    assert_eq!(rig.get(port + 0x14), 1 << 12);
}

#[test]
fn a_peripheral_without_its_clock_does_nothing_and_is_told() {
    let mut rig = Rig::new(World::default());
    rig.put(RCC + 0x40, 0);
    rig.put(0x4000_0400 + 0x2C, 99);
    assert_eq!(rig.get(0x4000_0400 + 0x2C), 0);
    assert_eq!(rig.chip.wires.events.len(), 1);
    assert_eq!(rig.chip.fetch(0x4009_0000, 4), None);
}

#[test]
fn a_serial_port_takes_the_time_of_its_baud_rate() {
    let mut rig = Rig::new(World::default());
    rig.lead("PA2", 7);
    let port = 0x4000_4400;
    // 16 MHz / 1600 is 10 kBd: 1 ms for ten bits.
    rig.put(port + 8, 1600);
    rig.put(port + 0x0C, 1 << 13 | 1 << 3);
    // As a byte, which some programs write.
    rig.chip.put(port + 4, 0x41, 1).unwrap();
    rig.chip.put(port + 4, 0x42, 1).unwrap();
    assert_eq!(rig.get(port) & 0xC0, 0);
    rig.run_until(1_500 * US);
    assert_eq!(rig.get(port) & 0xC0, 0x80);
    rig.run_until(3_000 * US);
    assert_eq!(rig.get(port) & 0xC0, 0xC0);
    assert_eq!(rig.world.lock().unwrap().sent, [(1_000 * US, 0x41), (2_000 * US, 0x42)]);
}

#[test]
fn a_timer_counts_updates_and_compares() {
    let mut rig = Rig::new(World::default());
    let timer = 0x4000_0400;
    // 1 MHz, a period of 1000, compare at 300.
    rig.put(timer + 0x28, 15);
    rig.put(timer + 0x2C, 999);
    rig.put(timer + 0x34, 300);
    // The other channels have compare values that the counter never reaches.
    for channel in 1..4 {
        rig.put(timer + 0x34 + 4 * channel, 5_000);
    }
    rig.put(timer + 0x14, 1);
    rig.put(timer + 0x10, 0);
    rig.put(timer + 0x0C, 3);
    rig.put(timer, 1);
    rig.run_until(299 * US);
    assert_eq!((rig.get(timer + 0x24), rig.get(timer + 0x10)), (299, 0));
    rig.run_until(300 * US);
    assert_eq!((rig.get(timer + 0x24), rig.get(timer + 0x10)), (300, 2));
    assert_eq!(rig.chip.wires.take_changed(), [(29, true)]);
    rig.put(timer + 0x10, 0);
    assert_eq!(rig.chip.wires.take_changed(), [(29, false)]);
    rig.run_until(1_000 * US);
    assert_eq!((rig.get(timer + 0x24), rig.get(timer + 0x10)), (0, 1));
    rig.run_until(3_456 * US);
    assert_eq!((rig.get(timer + 0x24), rig.get(timer + 0x10)), (456, 3));
}

#[test]
fn a_timer_measures_period_and_width() {
    let pad = Pad::named("PA6").unwrap();
    let edges =
        [(100, true), (130, false), (350, true), (420, false)].map(|(us, level)| (us * US, level));
    let mut rig =
        Rig::new(World { edges: BTreeMap::from([(pad, edges.to_vec())]), ..World::default() });
    rig.lead("PA6", 2);
    let timer = 0x4000_0400;
    rig.put(timer + 0x28, 15);
    rig.put(timer + 0x14, 1);
    // On one wire, channel 1 captures rising edges and channel 2 falling ones; rising ones reset the counter.
    rig.put(timer + 0x18, 1 | 2 << 8);
    rig.put(timer + 0x20, 1 | 3 << 4);
    rig.put(timer + 0x08, 5 << 4 | 4);
    rig.put(timer, 1);
    rig.run_until(200 * US);
    // Of n ticks, n - 1 are captured: the counter starts at 0.
    assert_eq!(rig.get(timer + 0x38), 29);
    rig.run_until(500 * US);
    assert_eq!((rig.get(timer + 0x34), rig.get(timer + 0x38)), (249, 69));
}

#[test]
fn a_converter_fills_memory_by_the_dma() {
    let mut rig = Rig::new(World::default());
    let (adc, dma) = (0x4001_2000, 0x4002_6400);
    // Stream 0 of DMA2: half-words, incrementing memory address, interrupt at the end.
    rig.put(dma + 0x10 + 0x08, adc + 0x4C);
    rig.put(dma + 0x10 + 0x0C, SRAM_BASE + 16);
    rig.put(dma + 0x10 + 0x04, 2);
    rig.put(dma + 0x10, 1 | 1 << 4 | 1 << 10 | 1 << 11 | 1 << 13);
    // Channels 1 and 17, with 3 sampling cycles each.
    rig.put(adc + 4, 1 << 8);
    rig.put(adc + 0x2C, 1 << 20);
    rig.put(adc + 0x34, 1 | 17 << 5);
    rig.put(adc + 8, 1 | 1 << 8);
    rig.put(adc + 8, 1 | 1 << 8 | 1 << 30);
    // 15 cycles of 8 MHz each.
    rig.run_until(1_874);
    assert_eq!(rig.get(dma + 0x14), 2);
    rig.run_until(3_750);
    assert_eq!(rig.get(dma + 0x14), 0);
    assert_eq!(rig.get(dma) & 0x20, 0x20);
    assert!(rig.chip.wires.take_changed().contains(&(56, true)));
    let mut samples = [0; 4];
    rig.chip.memory().sram.read_at(16, &mut samples).unwrap();
    assert_eq!(u16::from_le_bytes([samples[0], samples[1]]), 2048);
    assert_eq!(u16::from_le_bytes([samples[2], samples[3]]), 1501);
}

#[test]
fn a_bus_master_addresses_sends_and_receives() {
    let mut rig = Rig::new(World::default());
    rig.lead("PB6", 4);
    rig.lead("PB7", 4);
    let bus = 0x4000_5400;
    // 100 kHz from 16 MHz.
    rig.put(bus + 0x1C, 80);
    rig.put(bus, 1);
    rig.put(bus, 1 | 1 << 8);
    rig.run_until(20 * US);
    assert_eq!(rig.get(bus + 0x14) & 1, 1);
    rig.put(bus + 0x10, 0x41);
    // An acknowledged byte, and then one that is not.
    rig.put(bus, 1 | 1 << 10);
    rig.run_until(200 * US);
    assert_eq!(rig.get(bus + 0x14) & 2, 2);
    rig.get(bus + 0x18);
    rig.run_until(300 * US);
    assert_eq!(rig.get(bus + 0x14) & 0x40, 0x40);
    rig.put(bus, 1 | 1 << 9);
    assert_eq!(rig.get(bus + 0x10), 0xC3);
    rig.run_until(600 * US);
    let start = I2cEvent::Start { address: 0x20, read: true };
    assert_eq!(rig.world.lock().unwrap().bus[..2], [start, I2cEvent::Read { ack: true }]);
    assert_eq!(rig.world.lock().unwrap().bus.last(), Some(&I2cEvent::Stop));
    // There is no chip at 0x21.
    rig.put(bus, 1 | 1 << 8);
    rig.run_until(800 * US);
    rig.get(bus + 0x14);
    rig.put(bus + 0x10, 0x42);
    rig.run_until(1_000 * US);
    assert_eq!(rig.get(bus + 0x14) & 1 << 10, 1 << 10);
}

#[test]
fn the_watchdog_bites_when_it_is_not_fed() {
    let mut rig = Rig::new(World::default());
    let dog = 0x4000_3000;
    rig.put(dog, 0xCCCC);
    rig.put(dog, 0x5555);
    // 32 kHz / 4 and 7 + 1 counts: 1 ms.
    rig.put(dog + 8, 7);
    rig.put(dog, 0xAAAA);
    rig.run_until(900 * US);
    rig.put(dog, 0xAAAA);
    rig.run_until(1_800 * US);
    assert_eq!(rig.chip.reset, None);
    rig.run_until(1_901 * US);
    assert_eq!(rig.chip.reset, Some(super::ResetCause::Watchdog));
}

#[test]
fn images_of_others_are_refused_with_a_reason() {
    let elf = |class: u8, machine: u16| {
        let mut bytes = vec![0; 64];
        bytes[..6].copy_from_slice(&[0x7F, b'E', b'L', b'F', class, 1]);
        bytes[18..20].copy_from_slice(&machine.to_le_bytes());
        bytes
    };
    let flash_of = |image: &[u8]| flash_of(image, f407());
    assert_eq!(flash_of(&elf(2, 62)), Err(ImageError::OtherProcessor("x86-64".to_owned())));
    assert_eq!(flash_of(&elf(1, 83)), Err(ImageError::OtherProcessor("AVR".to_owned())));
    assert!(matches!(flash_of(&elf(1, 40)), Err(ImageError::Damaged(_))));
    assert_eq!(flash_of(b"sense"), Err(ImageError::NotAProgram));
    assert_eq!(
        flash_of(&vec![0; (1 << 20) + 1]),
        Err(ImageError::TooLong { mcu: f407(), length: (1 << 20) + 1 })
    );
    // The RAM of another MCU, and the flash of another.
    let raw = |stack: u32, entry: u32| [stack.to_le_bytes(), entry.to_le_bytes()].concat();
    for (stack, entry) in
        [(0x3000_0000, 0x0800_0101), (0x2000_1000, 0x0000_0101), (0x2000_1000, 0x0800_0100)]
    {
        assert_eq!(
            flash_of(&raw(stack, entry)),
            Err(ImageError::Vectors { mcu: f407(), stack, entry })
        );
    }
    assert!(flash_of(&raw(0x2002_0000, 0x0800_0101)).is_ok());
}

/// A vector table, and `b .` at the start of the program.
#[test]
fn waiting_costs_nothing_and_ends_in_time() {
    let mut image = vec![0; 0x200];
    image[..8].copy_from_slice(&[0, 0, 2, 0x20, 1, 1, 0, 8]);
    image[0x100..0x102].copy_from_slice(&[0xFE, 0xE7]);
    let settings = Settings { crystal_hz: 8_000_000, link: LinkPort::Usb, mcu: f407() };
    let mut machine = Machine::new(settings, Arc::new(Mutex::new(World::default())));
    machine.load(&image).unwrap();
    machine.run_until(3_600_000_000_000);
    assert!(machine.now_ns() - 3_600_000_000_000 < 1_000, "{}", machine.now_ns());
    assert_eq!((machine.pc(), machine.halt()), (0x0800_0100, None));
    assert!(machine.cycles_worked() < 1_000_000_000);
}
