//! One design, one world, one seed, and a program for each target: a host cannot tell them apart,
//! except by the times at which values arrive.

use std::collections::BTreeMap;

use sensedsl_twin::truth::real;

use super::examples::{UART, USB, on_discovery};
use super::trial::{System, Trial, run};

const SECONDS: u64 = 8;
/// From this time on all devices have reported, over either link.
const BEGIN_MS: u64 = 2_000;
/// The interval at which values are compared.
const STEP_MS: u64 = 5;
/// The programs may differ in time by the cycle of the device plus this.
const APART_MS: u64 = 40;

/// The values of a device in order of arrival.
type Course = Vec<(u64, Vec<f64>)>;

fn courses(trial: &Trial) -> BTreeMap<u8, Course> {
    let mut all: BTreeMap<u8, Course> = BTreeMap::new();
    for (at, id, elements) in &trial.reported {
        let elements = elements.iter().map(|one| real(*one)).collect();
        all.entry(*id).or_default().push((*at, elements));
    }
    all
}

/// The value that a host knows at a time.
fn known(course: &Course, at_ms: u64) -> &[f64] {
    let next = course.partition_point(|(at, _)| *at <= at_ms);
    &course[next - 1].1
}

/// At each time, a host must know a value that it knows from the other program at about that time;
/// exactly that value, if it does not change meanwhile.
fn differs(one: &Course, other: &Course, apart: u64) -> Option<String> {
    for at in (BEGIN_MS..SECONDS * 1_000 - apart).step_by(STEP_MS as usize) {
        let about = [at - apart, at, at + apart].map(|at| known(other, at).to_vec());
        let between = other.iter().filter(|(when, _)| when.abs_diff(at) <= apart);
        let about: Vec<Vec<f64>> =
            about.into_iter().chain(between.map(|(_, all)| all.clone())).collect();
        for (place, value) in known(one, at).iter().enumerate() {
            let all = about.iter().map(|elements| elements[place]);
            let (least, greatest) =
                all.fold((f64::MAX, f64::MIN), |(l, g), v| (l.min(v), g.max(v)));
            if *value < least || *value > greatest {
                return Some(format!("at {at} ms: {value}, not {least} to {greatest}"));
            }
        }
    }
    None
}

/// The final values, after everything has come to rest, and the number of values.
fn ends(course: &Course) -> (&[f64], usize) {
    let count = course.iter().filter(|(at, _)| *at > BEGIN_MS).count();
    (&course.last().unwrap().1, count)
}

/// The case that always runs; an exhaustive run draws from the others.
const ALWAYS: (&str, &str) = ("all_kinds", UART);

/// Compares both programs of a design in its world over a link; `cycle_ms` is the longest cycle of
/// any device.
fn say_the_same(design: &str, link: &str, cycle_ms: u64) {
    if (design, link) != ALWAYS && !sensedsl_tests::is_drawn(&format!("both {design} {link}")) {
        return;
    }
    let text = on_discovery(design, link);
    let world = sensedsl_tests::text(&format!("tests/firmware/both/{design}.toml"));
    let trials = [System::Chibios, System::Embassy].map(|system| {
        let which = if link == UART { "uart" } else { "usb" };
        let image = system.image(&format!("both_{design}_{which}_{system:?}"), &text)?;
        let trial = run(system, (&text, &world), &image, SECONDS, &[]);
        assert!(trial.halt.is_none() && trial.mismatches.is_empty(), "{:?}", trial.mismatches);
        assert!(trial.wrong().is_empty(), "{system:?}: {:#?}", trial.wrong());
        let silent = trial.judged.iter().filter(|one| one.reports == 0);
        assert_eq!(silent.map(|one| one.name.as_str()).collect::<Vec<_>>(), [""; 0]);
        Some((courses(&trial), trial.names))
    });
    let [Some((chibios, names)), Some((embassy, _))] = trials else { return };
    let ids = |courses: &BTreeMap<u8, Course>| courses.keys().copied().collect::<Vec<u8>>();
    assert_eq!(ids(&chibios), ids(&embassy));
    for (id, one) in &chibios {
        let (name, other, apart) = (&names[id], &embassy[id], APART_MS + cycle_ms);
        let found = differs(one, other, apart).or_else(|| differs(other, one, apart));
        assert_eq!(found, None, "{design}: {name}");
        let ((last, count), (other_last, other_count)) = (ends(one), ends(other));
        assert_eq!(last, other_last, "{design}: {name} ends at another value");
        // One reading more or less at either end, and a margin for random losses between.
        let most = 3 + count / 50;
        assert!(
            count.abs_diff(other_count) <= most,
            "{design}: {name} has {count} and {other_count} values"
        );
    }
    eprintln!("{design}: {} devices say the same", chibios.len());
}

macro_rules! designs {
    ($($name:ident in $cycle_ms:literal,)*) => {
        $(
            mod $name {
                #[test]
                fn uart() {
                    super::say_the_same(stringify!($name), super::UART, $cycle_ms);
                }

                #[test]
                fn usb() {
                    super::say_the_same(stringify!($name), super::USB, $cycle_ms);
                }
            }
        )*
    };
}

designs! {
    all_kinds in 100,
    fig2 in 100,
    miniature_car in 100,
    line_follower in 100,
    quadcopter in 200,
}
