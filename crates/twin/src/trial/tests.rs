//! Tests of trials: designs with tests in, verdicts of their runs out.
#![allow(
    clippy::indexing_slicing,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a panic is a test's failure"
)]

use sensedsl_diagnostics::SourceMap;
use sensedsl_job::jobs;
use sensedsl_model::NoFiles;
use sensedsl_session::{Ask, On, Workspace};

use super::*;
use crate::bench::Bench;
use crate::soft::{SoftBoard, UserCode};
use crate::world::{self, Scene};

const BOARD: &str = "board Oven on NUCLEO_F446RE {
    sensor Heat returns uint16 { type = analog; delay = 10 ms; quantity = \"degC\"; scale = 0.1; }
    sensor Air returns int16 { type = i2c; address = 0x44; register = 0; delay = 20 ms; }
    actuator Fan accepts uint16 { type = pwm; failsafe = 0; }
    actuator Heater accepts uint16 { type = pwm; failsafe = 0; }
    link { transport = usb; silence = 300 ms; }
    CONTROLLER
}
";

/// Code that copies the sensor's value to the heater.
struct Copies;

impl UserCode for Copies {
    fn restart(&mut self) -> Result<(), String> {
        Ok(())
    }

    fn step(&mut self, _: u8, request: &[u8], answer: &mut [u8]) -> Result<(), String> {
        answer[0] = request[4];
        answer[1..3].copy_from_slice(&request[9..11]);
        Ok(())
    }
}

/// The verdicts on the rules of the one test of a design.
fn judged(controller: &str, steps: &str, of_world: &str) -> Vec<Judged> {
    judged_on(controller, steps, of_world, &|board| Box::new(board))
}

/// The same on a board that is made of that of this program.
fn judged_on(
    controller: &str,
    steps: &str,
    of_world: &str,
    as_seen: &dyn Fn(SoftBoard) -> Box<dyn Tested>,
) -> Vec<Judged> {
    let board = BOARD.replace("CONTROLLER", controller);
    let text = format!("{board}test A {{ for = 3 s; {steps} }}");
    let mut workspace = Workspace::default();
    workspace.open("oven.sense", text.as_str());
    let snapshot = workspace.snapshot("oven.sense", On::default(), &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let (design, wiring) = answer.wired().unwrap_or_else(|| panic!("{:?}", answer.diagnostics));
    let job = jobs(design, wiring).next().unwrap();
    let devices: Vec<_> = job.devices.iter().map(|one| one.index).collect();
    let scene = Scene {
        design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: None,
        samples: &|name| Err(format!("there is no {name}")),
    };
    let file = SourceMap::default().add("world.toml", of_world);
    let (mut world, mistakes) = world::read(file, of_world, &scene);
    assert!(mistakes.is_empty(), "{mistakes:?}");
    let test = &design.tests[0];
    add_faults(&mut world, test, &job);
    let mut board = SoftBoard::new(&job, Bench::new(&job, &world, 1));
    if !controller.is_empty() {
        board = board.with_code(Box::new(Copies));
    }
    let mut board = as_seen(board);
    let mut recording = Recording::new(test);
    let mut trial = Trial::new(&job, test, &world.commands);
    let unseen = trial.unseen(board.as_ref());
    assert_eq!(trial.run(board.as_mut(), &mut recording), None);
    judge(design, test, &recording.trace, &unseen)
}

/// A board that nobody looks into, and whose clock stands a little behind each millisecond: as an emulated one, if its
/// wires are measured, or as a real one.
struct Outside {
    board: SoftBoard,
    has_probes: bool,
}

impl Tested for Outside {
    fn now_ns(&self) -> u64 {
        self.board.now_ns() + 7
    }

    fn run_until(&mut self, until_ns: u64) {
        Tested::run_until(&mut self.board, until_ns);
    }

    fn link_open(&mut self) {
        Tested::link_open(&mut self.board);
    }

    fn link_write(&mut self, bytes: &[u8]) {
        self.board.link_write(bytes);
    }

    fn link_read(&mut self) -> Vec<u8> {
        self.board.link_read()
    }

    fn outputs(&self) -> Option<Outputs> {
        self.has_probes.then(|| self.board.bench().outputs().clone())
    }

    fn stopped(&mut self) -> Option<Stopped> {
        self.board.stopped()
    }
}

/// What code sets is read from the wires where somebody measures them, and health is asked for whatever the clock.
#[test]
fn what_code_sets_is_seen_on_the_wires() {
    let controller = "controller Hold every 10 ms { reads = Heat; sets = Heater; }
        actuator Goal accepts float32 { type = code; default = 7; }";
    let steps = "always Heater > 900 from 1 s; never Heater > 900 from 1 s;
        when rising(health(Air) == failed) then Heater > 900 within 100 ms;
        always Goal == 7;
        eventually Heat > 1000 degC within 1 us;
        fault no_answer of Air at 1 s for 1 s;";
    let of_world = "[devices]\nHeat = 100\n";
    let on = |has_probes| {
        judged_on(controller, steps, of_world, &|board| Box::new(Outside { board, has_probes }))
    };
    let all = on(true);
    assert!(all[0].is_held() && is_violated(&all[1]), "{:?}", &all[..2]);
    assert!(all[2].is_held() && all[2].outcome.occasions == 1, "{:?}", all[2]);
    assert!(all[3].is_held(), "{:?}", all[3]);
    // Its values came after its time.
    assert!(all[4].verdict == RuleVerdict::Open && all[4].outcome.open == 0, "{:?}", all[4]);
    let all = on(false);
    let unseen = RuleVerdict::Unseen("Heater".to_owned());
    assert_eq!([&all[0].verdict, &all[1].verdict, &all[2].verdict], [&unseen; 3]);
}

fn is_violated(one: &Judged) -> bool {
    matches!(one.verdict, RuleVerdict::Violated { .. })
}

#[test]
fn reported_values_are_held_to_rules_in_their_unit() {
    let world = "[devices]\nHeat = { ramp = [20, 220], over = \"2 s\" }\nAir = 5";
    let all = judged(
        "",
        "always Heat < 100 degC; always Heat < 250 degC; eventually Heat > 215 from 2 s;",
        world,
    );
    let RuleVerdict::Violated { first, .. } = &all[0].verdict else { panic!("{:?}", all[0]) };
    // 100 °C are reached after 0.8 s; the next report comes within two cycles.
    assert!((800_000_000..=830_000_000).contains(&first.at_ns), "{first:?}");
    let number: f64 = first.values[0].1.trim_end_matches(" degC").parse().unwrap();
    assert!((100.0..=103.0).contains(&number), "{first:?}");
    assert_eq!(all[0].margin.as_deref(), Some("off by 120 degC at worst"));
    assert_eq!(all[1].margin.as_deref(), Some("30 degC to spare"));
    assert!(all[2].is_held());
}

#[test]
fn what_the_host_sets_is_applied_and_kept_from_falling_back() {
    let steps = "at 1 s set Fan = 30 %;
        eventually Fan == 30 % within 1100 ms;
        always Fan == 3000 from 1100 ms;
        always Fan == 0 to 900 ms;
        eventually Fan > 30 % within 2 s;";
    let all = judged("", steps, "");
    assert!(all[..3].iter().all(Judged::is_held), "{all:?}");
    let spare = all[0].outcome.spare_ns.unwrap();
    assert!((50_000_000..100_000_000).contains(&spare), "{spare}");
    assert!(is_violated(&all[3]));
}

#[test]
fn code_of_controllers_sets_what_rules_see() {
    let controller = "controller Hold every 20 ms { reads = [Heat]; sets = [Heater]; }";
    let world = "[devices]\nHeat = { ramp = [20, 220], over = \"2 s\" }";
    let steps = "always Heater in 1.5 % .. 25 % from 100 ms; when Heat > 100 then Heater > 9 % within 50 ms;
        never Hold.overruns > 0;";
    let all = judged(controller, steps, world);
    assert!(all.iter().all(Judged::is_held), "{all:?}");
    assert_eq!(all[1].outcome.occasions, 1);
}

#[test]
fn faults_of_the_test_break_what_they_say() {
    let steps = "fault no_answer of Air at 1 s for 500 ms;
        never age(Air) > 100 ms from 500 ms to 1 s;
        eventually age(Air) > 400 ms from 1 s;
        never health(Air) == failed to 1 s;
        eventually health(Air) == failed from 1 s;
        always health(Air) == good from 2 s;
        never health(Air) != good from 500 ms;";
    let all = judged("", steps, "[devices]\nAir = 5");
    assert!(all[..5].iter().all(Judged::is_held), "{all:?}");
    let RuleVerdict::Violated { first, .. } = &all[5].verdict else { panic!("{:?}", all[5]) };
    assert_eq!(first.values, [("health(Air)".to_owned(), "failed".to_owned())]);
}

#[test]
fn a_rule_about_what_never_came_is_not_held() {
    let all = judged(
        "",
        "fault no_answer of Air at 0 s for 3 s; always Air < 5; always Heat < 5000;",
        "",
    );
    assert_eq!(all[0].verdict, RuleVerdict::Unknown("Air".to_owned()));
    assert!(all[1].is_held());
}

#[test]
fn what_rises_has_risen_a_millisecond_later() {
    let steps = "at 1 s set Fan = 30 %; at 1200 ms set Heater = 10 %; at 1400 ms set Heater = 0; at 2 s set Heater = 20 %;
        when rising(Fan > 0) then Heater > 15 %  within 300 ms;
        when rising(Fan > 0) then Heater > 5 % within 300 ms;";
    // The fan stays on for two seconds, in most of which the heater is off: that is not asked.
    let all = judged("", steps, "");
    assert!(is_violated(&all[0]) && all[1].is_held(), "{all:?}");
    assert_eq!(all[1].outcome.occasions, 1);
}

#[test]
fn late_is_said_in_time() {
    let steps = "at 1 s set Fan = 30 %; at 1500 ms set Fan = 0;
        when rising(Fan > 0) then Fan == 0 within 400 ms;
        when rising(Fan > 0) then Fan == 0 within 600 ms;
        when Fan > 90 % then Fan == 0;";
    let all = judged("", steps, "");
    let late = all[0].margin.as_deref().unwrap();
    assert!(late.starts_with("late by ") && late.ends_with(" ms"), "{late}");
    let RuleVerdict::Violated { first, last } = &all[0].verdict else { panic!("{:?}", all[0]) };
    assert_eq!(last.as_ref().unwrap().at_ns - first.at_ns, 400_000_000);
    assert_eq!(last.as_ref().unwrap().values, [("Fan".to_owned(), "30 %".to_owned())]);
    assert!(
        all[1].is_held() && all[1].margin.as_deref().unwrap().ends_with("to spare"),
        "{:?}",
        all[1]
    );
    assert_eq!(all[2].note.as_deref(), Some("its condition was never true"));
}
