//! Worlds that answer: what the board does comes back in what it measures, and every mistake in a world has its place.

use std::sync::{Arc, Mutex};

use sensedsl_diagnostics::{Diagnostic, SourceMap};
use sensedsl_job::BoardJob;
use sensedsl_twin::bench::Bench;
use sensedsl_twin::judge::Judge;
use sensedsl_twin::plants::{Process, Value};
use sensedsl_twin::soft::{SoftBoard, UserCode};
use sensedsl_twin::world::{self, Scene, World};
use sensedsl_wire::{Decoder, Direction, Event, Scalar, encode_hello_request, encode_report};

use crate::run::with_job;

const MS: u64 = 1_000_000;

const ROVER: &str = "board Rover on NUCLEO_F446RE {
    chip Motors {
        driver = tb6612;
        actuator Left accepts int16 { reading = speed_a; }
        actuator Right accepts int16 { reading = speed_b; }
    }
    sensor Wheels returns int32[2] { type = encoder; counts = 1400; }
    sensor Turns returns uint32 { type = icu; mode = count; }
    sensor Line returns uint16[8] { type = analog; delay = 5 ms; }
    sensor Front returns uint16 { driver = hcsr04; delay = 60 ms; }
    sensor Hit returns bool { type = digital; pull = up; }
    sensor Pot returns uint16 { type = analog; delay = 10 ms; }
    sensor Warm returns int32 { driver = ntc; reading = temperature; delay = 20 ms; }
    actuator Heat accepts bool { type = digital; }
    actuator Arm accepts uint16 { driver = servo; }
    chip Imu { driver = mpu6050; delay = 10 ms; }
}";

const HALL: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="3000mm" viewBox="0 0 3000 2000">
    <path class="line" stroke-width="20" d="M500 1000 H2500"/>
    <rect class="wall" x="0" y="0" width="3000" height="2000"/>
</svg>"#;

fn samples(name: &str) -> Result<String, String> {
    match name {
        "hall.svg" => Ok(HALL.to_owned()),
        "small.svg" => Ok("<svg xmlns='x'><path class='line' d='M0 0 H9'/></svg>".to_owned()),
        "broken.svg" => Ok("<svg".to_owned()),
        _ => Err("there is no such file".to_owned()),
    }
}

fn read(job: &BoardJob<'_>, text: &str) -> (World, Vec<Diagnostic>) {
    let file = SourceMap::default().add("world.toml", text);
    let devices: Vec<_> = job.devices.iter().map(|one| one.index).collect();
    let scene = Scene {
        design: job.design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: Some(1),
        samples: &samples,
    };
    world::read(file, text, &scene)
}

/// A run in which a host sets actuators: milliseconds, name, codes.
struct Told<'a> {
    seconds: u64,
    commands: &'a [(u64, &'a str, &'a [i64])],
}

/// The reports of each sensor as they are shown, with milliseconds, and what the judge found.
struct Run {
    reports: Vec<(u64, String, Vec<f64>)>,
    wrong: Vec<String>,
    figures: Vec<String>,
    trouble: Option<String>,
}

impl Run {
    fn last(&self, name: &str) -> &[f64] {
        let found = self.reports.iter().rev().find(|one| one.1 == name);
        found.map(|one| one.2.as_slice()).unwrap_or_default()
    }

    fn at(&self, ms: u64, name: &str) -> &[f64] {
        let found = self.reports.iter().rev().find(|one| one.1 == name && one.0 <= ms);
        found.map(|one| one.2.as_slice()).unwrap_or_default()
    }
}

fn run(job: &BoardJob<'_>, text: &str, told: &Told<'_>, code: Option<Box<dyn UserCode>>) -> Run {
    run_with(job, text, told, code, |_| {})
}

fn run_with(
    job: &BoardJob<'_>,
    text: &str,
    told: &Told<'_>,
    code: Option<Box<dyn UserCode>>,
    prepare: impl FnOnce(&mut Bench),
) -> Run {
    let (world, mistakes) = read(job, text);
    assert!(mistakes.is_empty(), "{mistakes:#?}");
    let mut bench = Bench::new(job, &world, 1);
    prepare(&mut bench);
    let mut judge = Judge::new(job, &bench);
    let mut board = SoftBoard::new(job, bench.clone());
    if let Some(code) = code {
        board = board.with_code(code);
    }
    let mut decoder = Decoder::new(&job.schema, Direction::Sensor);
    let (mut reports, mut trouble) = (Vec::new(), None);
    for ms in 1..=told.seconds * 1_000 {
        for (_, name, codes) in told.commands.iter().filter(|one| one.0 == ms) {
            let one = job.devices.iter().find(|one| one.name() == *name).unwrap();
            let of = one.device.value.value.scalar;
            let value = codes.iter().map(|code| world_scalar(of, *code)).collect();
            let frame = [(one.device.id.value, value)];
            board.link_write(&encode_report(&job.schema, Direction::Actuator, &frame).unwrap());
        }
        if ms % 100 == 0 {
            // A host that speaks, so that nothing falls back.
            board.link_write(&encode_hello_request(&job.schema));
        }
        board.run_until(ms * MS);
        decoder.feed(&board.link_read(), |event| {
            let Event::Report(_, values) = event else { return };
            judge.take(ms * MS, &values);
            for (id, value) in values {
                let one = job.devices.iter().find(|one| one.device.id.value == id).unwrap();
                let scale = sensedsl_twin::truth::scale_of(&one.device.shown);
                let shown =
                    value.into_iter().map(|one| scale.shown(sensedsl_twin::truth::real(one)));
                reports.push((ms, one.name().to_owned(), shown.collect()));
            }
        });
        trouble = trouble.or(board.bench().trouble().map(|one| one.why));
    }
    let findings = judge.finish(told.seconds * 1_000 * MS);
    let wrong = findings.iter().filter(|one| one.wrong > 0);
    Run {
        reports,
        wrong: wrong.map(|one| format!("{}: {:?}", one.name, one.worst)).collect(),
        figures: bench.story(job.design).map(|story| story.figures).unwrap_or_default(),
        trouble,
    }
}

fn world_scalar(of: sensedsl_wire::ScalarType, code: i64) -> Scalar {
    sensedsl_twin::truth::scalar(of, code as f64)
}

const SET: &[(u64, &str, &[i64])] = &[
    (200, "Left", &[5_000]),
    (200, "Right", &[5_000]),
    (300, "Heat", &[1]),
    (400, "Arm", &[10_000]),
];

#[test]
fn a_motor_turns_its_encoder_and_the_judge_agrees() {
    with_job(ROVER, |job| {
        let world = "[plants.A]\nkind = 'motor'\ndrive = 'Left'\nspeed = '300 rpm'\nsettling = '50 ms'\n
            dead_zone = 0\nencoder = 'Wheels[0]'\n
            [plants.B]\nkind = 'motor'\ndrive = 'Right'\nspeed = '300 rpm'\nload = '10 %'\nreversed = true\n
            encoder = 'Wheels[1]'\n";
        let told = Told { seconds: 3, commands: SET };
        let found = run(job, world, &told, None);
        assert_eq!(found.wrong, Vec::<String>::new());
        // 2.8 s at half of 5 turns a second, less what it takes to start; 40 % of it backwards.
        let [left, right] = found.last("Wheels") else { panic!("two wheels") };
        assert!((left - 1_400.0 * 2.5 * 2.75).abs() < 80.0, "{left}");
        assert!((right + 1_400.0 * 2.0 * 2.70).abs() < 80.0, "{right}");
        assert_eq!(found.at(200, "Wheels"), [0.0, 0.0]);
        // Another motor would be seen: the test can fail.
        let slower = run(job, &world.replace("300 rpm", "250 rpm"), &told, None);
        assert!(slower.last("Wheels")[0] < 0.9 * left);
    });
}

#[test]
fn a_robot_on_a_map_is_seen_by_all_of_its_sensors() {
    with_job(ROVER, |job| {
        let world = "[plants.Robot]\nkind = 'differential_drive'\nleft = 'Left'\nright = 'Right'\n
            encoders = 'Wheels'\nspeed = '0.6 m/s'\ndead_zone = 0\nbody = '100 mm'\n
            map = 'hall.svg'\nline = { sensors = 'Line', pitch = '12 mm' }\nranger = 'Front'\nbumper = 'Hit'\n
            gyro = 'ImuRate'\naccelerometer = 'ImuAcceleration'\n";
        let told = Told { seconds: 12, commands: SET };
        let found = run(job, world, &told, None);
        assert_eq!(found.wrong, Vec::<String>::new());
        // Straight along the line: both middle sensors see it, those outside do not.
        let line = found.at(3_000, "Line");
        assert!(line[3] > 3_100.0 && line[4] > 3_100.0, "{line:?}");
        assert!(line[0] < 310.0 && line[7] < 310.0, "{line:?}");
        // 0.3 m/s from x = 0.5 m: the wall is at 3 m, the sensor 0.1 m before the axle.
        // As long as sound takes there and back.
        let front = found.at(5_000, "Front")[0] / 58.0;
        assert!((front - 100.0 * (3.0 - 0.6 - 0.3 * 4.7)).abs() < 4.0, "{front}");
        let [hit, last] = [found.at(5_000, "Hit")[0], found.last("Hit")[0]];
        assert_eq!((hit, last), (0.0, 1.0));
        let [x, y, z] = found.at(5_000, "ImuAcceleration") else { panic!("three axes") };
        assert!(x.abs() < 0.01 && y.abs() < 0.01 && (z - 1.0).abs() < 0.01, "{x} {y} {z}");
        // The line ends at 2.5 m, and the wall stops it 0.1 m before 3 m.
        let figures = "Robot: 2.40 m, at most 400.0 mm off the line, at least 0 mm from walls";
        assert_eq!(found.figures, [figures]);
    });
}

#[test]
fn a_robot_turns_as_its_gyroscope_says() {
    with_job(ROVER, |job| {
        let world = "[plants.Robot]\nkind = 'differential_drive'\nleft = 'Left'\nright = 'Right'\n
            encoders = 'Wheels'\nspeed = '0.3 m/s'\ndead_zone = 0\ntrack = '150 mm'\ngyro = 'ImuRate'\n
            start = { x = '1 m', y = '1 m', heading = '90 deg' }\n";
        let commands: &[(u64, &str, &[i64])] =
            &[(200, "Left", &[-2_000]), (200, "Right", &[2_000])];
        let found = run(job, world, &Told { seconds: 3, commands }, None);
        assert_eq!(found.wrong, Vec::<String>::new());
        // 0.06 m/s on either side of 150 mm, counter-clockwise.
        let wanted = (2.0_f64 * 0.06 / 0.15).to_degrees();
        let [x, y, z] = found.last("ImuRate") else { panic!("three axes") };
        assert!((z - wanted).abs() < 0.2 && *x == 0.0 && *y == 0.0, "{x} {y} {z}");
        // One that is not calibrated shows as much more on all axes, and the judge knows.
        let biased = world.replace("gyro = 'ImuRate'", "gyro = { sensor = 'ImuRate', bias = 1.5 }");
        let found = run(job, &biased, &Told { seconds: 3, commands }, None);
        assert_eq!(found.wrong, Vec::<String>::new());
        let [x, _, z] = found.last("ImuRate") else { panic!("three axes") };
        assert!((z - wanted - 1.5).abs() < 0.2 && (x - 1.5).abs() < 0.1, "{x} {z}");
    });
}

#[test]
fn heaters_servos_and_counters_follow_their_actuators() {
    with_job(ROVER, |job| {
        let world =
            "[plants.Oven]\nkind = 'heater'\ndrive = 'Heat'\npower = '40 W'\nrise = '2 K/W'\n
            settling = '10 s'\ntemperature = 'Warm'\n
            [plants.Joint]\nkind = 'servo'\ndrive = 'Arm'\nrate = '60 deg/s'\n
            angle = { sensor = 'Pot', points = [['-90 deg', 300], ['90 deg', 3700]] }\n
            [plants.Wheel]\nkind = 'motor'\ndrive = 'Left'\nspeed = '600 rpm'\ndead_zone = 0\n
            encoder = { sensor = 'Turns', counts = 20 }\n";
        let found = run(job, world, &Told { seconds: 10, commands: SET }, None);
        assert_eq!(found.wrong, Vec::<String>::new());
        let warm = found.last("Warm")[0];
        assert!((warm - (20.0 + 80.0 * (1.0 - (-0.97_f64).exp()))).abs() < 0.6, "{warm}");
        // 90 degrees away, at 60 a second.
        let [under_way, there] = [found.at(1_400, "Pot")[0], found.last("Pot")[0]];
        assert!((under_way - (2_000.0 + 1_700.0 / 1.5)).abs() < 60.0, "{under_way}");
        assert!((there - 3_700.0).abs() < 3.0, "{there}");
        let turns = found.last("Turns")[0];
        assert!((turns - 20.0 * 5.0 * 9.7).abs() < 4.0, "{turns}");
    });
}

#[test]
fn a_run_is_the_same_each_time_and_noise_has_a_seed() {
    with_job(ROVER, |job| {
        let world = "[plants.Robot]\nkind = 'differential_drive'\nleft = 'Left'\nright = 'Right'\n
            map = 'hall.svg'\nline = { sensors = { sensor = 'Line', noise = 40 } }\n";
        let told = Told { seconds: 2, commands: SET };
        let [one, other] = [run(job, world, &told, None), run(job, world, &told, None)];
        assert_eq!(one.reports, other.reports);
        assert_eq!(one.wrong, Vec::<String>::new());
        let seen: Vec<f64> = one.reports.iter().filter(|r| r.1 == "Line").map(|r| r.2[0]).collect();
        assert!(seen.iter().any(|value| *value != seen[0]), "noise changes nothing");
    });
}

/// What a program answers at a moment.
type Answered = Result<Vec<(String, Value)>, String>;

/// A spring that pulls a mass, as a program of a world.
struct Echo {
    calls: Arc<Mutex<Vec<f64>>>,
    answer: fn(f64) -> Answered,
}

impl Process for Echo {
    fn step(
        &mut self,
        seconds: f64,
        set: &[(String, Option<Value>)],
    ) -> Result<Vec<(String, Value)>, String> {
        self.calls.lock().unwrap().push(seconds);
        assert_eq!(set.len(), 1);
        let Some(Value::One(left)) = &set[0].1 else { return (self.answer)(0.0) };
        (self.answer)(*left)
    }
}

const PROGRAM: &str =
    "[plants.Thing]\nkind = 'process'\ncommand = ['thing']\nstep = '5 ms'\nset = 'Left'\n
    sensors = ['Pot', 'Wheels']\n";

fn with_program(answer: fn(f64) -> Answered) -> (Run, Vec<f64>) {
    let calls = Arc::new(Mutex::new(Vec::new()));
    let program = Echo { calls: Arc::clone(&calls), answer };
    let told = Told { seconds: 2, commands: SET };
    let found = with_job(ROVER, |job| {
        run_with(job, PROGRAM, &told, None, |bench| bench.attach("Thing", Box::new(program)))
    });
    let calls = calls.lock().unwrap().clone();
    (found, calls)
}

#[test]
fn a_program_is_stepped_in_lockstep() {
    let (found, calls) = with_program(|left| {
        let pot = ("Pot".to_owned(), Value::One(1_000.0 + 20.0 * left));
        Ok(vec![pot, ("Wheels".to_owned(), Value::Many(vec![left, -left]))])
    });
    assert_eq!((found.trouble.as_deref(), found.wrong.as_slice()), (None, &[][..]));
    assert_eq!(found.at(150, "Pot"), [1_000.0]);
    assert_eq!(found.last("Pot"), [2_000.0]);
    assert_eq!(found.last("Wheels"), [50.0, -50.0]);
    // The last step that was asked for ends after the run.
    let wanted: Vec<f64> = (0..=401).map(|step| f64::from(step) * 0.005).collect();
    assert_eq!(calls.len(), wanted.len());
    assert!(calls.iter().zip(&wanted).all(|(one, other)| (one - other).abs() < 1e-12));
}

#[test]
fn a_program_that_answers_wrongly_is_told_and_let_go() {
    type Answer = fn(f64) -> Answered;
    let cases: [(Answer, &str); 5] = [
        (|_| Err("it ended".to_owned()), "it ended"),
        (|_| Ok(vec![("Pot".to_owned(), Value::One(1.0))]), "lacks `Wheels`"),
        (|_| Ok(vec![("Line".to_owned(), Value::One(1.0))]), "not among its `sensors`"),
        (
            |_| {
                let pot = ("Pot".to_owned(), Value::One(f64::NAN));
                Ok(vec![pot, ("Wheels".to_owned(), Value::Many(vec![0.0, 0.0]))])
            },
            "is not a number",
        ),
        (
            |_| {
                let pot = ("Pot".to_owned(), Value::One(1.0));
                Ok(vec![pot, ("Wheels".to_owned(), Value::Many(vec![0.0]))])
            },
            "has 2 elements",
        ),
    ];
    for (answer, why) in cases {
        let (found, calls) = with_program(answer);
        assert!(found.trouble.as_deref().is_some_and(|text| text.contains(why)), "{why}");
        assert_eq!(calls.len(), 1, "{why}");
    }
}

#[test]
fn each_mistake_of_a_plant_has_its_code_and_its_place() {
    const DRIVE: &str = "kind = 'differential_drive'\nleft = 'Left'\nright = 'Right'\n";
    let cases = [
        ("plants = 3", "E0540", "3"),
        ("[plants]\nA = 3", "E0540", "3"),
        ("[plants.A]\ndrive = 'Left'", "E0540", "[plants.A]"),
        ("[plants.A]\nkind = 'motr'\ndrive = 'Left'", "E0541", "'motr'"),
        ("[plants.A]\nkind = 'motor'", "E0540", "[plants.A]"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Lft'", "E0541", "'Lft'"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Wheels'", "E0541", "'Wheels'"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\nspeeed = '3 rpm'", "E0541", "speeed"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\nspeed = '3 kg'", "E0542", "'3 kg'"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\nspeed = 3", "E0542", "3"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\nspeed = '0 rpm'", "E0542", "'0 rpm'"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\ndead_zone = '200 %'", "E0542", "'200 %'"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\nsettling = 'soon'", "E0543", "'soon'"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\nencoder = 'Whels'", "E0541", "'Whels'"),
        (
            "[plants.A]\nkind = 'motor'\ndrive = 'Left'\nencoder = 'Wheels[2]'",
            "E0571",
            "'Wheels[2]'",
        ),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\nencoder = 'Wheels'", "E0571", "'Wheels'"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\nencoder = 'Turns'", "E0571", "'Turns'"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\nencoder = 5", "E0540", "5"),
        ("[plants.A]\nkind = 'motor'\ndrive = 'Left'\ntemperature = 'Front'", "E0571", "'Front'"),
        ("[plants.A]\nkind = 'servo'\ndrive = 'Arm'\nangle = 'Pot'", "E0571", "'Pot'"),
        ("[plants.A]\nkind = 'servo'\ndrive = 'Arm'\nangles = ['1 deg']", "E0540", "['1 deg']"),
        (
            "[devices]\nWheels = 3\n[plants.A]\nkind = 'motor'\ndrive = 'Left'\nencoder = 'Wheels[0]'",
            "E0570",
            "'Wheels[0]'",
        ),
        (
            "[plants.A]\nkind = 'motor'\ndrive = 'Left'\nencoder = 'Wheels[0]'\n
            [plants.B]\nkind = 'motor'\ndrive = 'Right'\nencoder = 'Wheels[0]'",
            "E0570",
            "'Wheels[0]'",
        ),
        (&format!("[plants.A]\n{DRIVE}map = 'no.svg'"), "E0572", "'no.svg'"),
        (&format!("[plants.A]\n{DRIVE}map = 'small.svg'"), "E0572", "'small.svg'"),
        (&format!("[plants.A]\n{DRIVE}map = 'broken.svg'"), "E0572", "'broken.svg'"),
        (&format!("[plants.A]\n{DRIVE}encoders = 'Turns'"), "E0571", "'Turns'"),
        (&format!("[plants.A]\n{DRIVE}encoders = 'Wheels[0]'"), "E0571", "'Wheels[0]'"),
        (&format!("[plants.A]\n{DRIVE}line = 'Warm'"), "E0571", "'Warm'"),
        (&format!("[plants.A]\n{DRIVE}line = {{ sensors = 'Line', pich = 1 }}"), "E0541", "pich"),
        (&format!("[plants.A]\n{DRIVE}start = {{ x = 'left' }}"), "E0542", "'left'"),
        ("[plants.A]\nkind = 'battery'\nsupplies = 'Oven'\nvoltage = 'Pot'", "E0541", "'Oven'"),
        ("[plants.A]\nkind = 'process'\nstep = '5 ms'", "E0540", "[plants.A]"),
        ("[plants.A]\nkind = 'process'\ncommand = 'x'\nsensors = 'Pot'", "E0540", "[plants.A]"),
        (
            "[plants.A]\nkind = 'process'\ncommand = 'x'\nstep = '0.5 ms'\nsensors = 'Pot'",
            "E0540",
            "'0.5 ms'",
        ),
        ("[plants.A]\nkind = 'process'\ncommand = 'x'\nstep = '5 ms'", "E0540", "[plants.A]"),
    ];
    with_job(ROVER, |job| {
        for (text, code, place) in cases {
            let (_, mistakes) = read(job, text);
            let [one] = mistakes.as_slice() else { panic!("{text}: {mistakes:#?}") };
            assert_eq!(one.code.name(), code, "{text}: {}", one.message);
            let found =
                text.get(one.primary.span.start as usize..one.primary.span.end as usize).unwrap();
            assert!(found.starts_with(place), "{text}: {found}");
        }
    });
}
