//! The reading of worlds, and the effects of faults.

use crate::run::{plainly, read, with_job};

const BOARD: &str = "board STM32F4DiscoveryBoard {
    sensor Light returns uint16 { id = 1; type = analog; delay = 20; }
    sensor Percent returns uint8 { id = 2; type = analog; delay = 20; }
    sensor Rear returns uint16 { id = 3; driver = srf08; address = 0x70; delay = 100; }
    sensor Wheel returns uint32 { id = 4; type = icu; }
    sensor Pair returns uint16[2] { id = 5; type = analog; delay = 20; }
    sensor Button returns bool { id = 6; type = digital; delay = 20; }
    actuator Lamp accepts bool { id = 7; type = digital; }
    sensor Rain returns uint32 { id = 8; type = digital; edge = falling; debounce = 20 ms; delay = 50; }
}";

/// The codes and places of the errors in a world.
fn reported(text: &str) -> Vec<(String, String)> {
    with_job(BOARD, |job| {
        let (_, reported) = read(job, text, 1);
        for one in &reported {
            assert!(one.help.is_some(), "{one:#?}");
        }
        let place = |one: &sensedsl_diagnostics::Diagnostic| {
            text.get(one.primary.span.range()).unwrap_or_default().to_owned()
        };
        reported.iter().map(|one| (one.code.to_string(), place(one))).collect()
    })
}

fn only(text: &str, code: &str, place: &str) {
    assert_eq!(reported(text), [(code.to_owned(), place.to_owned())], "{text}");
}

#[test]
fn every_mistake_is_told_with_its_place() {
    let device = |text: &str, code: &str, place: &str| {
        only(&format!("[devices]\n{text}"), code, place);
    };
    only("[devices\nLight = 5", "E0540", "");
    device("Light = \"bright\"", "E0540", "\"bright\"");
    device("Light = { }", "E0540", "{ }");
    device("Light = { value = 1, rate = 2 }", "E0540", "{ value = 1, rate = 2 }");
    device("Light = { sine = 5 }", "E0540", "{ sine = 5 }");
    only("seed = -1", "E0540", "-1");
    device("Ligth = 5", "E0541", "Ligth");
    device("Lamp = 1", "E0541", "Lamp");
    device("Light = { sinus = 5 }", "E0541", "sinus");
    only("[device]\nLight = 5", "E0541", "device");
    device("Light = 5000", "E0542", "5000");
    device("Percent = 300", "E0542", "300");
    device("Light = { ramp = [0, -1], over = 1 }", "E0542", "{ ramp = [0, -1], over = 1 }");
    device("Pair = [1, 2, 3]", "E0542", "[1, 2, 3]");
    let falls = "{ sine = 5, offset = 9, period = \"1 s\" }";
    device(&format!("Wheel = {falls}"), "E0542", falls);
    for fast in
        ["{ rate = 25 }", "{ ramp = [0, 100], over = \"2 s\" }", "{ steps = [[0, 0], [1, 60]] }"]
    {
        device(&format!("Rain = {fast}"), "E0542", fast);
    }
    assert_eq!(reported("[devices]\nRain = { rate = 24 }"), []);
    device("Light = { ramp = [0, 1], over = \"1 fortnight\" }", "E0543", "\"1 fortnight\"");
    device("Light = { steps = [[2, 1], [1, 5]] }", "E0543", "[1, 5]");
    device("Light = { csv = \"none.csv\" }", "E0545", "\"none.csv\"");
    device("Light = { csv = \"drive.csv\", column = \"sped\" }", "E0545", "\"drive.csv\"");
    device("Light = { csv = \"bad.csv\", column = \"speed\" }", "E0545", "\"bad.csv\"");
    let fault = |what: &str| format!("[[fault]]\nat = 1\nfor = 1\n{what}");
    only(&fault("kind = \"no_answer\"\ndevice = \"Light\""), "E0544", "\"Light\"");
    only(&fault("kind = \"silent\"\ndevice = \"Rear\""), "E0544", "\"Rear\"");
    only(&fault("kind = \"reset\"\ndevice = \"Rear\""), "E0544", "\"Rear\"");
    only(&fault("kind = \"torm\"\ndevice = \"Rear\""), "E0541", "\"torm\"");
    only(&fault("kind = \"torn\"\ndevice = \"Raer\""), "E0541", "\"Raer\"");
}

#[test]
fn samples_are_joined_by_straight_lines() {
    with_job(BOARD, |job| {
        let text = "[devices]\nLight = { csv = \"drive.csv\", column = \"speed\" }";
        let (world, reported) = read(job, text, 1);
        assert!(reported.is_empty(), "{reported:#?}");
        let signal = &world.signals.values().next().unwrap()[0];
        assert!((signal.at(500_000_000) - 15.0).abs() < 1e-9);
        assert!((signal.at(9_000_000_000) - 20.0).abs() < 1e-9);
    });
}

/// The times at which a device was reported.
fn times(world: &str, id: u8) -> Vec<u64> {
    let run = plainly(BOARD, world, 8);
    assert!(run.wrong().is_empty(), "{world}: {:#?}", run.wrong());
    let has = |values: &crate::run::Values| values.iter().any(|(of, _)| *of == id);
    run.reports.iter().filter(|(_, values)| has(values)).map(|(at, _)| at / 1_000_000).collect()
}

#[test]
fn what_breaks_is_silent_and_comes_back() {
    for kind in ["no_answer", "stuck_sda", "hang", "torn"] {
        let world = format!("[[fault]]\nkind = \"{kind}\"\ndevice = \"Rear\"\nat = 2\nfor = 2\n");
        let times = times(&world, 3);
        let during = times.iter().filter(|at| (2_300..4_000).contains(*at)).count();
        assert_eq!(during, 0, "{kind}");
        assert!(times.iter().any(|at| *at < 2_000), "{kind}");
        assert!(times.iter().any(|at| *at > 6_000), "{kind} never comes back");
    }
}

/// Every bit of a message that is turned round costs the message, and gives no wrong value: the fault turns another one
/// each time, and a capsule of a scanner has 672 of them.
#[test]
fn a_spoiled_message_is_no_value() {
    for (chip, sensor) in [
        ("rplidar", "sensor Value returns uint16[16] { id = 1; reading = distances_1; }"),
        ("ld06", "sensor Value returns uint16[12] { id = 1; reading = distances; }"),
        ("tfmini", "sensor Value returns uint16 { id = 1; reading = distance; }"),
    ] {
        let board = format!(
            "board NUCLEO_F446RE {{ link {{ transport = uart; baud = 921600; }}
                chip Part {{ driver = {chip}; delay = 20 ms; {sensor} }} }}"
        );
        let world = "[[fault]]\nkind = \"bad_checksum\"\ndevice = \"Value\"\nat = 2\nfor = 16\n";
        let run = plainly(&board, world, 20);
        assert!(run.wrong().is_empty(), "{chip}: {:#?}", run.wrong());
        let times: Vec<u64> = run.reports.iter().map(|(at, _)| at / 1_000_000).collect();
        let during = times.iter().filter(|at| (2_100..18_000).contains(*at)).count();
        assert_eq!(during, 0, "{chip}");
        let around = |from, to| times.iter().filter(|at| (from..to).contains(*at)).count();
        assert!(around(1_000, 2_000) > 40 && around(19_000, 20_000) > 40, "{chip}: {times:?}");
    }
    // What has no checksum cannot be spoiled so that it would be noticed.
    let bare =
        "board NUCLEO_F446RE { sensor Raw returns uint16 { id = 1; type = uart; start = [1]; } }";
    let world = "[[fault]]\nkind = \"bad_checksum\"\ndevice = \"Raw\"\nat = 2\n";
    let refused = with_job(bare, |job| read(job, world, 1).1);
    assert_eq!(refused.len(), 1, "{refused:#?}");
}

#[test]
fn a_board_that_was_reset_begins_anew() {
    let times = times("[[fault]]\nkind = \"reset\"\nat = 3\nfor = \"500 ms\"\n", 1);
    assert!(!times.iter().any(|at| (3_050..3_500).contains(at)), "{times:?}");
    assert!(times.iter().any(|at| (3_500..3_700).contains(at)), "{times:?}");
}

#[test]
fn garbage_on_the_link_costs_no_wrong_value() {
    let world = "[[fault]]\nkind = \"garbage\"\nat = 2\nfor = \"200 ms\"\n";
    let run = plainly(BOARD, world, 5);
    assert!(run.wrong().is_empty(), "{:#?}", run.wrong());
    assert!(run.dropped > 50, "{}", run.dropped);
}

const SHOWN: &str = "board STM32F407G_DISC1 {
    sensor Front returns uint16 { id = 1; type = analog; quantity = cm; scale = 0.1; offset = 5; }
    sensor Angle returns int32 { id = 2; type = encoder; quantity = deg; scale = 0.5; }
    sensor Light returns uint16 { id = 3; type = analog; quantity = \"lx\"; }
    sensor Bent returns uint16 { id = 4; type = analog; quantity = cm; curve = [[0, 0], [4095, 80]]; }
    actuator Servo accepts uint16 { id = 5; type = pwm; min = 1 ms; max = 2 ms; }
    actuator Motor accepts int16 { id = 6; type = can; frame = 1; quantity = \"deg/s\"; scale = 0.5; failsafe = -20 deg/s; }
}";

#[test]
fn values_carry_units_and_codes() {
    with_job(SHOWN, |job| {
        let of = |line: &str, at_s: u64| {
            let (world, reported) = read(job, &format!("[devices]\n{line}"), 1);
            assert!(reported.is_empty(), "{line}: {reported:#?}");
            world.signals.values().next().unwrap()[0].at(at_s * 1_000_000_000)
        };
        for (line, at_s, expected) in [
            ("Front = \"0.2 m\"", 0, 20.0),
            ("Front = \"20\"", 0, 20.0),
            ("Front = \"raw 307\"", 0, 35.7),
            ("Front = { value = \"200 mm\" }", 0, 20.0),
            ("Front = { ramp = [\"raw 100\", \"0.3 m\"], over = 2 }", 0, 15.0),
            ("Front = { ramp = [\"raw 100\", \"0.3 m\"], over = 2 }", 2, 30.0),
            ("Front = { sine = \"raw 50\", offset = \"0.2 m\", period = 4 }", 1, 25.0),
            ("Front = { steps = [[0, 10], [1, \"0.4 m\"]] }", 2, 40.0),
            ("Angle = { rate = \"90 deg/s\", start = \"raw 20\" }", 1, 100.0),
            ("Angle = { rate = \"raw 30\" }", 1, 15.0),
            ("Light = \"300 lx\"", 0, 300.0),
            ("Bent = \"raw 2047.5\"", 0, 40.0),
        ] {
            let found = of(line, at_s);
            assert!((found - expected).abs() < 1e-6, "{line}: {found}");
        }
        let command = |device: &str, value: &str| {
            let text = format!("[[command]]\ndevice = \"{device}\"\nat = 1\nvalue = {value}");
            let (world, reported) = read(job, &text, 1);
            assert!(reported.is_empty(), "{value}: {reported:#?}");
            sensedsl_twin::truth::real(world.commands[0].value[0])
        };
        for (device, value, code) in [
            ("Servo", "\"1500 us\"", 5000.0),
            ("Servo", "\"25 %\"", 2500.0),
            ("Servo", "\"raw 307\"", 307.0),
            ("Servo", "307", 307.0),
            ("Motor", "-20", -40.0),
            ("Motor", "\"-20 deg/s\"", -40.0),
            ("Motor", "\"raw -7\"", -7.0),
        ] {
            let found = command(device, value);
            assert!((found - code).abs() < 1e-9, "{device} {value}: {found}");
        }
    });
}

#[test]
fn a_unit_that_does_not_fit_is_told() {
    with_job(SHOWN, |job| {
        for (line, code, words) in [
            ("Front = \"5 V\"", "E0542", "the device shows cm, and this is a number of V"),
            ("Front = \"5 furlong\"", "E0542", "the device shows cm, and `furlong` is not that"),
            ("Front = \"raw 5 cm\"", "E0542", "a code has no unit"),
            ("Front = \"raw 5000\"", "E0542", "cannot be"),
            ("Angle = { rate = \"90 deg\" }", "E0542", "the device shows deg/s"),
            ("Bent = { sine = \"raw 5\", period = 1 }", "E0542", "along a `curve`"),
            ("Front = { noise = \"much\", value = 20 }", "E0540", "`noise` must be"),
        ] {
            let (_, reported) = read(job, &format!("[devices]\n{line}"), 1);
            let found: Vec<_> =
                reported.iter().map(|one| (one.code.to_string(), &*one.message)).collect();
            assert_eq!(found.len(), 1, "{line}: {found:#?}");
            assert!(found[0].0 == code && found[0].1.contains(words), "{line}: {found:#?}");
        }
        for (device, value) in
            [("Servo", "\"3 ms\""), ("Servo", "\"5 cm\""), ("Motor", "\"5 m/s\"")]
        {
            let text = format!("[[command]]\ndevice = \"{device}\"\nat = 1\nvalue = {value}");
            let (_, reported) = read(job, &text, 1);
            assert_eq!(reported.len(), 1, "{value}: {reported:#?}");
            assert_eq!(reported[0].code.to_string(), "E0542");
            assert!(reported[0].help.is_some());
        }
    });
}
