//! Stepper motors: each step is counted, over a series of targets that come while the motor is under way, and boards
//! with one mistake each are found out.

use crate::commanded::tried_as;

const RIGHT: &str = "board STM32F407G_DISC1 {
    link { transport = uart; unit = USART3; silence = 400 ms; }
    chip Axis {
        driver = a4988;
        speed = 4000;
        acceleration = 20000;
        actuator Target accepts int32 { id = 1; }
        sensor Position returns int32 { id = 2; }
    }
    actuator Feed accepts int16 { id = 3; type = stepper; mode = velocity; speed = 2000; acceleration = 10000; enabled = low; }
    actuator Home accepts int32 { id = 4; type = stepper; speed = 500; acceleration = 5000; failsafe = 0; }
}";

/// Targets at random moments, most of them in mid-ramp: the last one has time to be reached.
fn series() -> String {
    let mut state = 20_261_129_u64;
    let mut below = |most: u64| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % most
    };
    let (mut at_ms, mut text) = (1_000, String::new());
    for _ in 0..30 {
        let (target, speed) = (below(6_000) as i64 - 3_000, below(4_400) as i64 - 2_200);
        for (device, value) in [("Target", target), ("Feed", speed)] {
            text.push_str(&format!(
                "[[command]]\ndevice = \"{device}\"\nat = \"{at_ms} ms\"\nvalue = {value}\n"
            ));
        }
        at_ms += 20 + below(150);
    }
    text
}

#[test]
fn every_step_is_one_that_the_host_asked_for() {
    for world in ["", &series()] {
        let all = tried_as(RIGHT, RIGHT, world);
        for one in &all {
            assert_eq!((one.wrong, one.is_silence_left), (0, false), "{one:#?}");
            assert!(one.looks >= 3 && one.commands >= 3, "{one:#?}");
        }
        assert_eq!(all.len(), 3);
    }
}

#[test]
fn each_mistake_of_a_motor_is_noticed() {
    let seeds = [
        ("speed = 4000", "speed = 4100", "Target"),
        ("acceleration = 20000", "acceleration = 26000", "Target"),
        ("driver = a4988;", "driver = a4988; forward = low;", "Target"),
        ("driver = a4988;", "driver = a4988; enabled = high;", "Target"),
        ("driver = a4988;", "driver = a4988; pulse = 1 us;", "Target"),
        ("acceleration = 10000", "acceleration = 13000", "Feed"),
        ("mode = velocity; ", "", "Feed"),
        ("speed = 2000", "speed = 1900", "Feed"),
        ("failsafe = 0", "failsafe = 1", "Home"),
        ("failsafe = 0;", "", "Home"),
    ];
    for (from, to, name) in seeds.into_iter().step_by(crate::step(5)) {
        assert!(RIGHT.contains(from), "{from}");
        let all = tried_as(RIGHT, &RIGHT.replacen(from, to, 1), "");
        let found: Vec<_> = all.iter().filter(|one| one.wrong > 0).map(|one| &one.name).collect();
        assert!(found.iter().any(|one| *one == name), "{from} -> {to}: {found:?}");
    }
}
