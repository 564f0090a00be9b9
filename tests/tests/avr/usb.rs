//! The USB port of the ATmega32U4, with a sketch on the Arduino core: enumeration, and bytes both ways.

use std::collections::BTreeMap;

use super::child::{Avr, Link, Setup};
use super::tools::{can_compile_sketches, sketch};
use super::units::{CLOCK_HZ, World, pad, run};

#[test]
fn a_sketch_talks_to_its_host() {
    if !can_compile_sketches() {
        return;
    }
    let setup = Setup {
        mcu: "atmega32u4",
        clock_hz: CLOCK_HZ,
        image: &sketch("usb"),
        link: Link::Usb,
        serials: BTreeMap::new(),
        pads: Vec::new(),
    };
    let mut avr = Avr::start(&setup, World::default());
    let led = |avr: &Avr<World>| {
        let mut all = avr.around.driven.iter().filter(|(_, of, _)| *of == pad("PC7"));
        all.next_back().and_then(|(.., level)| *level)
    };
    run(&mut avr, 500);
    assert_eq!(led(&avr), Some(false));
    avr.link_open(true);
    run(&mut avr, 520);
    assert_eq!(led(&avr), Some(true));
    // More than packets and the banks for them hold.
    let said: Vec<u8> = (0..=255).cycle().take(1_000).collect();
    avr.link_write(&said);
    let sent: Vec<u8> = run(&mut avr, 700).into_iter().map(|(_, byte)| byte).collect();
    let wanted: Vec<u8> = said.iter().map(|byte| byte.wrapping_add(1)).collect();
    assert_eq!(sent, wanted);
    avr.link_open(false);
    run(&mut avr, 720);
    assert_eq!(led(&avr), Some(false));
}
