//! No good image is judged wrong: the examples over several links, and the library's drivers in
//! groups, for both targets, through the command that users run: `simulate --firmware IMAGE
//! --judge`.
//!
//! A sixth runs with `SENSEDSL_THOROUGH=2`, all with `SENSEDSL_THOROUGH=3`: it builds and runs more than sixty programs.

use sensedsl_tests::{Random, TempDir, is_drawn, is_exhaustive, is_whole, sensedsl};

use super::examples::{UART, USB, on_discovery};
use super::trial::System;
use crate::false_alarms::{drivers, is_wired};

pub(super) const EXAMPLES: [&str; 7] =
    ["all_kinds", "arm", "fig2", "greenhouse", "line_follower", "miniature_car", "quadcopter"];
/// A serial link at the default speed.
const SLOW_UART: &str = "link { transport = uart; unit = USART3; }";
/// The number of drivers that are first tried together.
const TOGETHER: usize = 24;
/// The minimum number of programs that must be judged.
const IMAGES_MIN: usize = 60;

/// Whether the command says that a part may cost another one a byte now and then: the judge then rightly finds it.
fn loses_bytes(text: &str, target: &str) -> bool {
    let ran = sensedsl(["check", "-", "--target", target]).stdin(text).run();
    format!("{}{}", ran.stdout, ran.stderr).contains("[W0628]")
}

/// Groups with as many drivers as can be wired together on the board whose MCU is emulated.
fn groups(parts: &[String], target: &str) -> Vec<String> {
    let together = format!("board STM32F407G_DISC1 {{\n{}}}\n", parts.concat());
    if is_wired(&together, target) && !loses_bytes(&together, target) {
        return vec![together];
    }
    if parts.len() < 2 {
        return Vec::new();
    }
    let (one, other) = parts.split_at(parts.len() / 2);
    [groups(one, target), groups(other, target)].concat()
}

fn designs(target: &str) -> Vec<String> {
    let mut random = Random::new(7);
    let mut parts = drivers();
    for place in (1..parts.len()).rev() {
        parts.swap(place, random.below(place + 1));
    }
    let examples = EXAMPLES
        .iter()
        .flat_map(|example| [USB, UART, SLOW_UART].map(|link| on_discovery(example, link)));
    let examples = examples.filter(|text| is_wired(text, target));
    let groups = parts.chunks(TOGETHER).flat_map(|parts| groups(parts, target));
    examples.chain(groups).collect()
}

/// The complaint of the command about a given program.
pub(super) fn alarm_of(system: System, name: &str, text: &str, image: &[u8]) -> Option<String> {
    let scratch = TempDir::new(name);
    let design = scratch.write("design.sense", text).display().to_string();
    let program = scratch.join("program.elf");
    std::fs::write(&program, image).unwrap();
    let program = program.display().to_string();
    let target = system.target().unwrap_or("chibios");
    let call = ["simulate", &design, "--target", target, "--judge", "--firmware", &program];
    let ran = sensedsl(call).run();
    (ran.status != 0).then(|| format!("{name}: {text}\n{}\n{}", ran.stdout, ran.stderr))
}

/// Builds and judges the programs of both systems that this run draws: of all at least so many, each of the name and the
/// text of a design for a target.
pub(super) fn judge_all(least: usize, designs: impl Fn(&str) -> Vec<(String, String)>) {
    let (mut count, mut drawn, mut alarms) = (0, 0, Vec::new());
    for system in [System::Chibios, System::Embassy] {
        for (name, text) in designs(system.target().unwrap_or("chibios")) {
            let name = format!("{name}_{system:?}");
            count += 1;
            if !is_drawn(&name) {
                continue;
            }
            let Some(image) = system.image(&name, &text) else { return };
            drawn += 1;
            alarms.extend(alarm_of(system, &name, &text, &image));
        }
    }
    assert!(alarms.is_empty(), "{} of {drawn}: {}", alarms.len(), alarms.join("\n\n"));
    assert!(count >= least, "there are only {count} images");
    assert!(
        drawn >= if is_whole() { count } else { count / 40 },
        "only {drawn} of {count} images were judged"
    );
    eprintln!("{drawn} of {count} images, no alarm");
}

#[test]
fn no_image_is_called_wrong() {
    if !is_exhaustive() {
        return;
    }
    judge_all(IMAGES_MIN, |target| {
        let named = |(place, text)| (format!("images_{place}"), text);
        designs(target).into_iter().enumerate().map(named).collect()
    });
}
