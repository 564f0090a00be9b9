//! Images for the RP2040 on an emulator by others: links, values, outputs, faults and the watchdog.
//!
//! Runs with `SENSEDSL_THOROUGH=2`; needs Node.js with `npm ci --prefix tests/rp2040`, whose `board.mjs` is the board and
//! what is around it.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::Command;

use sensedsl_tests::{TempDir, answered, has, is_exhaustive, missing, root};
use sensedsl_wire::{
    Causes, Decoder, Direction, Event, Health, ResetCause, Scalar, Schema, encode_health_request,
    encode_hello_request, encode_report,
};
use serde_json::{Value, json};

use super::rp::generated;
use super::{can_link, linked, uf2_of, with_job};

/// All kinds that there is code for; the link is told before.
const DEVICES: &str = r"
    sensor Light returns uint16 { id = 1; type = analog; pin = GP26; samples = 4; delay = 50 ms; }
    sensor Pair returns uint16[2] { id = 2; type = analog; pin = [GP27, GP28]; median = 3; delay = 100 ms; }
    sensor Range returns uint16 { id = 3; type = i2c; address = 0x70; register = 2; length = 2; sda = GP4; scl = GP5; delay = 50 ms; }
    sensor Wheel returns uint32 { id = 4; type = icu; pin = GP7; }
    sensor Stick returns uint16 { id = 5; type = icu; mode = width; edge = falling; pin = GP13; }
    sensor Bump returns bool { id = 6; type = digital; pin = GP11; debounce = 5 ms; delay = 50 ms; }
    sensor Door returns bool { id = 7; type = digital; pin = GP14; pull = up; active = low; delay = 50 ms; }
    sensor Rain returns uint32 { id = 8; type = digital; pin = GP12; edge = falling; debounce = 20 ms; }
    sensor Gyro returns uint16 { id = 9; type = spi; sck = GP18; miso = GP16; mosi = GP19; cs = GP17; read = [0]; length = 2; delay = 50 ms; }
    sensor Place returns uint16 { id = 10; type = uart; unit = UART1; rx = GP9; length = 2; delay = 50 ms; }
    sensor Near returns uint32 { id = 11; driver = hcsr04; pin = GP15; trigger = GP3; divider = [5.6 kOhm, 10 kOhm]; delay = 100 ms; }
    actuator Servo accepts uint16 { id = 12; type = pwm; pin = GP2; frequency = 50 Hz; failsafe = 5000; }
    actuator Lamps accepts uint16[2] { id = 13; type = pwm; pin = [GP20, GP21]; frequency = 1000 Hz; }
    actuator Relay accepts bool { id = 14; type = digital; pin = GP22; }
}
";
/// The other port is a device's.
const USB: &str = "actuator Words accepts uint16 { id = 15; type = uart; unit = UART0; start = [0xAA]; length = 2; }";
const UART: &str = "link { transport = uart; unit = UART0; checksum = crc16; }";

const MS: u64 = 1_000;
const SERVO: &str = "2";
const TRIGGER: &str = "3";

/// A design, its image as a UF2 file, and its schema.
pub(super) struct Made {
    has_words: bool,
    pub(super) image: PathBuf,
    pub(super) schema: Schema,
    _scratch: TempDir,
}

/// What the host received, and what was on the pins.
pub(super) struct Run {
    hellos: Vec<u32>,
    pub(super) values: BTreeMap<u8, Vec<(u64, Vec<Scalar>)>>,
    pub(super) health: Vec<Health>,
    /// By pin: times in microseconds, with levels.
    pub(super) pins: BTreeMap<String, Vec<(u64, u64)>>,
    resets: Vec<u64>,
    /// What devices at ports were sent, by number.
    written: BTreeMap<String, Vec<u8>>,
}

pub(super) fn is_possible() -> bool {
    if !is_exhaustive() {
        return false;
    }
    if !can_link("thumbv6m-none-eabi") {
        return false;
    }
    if !has("node")
        || !["rp2040js", "uf2"].iter().all(|name| folder().join("node_modules").join(name).exists())
    {
        missing(
            "Node.js with the emulator of the RP2040 and a reader of UF2 files: npm ci --prefix tests/rp2040",
        );
    } else {
        return true;
    }
    false
}

fn folder() -> PathBuf {
    root().join("tests/rp2040")
}

fn made(name: &str, link: &str) -> Made {
    made_of(name, link, DEVICES)
}

/// The image for a Pico with these devices.
pub(super) fn made_of(name: &str, link: &str, devices: &str) -> Made {
    let scratch = TempDir::new(name);
    let design = format!(" {{ target = embassy; {link} {devices}");
    let board = "RASPBERRYPI_PICO";
    let project = generated(&scratch, board, &design);
    let image = uf2_of(&project, &linked(&project, "thumbv6m-none-eabi"));
    let schema = with_job(&format!("board {board}{design}"), None, |job| job.schema.clone());
    Made { has_words: link == USB, image, schema, _scratch: scratch }
}

/// Every tenth of a second a pulse to each input that measures one, and two characters; contacts open and close.
fn world(made: &Made, until_us: u64) -> Value {
    let rests = [12, 13, 14].map(|pin| (0, pin, 1));
    let mut levels: Vec<(u64, u8, u8)> = rests.to_vec();
    let mut ports = Vec::new();
    for at in (200 * MS..until_us).step_by(100_000) {
        levels.extend([(at, 7, 1), (at + 50, 7, 0)]);
        levels.extend([(at, 13, 0), (at + 1_500, 13, 1)]);
        levels.extend([(at + 20 * MS, 15, 1), (at + 25 * MS, 15, 0)]);
        ports.push((at, 1, "2143"));
    }
    levels.extend([(300 * MS, 14, 0), (350 * MS, 11, 1)]);
    // A contact that bounces, twice.
    for at in [500 * MS, 900 * MS] {
        levels.extend([(at, 12, 0), (at + 2 * MS, 12, 1), (at + 4 * MS, 12, 0)]);
        levels.push((at + 60 * MS, 12, 1));
    }
    json!({
        "image": made.image, "until": until_us, "analog": [1_000, 2_000, 3_000, 0],
        "chips": { "112": [0, 0, 0x12, 0x34] }, "spi": [0xFF, 0x34, 0x56],
        "levels": levels, "ports": ports, "link": (!made.has_words).then_some(0),
    })
}

pub(super) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

pub(super) fn run(made: &Made, world: &Value) -> Run {
    let mut node = Command::new("node");
    let answer = answered(node.arg(folder().join("board.mjs")), world.to_string());
    let answer: Value = serde_json::from_str(&answer).unwrap();
    let mut run = Run {
        hellos: Vec::new(),
        values: BTreeMap::new(),
        health: Vec::new(),
        pins: serde_json::from_value(answer["pins"].clone()).unwrap(),
        resets: serde_json::from_value(answer["resets"].clone()).unwrap(),
        written: serde_json::from_value(answer["written"].clone()).unwrap(),
    };
    let received: Vec<(u64, String)> = serde_json::from_value(answer["heard"].clone()).unwrap();
    let mut decoder = Decoder::new(&made.schema, Direction::Sensor);
    for (at, bytes) in &received {
        let bytes: Vec<u8> = (0..bytes.len() / 2)
            .map(|byte| u8::from_str_radix(&bytes[2 * byte..2 * byte + 2], 16).unwrap())
            .collect();
        decoder.feed(&bytes, |event| match event {
            Event::Report(_, values) => {
                for (id, scalars) in values {
                    run.values.entry(id).or_default().push((*at, scalars));
                }
            }
            Event::Hello(hash) => run.hellos.push(hash),
            Event::Health(health) => run.health.push(health),
            other => panic!("{other:?}"),
        });
    }
    run
}

impl Run {
    pub(super) fn last(&self, id: u8) -> &[Scalar] {
        self.values.get(&id).and_then(|all| all.last()).map_or(&[], |(_, scalars)| scalars)
    }

    /// Times between a rise and the fall after it, with the time of the rise.
    pub(super) fn widths(&self, pin: &str) -> Vec<(u64, u64)> {
        let edges = self.pins.get(pin).map_or(&[][..], |all| all);
        let pairs = edges.windows(2).filter(|pair| pair[0].1 == 1 && pair[1].1 == 0);
        pairs.map(|pair| (pair[0].0, pair[1].0 - pair[0].0)).collect()
    }
}

fn unsigned(value: u64) -> Vec<Scalar> {
    vec![Scalar::Unsigned(value)]
}

/// Every value is the world's, and every output is what the host says, or its failsafe before and while it is silent.
fn assert_agrees(made: &Made) {
    let set = |values: &[(u8, Vec<Scalar>)]| {
        hex(&encode_report(&made.schema, Direction::Actuator, values).unwrap())
    };
    let lamps = vec![Scalar::Unsigned(1_000), Scalar::Unsigned(9_000)];
    let mut all = vec![(12, unsigned(2_500)), (13, lamps), (14, vec![Scalar::Bool(true)])];
    all.extend(made.has_words.then(|| (15, unsigned(0x4567))));
    let mut world = world(made, 3_000 * MS);
    world["said"] = json!([
        (600 * MS, hex(&encode_hello_request(&made.schema))),
        (1_000 * MS, set(&all)),
        (2_900 * MS, hex(&encode_health_request(&made.schema))),
    ]);
    let run = run(made, &world);

    let hash = made.schema.hash();
    assert!(run.hellos.len() == 2 && run.health.len() == 1, "{:?}", run.health);
    assert!(run.hellos.iter().all(|one| *one == hash), "{:?}", run.hellos);
    let steady = [
        (1, unsigned(1_000)),
        (2, vec![Scalar::Unsigned(2_000), Scalar::Unsigned(3_000)]),
        (3, unsigned(0x1234)),
        (9, unsigned(0x3456)),
        (10, unsigned(0x2143)),
    ];
    for (id, value) in steady {
        let all = &run.values[&id];
        assert!(all.len() >= 20 && all.iter().all(|(_, one)| *one == value), "{id}: {all:?}");
    }
    for (id, low, high) in [(5, 1_499, 1_501), (11, 4_999, 5_001)] {
        let all = &run.values[&id];
        let is_near = |one: &[Scalar]| matches!(one, [Scalar::Unsigned(value)] if (low..=high).contains(value));
        assert!(all.len() >= 20 && all.iter().all(|(_, one)| is_near(one)), "{id}: {all:?}");
    }
    // One pulse each tenth of a second from 0.2 s on; told within the reporter's cycle.
    for (at, value) in &run.values[&4] {
        let wanted = (at.saturating_sub(100 * MS) / (100 * MS)).min(28);
        assert!(
            *value == unsigned(wanted) || *value == unsigned(wanted.saturating_sub(1)),
            "{at}: {value:?}"
        );
    }
    assert_eq!(run.last(4), unsigned(28));
    let turned =
        |id: u8| run.values[&id].iter().find(|(_, one)| one[0] == Scalar::Bool(true)).unwrap().0;
    assert!((355 * MS..420 * MS).contains(&turned(6)), "{}", turned(6));
    assert!((300 * MS..370 * MS).contains(&turned(7)), "{}", turned(7));
    assert_eq!(run.last(8), unsigned(2));

    let health = run.health.last().unwrap();
    assert_eq!(health.reset_cause, ResetCause::Power);
    assert!(health.devices.iter().all(|one| one.causes == Causes::default()), "{health:?}");
    let servo = run.widths(SERVO);
    let (before, after): (Vec<_>, Vec<_>) = servo.iter().partition(|(at, _)| *at < 1_000 * MS);
    assert!(
        before.len() > 40 && before.iter().all(|(_, us)| us.abs_diff(10_000) <= 2),
        "{before:?}"
    );
    let after = &after[2..20];
    assert!(after.iter().all(|(_, us)| us.abs_diff(5_000) <= 2), "{after:?}");
    let silent: Vec<_> =
        servo.iter().filter(|(at, _)| (1_800 * MS..2_800 * MS).contains(at)).collect();
    assert!(
        silent.len() > 40 && silent.iter().all(|(_, us)| us.abs_diff(10_000) <= 2),
        "{silent:?}"
    );
    for (pin, wanted) in [("20", 100_u64), ("21", 900)] {
        let widths = run.widths(pin);
        let set: Vec<_> =
            widths.iter().filter(|(at, _)| (1_100 * MS..1_400 * MS).contains(at)).collect();
        assert!(
            set.len() > 200 && set.iter().all(|(_, us)| us.abs_diff(wanted) <= 1),
            "{pin}: {set:?}"
        );
    }
    assert!(
        run.pins["22"]
            .iter()
            .any(|(at, level)| *level == 1 && (1_000 * MS..1_100 * MS).contains(at))
    );
    if made.has_words {
        assert_eq!(run.written["0"], [0xAA, 0x45, 0x67]);
    }
    let triggers = run.widths(TRIGGER);
    // A pulse has at least its length; an interrupt, such as USB's, may make it longer.
    let undisturbed = triggers.iter().filter(|(_, us)| *us <= 13).count();
    assert!(triggers.iter().all(|(_, us)| (10..=40).contains(us)), "{triggers:?}");
    assert!(triggers.len() > 1 && 10 * undisturbed >= 9 * triggers.len(), "{triggers:?}");
}

#[test]
fn values_agree_over_usb() {
    if is_possible() {
        assert_agrees(&made("embassy-rp-usb", USB));
    }
}

/// The same over a serial port; then a part keeps its bus, and the core hangs.
#[test]
fn values_agree_over_a_serial_port_and_faults_are_told() {
    if !is_possible() {
        return;
    }
    let made = made("embassy-rp-uart", UART);
    assert_agrees(&made);
    a_bus_that_is_kept(&made, true);
    a_bus_that_is_kept(&made, false);
    a_core_that_hangs(&made);
}

/// The others go on, health names the part, and it is read again afterwards, whether what was under way ends or not.
fn a_bus_that_is_kept(made: &Made, goes_on: bool) {
    let mut world = world(made, 4_000 * MS);
    world["held"] = json!([(1_000 * MS, 2_000 * MS, goes_on)]);
    let ask = hex(&encode_health_request(&made.schema));
    world["said"] = json!([(1_900 * MS, &ask), (3_900 * MS, &ask)]);
    let run = run(made, &world);
    assert!(run.resets.is_empty(), "{:?}", run.resets);
    let during = |id: u8, from: u64, to: u64| {
        run.values[&id].iter().filter(|(at, _)| (from * MS..to * MS).contains(at)).count()
    };
    assert!(during(1, 1_100, 1_900) >= 14, "{}", during(1, 1_100, 1_900));
    let after = during(3, 2_200, 4_000);
    assert!(after >= 30, "{goes_on}: {after}: {:?}", run.health);
    assert!(run.values[&3].iter().all(|(_, one)| *one == unsigned(0x1234)), "{:?}", run.values[&3]);
    let [first, last] = &run.health[..] else { panic!("{:?}", run.health) };
    let of = |health: &Health| health.devices.iter().find(|one| one.id == 3).copied().unwrap();
    assert!(of(first).causes.timed_out > 3, "{first:?}");
    assert_eq!(of(last).status, sensedsl_wire::Status::Good, "{last:?}");
    let others = first.devices.iter().filter(|one| one.id != 3);
    assert!(others.clone().all(|one| one.causes == Causes::default()), "{first:?}");
}

/// The watchdog starts the board anew, and health says so.
fn a_core_that_hangs(made: &Made) {
    let mut world = world(made, 7_000 * MS);
    world["hung"] = json!(1_500 * MS);
    world["said"] = json!([(6_800 * MS, hex(&encode_health_request(&made.schema)))]);
    let run = run(made, &world);
    assert_eq!(run.resets.len(), 1, "{:?}", run.resets);
    let health = run.health.last().unwrap();
    assert_eq!(health.reset_cause, ResetCause::Watchdog);
    assert!(run.values[&1].iter().any(|(at, _)| *at > run.resets[0]), "nothing after the reset");
}
