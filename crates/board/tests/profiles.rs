//! Target profiles and built-in boards, as later stages use them.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use sensedsl_board::pin::PinName;
use sensedsl_board::profile::{self, Fallback, NoProfile, Target, TargetProfile, Transport};
use sensedsl_board::signal::{Function, Signal};
use sensedsl_board::{catalog, table};

fn pin(name: &str) -> PinName {
    PinName::parse(name).unwrap()
}

fn signal(name: &str) -> Signal {
    Signal::parse(name).0
}

fn f407() -> TargetProfile {
    match profile::find("chibios", "STM32F407VGT6") {
        Ok(Target::Profile(profile)) => *profile,
        other => panic!("{other:?}"),
    }
}

#[test]
fn targets_are_found_by_name_and_mcu() {
    assert_eq!(profile::find("none", "anything"), Ok(Target::None));
    assert_eq!(profile::full_name("ChibiOS"), Some("chibios-21.11"));
    assert_eq!(profile::full_name("chibios-21.11"), Some("chibios-21.11"));
    let names = profile::names();
    assert_eq!(names[..2], ["none", "chibios"]);
    assert!(names.contains(&"chibios-21.11".to_owned()), "{names:?}");
    assert_eq!(f407().name, "chibios-21.11");
    assert_eq!(f407().parts, ["STM32F405", "STM32F407", "STM32F415", "STM32F417"]);
    let Err(NoProfile::UnknownTarget { nearest, .. }) = profile::find("chibois", "STM32F407VG")
    else {
        panic!("an unknown target was found")
    };
    assert_eq!(nearest.as_deref(), Some("chibios"));
    let Err(NoProfile::UnknownMcu { target, covered }) = profile::find("chibios", "RP2040") else {
        panic!("an unknown MCU was found")
    };
    assert_eq!(target, "chibios-21.11");
    assert!(covered.contains(&"STM32F4".to_owned()), "{covered:?}");
    let Err(NoProfile::UnknownMcu { covered, .. }) = profile::find("chibios", "STM32F423ZH") else {
        panic!("a profile for F423 was found")
    };
    assert!(covered.contains(&"STM32F413".to_owned()), "{covered:?}");
}

#[test]
fn timers_of_the_f407() {
    let profile = f407();
    let numbers = |has: &dyn Fn(&profile::Timer) -> bool| -> Vec<u8> {
        profile
            .timers
            .iter()
            .filter(|timer| has(timer))
            .filter_map(|timer| timer.name.strip_prefix("TIM")?.parse().ok())
            .collect()
    };
    assert_eq!(numbers(&|timer| timer.icu.is_some()), [1, 2, 3, 4, 5, 8, 9, 12]);
    assert_eq!(numbers(&|timer| timer.encoder), [1, 2, 3, 4, 5, 8]);
    assert_eq!(numbers(&|timer| timer.bits == 32), [2, 5]);
    assert_eq!(numbers(&|timer| timer.clock == "STM32_TIMCLK2"), [1, 8, 9, 10, 11]);
    assert_eq!(numbers(&|timer| timer.pwm.is_some()), [1, 2, 3, 4, 5, 8, 9, 10, 11, 12, 13, 14]);
    assert_eq!(profile.timer("TIM3").unwrap().icu.as_ref().unwrap().channels, [1, 2]);
    assert_eq!(profile.timer("TIM6"), None);
    assert_eq!(profile.kernel.timers, ["TIM2", "TIM5"]);
    assert_eq!(profile.kernel.fallback, Some(Fallback::Systick));
}

#[test]
fn streams_of_the_f407() {
    let profile = f407();
    let streams = |unit: &str| -> Vec<String> {
        let text = |request: &profile::DmaRequest| {
            let streams: Vec<String> = request.streams.iter().map(ToString::to_string).collect();
            format!("{}={}", request.name, streams.join("|"))
        };
        profile.dma(unit).iter().map(text).collect()
    };
    assert_eq!(streams("ADC1"), ["ADC1=2,4|2,0"]);
    assert_eq!(streams("I2C1"), ["I2C1_RX=1,0|1,5", "I2C1_TX=1,6|1,7"]);
    assert_eq!(streams("I2C3"), ["I2C3_RX=1,2", "I2C3_TX=1,4"]);
    assert_eq!(streams("SPI3"), ["SPI3_RX=1,0|1,2", "SPI3_TX=1,7|1,5"]);
    assert_eq!(streams("USART1"), Vec::<String>::new());
    assert_eq!(streams("I2C9"), Vec::<String>::new());
}

#[test]
fn alternate_functions_of_the_f407() {
    let profile = f407();
    for (name, expected) in [
        ("TIM1_CH1", Some(1)),
        ("TIM2_CH2", Some(1)),
        ("TIM5_CH2", Some(2)),
        ("TIM8_CH1N", Some(3)),
        ("TIM14_CH1", Some(9)),
        ("I2C3_SCL", Some(4)),
        ("SPI1_SCK", Some(5)),
        ("SPI3_SCK", Some(6)),
        ("USART1_TX", Some(7)),
        ("UART4_RX", Some(8)),
        ("USART6_RX", Some(8)),
        ("CAN2_TX", Some(9)),
        ("CAN_TX", Some(9)),
        ("ADC1_IN3", None),
        ("TIM15_CH1", None),
        ("FSMC_D4", None),
    ] {
        assert_eq!(profile.alternate(&signal(name), &pin("PA1")), expected, "{name}");
    }
}

#[test]
fn other_facts_of_the_f407() {
    let profile = f407();
    assert_eq!(profile.exti_group(&pin("PA7")), Some(7));
    assert_eq!(profile.exti_group(&pin("PE7")), Some(7));
    assert_eq!(profile.link_pins(Transport::Usb, None), [pin("PA11"), pin("PA12")]);
    assert_eq!(profile.link_pins(Transport::Usb, Some("otg1")), [pin("PA11"), pin("PA12")]);
    assert_eq!(profile.link_pins(Transport::Uart, Some("USART2")), []);
    assert_eq!(profile.debug.pins, [pin("PA13"), pin("PA14")]);
    assert_eq!(profile.dac_output(1, 2).unwrap().channel, 2);
    assert_eq!(profile.dac_output(2, 1), None);
    assert!(profile.serves(signal("ADC123_IN1").function()));
    assert!(!profile.serves(signal("ADC4_IN1").function()));
    assert!(!profile.serves(&Function::Other));
}

#[test]
fn boards_are_found_by_any_spelling() {
    let paper = catalog::find("stm32f4-discovery_board").unwrap();
    assert_eq!(paper.name, "STM32F4DiscoveryBoard");
    assert_eq!(catalog::find("STM32F5DiscoveryBoard"), None);
    let nearest = catalog::nearest_name("STM32F4DiscoverBoard");
    assert_eq!(nearest, Some("STM32F4DiscoveryBoard"));
    assert_eq!(catalog::nearest_name("toaster"), None);
    assert_eq!(catalog::find("ESP32_S3_DevKitC_1").unwrap().name, "ESP32-S3-DEVKITC-1");
    assert_eq!(catalog::not_yet("Arduino_Giga"), Some("Arduino Giga"));
    assert!(catalog::all().iter().all(|board| catalog::not_yet(board.name).is_none()));
    assert_eq!(catalog::of_mcu("STM32F407VG").unwrap().mcu, "STM32F407VGT6");
    assert_eq!(catalog::of_mcu("STM32F407IG"), None);
}

#[test]
fn the_paper_s_board_has_what_its_firmware_needs() {
    let entry = catalog::find("STM32F4DiscoveryBoard").unwrap();
    let pins = entry.table();
    assert_eq!(pins.mcu.as_deref(), Some("STM32F407VGT6"));
    assert_eq!(pins.to_csv(), entry.csv());
    assert_eq!(table::load(entry.csv()).findings, []);
    let board = entry.board().unwrap();
    let chibios = &board.system["chibios"];
    assert_eq!(chibios.own["board"].as_str(), Some("ST_STM32F4_DISCOVERY"));
    assert_eq!(chibios.clocks_hz["STM32_TIMCLK2"], 168_000_000);
    let link = board.link.first().unwrap();
    assert_eq!((link.transport, link.unit.as_str()), (Transport::Usb, "OTG1"));
    assert_eq!(board.button.unwrap().pin, pin("PA0"));
    // ChibiOS has a driver for every usage in the table, except one-channel capture.
    let profile = f407();
    for pin in &pins.pins {
        for usage in &pin.usages {
            assert!(profile.serves(usage.signal.function()), "{} {}", pin.name, usage.spelled);
        }
    }
}
