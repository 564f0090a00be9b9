//! Both runtimes against `tests/vectors/stepper`: in a file of moves each step is due when exact arithmetic says, and
//! the motor is then where it says.

use sensedsl_tests::text;

use super::answer::Desk;

/// How far an interval may be off: a step comes at a tick, the root of a speed has 16 digits, and none finer than
/// 1/256 step/s.
fn is_near(ticks: f64, exact: f64, tick_hz: f64) -> bool {
    (ticks - exact).abs() <= 1.0 + exact * (1e-4 + exact / tick_hz / 256.0)
}

/// Asks for one interval after the other until there is a step: its ticks since the step before, and the position after
/// it; none at rest.
fn step(ask: &mut impl FnMut(&str) -> String) -> Option<(f64, i64)> {
    let mut sum = 0;
    loop {
        let answer = ask("advance");
        let numbers: Vec<i64> = answer.split(' ').skip(1).map(|one| one.parse().unwrap()).collect();
        let [ticks, is_step, is_backward, position] = numbers[..] else { panic!("{answer}") };
        if ticks == 0 {
            return None;
        }
        sum += ticks;
        if is_step == 1 {
            return Some((sum as f64, position + if is_backward == 1 { -1 } else { 1 }));
        }
    }
}

/// The lines of the file, and what a runtime is asked for each of them.
pub(crate) fn hold(ask: &mut impl FnMut(&str) -> String) {
    let text = text("tests/vectors/stepper/moves.txt");
    let (mut steps, mut tick_hz) = (0, 1.0);
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let words: Vec<&str> = line.split(' ').collect();
        match words[..] {
            ["motor", ticks, speed, acceleration, mode] => {
                tick_hz = ticks.parse().unwrap();
                ask(&format!(
                    "motor {ticks} {speed} {acceleration} {}",
                    u8::from(mode == "velocity")
                ));
            }
            ["target", number] => {
                let number: i32 = number.parse().unwrap();
                ask(&format!("target 6 {:x}", number.cast_unsigned()));
            }
            ["halt"] => drop(ask("halt")),
            ["step", exact, position] => {
                let exact: f64 = exact.parse().unwrap();
                let (ticks, is_at) = step(ask).unwrap_or_else(|| panic!("at rest: {line}"));
                assert!(is_near(ticks, exact, tick_hz), "{line}: {ticks} ticks");
                assert_eq!(is_at.to_string(), position, "{line}");
                steps += 1;
            }
            ["rest"] => assert_eq!(step(ask), None, "{line}"),
            _ => panic!("{line}"),
        }
    }
    assert!(steps > 200, "{steps} steps");
}

#[test]
fn the_motor_in_rust_moves_as_the_vectors_say() {
    let mut desk = Desk::default();
    hold(&mut |question| desk.answer(question));
}
