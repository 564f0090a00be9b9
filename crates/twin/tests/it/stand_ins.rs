//! Blocks of a world in the place of a controller's code: they close the loop, and every mistake in one has its place.

use sensedsl_diagnostics::{Diagnostic, SourceMap, render};
use sensedsl_job::BoardJob;
use sensedsl_twin::bench::Bench;
use sensedsl_twin::soft::{SoftBoard, StandIns};
use sensedsl_twin::world::{self, Scene, World};

use crate::run::with_job;

const OVEN: &str = "board Oven on NUCLEO_L432KC {
    sensor Temperature returns int16 { driver = tmp117; delay = 100 ms; }
    sensor Light returns uint16 { type = analog; delay = 100 ms; quantity = cm; }
    actuator Heater accepts uint16 { type = pwm; frequency = 100 Hz; quantity = \"%\"; scale = 0.01; }
    actuator Fan accepts uint16 { type = pwm; frequency = 100 Hz; }
    actuator Setpoint accepts float32 { type = code; quantity = degC; default = 45; min = 0; max = 80; }
    sensor Off returns float32[2] { type = code; quantity = K; }
    controller Hold every 100 ms { reads = [Temperature, Setpoint]; sets = [Heater, Fan, Off]; }
}";

const PLANT: &str = r#"
[plants.Oven]
kind = "heater"
drive = "Heater"
power = "40 W"
rise = "2 K/W"
settling = "20 s"
room = "20 degC"
temperature = { sensor = "Temperature" }
"#;

fn read(job: &BoardJob<'_>, text: &str) -> (World, Vec<Diagnostic>, SourceMap) {
    let mut sources = SourceMap::default();
    let file = sources.add("world.toml", text);
    let devices: Vec<_> = job.devices.iter().map(|one| one.index).collect();
    let scene = Scene {
        design: job.design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: Some(1),
        samples: &|_| Err("there is no such file".to_owned()),
    };
    let (world, wrong) = world::read(file, text, &scene);
    (world, wrong, sources)
}

/// What a device was last set to, in its codes.
fn run(job: &BoardJob<'_>, text: &str, seconds: u64) -> impl Fn(&str) -> Option<Vec<u8>> {
    let (world, wrong, _) = read(job, text);
    assert!(wrong.is_empty(), "{wrong:#?}");
    let code = StandIns::new(job, &world.stand_ins);
    let mut board = SoftBoard::new(job, Bench::new(job, &world, 1)).with_code(Box::new(code));
    board.link_open(true);
    board.run_until(seconds * 1_000_000_000);
    let names: Vec<String> = job.devices.iter().map(|one| one.name().to_owned()).collect();
    move |name| board.applied(names.iter().position(|one| one == name)?).map(<[u8]>::to_vec)
}

fn code(value: Option<Vec<u8>>) -> u16 {
    u16::from_be_bytes(value.expect("it was set").try_into().expect("two bytes"))
}

#[test]
fn a_loop_is_closed_and_does_not_wind_up() {
    with_job(OVEN, |job| {
        let text = format!(
            "{PLANT}\n[controllers.Hold.Heater]\nmeasured = \"Temperature\"\nsetpoint = \"Setpoint\"\nkp = 20\nki = 2\n"
        );
        // From 20 to 45 degrees of at most 100: the power that holds it is 31 %.
        let heater = code(run(job, &text, 120)("Heater"));
        assert!((3_000..3_250).contains(&heater), "{heater}");
        // In the beginning it is at its limit.
        assert_eq!(code(run(job, &text, 3)("Heater")), 10_000);
        let limited = text.clone() + "max = 40\n";
        assert_eq!(code(run(job, &limited, 3)("Heater")), 4_000);
    });
}

#[test]
fn what_is_set_is_in_the_unit_that_people_read() {
    with_job(OVEN, |job| {
        let text = "[devices]\nTemperature = 25\n[controllers.Hold]\n\
            Fan = { feedforward = \"(Temperature - 20 degC) / 0.5 degC * 1 %\" }\n\
            Heater = { measured = \"Temperature\", setpoint = \"30 degC\", kp = 3, feedforward = \"5 %\" }\n";
        let set = run(job, text, 2);
        assert_eq!((code(set("Fan")), code(set("Heater"))), (1_000, 2_000));
    });
}

/// An array is set when all of its elements are, and nothing is set of what is not measured.
#[test]
fn what_is_not_known_is_not_set() {
    with_job(OVEN, |job| {
        let block = "[[controllers.Hold.Off]]\nmeasured = \"Temperature\"\nsetpoint = \"Setpoint\"\nkp = 1\n";
        let second =
            "[[controllers.Hold.Off]]\nmeasured = \"Setpoint\"\nsetpoint = \"Setpoint\"\nkp = 1\n";
        let text = format!("[devices]\nTemperature = 25\n{block}{second}");
        let (world, wrong, _) = read(job, &text);
        assert!(wrong.is_empty() && world.stand_ins[0].loops.len() == 2, "{wrong:#?}");
        let broken = "[[fault]]\nat = \"0 s\"\nkind = \"no_answer\"\nfor = \"9 s\"\ndevice = \"Temperature\"\n";
        let heater = "[controllers.Hold.Heater]\nmeasured = \"Temperature\"\nsetpoint = \"30 degC\"\nkp = 3\n";
        let set = run(job, &format!("{broken}{heater}"), 2)("Heater");
        assert!(set.is_none_or(|value| value == [0, 0]), "nothing is known of the temperature");
    });
}

/// Worlds with a mistake: what is said of it, and what its place has.
const MISTAKES: [(&str, &str, &str); 20] = [
    ("[controllers.Hover.Heater]\nkp = 1", "`Hover` means nothing in `[controllers]`", "Hover"),
    (
        "[controllers.Hold.Setpoint]\nkp = 1",
        "`Setpoint` means nothing in what Hold sets",
        "Setpoint",
    ),
    ("[controllers.Hold.Heater]\ngain = 1", "`gain` means nothing in a block of Hold", "gain"),
    ("[controllers.Hold.Heater]\nkp = 1", "`kp` needs `measured`", "1"),
    (
        "[controllers.Hold.Heater]\nmeasured = \"Temperature\"\nkp = 1",
        "`measured` needs `setpoint`",
        "\"Temperature\"",
    ),
    (
        "[controllers.Hold.Heater]\nmeasured = \"Light\"\nsetpoint = 1",
        "`measured`: Hold does not read `Light`",
        "\"Light\"",
    ),
    ("[controllers.Hold.Heater]\nmeasured = \"Temperature +\"\nsetpoint = 1", "expected", ""),
    (
        "[controllers.Hold.Heater]\nmeasured = \"Temperature; never Off[0] == 0\"\nsetpoint = 1",
        "",
        "",
    ),
    (
        "[controllers.Hold.Heater]\nmeasured = \"Temperature == 0 and Temperature\"\nsetpoint = 1",
        "",
        "",
    ),
    (
        "[controllers.Hold.Heater]\nmeasured = \"Temperature == 5;}//\"\nsetpoint = 1",
        "not a number",
        "Temperature",
    ),
    (
        "[controllers.Hold.Heater]\nmeasured = \"Temperature == 5;} test Y{always Off[0]\"\nsetpoint = 1",
        "not a number",
        "Temperature",
    ),
    ("[controllers.Hold.Heater]\nmeasured = \"Warmth\"\nsetpoint = 1", "Warmth", "Warmth"),
    (
        "[controllers.Hold.Heater]\nmeasured = \"Temperature\"\nsetpoint = \"20 cm\"",
        "degC",
        "20 cm",
    ),
    ("[controllers.Hold.Heater]\nfeedforward = \"Temperature\"", "is needed", "Temperature"),
    (
        "[controllers.Hold.Heater]\nfeedforward = \"5 %\"\nmin = 9\nmax = 3",
        "`max`: `min` is above it",
        "3",
    ),
    (
        "[controllers.Hold.Heater]\nfeedforward = [1]",
        "`feedforward` must be a text or a number",
        "[1]",
    ),
    (
        "[controllers.Hold.Heater]\nkp = \"much\"\nmeasured = \"Temperature\"\nsetpoint = 1",
        "`kp` must be a number",
        "\"much\"",
    ),
    (
        "[controllers.Hold.Off]\nfeedforward = 1",
        "`Off` has 2 elements, and there are 1 here",
        "Off",
    ),
    ("[controllers]\nHold = 3", "`Hold` must be a table for each output", "Hold"),
    ("controllers = 3", "`controllers` must be a table for each controller", "3"),
];

#[test]
fn mistakes_have_places() {
    with_job(OVEN, |job| {
        for (text, message, place) in MISTAKES {
            let (_, wrong, sources) = read(job, text);
            let [one] = wrong.as_slice() else { panic!("{text}: {wrong:#?}") };
            assert!(one.message.contains(message), "{text}: {}", one.message);
            let range = one.primary.span.start as usize..one.primary.span.end as usize;
            assert!(text.get(range).is_some_and(|found| found.contains(place)), "{text}: {one:?}");
            assert!(one.help.is_some(), "{text}");
            assert!(render::json_value(one, &sources).is_object());
        }
    });
}
