//! Tests of what is read of tests: texts in, what is understood and what is wrong out.
#![allow(
    clippy::indexing_slicing,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a panic is a test's failure"
)]

use sensedsl_rules::{Compare, Formula, Shape, Signal, Term, Trace, Verdict};

use crate::design::{SignalOf, Test};
use crate::{NoFiles, Request, resolve};

const BOARD: &str = "const REACTION = 150 ms;
board Oven on NUCLEO_F446RE {
    sensor Front returns uint16 { type = analog; quantity = cm; scale = 0.5; }
    sensor Rear returns uint16 { type = analog; quantity = mm; }
    sensor Lux returns uint16 { type = analog; quantity = \"lx\"; }
    sensor Line returns uint16[4] { type = analog; }
    sensor Door returns bool { type = digital; }
    sensor Air returns int16 { driver = sht31; }
    actuator Heater accepts uint16 { type = pwm; }
    actuator Fan accepts uint16 { type = pwm; }
    actuator Servo accepts uint16 { type = pwm; min = 1 ms; max = 2 ms; }
    actuator Target accepts float32 { type = code; default = 180; min = 0; max = 250; quantity = \"degC\"; }
    controller Hold every 20 ms { reads = [Front, Target]; sets = [Heater]; }
}
";

/// The tests of a text after the board, and the codes with messages of what is wrong.
fn read(text: &str) -> (Vec<Test>, Vec<String>) {
    let text = format!("{BOARD}{text}");
    let request = Request { path: "oven.sense", text: &text, ..Request::default() };
    let resolved = resolve(&request, &NoFiles);
    let wrong = resolved.diagnostics.iter().filter(|one| one.code.name().starts_with('E'));
    let wrong = wrong.map(|one| format!("{} {}", one.code.name(), one.message)).collect();
    (resolved.design.map(|design| design.tests).unwrap_or_default(), wrong)
}

fn test(steps: &str) -> Test {
    let (mut tests, wrong) = read(&format!("test A {{ for = 10 s; {steps} }}"));
    assert!(wrong.is_empty(), "{steps}: {wrong:?}");
    tests.remove(0)
}

/// What is wrong with steps, which must be one thing.
fn wrong(steps: &str) -> String {
    let (_, wrong) = read(&format!("test A {{ for = 10 s; {steps} }}"));
    assert_eq!(wrong.len(), 1, "{steps}: {wrong:?}");
    wrong[0].clone()
}

/// The comparison of a rule that always holds.
fn compared(steps: &str) -> (Term, Compare, Term) {
    match &test(steps).rules[0].rule.shape {
        Shape::Always(Formula::Compare(one, how, other)) => (one.clone(), *how, other.clone()),
        other => panic!("{other:?}"),
    }
}

fn limit(steps: &str) -> f64 {
    match compared(steps) {
        (_, _, Term::Number(limit)) => limit,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_number_is_converted_from_its_unit_or_is_in_that_of_the_device() {
    assert_eq!(limit("always Front < 20 cm;"), 0.2);
    assert_eq!(limit("always Front < 0.2 m;"), 0.2);
    assert_eq!(limit("always Front < 200 mm;"), 0.2);
    assert_eq!(limit("always Front < 20;"), 0.2);
    assert_eq!(limit("always Front < raw 40;"), 0.2);
    assert_eq!(limit("always Lux < 20;"), 20.0);
    assert_eq!(limit("always Heater < 30 %;"), 30.0);
    assert_eq!(limit("always Heater < 3000;"), 30.0);
    assert_eq!(limit("always Servo < 1500 us;"), 50.0);
    assert_eq!(limit("always age(Front) < REACTION;"), 0.15);
    assert_eq!(limit("always Target < 2 * 100;"), 200.0);
}

#[test]
fn values_of_several_units_are_compared_as_what_they_measure() {
    let test = test("always Front - Rear < 5 cm;");
    let trace = |front: f64, rear: f64| Trace {
        signals: [front, rear]
            .iter()
            .zip(&test.signals)
            .map(|(shown, signal)| Signal { samples: vec![(0, signal.unit.computed(*shown))] })
            .collect(),
        end_ns: 10,
    };
    let rule = &test.rules[0].rule;
    assert_eq!(rule.judge(&trace(20.0, 151.0)).verdict, Verdict::Held);
    let outcome = rule.judge(&trace(20.0, 120.0));
    assert!(matches!(outcome.verdict, Verdict::Violated { at_ns: 0, .. }), "{outcome:?}");
    let unit = test.rules[0].margin.as_ref().unwrap();
    assert_eq!((unit.shown(outcome.robustness), unit.name.as_deref()), (-3.0, Some("cm")));
}

#[test]
fn signals_are_devices_elements_ages_and_states() {
    let test = test(
        "always Line[1 + 2] > 5 and age(Air) < 1 s and health(Air) == good and Hold.overruns == 0 and max(Line) < 9;",
    );
    let names: Vec<&str> = test.signals.iter().map(|one| one.name.as_str()).collect();
    assert_eq!(
        names,
        ["Line[3]", "age(Air)", "health(Air)", "Hold.overruns", "Line[0]", "Line[1]", "Line[2]"]
    );
    assert_eq!(test.signals[0].of, SignalOf::Value(3));
    assert_eq!(test.signals[1].of, SignalOf::Age);
    assert_eq!(test.rules[0].margin, None);
}

#[test]
fn what_is_true_or_false_is_a_condition() {
    let test = test("when rising(Door) then not Door or Fan == 0 within 1 s from 1 s to 2 s;");
    let Shape::When(Formula::Rising(_), Formula::Or(..), Some(1_000_000_000)) =
        test.rules[0].rule.shape
    else {
        panic!("{:?}", test.rules[0])
    };
    assert_eq!(test.rules[0].rule.from_ns, 1_000_000_000);
    assert_eq!(test.rules[0].rule.to_ns, Some(2_000_000_000));
    let text = "when rising(Door) then not Door or Fan == 0 within 1 s from 1 s to 2 s";
    assert_eq!(test.rules[0].text, text);
}

#[test]
fn steps_are_in_the_order_of_time() {
    let test = test(
        "at 2 s set Target = 200; at 1 s set Fan = 30 %; fault reset at 3 s; fault no_answer of Air at 2 s for 1 s;
         always Door == true;",
    );
    let sets: Vec<(u64, f64)> =
        test.sets.iter().map(|one| (one.at_ns / 1_000_000, one.raw)).collect();
    assert_eq!(sets, [(1_000, 3_000.0), (2_000, 200.0)]);
    let faults: Vec<(u64, u64)> =
        test.faults.iter().map(|one| (one.at_ns / 1_000_000, one.lasts_ns / 1_000_000)).collect();
    assert_eq!(faults, [(2_000, 1_000), (3_000, 100)]);
}

#[test]
fn each_mistake_has_its_code() {
    let all = [
        ("always Frnt < 5;", "E0252 `Frnt` is not a device or a constant of this design"),
        ("always Line < 5;", "E0252 `Line` has 4 elements"),
        ("always Line[4] < 5;", "E0252 `Line` has no element 4"),
        ("always Line[Front] < 5;", "E0252 this is not an index of `Line`"),
        ("always Front[0] < 5;", "E0252 `Front` has one value, not several elements"),
        ("always Hold < 5;", "E0252 `Hold` is a controller, not a value"),
        ("always Hold.late < 5;", "E0252 `Hold` has nothing called `late`"),
        ("always Front.overruns < 5;", "E0252 `Front` has nothing called `overruns`"),
        ("always agee(Front) < 5 s;", "E0252 `agee` is not a function of tests"),
        ("always age(Fan) < 5 s;", "E0252 `Fan` is an actuator, so no value of it comes"),
        ("always abs(Front, Rear) < 5;", "E0252 `abs` takes one number"),
        ("always health(Front) == fine;", "E0252 `health(…)` is compared with a state"),
        ("always health(Front) > good;", "E0253 a state is equal to another one, or it is not"),
        ("always Front < 20 degC;", "E0253 the value is in cm, and this is a number of degC"),
        ("always Line[0] < 20 cm;", "E0253 the value has no unit, and this is a number of cm"),
        ("always Lux < 20 cm;", "E0253 the value is in lx, and this is a number of cm"),
        ("always Front < Target;", "E0253 a value in cm and a value in degC cannot be compared"),
        ("always Front + Lux < 5;", "E0253 a value in cm and a value in lx cannot be added"),
        ("always Front * Lux < 5;", "E0253 a value in cm and a value in lx cannot be multiplied"),
        ("always age(Front) < 20;", "E0253 a time is compared with a plain number"),
        ("always 1 < 2;", "E0253 no device is in this comparison, so it never changes"),
        (
            "always Front in 30 cm .. 20 cm;",
            "E0253 the range ends below its beginning, so nothing is in it",
        ),
        ("always Front in 0 cm .. Rear;", "E0253 an end of a range is a constant"),
        ("always Front < 5 / 0;", "E0253 this divides by zero"),
        ("always Front;", "E0256 this is a number, not true or false"),
        ("always Front < (Rear < 5);", "E0256 this is true or false, not a number"),
        ("always rising(Door) < 5;", "E0256 this is true or false, not a number"),
        ("always Front < 5 within 1 s;", "E0254 `within` cannot stand in this rule"),
        ("eventually Front < 5 within 11 s;", "E0254 the test is over after 10 s, before 11 s"),
        (
            "eventually Front < 5 within 6 s from 5 s;",
            "E0254 the test is over after 10 s, before 11 s",
        ),
        ("eventually Front < 5 within 1 s to 5 s;", "E0254 `to` cannot stand in this rule"),
        ("always Front < 5 from 3 s to 2 s;", "E0254 this ends at 2 s, and begins at 3 s"),
        ("always Front < 5 from 3;", "E0254 a time is needed here, not the number 3"),
        ("always Front < 5 from 3 cm;", "E0254 a time is needed here, not a number of cm"),
        ("at 11 s set Fan = 5 %; always Door;", "E0254 the test is over after 10 s, before 11 s"),
        (
            "at 1 s set Door = 1; always Door;",
            "E0257 `Door` is a sensor, so the host cannot set it",
        ),
        (
            "at 1 s set Heater = 1; always Door;",
            "E0257 `Heater` is set by the controller `Hold`, which refuses the host",
        ),
        ("at 1 s set Fann = 1; always Door;", "E0257 `Fann` is not an actuator of this design"),
        (
            "at 1 s set Target = 300; always Door;",
            "E0234 `Target`: 300 degC is above `max`, 250 degC",
        ),
        ("fault smoke at 1 s; always Door;", "E0258 there is no fault `smoke`"),
        (
            "fault torn at 1 s for 1 s; always Door;",
            "E0258 the fault `torn` is of a sensor, and names none",
        ),
        (
            "fault reset of Air at 1 s; always Door;",
            "E0258 the fault `reset` is of the board, not of a device",
        ),
        (
            "fault torn of Fan at 1 s for 1 s; always Door;",
            "E0258 `Fan` is not a sensor of this design",
        ),
        (
            "fault hang of Front at 1 s for 1 s; always Door;",
            "E0258 `Front` is on analog, so it cannot have the fault `hang`",
        ),
        (
            "fault torn of Front at 1 s; always Door;",
            "E0258 the fault `torn` does not say how long it lasts",
        ),
        ("at 1 s set Fan = 5 %;", "E0255 the test `A` has no rules, so it could not fail"),
    ];
    for (steps, expected) in all {
        assert_eq!(wrong(steps), expected, "{steps}");
    }
}

#[test]
fn a_test_needs_a_length_and_a_name_of_its_own() {
    let (_, wrong) = read("test A { always Door; }");
    assert_eq!(wrong, ["E0206 the test `A` needs `for`"]);
    let (_, wrong) = read("test A { for = 1 s; always Door; } test A { for = 1 s; always Door; }");
    assert!(wrong[0].starts_with("E0204"), "{wrong:?}");
    let (_, wrong) = read("test A { for = 1 s; wrld = \"a.toml\"; always Door; }");
    assert!(wrong[0].starts_with("E0201"), "{wrong:?}");
}

#[test]
fn a_device_that_could_not_be_read_is_told_once() {
    let (_, wrong) = read(
        "sensor Bad returns uint16 { type = analogue; } test A { for = 1 s; always Bad < 5; }",
    );
    assert_eq!(wrong.len(), 1, "{wrong:?}");
    assert!(wrong[0].starts_with("E0207"), "{wrong:?}");
}
