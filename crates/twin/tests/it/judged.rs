//! The mistakes that the judge must catch: reports that were tampered with.

use sensedsl_job::JobDevice;
use sensedsl_twin::bench::Bench;
use sensedsl_twin::judge::{DeviceFindings, Finding, Judge};
use sensedsl_wire::{Causes, DeviceHealth, Health, ResetCause, Scalar, Status};

use crate::run::{Values, plainly, read, simulate, with_job};

const CAR: &str = "board STM32F4DiscoveryBoard {
    sensor Near returns uint16 { id = 1; type = analog; delay = 20; scale = 0.1; quantity = cm; }
    sensor Far returns uint16 { id = 2; type = analog; delay = 20; scale = 0.1; quantity = cm; }
    sensor Rear returns uint16 { id = 3; driver = srf08; address = 0x70; delay = 100; }
    sensor Left returns uint32 { id = 4; type = icu; }
    sensor Right returns uint32 { id = 5; type = icu; }
    chip Climate { driver = bme280; delay = 100 ms;
        sensor Temperature returns int32 { id = 6; }
        sensor Pressure returns uint32 { id = 7; } }
    sensor Line returns uint16[3] { id = 8; type = analog; delay = 20; }
}";
const WORLD: &str = "[devices]
Near = { sine = 80, offset = 150, period = \"3 s\", noise = 0.5 }
Far = { ramp = [10, 400], over = \"6 s\" }
Rear = { ramp = [30, 300], over = \"6 s\" }
Left = { rate = 50 }
Right = { rate = 90 }
Temperature = { sine = 5, offset = 20, period = \"4 s\" }
Line = [500, 1500, { sine = 500, offset = 2500, period = \"2 s\" }]
";

fn with(tamper: impl FnMut(u64, &mut Values)) -> Vec<String> {
    let run = simulate(CAR, WORLD, 3, tamper);
    run.judged.into_iter().filter(|one| one.wrong > 0).map(|one| one.name).collect()
}

fn change(id: u8, mut how: impl FnMut(u64) -> u64) -> impl FnMut(u64, &mut Values) {
    move |_, values| {
        for (_, elements) in values.iter_mut().filter(|(of, _)| *of == id) {
            for element in elements {
                match element {
                    Scalar::Unsigned(number) => *number = how(*number),
                    Scalar::Signed(number) => {
                        *number = i64::try_from(how(number.unsigned_abs())).unwrap();
                    }
                    Scalar::Bool(_) | Scalar::Float32(_) | Scalar::Float64(_) => {}
                }
            }
        }
    }
}

#[test]
fn what_is_right_is_found_right() {
    let run = plainly(CAR, WORLD, 3);
    assert!(run.wrong().is_empty(), "{:#?}", run.wrong());
    for one in &run.judged {
        assert!(one.reports >= 10, "{}: {}", one.name, one.reports);
    }
}

#[test]
fn another_scale_is_wrong() {
    assert_eq!(with(change(1, |raw| raw * 21 / 20)), ["Near"]);
    assert_eq!(with(change(3, |raw| raw * 254 / 100)), ["Rear"]);
    assert_eq!(with(change(7, |raw| raw / 256)), ["Pressure"]);
    assert_eq!(with(change(4, |raw| raw * 2)), ["Left"]);
}

#[test]
fn another_order_of_bytes_is_wrong() {
    let swapped = |raw: u64| u64::from(u16::try_from(raw).unwrap().swap_bytes());
    assert_eq!(with(change(2, swapped)), ["Far"]);
    assert_eq!(with(change(3, swapped)), ["Rear"]);
}

#[test]
fn one_degree_is_wrong() {
    assert_eq!(with(change(6, |raw| raw + 100)), ["Temperature"]);
}

#[test]
fn swapped_devices_are_wrong() {
    let swap = |(one, other): (u8, u8)| {
        move |_: u64, values: &mut Values| {
            for (id, _) in values.iter_mut() {
                *id = if *id == one {
                    other
                } else if *id == other {
                    one
                } else {
                    *id
                };
            }
        }
    };
    assert_eq!(with(swap((1, 2))), ["Near", "Far"]);
    assert_eq!(with(swap((4, 5))), ["Left", "Right"]);
    let turned = |_: u64, values: &mut Values| {
        values.iter_mut().filter(|(id, _)| *id == 8).for_each(|(_, all)| all.rotate_left(1));
    };
    assert_eq!(with(turned), ["Line"]);
}

#[test]
fn old_values_are_wrong() {
    // A value that was measured 300 ms ago.
    let mut queue: Vec<(u64, Vec<Scalar>)> = Vec::new();
    let late = move |now: u64, values: &mut Values| {
        for (_, elements) in values.iter_mut().filter(|(id, _)| *id == 1) {
            queue.push((now, elements.clone()));
            let then = queue.iter().rev().find(|(at, _)| at + 300_000_000 <= now);
            if let Some((_, old)) = then.or(queue.first()) {
                elements.clone_from(old);
            }
        }
    };
    assert_eq!(with(late), ["Near"]);
    // A value that never changes.
    let mut first = None;
    let still = move |_: u64, values: &mut Values| {
        for (_, elements) in values.iter_mut().filter(|(id, _)| *id == 3) {
            elements.clone_from(first.get_or_insert_with(|| elements.clone()));
        }
    };
    assert_eq!(with(still), ["Rear"]);
}

#[test]
fn what_does_not_come_is_wrong() {
    let lost = |now: u64, values: &mut Values| {
        if now > 500_000_000 {
            values.retain(|(id, _)| *id != 2);
        }
    };
    let run = simulate(CAR, WORLD, 8, lost);
    let wrong: Vec<&str> =
        run.judged.iter().filter(|one| one.wrong > 0).map(|one| one.name.as_str()).collect();
    assert_eq!(wrong, ["Far"]);
    let worst = run.of("Far").worst.as_ref().unwrap();
    assert!(matches!(worst.finding, Finding::Silence(_)), "{worst:?}");
}

/// A count must be reported when it has changed, not only together with another value, and is repeated once a second.
#[test]
fn a_count_that_is_told_late_or_again_is_wrong() {
    let words = |tamper: &mut dyn FnMut(u64, &mut Values)| {
        let run = simulate(CAR, WORLD, 6, tamper);
        assert!(wrong_names(&run.judged).iter().all(|name| *name == "Left"), "{:?}", run.wrong());
        run.of("Left").words()
    };
    let mut last = 0;
    let late = words(&mut |now, values| {
        // The value is left out until 60 ms have passed.
        values.retain(|(id, _)| *id != 4 || now >= last + 60_000_000);
        last = if values.iter().any(|(id, _)| *id == 4) { now } else { last };
    });
    assert!(late.contains("after it has changed on average"), "{late}");
    let mut before = None;
    let again = words(&mut |_, values| {
        if let Some(own) = values.iter().find(|(id, _)| *id == 4) {
            before = Some(own.clone());
        } else {
            values.extend(before.clone());
        }
    });
    assert!(again.contains("though it had not changed"), "{again}");
}

/// A wheel cannot jump: noise that did would cost an encoder steps.
#[test]
fn an_encoder_with_noise_agrees_with_its_world() {
    let board = "board STM32F407G_DISC1 { sensor Turns returns int32 { id = 1; type = encoder; } }";
    for turns in
        ["{ rate = 100, noise = 2 }", "{ sine = 500, offset = 0, period = \"3 s\", noise = 5 }"]
    {
        let run = plainly(board, &format!("[devices]\nTurns = {turns}\n"), 5);
        assert!(run.wrong().is_empty(), "{turns}: {:#?}", run.wrong());
        assert!(run.judged[0].reports > 100, "{turns}: {:?}", run.judged[0]);
    }
}

/// A board measures as soon as it is up: the first value of a slow device does not wait for its cycle.
#[test]
fn a_first_value_that_does_not_come_is_wrong() {
    let board = "board STM32F407G_DISC1 {
        chip Clock { driver = ds3231; delay = 60 s; }
        sensor Soil returns uint16 { id = 20; type = analog; delay = 60 s; }
        sensor Light returns uint16 { id = 21; type = analog; delay = 20 ms; }
    }";
    let run = plainly(board, "", 6);
    assert!(run.wrong().is_empty(), "{:#?}", run.wrong());
    assert_eq!((run.of("Soil").reports, run.of("ClockMinute").reports), (1, 1));
    let minute = with_job(board, |job| {
        let one = job.devices.iter().find(|one| one.name() == "ClockMinute");
        one.unwrap().device.id.value
    });
    for (id, name) in [(20, "Soil"), (minute, "ClockMinute")] {
        let run = simulate(board, "", 6, |_, values| values.retain(|one| one.0 != id));
        let wrong: Vec<&str> = wrong_names(&run.judged);
        assert_eq!(wrong, [name]);
    }
}

fn wrong_names(judged: &[DeviceFindings]) -> Vec<&str> {
    judged.iter().filter(|one| one.wrong > 0).map(|one| one.name.as_str()).collect()
}

/// A count that does not change comes once a second, whatever `delay` says: the board must not call it stale.
#[test]
fn what_is_at_rest_is_not_stale() {
    for (text, name, value) in [
        ("sensor Wheel returns int32 { type = encoder; delay = 5 ms; }", "Wheel", "0"),
        ("sensor Pulses returns uint32 { type = icu; mode = count; delay = 5 ms; }", "Pulses", "0"),
        ("chip Axis { driver = a4988; delay = 5 ms; }", "AxisPosition", ""),
    ] {
        let board = format!("board STM32F407G_DISC1 {{ {text} }}");
        let world = format!("[devices]\n{name} = {value}\n");
        let run = plainly(&board, if value.is_empty() { "" } else { &world }, 4);
        assert_eq!(run.wrong(), [""; 0], "{text}");
        assert!(run.of(name).reports > 1, "{text}");
        let is_stale = run.statuses.iter().any(|(_, status)| *status == Status::Stale);
        assert!(!is_stale, "{text}: {:?}", run.statuses);
    }
}

/// A part that needs longer than its cycle, and rangers whose turns do, are asked in vain in between.
#[test]
fn what_takes_longer_than_its_cycle_is_not_stale() {
    let slow =
        "sensor Rear returns uint8 { type = i2c; address = 0x70; delay = 10 ms; wait = 65 ms; }";
    let turns =
        "sensor Around returns uint16[6] { type = icu; mode = width; pulse = 10 us; wait = 40 ms;
                     group = sound; delay = 50 ms; }";
    let alone =
        "sensor Front returns uint16 { type = icu; mode = width; pulse = 10 us; wait = 40 ms;
                     group = sound; delay = 50 ms; }";
    for text in [slow.to_owned(), turns.to_owned(), format!("{turns} {alone}")] {
        let board = format!("board STM32F407G_DISC1 {{ {text} }}");
        for seconds in 2..6 {
            let run = plainly(&board, "", seconds);
            let is_good = run.statuses.iter().all(|(_, status)| *status == Status::Good);
            assert!(is_good, "{text} after {seconds} s: {:?}", run.statuses);
        }
    }
}

/// A host hears a value no more often than the link's `rate` lets it go; the board knows it sooner.
#[test]
fn a_slow_rate_makes_no_value_late() {
    let board = "board STM32F407G_DISC1 { link { rate = 1 Hz; } sensor Light returns uint16 { type = analog; delay = 50 ms; } }";
    with_job(board, |job| {
        let light = job.devices[0].device;
        let told = (job.design.paced_ms(light), job.design.told_every_ms(light));
        assert_eq!(told, (Some(50), Some(1_000)));
    });
}

/// The board sends a ranger its pulse, so it knows when there is no echo. Nobody asks a receiver for its pulses.
#[test]
fn an_echo_that_does_not_come_is_stale() {
    let width = |own: &str| {
        format!("sensor Near returns uint16 {{ type = icu; mode = width; {own} delay = 60 ms; }}")
    };
    for (text, status) in [
        (width("pulse = 10 us; wait = 40 ms;"), Status::Stale),
        (width("pulse = 10 us; wait = 40 ms;").replace("uint16", "uint16[2]"), Status::Stale),
        (width("").replace("delay = 60 ms;", ""), Status::Good),
    ] {
        let board = format!("board STM32F407G_DISC1 {{ {text} }}");
        let world = "[[fault]]\nkind = \"silent\"\ndevice = \"Near\"\nat = 2\nfor = 9\n";
        assert_eq!(plainly(&board, world, 4).statuses[0].1, status, "{text}");
    }
}

/// A board reports the health of each of its devices once, and of no others.
#[test]
fn health_of_other_devices_is_wrong() {
    with_job(CAR, |job| {
        let (world, _) = read(job, WORLD, 7);
        let bench = Bench::new(job, &world, 7);
        let row = |one: &JobDevice<'_>| DeviceHealth {
            id: one.device.id.value,
            status: Status::Good,
            age_ms: 0,
            causes: Causes::default(),
        };
        let right = Health {
            uptime_ms: 1_000,
            reset_cause: ResetCause::Power,
            reset_device: 0,
            reports_sent: 0,
            reports_refused: 0,
            load_percent: 10,
            stack_left_bytes: 200,
            devices: job.devices.iter().map(row).collect(),
        };
        let found = |health: &Health| {
            let mut judge = Judge::new(job, &bench);
            judge.health(1_000_000_000, health, 0);
            let judged = judge.finish(1_000_000_000);
            judged.iter().any(|one| one.wrong > 0 && one.name == job.board.name.value)
        };
        assert!(!found(&right));
        let mut other = right.clone();
        other.devices[1].id = 0;
        let mut fewer = right.clone();
        let _ = fewer.devices.pop();
        assert!(found(&other) && found(&fewer));
    });
}
