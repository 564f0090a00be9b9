//! Tests of the blocks of STM32F1 through their registers.

use std::collections::BTreeMap;

use super::{Rig, US, World};
use crate::transfer::SRAM_BASE;
use sensedsl_surroundings::Pad;

/// The unit of STM32F103, and its ports A and B.
pub(super) const RCC_F1: u32 = 0x4002_1000;
const PORTS_F1: [u32; 2] = [0x4001_0800, 0x4001_0C00];

#[test]
fn a_converter_of_f1_fills_memory_by_the_dma() {
    let mut rig = Rig::f103(World::default());
    let (adc, dma) = (0x4001_2400, 0x4002_0000);
    // The first stream: half-words, incrementing memory address, interrupt at the end.
    rig.put(dma + 0x10, adc + 0x4C);
    rig.put(dma + 0x14, SRAM_BASE + 16);
    rig.put(dma + 0x0C, 2);
    rig.put(dma + 0x08, 1 | 1 << 1 | 1 << 7 | 1 << 8 | 1 << 10);
    // A calibration is over at once.
    rig.put(adc + 8, 1 | 1 << 2 | 1 << 3);
    assert_eq!(rig.get(adc + 8), 1);
    // Channels 1 and 17, the reference, with 1.5 sampling cycles each.
    rig.put(adc + 4, 1 << 8);
    rig.put(adc + 0x2C, 1 << 20);
    rig.put(adc + 0x34, 1 | 17 << 5);
    let control = 1 | 1 << 8 | 1 << 23;
    rig.put(adc + 8, control);
    assert_eq!(rig.chip.deadline(), u64::MAX);
    rig.put(adc + 8, control);
    // 14 cycles of 4 MHz each.
    rig.run_until(3_499);
    assert_eq!(rig.get(dma + 0x0C), 2);
    rig.run_until(7_000);
    assert_eq!((rig.get(dma + 0x0C), rig.get(dma)), (0, 7));
    assert!(rig.chip.wires.take_changed().contains(&(11, true)));
    let mut samples = [0; 4];
    rig.chip.memory().sram.read_at(16, &mut samples).unwrap();
    assert_eq!(u16::from_le_bytes([samples[0], samples[1]]), 2048);
    assert_eq!(u16::from_le_bytes([samples[2], samples[3]]), 1489);
    // Software starts it where that is the trigger.
    rig.put(adc + 8, 1 | 7 << 17 | 1 << 20);
    rig.put(adc + 8, 1 | 7 << 17 | 1 << 20 | 1 << 22);
    rig.run_until(20_000);
    assert_eq!(rig.get(adc) & 2, 2);
}

#[test]
fn lines_of_f1_watch_the_ports_that_afio_chooses() {
    let pad = Pad::named("PB4").unwrap();
    let edges = vec![(100 * US, true), (200 * US, false)];
    let mut rig = Rig::f103(World { edges: BTreeMap::from([(pad, edges)]), ..World::default() });
    let (afio, exti) = (0x4001_0000, 0x4001_0400);
    // Line 4 of port B, at both edges.
    rig.put(afio + 0x0C, 1);
    rig.put(exti + 0x08, 1 << 4);
    rig.put(exti + 0x0C, 1 << 4);
    rig.put(exti, 1 << 4);
    rig.run_until(150 * US);
    assert_eq!((rig.get(exti + 0x14), rig.get(PORTS_F1[1] + 8) & 1 << 4), (1 << 4, 1 << 4));
    assert_eq!(rig.chip.wires.take_changed(), [(10, true)]);
    rig.put(exti + 0x14, 1 << 4);
    rig.run_until(250 * US);
    assert_eq!((rig.get(exti + 0x14), rig.get(PORTS_F1[1] + 8) & 1 << 4), (1 << 4, 0));
    // The port's clock is off: nothing is read.
    rig.put(RCC_F1 + 0x18, 0);
    assert_eq!(rig.get(PORTS_F1[1]), 0);
}

#[test]
fn units_of_f1_run_on_pads_that_they_choose() {
    let pad = Pad::named("PB6").unwrap();
    let edges = [(100, true), (130, false)].map(|(us, level)| (us * US, level));
    let mut rig =
        Rig::f103(World { edges: BTreeMap::from([(pad, edges.to_vec())]), ..World::default() });
    // TIM4, whose first channel is on PB6, an input, measures with 1 MHz.
    let timer = 0x4000_0800;
    rig.put(timer + 0x28, 7);
    rig.put(timer + 0x14, 1);
    rig.put(timer + 0x18, 1 | 2 << 8);
    rig.put(timer + 0x20, 1 | 3 << 4);
    rig.put(timer + 0x08, 5 << 4 | 4);
    rig.put(timer, 1);
    rig.run_until(200 * US);
    assert_eq!(rig.get(timer + 0x38), 29);
    // A counter has 16 bits.
    assert_eq!(rig.get(0x4000_0000 + 0x2C), 0xFFFF);
    // PA9 belongs to USART1, which sends with 8 MHz / 800.
    let port = 0x4001_3800;
    rig.put(PORTS_F1[0] + 4, 0x4444_44B4);
    rig.put(port + 8, 800);
    rig.put(port + 0x0C, 1 << 13 | 1 << 3);
    rig.put(port + 4, 0x41);
    rig.run_until(2_000 * US);
    assert_eq!(rig.world.lock().unwrap().sent, [(1_200 * US, 0x41)]);
}

#[test]
fn the_watchdog_of_f1_has_its_own_oscillator() {
    let mut rig = Rig::f103(World::default());
    let dog = 0x4000_3000;
    rig.put(dog, 0xCCCC);
    rig.put(dog, 0x5555);
    // 40 kHz / 4 and 9 + 1 counts: 1 ms.
    rig.put(dog + 8, 9);
    rig.put(dog, 0xAAAA);
    assert_eq!(rig.chip.watchdog_ns(), Some(1_000 * US));
    // What the backup domain keeps, and what a reset clears.
    rig.put(0x4000_6C04, 0x1234);
    rig.chip.restart(crate::ResetCause::Watchdog);
    assert_eq!((rig.chip.watchdog_ns(), rig.chip.rcc.causes() >> 29 & 1), (None, 1));
    rig.put(RCC_F1 + 0x1C, u32::MAX);
    assert_eq!(rig.get(0x4000_6C04), 0x1234);
    rig.chip.restart(crate::ResetCause::Power);
    rig.put(RCC_F1 + 0x1C, u32::MAX);
    assert_eq!(rig.get(0x4000_6C04), 0);
}

#[test]
fn usb_of_f1_is_found_when_it_is_on() {
    let mut rig = Rig::f103(World::default());
    let (usb, memory) = (0x4000_5C00, 0x4000_6000);
    // Without 48 MHz, no host understands the device.
    rig.put(usb + 0x40, 1 << 10);
    rig.run_until(200_000 * US);
    assert_eq!(rig.get(usb + 0x44), 0);
    rig.put(RCC_F1 + 4, 1 << 16 | 7 << 18);
    rig.put(RCC_F1, 1 | 1 << 16 | 1 << 24);
    rig.put(usb + 0x40, 3);
    rig.put(usb + 0x40, 1 << 10 | 1 << 15);
    rig.put(usb + 0x44, 0);
    let _ = rig.chip.wires.take_changed();
    rig.run_until(299_000 * US);
    assert_eq!(rig.get(usb + 0x44), 0);
    rig.run_until(301_000 * US);
    assert_eq!(rig.get(usb + 0x44) & 1 << 10, 1 << 10);
    assert_eq!(rig.chip.wires.take_changed(), [(20, true)]);
    // Endpoint 0 takes the first request, 64 bytes of the device's description, in 16 bits of 32.
    rig.put(memory + 8, 0x40);
    rig.put(memory + 12, 0x8400);
    rig.put(usb, 1 << 9 | 3 << 12);
    rig.put(usb + 0x4C, 0x80);
    rig.put(usb + 0x44, 0);
    rig.run_until(320_000 * US);
    assert_eq!(rig.get(usb + 0x44) & 0x841F, 0x8010);
    let words: Vec<u32> = (0..4).map(|at| rig.get(memory + 0x80 + 4 * at)).collect();
    assert_eq!(words, [0x0680, 0x0100, 0, 0x40]);
    assert_eq!(rig.get(memory + 12), 0x8408);
}
