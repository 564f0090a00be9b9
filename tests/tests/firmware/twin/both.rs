//! One design, one world, one seed, and a program of each target: a host cannot tell which one it listens to, but for
//! the moments at which values come.

use std::collections::BTreeMap;

use sensedsl_wire::Scalar;

use super::trial::{System, Trial, run};
use crate::firmware::tools::root;

const SECONDS: u64 = 8;
/// From here on all devices have reported.
const BEGIN_MS: u64 = 1_500;
/// Values are compared at these distances.
const STEP_MS: u64 = 5;
/// So far apart the programs may be: a cycle of the device, and this.
const APART_MS: u64 = 40;
const LONGEST_CYCLE_MS: u64 = 100;

/// What is constant must be the same, what jumps must jump to the same, and what counts must count the same edges.
const WORLD: &str = r#"
seed = 11

[devices]
Distance = { steps = [["0 s", 1200], ["3 s", 3100]] }
Motor = { steps = [["0 s", 25], ["4 s", 61]] }
Heading = [-3000, { steps = [["0 s", 1200], ["5 s", -7]] }, 32767]
Angle = { steps = [["0 s", 4660], ["2500 ms", 65535]] }
Speed = { steps = [["0 s", 1250], ["4500 ms", 333]] }
Turns = { steps = [["0 s", 0], ["2 s", 0], ["5 s", 2100]] }
Bumper = { square = [0, 1], period = "3 s" }
Drops = { steps = [["0 s", 0], ["2 s", 0], ["6 s", 160]] }
Ahead = { steps = [["0 s", 300], ["3500 ms", 1199]] }
Torque = { steps = [["0 s", 10000], ["5500 ms", 2]] }
Position = { steps = [["0 s", 0], ["2 s", 0], ["6 s", 500]] }

[[fault]]
kind = "no_answer"
device = "Heading"
at = "6500 ms"
for = "300 ms"
"#;

fn number(scalar: Scalar) -> f64 {
    match scalar {
        Scalar::Bool(value) => f64::from(u8::from(value)),
        Scalar::Unsigned(value) => value as f64,
        Scalar::Signed(value) => value as f64,
        Scalar::Float32(value) => f64::from(value),
        Scalar::Float64(value) => value,
    }
}

/// The values of a device in the order in which they came.
type Course = Vec<(u64, Vec<f64>)>;

fn courses(trial: &Trial) -> BTreeMap<u8, Course> {
    let mut all: BTreeMap<u8, Course> = BTreeMap::new();
    for (at, id, elements) in &trial.reported {
        let elements = elements.iter().map(|one| number(*one)).collect();
        all.entry(*id).or_default().push((*at, elements));
    }
    all
}

/// What a host knows at a time.
fn known(course: &Course, at_ms: u64) -> &[f64] {
    let next = course.partition_point(|(at, _)| *at <= at_ms);
    &course[next - 1].1
}

/// What a host knows at a time must be what it knows from the other program about then: exactly, where that does not
/// change meanwhile.
fn differs(one: &Course, other: &Course) -> Option<String> {
    for at in (BEGIN_MS..SECONDS * 1_000 - LONGEST_CYCLE_MS).step_by(STEP_MS as usize) {
        let apart = APART_MS + LONGEST_CYCLE_MS;
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

/// The last values, once everything stands still, and how many values came.
fn ends(course: &Course) -> (&[f64], usize) {
    (&course.last().unwrap().1, course.len())
}

#[test]
fn programs_of_both_targets_say_the_same() {
    let text = std::fs::read_to_string(root().join("examples/all_kinds.sense")).unwrap();
    let trials = [System::Chibios, System::Embassy].map(|system| {
        let image = system.image(&format!("both_{system:?}"), &text)?;
        let trial = run(system, (&text, WORLD), &image, SECONDS, &[]);
        assert!(trial.halt.is_none() && trial.misled.is_empty(), "{:?}", trial.misled);
        assert!(trial.wrong().is_empty(), "{system:?}: {:#?}", trial.wrong());
        Some(courses(&trial))
    });
    let [Some(chibios), Some(embassy)] = trials else { return };
    let ids = |courses: &BTreeMap<u8, Course>| courses.keys().copied().collect::<Vec<u8>>();
    assert_eq!(ids(&chibios), ids(&embassy));
    assert_eq!(ids(&chibios), [1, 2, 3, 5, 6, 7, 8, 9, 10, 11, 17]);
    for (id, one) in &chibios {
        let other = &embassy[id];
        let apart = differs(one, other).or_else(|| differs(other, one));
        assert_eq!(apart, None, "device {id}");
        let ((last, count), (other_last, other_count)) = (ends(one), ends(other));
        assert_eq!(last, other_last, "device {id} ends at another value");
        // A reading more or less at either end, and what chance may take of those between.
        let most = 3 + count / 50;
        assert!(
            count.abs_diff(other_count) <= most,
            "device {id}: {count} and {other_count} values"
        );
    }
}
