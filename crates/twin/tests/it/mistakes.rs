//! The mistakes in firmware that the judge must see: the board does the job of another file than the one it is judged
//! by.

use sensedsl_twin::judge::Finding;

use crate::run::{mistaken, plainly};

const ROVER: &str = "board STM32F407G_DISC1 {
    sensor Near returns uint16 { id = 1; type = analog; delay = 20 ms; }
    sensor Far returns uint16 { id = 2; type = analog; delay = 60 ms; smooth = 200 ms; }
    sensor Noisy returns uint16 { id = 3; type = analog; delay = 20 ms; median = 5; }
    sensor Rear returns uint16 { id = 4; driver = srf08; address = 0x70; delay = 100 ms; invalid = 0; }
    sensor Angle returns uint16 { id = 5; driver = as5600; address = 0x36; delay = 20 ms; change = 40; heartbeat = 1 s; }
    sensor Steering returns uint16 { id = 6; type = icu; mode = width; }
    sensor Level returns uint16 { id = 7; type = i2c; address = 0x48; delay = 50 ms; invalid = 65535; register = 1; }
    sensor Bumper returns bool { id = 8; type = digital; delay = 30 ms; }
}";

/// The names of the devices with findings, and the findings in words.
fn wrong(find: &str, with: &str, world: &str, seconds: u64) -> Vec<(String, String)> {
    assert!(ROVER.contains(find), "{find}");
    let run = mistaken(ROVER, &ROVER.replacen(find, with, 1), world, seconds);
    let wrong = run.judged.iter().filter(|one| one.wrong > 0);
    wrong.map(|one| (one.name.clone(), one.words())).collect()
}

#[test]
fn a_board_without_a_mistake_is_right() {
    let run = plainly(ROVER, "", 10);
    assert!(run.wrong().is_empty(), "{:#?}", run.wrong());
    for one in &run.judged {
        let every = one.every_ns.unwrap_or_else(|| panic!("{} has no pace", one.name));
        assert!(one.reports > 9, "{}: {} reports, every {every} ns", one.name, one.reports);
    }
}

/// The text in the file, the one in the firmware, the device with the finding, and a word of it.
#[test]
fn mistakes_of_firmware_are_seen() {
    let cases = [
        ("analog; delay = 20 ms", "analog; delay = 200 ms", "Near", "every 200 ms"),
        ("analog; delay = 20 ms", "analog; delay = 24 ms", "Near", "every 24 ms"),
        ("analog; delay = 20 ms", "analog; delay = 15 ms", "Near", "every 15 ms"),
        ("delay = 60 ms; smooth", "delay = 600 ms; smooth", "Far", "every 60"),
        ("smooth = 200 ms", "smooth = 20 ms", "Far", " and not "),
        ("smooth = 200 ms", "smooth = 2000 ms", "Far", " and not "),
        ("smooth = 200 ms;", "", "Far", " and not "),
        ("median = 5;", "", "Noisy", " and not "),
        ("address = 0x70", "address = 0x71", "Rear", "not acknowledged"),
        ("0x70; delay = 100 ms", "0x70; delay = 120 ms", "Rear", "every 120 ms"),
        ("address = 0x48", "address = 0x49", "Level", "not acknowledged"),
        ("invalid = 65535;", "", "Level", "which is `invalid`"),
        ("delay = 20 ms; change = 40;", "delay = 400 ms; change = 40;", "Angle", ""),
        ("change = 40;", "change = 400;", "Angle", "nothing for"),
        ("change = 40; heartbeat = 1 s;", "", "Angle", "less than `change`"),
        ("heartbeat = 1 s", "heartbeat = 60 s", "Angle", "nothing for"),
        ("digital; delay = 30 ms", "digital; delay = 300 ms", "Bumper", "every 300 ms"),
    ];
    let mut missed = Vec::new();
    for (find, with, name, words) in cases.into_iter().step_by(crate::step(3)) {
        let world = if find.contains("heartbeat = 1 s") && with.contains("60 s") {
            "[devices]\nAngle = 100\n"
        } else {
            ""
        };
        let messages = wrong(find, with, world, 12);
        let is_seen = messages.iter().all(|(of, _)| of == name)
            && messages.iter().any(|(_, what)| what.contains(words));
        if !is_seen {
            missed.push(format!("`{find}` as `{with}`: {messages:?}"));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// A value that the world does not send is not a mistake, and one that it sends must come.
#[test]
fn what_the_world_explains_is_right() {
    let mute = "[devices]\nRear = 0\nAngle = 1000\nSteering = 0\nLevel = 65535\n";
    let run = plainly(ROVER, mute, 8);
    assert!(run.wrong().is_empty(), "{:#?}", run.wrong());
    for name in ["Rear", "Steering", "Level"] {
        assert_eq!(run.of(name).reports, 0, "{name}");
    }
}

/// Three channels of a model receiver that are never reported.
#[test]
fn a_capture_that_does_not_come_is_wrong() {
    let lost = |_: u64, values: &mut crate::run::Values| values.retain(|(id, _)| *id != 6);
    let run = crate::run::simulate(ROVER, "", 6, lost);
    let worst = run.of("Steering").worst.clone().unwrap();
    assert!(matches!(worst.finding, Finding::Silence(_)), "{worst:?}");
    let wrong: Vec<&str> =
        run.judged.iter().filter(|one| one.wrong > 0).map(|one| one.name.as_str()).collect();
    assert_eq!(wrong, ["Steering"]);
}

/// Boards whose units have no number, or share one: `TWI` and `SPI` of an AVR.
#[test]
fn units_without_a_number_are_read() {
    let text = "board ARDUINO_UNO_R3 {
        sensor Acceleration returns int16[3] { id = 1; type = i2c; address = 0x68; register = 0x3B; delay = 20 ms; }
        sensor Angle returns uint16 { id = 2; driver = as5047p; delay = 20 ms; }
    }";
    let run = plainly(text, "", 5);
    assert!(run.wrong().is_empty(), "{:#?}", run.wrong());
    assert!(run.judged.iter().all(|one| one.reports > 200), "{:#?}", run.judged);
}

/// A part that is not woken measures nothing, as its data sheet says.
#[test]
fn a_part_that_is_not_woken_is_seen() {
    let board = |init: &str| {
        format!(
            "board STM32F407G_DISC1 {{ chip Imu {{ driver = adxl345; address = 0x53; delay = 20 ms; {init} }} }}"
        )
    };
    let right = board("");
    assert!(plainly(&right, "", 5).wrong().is_empty());
    let asleep = mistaken(&right, &board("init = [[0x31, 0x0B], [0x2C, 0x0A]];"), "", 5);
    assert!(!asleep.wrong().is_empty());
}

/// The wire of a contact has spikes that are shorter than `debounce`.
#[test]
fn a_contact_that_is_not_debounced_is_seen() {
    let text = |debounce: &str| {
        format!(
            "board STM32F407G_DISC1 {{ sensor Bumper returns bool {{ id = 1; type = digital; debounce = {debounce}; delay = 50 ms; }} }}"
        )
    };
    let run = mistaken(&text("20 ms"), &text("0 ms"), "", 10);
    assert_eq!(run.wrong().len(), 1, "{:#?}", run.wrong());
    let right = mistaken(&text("20 ms"), &text("20 ms"), "", 10);
    assert!(right.wrong().is_empty(), "{:#?}", right.wrong());
}

/// The contact changes for a little less than `debounce`, which must not be reported, and for a little longer.
#[test]
fn a_contact_that_must_last_for_another_time_is_seen() {
    for edge in ["", "edge = both;"] {
        let text = |debounce: &str| {
            format!(
                "board STM32F407G_DISC1 {{ sensor Bumper returns bool {{ id = 1; type = digital; debounce = {debounce}; \
                 {edge} delay = 50 ms; pull = up; active = low; }} }}"
            )
        };
        let reported = |debounce: &str| {
            let run = mistaken(&text("20 ms"), &text(debounce), "", 6);
            run.of("Bumper").words()
        };
        assert_eq!(reported("20 ms"), "", "{edge}");
        let longer = reported("40 ms");
        assert!(longer.contains("a little longer than its 20 ms"), "{edge} {longer}");
        let shorter = reported("10 ms");
        assert!(shorter.contains("and not"), "{edge} {shorter}");
    }
}

/// A pause that a driver requires while it sets up its part.
#[test]
fn a_pause_that_is_left_out_is_seen() {
    let board = |pause: &str| {
        format!(
            "board STM32F407G_DISC1 {{ chip Compass {{ driver = qmc5883l; delay = 100 ms; \
             init = [[0x0A, 0x80], {pause} [0x0B, 0x01], [0x09, 0x1D], 10 ms]; }} }}"
        )
    };
    let odd = |pause: &str| mistaken(&board("10 ms,"), &board(pause), "", 3).odd;
    assert_eq!(odd("10 ms,"), []);
    assert_eq!(odd("20 ms,"), []);
    for pause in ["", "5 ms,"] {
        let odd = odd(pause);
        let what = odd.first().map(|(_, what)| what.as_str()).unwrap_or_default();
        assert!(what.contains("after 0A 80 is written, and needs 10 ms"), "{pause} {odd:?}");
    }
}

/// A board sends at most one report in each cycle of its reporter.
#[test]
fn a_board_that_reports_too_often_is_seen() {
    let board = |rate: &str| {
        format!(
            "board STM32F407G_DISC1 {{ link {{ transport = uart; unit = USART3; baud = 230400; {rate} }}
                sensor Turns returns int32 {{ id = 1; type = encoder; }}
                sensor Wheel returns uint32 {{ id = 2; type = icu; }}
                sensor Near returns uint16 {{ id = 3; type = analog; delay = 20 ms; }}
                sensor Bumper returns bool {{ id = 4; type = digital; delay = 10 ms; }}
                sensor Angle returns uint16 {{ id = 5; type = spi; clock = 1 MHz; mode = 1; register = 0x3F; \
             length = 2; delay = 15 ms; }} }}"
        )
    };
    let run = mistaken(&board(""), &board("rate = 1 kHz;"), "", 6);
    let words = run.of("STM32F407G_DISC1").words();
    assert!(words.contains("and not every 10 ms"), "{words}");
    let run = mistaken(&board("rate = 300 Hz;"), &board("rate = 300 Hz;"), "", 6);
    assert!(run.wrong().is_empty(), "{:#?}", run.wrong());
}
