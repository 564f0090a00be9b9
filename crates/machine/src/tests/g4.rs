//! Tests of the blocks of STM32G4 through their registers.

use std::sync::{Arc, Mutex};

use super::{Rig, US, World};
use crate::transfer::SRAM_BASE;
use crate::{LinkPort, Machine, Mcu, Settings};
use sensedsl_surroundings::{I2cEvent, Pad};

const RCC: u32 = 0x4002_1000;
const CCIPR: u32 = RCC + 0x88;
const DMA1: u32 = 0x4002_0000;
const MULTIPLEXER: u32 = 0x4002_0800;
const I2C1: u32 = 0x4000_5400;
const SPI1: u32 = 0x4001_3000;
const ADC1: u32 = 0x5000_0000;
/// Bits of the DMA's CCR: on, an interrupt at the end, to the peripheral, circular, rising addresses in memory.
const ON: u32 = 1;
const AT_END: u32 = 1 << 1;
const TO_PERIPHERAL: u32 = 1 << 4;
const CIRCULAR: u32 = 1 << 5;
const RISING: u32 = 1 << 7;

impl Rig {
    /// An STM32G474 with all clocks on, at the 16 MHz of a reset.
    fn g474() -> Self {
        let mut rig = Self::of(Mcu::find("STM32G474RET6").unwrap(), World::default());
        for register in [0x48, 0x4C, 0x58, 0x5C, 0x60] {
            rig.put(RCC + register, u32::MAX);
        }
        rig
    }

    /// Switches a pad to a peripheral.
    fn lead_g4(&mut self, pad: &str, function: u32) {
        let pad = Pad::named(pad).unwrap();
        let (port, pin) = (0x4800_0000 + 0x400 * u32::from(pad.port), u32::from(pad.pin));
        let mode = self.get(port) & !(3 << (2 * pin)) | 2 << (2 * pin);
        self.put(port, mode);
        let register = port + 0x20 + 4 * (pin / 8);
        let functions = self.get(register) | function << (4 * (pin % 8));
        self.put(register, functions);
    }

    /// Sets up one of the first DMA controller's streams, with the request that the multiplexer selects.
    fn stream(&mut self, stream: u32, request: u32, peripheral: u32, memory: u32, count: u32) {
        let base = DMA1 + 0x08 + 0x14 * (stream - 1);
        self.put(MULTIPLEXER + 4 * (stream - 1), request);
        self.put(base + 4, count);
        self.put(base + 8, peripheral);
        self.put(base + 12, memory);
    }

    fn start_stream(&mut self, stream: u32, ccr: u32) {
        self.put(DMA1 + 0x08 + 0x14 * (stream - 1), ON | ccr);
    }
}

/// A program that writes a word to the core-coupled memory, and waits.
#[test]
fn the_core_coupled_memory_of_g4_is_the_end_of_the_other_one() {
    let mcu = Mcu::find("STM32G474RET6").unwrap();
    let settings = Settings { crystal_hz: 8_000_000, link: LinkPort::Usb, mcu };
    let mut machine = Machine::new(settings, Arc::new(Mutex::new(World::default())));
    let code = [0x4902_4801, 0xE7FE_6008, 0x1234_5678, 0x1000_0004];
    let words = [0x2002_0000_u32, 0x0800_0009].into_iter().chain(code);
    machine.load(&words.flat_map(u32::to_le_bytes).collect::<Vec<u8>>()).unwrap();
    machine.run_until(10_000);
    assert_eq!((machine.pc(), machine.halt()), (0x0800_000E, None));
    assert_eq!(machine.core.chip().memory.word(0x2001_8004), Some(0x1234_5678));
}

#[test]
fn pads_of_g4_are_analog_until_they_are_set_up() {
    let mut rig = Rig::g474();
    let port = 0x4800_0000;
    assert_eq!(
        [0, 0x400, 0x800].map(|at| rig.get(port + at)),
        [0xABFF_FFFF, 0xFFFF_FEBF, u32::MAX]
    );
    rig.put(port + 0x400, 0xFFFF_FEBD);
    rig.put(port + 0x414, 3);
    // BRR, which earlier families do not have.
    rig.put(port + 0x428, 1);
    // PB4 is the debugger's, with a pull-up.
    assert_eq!((rig.get(port + 0x414), rig.get(port + 0x410)), (2, 1 << 4));
}

#[test]
fn serial_ports_of_g4_have_the_speed_of_the_clock_they_select() {
    let mut rig = Rig::g474();
    rig.lead_g4("PA2", 7);
    let port = 0x4000_4400;
    // 16 MHz / 1600.
    rig.put(port + 0x0C, 1600);
    rig.put(port, 1 | 1 << 3 | 1 << 2);
    assert_eq!(rig.get(port + 0x1C), 0x0060_00C0);
    rig.put(port + 0x28, 0x41);
    assert_eq!(rig.get(port + 0x1C) & 0xC0, 0x80);
    rig.run_until(2_000 * US);
    assert_eq!(rig.world.lock().unwrap().sent, [(1_000 * US, 0x41)]);
    // The core runs on the crystal now, at 8 MHz, and the port once on the bus and once on the other oscillator.
    rig.put(RCC, 1 << 8 | 1 << 16);
    rig.put(RCC + 8, 2);
    rig.put(port + 0x28, 0x42);
    rig.run_until(4_500 * US);
    rig.put(CCIPR, 2 << 2);
    rig.put(port + 0x28, 0x43);
    rig.run_until(6_000 * US);
    let expected = [(1_000 * US, 0x41), (4_000 * US, 0x42), (5_500 * US, 0x43)];
    assert_eq!(rig.world.lock().unwrap().sent, expected);
    // Switched off, it has nothing to send, and ICR clears what is left of its flags.
    rig.put(port + 0x20, 1 << 6);
    assert_eq!(rig.get(port + 0x1C) & 0xC0, 0x80);
    rig.put(port, 0);
    assert_eq!(rig.get(port + 0x1C), 0xC0);
}

#[test]
fn the_low_power_port_counts_in_256ths() {
    let mut rig = Rig::g474();
    rig.lead_g4("PA2", 12);
    let port = 0x4000_8000;
    rig.put(port + 0x0C, 256 * 1600);
    // Seven bits and a parity bit.
    rig.put(port, 1 | 1 << 3 | 1 << 10);
    rig.put(port + 0x28, 0x41);
    rig.run_until(2_000 * US);
    assert_eq!(rig.world.lock().unwrap().sent, [(1_000 * US, 0x41)]);
    let states = rig.chip.ports();
    assert_eq!(states.len(), 1);
    assert_eq!(states[0].unit, "LPUART1");
    let expected = crate::Setting::Serial {
        baud: 10_000,
        data_bits: 7,
        odd_parity: Some(false),
        stop_bits: 1,
    };
    assert_eq!(states[0].setting, expected);
}

#[test]
fn a_bus_of_g4_counts_bytes_and_stops() {
    let mut rig = Rig::g474();
    rig.lead_g4("PB8", 4);
    rig.lead_g4("PB9", 4);
    let (cr1, cr2) = (I2C1, I2C1 + 4);
    rig.put(I2C1 + 0x10, 0x1042_C3C7);
    // Interrupts of refusals and ends, both directions by the DMA.
    rig.put(cr1, 1 | 1 << 4 | 1 << 6 | 1 << 14 | 1 << 15);
    rig.chip.memory.put_word(SRAM_BASE, 0x0000_BBAA);
    rig.stream(1, 17, I2C1 + 0x28, SRAM_BASE, 2);
    rig.start_stream(1, TO_PERIPHERAL | RISING);
    rig.put(cr2, 0x20 << 1 | 2 << 16);
    rig.put(cr2, 0x20 << 1 | 2 << 16 | 1 << 13);
    rig.run_until(2_000 * US);
    // The transfer is over, and the clock is held.
    assert_eq!(rig.get(I2C1 + 0x18) & 0x8050, 0x8040);
    assert_eq!(rig.chip.wires.take_changed(), [(31, true)]);
    // Two bytes come after a repeated start, and the unit stops by itself.
    rig.stream(2, 16, I2C1 + 0x24, SRAM_BASE + 8, 2);
    rig.start_stream(2, RISING);
    rig.put(cr2, 0x20 << 1 | 2 << 16 | 1 << 10 | 1 << 13 | 1 << 25);
    rig.run_until(4_000 * US);
    assert_eq!(rig.get(I2C1 + 0x18) & 0x8074, 0x20);
    assert_eq!(rig.chip.memory.word(SRAM_BASE + 8), Some(0xC3C3));
    let read = |ack| I2cEvent::Read { ack };
    let start = |address, read| I2cEvent::Start { address, read };
    let expected = [
        start(0x20, false),
        I2cEvent::Write(0xAA),
        I2cEvent::Write(0xBB),
        start(0x20, true),
        read(true),
        read(false),
        I2cEvent::Stop,
    ];
    assert_eq!(rig.world.lock().unwrap().bus, expected);
    // Nobody is at the next address: the unit stops by itself.
    rig.put(I2C1 + 0x1C, 0x20);
    rig.put(cr2, 0x21 << 1 | 1 << 16 | 1 << 13);
    rig.run_until(6_000 * US);
    assert_eq!(rig.get(I2C1 + 0x18) & 0x80F0, 0x30);
    assert_eq!(rig.world.lock().unwrap().bus[7..], [start(0x21, false), I2cEvent::Stop]);
}

#[test]
fn a_long_transfer_goes_on_where_the_program_reloads_it() {
    let mut rig = Rig::g474();
    rig.lead_g4("PB8", 4);
    rig.lead_g4("PB9", 4);
    rig.put(I2C1 + 0x10, 0x1042_C3C7);
    rig.put(I2C1, 1);
    rig.put(I2C1 + 4, 0x20 << 1 | 1 << 16 | 1 << 13 | 1 << 24);
    for byte in [1, 2] {
        rig.run_until(rig.chip.wires.now + 1_000 * US);
        // It wants a byte, and takes it.
        assert_eq!(rig.get(I2C1 + 0x18) & 0xC2, 2);
        rig.put(I2C1 + 0x28, byte);
        rig.run_until(rig.chip.wires.now + 1_000 * US);
        let flags = rig.get(I2C1 + 0x18) & 0xC2;
        assert_eq!(flags, if byte == 1 { 0x80 } else { 0x40 });
        rig.put(I2C1 + 4, 0x20 << 1 | 1 << 16);
    }
    rig.put(I2C1 + 4, 0x20 << 1 | 1 << 14);
    rig.run_until(10_000 * US);
    let bus = &rig.world.lock().unwrap().bus;
    assert_eq!(bus[1..], [I2cEvent::Write(1), I2cEvent::Write(2), I2cEvent::Stop]);
}

#[test]
fn a_wide_access_moves_two_short_items_of_spi() {
    let mut rig = Rig::g474();
    for pad in ["PA5", "PA6", "PA7"] {
        rig.lead_g4(pad, 5);
    }
    // Bytes, of which each counts; 16 MHz / 16.
    rig.put(SPI1 + 4, 7 << 8 | 1 << 12);
    rig.put(SPI1, 1 << 2 | 3 << 3 | 1 << 6);
    rig.chip.put(SPI1 + 0x0C, 0x2211, 2).unwrap();
    rig.chip.put(SPI1 + 0x0C, 0x33, 1).unwrap();
    assert_eq!(rig.get(SPI1 + 8) & 0x1883, 0x1082);
    rig.run_until(8 * US);
    assert_eq!(rig.get(SPI1 + 8) & 0x0601, 0x0201);
    rig.run_until(24 * US);
    // Three bytes came: the surroundings answer with the complement.
    assert_eq!(rig.get(SPI1 + 8) & 0x1FC3, 0x0603);
    assert_eq!(rig.chip.fetch(SPI1 + 0x0C, 1), Some(0xEE));
    assert_eq!(rig.chip.fetch(SPI1 + 0x0C, 2), Some(0xCCDD));
    assert_eq!(rig.get(SPI1 + 8) & 0x0601, 0);
    // One item of 16 bits goes out with its high byte first.
    rig.put(SPI1 + 4, 15 << 8);
    rig.chip.put(SPI1 + 0x0C, 0x0102, 2).unwrap();
    rig.run_until(48 * US);
    assert_eq!(rig.chip.fetch(SPI1 + 0x0C, 2), Some(0xFEFD));
    assert_eq!(rig.world.lock().unwrap().shifted, [0x11, 0x22, 0x33, 1, 2]);
}

#[test]
fn a_converter_of_g4_is_switched_on_in_steps() {
    let mut rig = Rig::g474();
    let cr = ADC1 + 8;
    // Without its regulator it does not start.
    rig.put(cr, 1);
    assert_eq!((rig.get(cr) & 1, rig.get(ADC1)), (0, 0));
    rig.put(cr, 0);
    rig.put(cr, 1 << 28);
    rig.put(cr, 1 << 28 | 1 << 31);
    assert_eq!(rig.get(cr), 1 << 28);
    rig.put(cr, 1 << 28 | 1);
    assert_eq!((rig.get(cr), rig.get(ADC1)), (1 << 28 | 1, 1));
    // 16 MHz / 4, 2.5 + 12.5 cycles for each of two inputs, round and round.
    rig.put(0x5000_0308, 3 << 16);
    rig.put(ADC1 + 0x30, 1 | 1 << 6 | 2 << 12);
    rig.put(ADC1 + 0x0C, 1 | 1 << 1 | 1 << 13);
    rig.stream(8, 5, ADC1 + 0x40, SRAM_BASE, 4);
    rig.start_stream(8, AT_END | CIRCULAR | RISING | 1 << 8 | 1 << 10);
    rig.put(cr, 1 << 28 | 1 | 1 << 2);
    rig.run_until(14 * US);
    assert_eq!(rig.chip.memory.word(SRAM_BASE + 4), Some(0x0800));
    rig.run_until(15 * US);
    assert_eq!(rig.chip.memory.word(SRAM_BASE + 4), Some(0x0800_0800));
    assert_eq!(rig.chip.wires.take_changed(), [(96, true)]);
    // It goes on until it is stopped.
    assert_eq!(rig.get(cr) >> 2 & 1, 1);
    rig.put(cr, 1 << 28 | 1 | 1 << 4);
    assert_eq!((rig.get(cr), rig.chip.deadline()), (1 << 28 | 1, u64::MAX));
}

#[test]
fn a_converter_without_dma_is_late_when_nobody_reads() {
    let mut rig = Rig::g474();
    // The fourth one, whose interrupt is its own, on the system's clock by 2.
    let adc = 0x5000_0500;
    rig.put(CCIPR, 2 << 30);
    rig.put(0x5000_0708, 1 << 18);
    rig.put(adc + 8, 1 << 28);
    rig.put(adc + 8, 1 << 28 | 1);
    rig.put(adc + 4, 1 << 2 | 1 << 4);
    rig.put(adc + 0x30, 3 << 6);
    for (until, flags) in [(2, 0b1111), (4, 0b1_1111)] {
        rig.put(adc + 8, 1 << 28 | 1 | 1 << 2);
        assert_eq!(rig.get(adc + 8) >> 2 & 1, 1);
        rig.run_until(until * US);
        assert_eq!((rig.get(adc), rig.get(adc + 8) >> 2 & 1), (flags, 0));
    }
    assert_eq!(rig.chip.wires.take_changed(), [(61, true)]);
    assert_eq!(rig.get(0x5000_0700) >> 16, 0b1_1111);
    rig.put(adc, 1 << 4);
    assert_eq!((rig.get(adc + 0x40), rig.get(adc)), (0x800, 0b1011));
    // A reset of the group leaves the others alone.
    rig.put(ADC1 + 8, 0);
    rig.put(RCC + 0x2C, 1 << 14);
    assert_eq!((rig.get(adc + 8), rig.get(0x5000_0708), rig.get(ADC1 + 8)), (1 << 29, 0, 0));
}

#[test]
fn usb_of_g4_is_found_when_it_pulls_the_bus_up() {
    let mut rig = Rig::g474();
    let (usb, memory) = (0x4000_5C00, 0x4000_6000);
    rig.put(RCC + 0x98, 1);
    rig.put(usb + 0x40, 1 << 10 | 1 << 15);
    rig.run_until(200_000 * US);
    assert_eq!(rig.get(usb + 0x44), 0);
    rig.put(usb + 0x58, 1 << 15);
    rig.run_until(299_000 * US);
    assert_eq!(rig.get(usb + 0x44), 0);
    rig.run_until(301_000 * US);
    assert_eq!(rig.get(usb + 0x44) & 1 << 10, 1 << 10);
    // Endpoint 0 takes the first request; words stand one after the other.
    rig.chip.put(memory + 4, 0x40, 2).unwrap();
    rig.chip.put(memory + 6, 0x8400, 2).unwrap();
    rig.put(usb, 1 << 9 | 3 << 12);
    rig.put(usb + 0x4C, 0x80);
    rig.put(usb + 0x44, 0);
    rig.run_until(320_000 * US);
    assert_eq!([rig.get(memory + 0x40), rig.get(memory + 0x44)], [0x0100_0680, 0x0040_0000]);
    assert_eq!(rig.chip.fetch(memory + 6, 2), Some(0x8408));
}

#[test]
fn outputs_of_g4_have_their_trigger_in_another_place() {
    let mut rig = Rig::g474();
    // The only output of the second unit, with the bit that is a trigger's elsewhere.
    let dac = 0x5000_0C00;
    rig.put(dac, 1 | 1 << 2);
    rig.put(dac + 8, 0x800);
    assert_eq!(rig.get(dac + 0x34), 1 << 11);
    rig.put(dac, 1 | 1 << 1);
    rig.put(dac + 8, 0);
    rig.put(dac + 4, 1);
    assert_eq!(rig.world.lock().unwrap().volts, [(3, 0.0), (3, 1650.0), (3, 0.0)]);
}

#[test]
fn frames_of_fdcan_go_where_filters_send_them() {
    let mut rig = Rig::g474();
    let (can, memory) = (0x4000_6400, 0x4000_A400);
    // 8 MHz of the crystal / 8, with what is sent led in again.
    rig.put(can + 0x18, 1 | 1 << 1);
    rig.put(can + 0x1C, 4 << 8 | 1);
    rig.put(can + 0x18, 1 | 1 << 1 | 1 << 7);
    rig.put(can + 0x10, 1 << 4);
    // One filter of short identifiers leads 0x120 to 0x12F to the second queue, and all others go to the first one.
    rig.put(can + 0x80, 1 << 16);
    rig.put(memory, 2 << 30 | 2 << 27 | 0x120 << 16 | 0x7F0);
    rig.put(can + 0x54, 1 | 1 << 3 | 1 << 7);
    rig.put(can + 0xDC, 0b111);
    // The second queue has the second interrupt.
    rig.put(can + 0x58, 1 << 1);
    rig.put(can + 0x5C, 0b11);
    rig.put(can + 0x18, 1 << 7);
    let buffers = memory + 0x278;
    for (at, word) in [(0, 0x123 << 18), (4, 2 << 16), (8, 0xBBAA), (72, 1 << 30 | 0x1234), (76, 0)]
    {
        rig.put(buffers + at, word);
    }
    rig.put(can + 0xCC, 0b01);
    rig.put(can + 0xCC, 0b10);
    assert_eq!(rig.get(can + 0xC4), 1 | 2 << 16);
    rig.run_until(62 * US);
    assert_eq!((rig.get(can + 0xC8), rig.get(can + 0x50)), (0b11, 0));
    rig.run_until(63 * US);
    assert_eq!((rig.get(can + 0xC8), rig.get(can + 0x50)), (0b10, 1 << 7 | 1 << 3));
    assert_eq!(rig.chip.wires.take_changed(), [(21, true), (22, true)]);
    rig.run_until(130 * US);
    // Number, first, and the place of the next one.
    assert_eq!([0x90, 0x98].map(|at| rig.get(can + at)), [1 | 1 << 16, 1 | 1 << 16]);
    assert_eq!([0, 4, 8].map(|at| rig.get(memory + 0x188 + at)), [0x123 << 18, 2 << 16, 0xBBAA]);
    assert_eq!([0, 4].map(|at| rig.get(memory + 0xB0 + at)), [1 << 30 | 0x1234, 1 << 31]);
    rig.put(can + 0x9C, 0);
    assert_eq!(rig.get(can + 0x98), 1 << 8 | 1 << 16);
    assert_eq!((rig.get(can + 0xC4), rig.get(can + 0xD4)), (3 | 2 << 8 | 2 << 16, 0b11));
    let bitrates = |rig: &Rig| {
        let states = rig.chip.ports().into_iter();
        states.map(|state| (state.unit, state.setting)).collect::<Vec<_>>()
    };
    let at = |unit: &str, bitrate_hz| (unit.to_owned(), crate::Setting::Can { bitrate_hz });
    assert_eq!(bitrates(&rig), [at("FDCAN1", 1_000_000)]);
    // The first unit divides the clock of all. The second one has 16 steps after a reset.
    rig.put(can + 0x100, 1);
    rig.put(can + 0x418, 0);
    assert_eq!(bitrates(&rig), [at("FDCAN1", 500_000), at("FDCAN2", 250_000)]);
}
