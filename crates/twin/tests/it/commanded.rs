//! The mistakes that the judge of actuators must catch: boards of a design with one mistake each, checked by the judge
//! of the correct design.

use sensedsl_twin::bench::Bench;
use sensedsl_twin::commands::{ActuatorFindings, Commands};
use sensedsl_twin::soft::SoftBoard;
use sensedsl_wire::{Decoder, Direction, Event, encode_hello_request};

use crate::run::{read, with_job};

const MS: u64 = 1_000_000;

const RIGHT: &str = "board STM32F407G_DISC1 {
    link { transport = uart; unit = USART3; silence = 400 ms; }
    release CS43L22;
    chip Left { driver = gearmotor_tb6612; actuator Speed accepts int16 { id = 1; reading = speed; } }
    chip Right { driver = bts7960; actuator Thrust accepts int16 { id = 2; reading = speed; failsafe = 0; } }
    actuator Servos accepts uint16[3] { id = 3; type = pwm; frequency = 50 Hz; min = 1 ms; max = 2 ms; failsafe = 5000; }
    actuator Relays accepts bool[2] { id = 4; type = digital; initial = true; failsafe = false; }
    actuator Lamp accepts uint8 { id = 5; type = digital; active = low; }
    actuator Level accepts uint16 { id = 6; type = dac; failsafe = 100; }
    actuator Lamps accepts uint16[2] { id = 7; type = i2c; address = 0x22; register = 0x10; length = 4; delay = 20 ms; failsafe = 3; }
    actuator Dial accepts int16 { id = 8; type = spi; clock = 1 MHz; register = 0x20; length = 2; delay = 20 ms; }
    actuator Demand accepts int16 { id = 9; type = can; bitrate = 500 kHz; frame = 0x120; failsafe = 7; }
    actuator Pace accepts uint16 { id = 12; type = can; bitrate = 500 kHz; frame = 0x121; resend = 20 ms; }
    actuator Limit accepts uint8 { id = 10; type = can; bitrate = 500 kHz; frame = 0x120; byte = 4; }
    actuator Say accepts uint16 { id = 11; type = uart; baud = 9600; start = [0x55, 0xAA]; length = 2; checksum = xor8; end = [0x0D]; failsafe = 1; }
}";

/// Outputs of an expander. In one of the boards each is a chip of its own, and these do not know each other's bits.
const EXPANDER: &str = "board STM32F407G_DISC1 {
    link { transport = uart; unit = USART3; silence = 400 ms; }
    chip Pins {
        driver = mcp23017_pins;
        unit = I2C1;
        delay = 20 ms;
        actuator Relay accepts bool { id = 1; reading = gpb3; failsafe = false; }
        actuator Pump accepts bool { id = 2; reading = gpb4; initial = true; }
    }
}";

/// The findings about the outputs of a board with a mistake, by the judge of the correct design.
fn tried(wrong: &str, world: &str) -> Vec<ActuatorFindings> {
    tried_as(RIGHT, wrong, world)
}

pub(crate) fn tried_as(right: &str, wrong: &str, world: &str) -> Vec<ActuatorFindings> {
    with_job(right, |right| {
        with_job(wrong, |wrong| {
            assert_eq!(right.schema.hash(), wrong.schema.hash());
            let (world, reported) = read(right, world, 7);
            assert!(reported.is_empty(), "{reported:#?}");
            let bench = Bench::new(right, &world, 7);
            let mut commands = Commands::new(right, &bench, 10_000 * MS);
            let mut board = SoftBoard::new(wrong, bench);
            for ms in 0..10_000 {
                if ms == 0 || ms == 500 {
                    board.link_write(&encode_hello_request(&right.schema));
                }
                board.link_write(&commands.host(ms * MS, ms >= 600));
                board.run_until((ms + 1) * MS);
                if commands.looks((ms + 1) * MS) {
                    commands.look((ms + 1) * MS, board.bench().outputs());
                }
            }
            commands.finish()
        })
    })
}

/// The names of the actuators with findings when a text of the design is replaced by another.
fn mismatch(from: &str, to: &str) -> Vec<String> {
    assert!(RIGHT.contains(from), "{from}");
    let all = tried(&RIGHT.replacen(from, to, 1), "");
    all.into_iter().filter(|one| one.wrong > 0).map(|one| one.name).collect()
}

#[test]
fn what_is_right_is_found_right() {
    let all = tried(RIGHT, "");
    for one in &all {
        assert_eq!((one.wrong, one.left, one.is_silence_left), (0, 0, false), "{one:#?}");
        assert!(one.looks >= 5 && (one.commands >= 5 || !one.is_set), "{one:#?}");
    }
    assert_eq!(all.iter().filter(|one| one.is_set).count(), 12);
    // STBY of one bridge, the enables of the other.
    assert_eq!(all.iter().filter(|one| !one.is_set).count(), 3);
}

#[test]
fn outputs_of_an_expander_are_judged_bit_by_bit() {
    for one in tried_as(EXPANDER, EXPANDER, "") {
        assert_eq!((one.wrong, one.left, one.is_silence_left), (0, 0, false), "{one:#?}");
        assert!(one.looks >= 5 && one.commands >= 4, "{one:#?}");
    }
    let mismatch = |wrong: &str| {
        let all = tried_as(EXPANDER, wrong, "").into_iter().filter(|one| one.wrong > 0);
        all.map(|one| one.name).collect::<Vec<String>>()
    };
    let seeds = [
        ("initial = true", "initial = false", "Pump"),
        ("failsafe = false", "failsafe = true", "Relay"),
        ("reading = gpb3", "reading = gpb5", "Relay"),
        ("reading = gpb4", "reading = gpb6", "Pump"),
    ];
    for (from, to, name) in seeds.into_iter().step_by(crate::step(10)) {
        let found = mismatch(&EXPANDER.replacen(from, to, 1));
        assert!(found.iter().any(|one| one == name), "{from} -> {to}: {found:?}");
    }
}

#[test]
fn each_mistake_is_noticed_where_it_is() {
    let seeds = [
        ("max = 2 ms", "max = 1900 us", "Servos"),
        ("min = 1 ms", "min = 1100 us", "Servos"),
        ("frequency = 50 Hz", "frequency = 100 Hz", "Servos"),
        ("failsafe = 5000", "failsafe = 5100", "Servos"),
        ("initial = true", "initial = false", "Relays"),
        ("failsafe = false", "failsafe = true", "Relays"),
        ("active = low", "active = high", "Lamp"),
        ("failsafe = 100", "failsafe = 0", "Level"),
        ("register = 0x10", "register = 0x11", "Lamps"),
        ("length = 4;", "length = 4; order = little;", "Lamps"),
        ("failsafe = 3", "failsafe = 4", "Lamps"),
        ("register = 0x20", "register = 0x21", "Dial"),
        ("byte = 4", "byte = 5", "Limit"),
        ("failsafe = 7", "failsafe = 8", "Demand"),
        ("resend = 20 ms", "resend = 200 ms", "Pace"),
        ("resend = 20 ms", "resend = 10 ms", "Pace"),
        ("frame = 0x120; failsafe = 7", "frame = 0x120; resend = 20 ms; failsafe = 7", "Demand"),
        ("0xAA", "0xAB", "Say"),
        ("checksum = xor8", "checksum = sum8", "Say"),
        ("end = [0x0D]", "end = [0x0A]", "Say"),
    ];
    for (from, to, name) in seeds.into_iter().step_by(crate::step(10)) {
        let found = mismatch(from, to);
        assert!(found.iter().any(|one| one == name), "{from} -> {to}: {found:?}");
    }
}

/// Values that are sent at the same time are in one frame: a board that takes only the first value of a frame is wrong.
#[test]
fn several_actuators_are_told_at_once() {
    with_job(RIGHT, |job| {
        let (world, _) = read(job, "", 7);
        let bench = Bench::new(job, &world, 7);
        let mut commands = Commands::new(job, &bench, 10_000 * MS);
        let mut board = SoftBoard::new(job, bench);
        let mut decoder = Decoder::new(&job.schema, Direction::Actuator);
        let mut most = 0;
        for ms in 0..10_000 {
            let bytes = commands.host(ms * MS, ms >= 600);
            decoder.feed(&bytes, |event| {
                if let Event::Report(_, values) = event {
                    most = values.len().max(most);
                }
            });
            board.link_write(&bytes);
            board.run_until((ms + 1) * MS);
            if commands.looks((ms + 1) * MS) {
                commands.look((ms + 1) * MS, board.bench().outputs());
            }
        }
        assert_eq!(most, 12);
    });
}

#[test]
fn a_silence_that_does_not_count_or_counts_too_soon_is_noticed() {
    for silence in ["3 s", "200 ms"] {
        let found = mismatch("silence = 400 ms", &format!("silence = {silence}"));
        assert!(found.len() >= 5, "{silence}: {found:?}");
    }
}

#[test]
fn a_world_has_a_script_of_its_own() {
    let world = "[[command]]\ndevice = \"Thrust\"\nat = \"2 s\"\nvalue = -50\n\
                 [[command]]\ndevice = \"Servos\"\nat = \"1500 ms\"\nvalue = [0, 2000, 10000]\n";
    let all = tried(RIGHT, world);
    let of = |name: &str| all.iter().find(|one| one.name == name).unwrap();
    // Once, and again after the silence.
    for name in ["Thrust", "Servos"] {
        assert_eq!((of(name).commands, of(name).wrong), (2, 0), "{:#?}", of(name));
    }
    let wrong = tried(&RIGHT.replacen("max = 2 ms", "max = 1900 us", 1), world);
    let first = wrong.iter().find_map(|one| one.first.clone()).unwrap();
    assert!(first.wire.starts_with("Servos["), "{first:#?}");
}

#[test]
fn a_command_that_cannot_be_is_told_with_its_place() {
    let reported = |text: &str| {
        with_job(RIGHT, |job| {
            read(job, text, 7).1.iter().map(|one| one.code.to_string()).collect::<Vec<_>>()
        })
    };
    let command = |rest: &str| reported(&format!("[[command]]\n{rest}\n"));
    assert_eq!(command("device = \"Thrust\"\nat = \"1 s\"\nvalue = 400"), ["E0542"]);
    assert_eq!(command("device = \"Thrsut\"\nat = \"1 s\"\nvalue = 4"), ["E0541"]);
    assert_eq!(command("device = \"Servos\"\nat = \"1 s\"\nvalue = [1, 2]"), ["E0542"]);
    assert_eq!(command("device = \"Thrust\"\nvalue = 4"), ["E0540"]);
    assert_eq!(command("device = \"Thrust\"\nat = \"soon\"\nvalue = 4"), ["E0543"]);
    assert_eq!(command("device = \"Thrust\"\nat = \"1 s\"\nvalue = \"fast\""), ["E0540"]);
    assert_eq!(command("device = \"Thrust\"\nat = \"1 s\"\nvalues = 4"), ["E0541"]);
}
