//! The robots of `sensedsl new --template` on boards with an AVR: built by the command, and held to their own tests with
//! the user's controller in C on the emulated processor.

use sensedsl_diagnostics::SourceMap;
use sensedsl_tests::{TempDir, read, sensedsl};
use sensedsl_twin::bench::Bench;
use sensedsl_twin::trial::{Recording, RuleVerdict, Trial, judge};
use sensedsl_twin::world::{self, Scene};

use super::board::AvrBoard;
use super::tools::can_compile_sketches;
use crate::embassy::with_job;

/// Makes a robot, builds its sketch, and runs each test of its design.
fn keeps_its_rules(template: &str, board: &str) {
    if !can_compile_sketches() {
        return;
    }
    let scratch = TempDir::new(&format!("avr-{template}-{board}"));
    let folder = scratch.join("robot");
    let named = folder.display().to_string();
    let _ = sensedsl(["new", &named, "--template", template, "--board", board]).run().exits(0);
    let design = folder.join("robot.sense");
    let _ = sensedsl(["build", &design.display().to_string(), "--quiet"]).run().exits(0);
    let image = folder.join("build/firmware/Robot/build/Robot.ino.elf");
    with_job(&read(&design), None, |job| {
        assert!(!job.design.tests.is_empty());
        for test in &job.design.tests {
            let name = &test.name.value;
            let world = read(&folder.join(&test.world.as_ref().unwrap().value));
            let devices: Vec<_> = job.devices.iter().map(|one| one.index).collect();
            let scene = Scene {
                design: job.design,
                devices: &devices,
                transport: job.board.link.transport,
                seed: None,
                samples: &|name| Ok(read(&folder.join(name))),
            };
            let file = SourceMap::default().add("world.toml", &world);
            let (world, mistakes) = world::read(file, &world, &scene);
            assert!(mistakes.is_empty(), "{mistakes:?}");
            let mut run = AvrBoard::new(job, Bench::new(job, &world, 1), &image);
            let mut host = Trial::new(job, test, &world.commands);
            let mut recording = Recording::new(test);
            let unseen = host.unseen(&run);
            let stopped = host.run(&mut run, &mut recording);
            assert!(stopped.is_none(), "{board} {name}: {stopped:?}");
            let judged = judge(job.design, test, &recording.trace, &unseen);
            for (rule, one) in test.rules.iter().zip(&judged) {
                println!("{board} {name}: {:?}, {:?} to spare", one.verdict, one.margin);
                let is_kept = matches!(one.verdict, RuleVerdict::Held | RuleVerdict::Unseen(_));
                assert!(is_kept, "{board} {name}, {rule:?}: {one:?}");
            }
        }
    });
}

#[test]
fn a_line_follower_keeps_its_rules_on_an_uno() {
    keeps_its_rules("line_follower", "ARDUINO-UNO-R3");
}

#[test]
fn a_line_follower_keeps_its_rules_on_a_nano() {
    keeps_its_rules("line_follower", "ARDUINO-NANO");
}

#[test]
fn a_line_follower_keeps_its_rules_on_a_mega() {
    keeps_its_rules("line_follower", "ARDUINO-MEGA-2560");
}
