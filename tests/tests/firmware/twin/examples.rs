//! The examples as firmware for both targets, over both links, before a judge for ten virtual seconds, as `simulate
//! --firmware IMAGE --judge` runs them.

use sensedsl_twin::machine::Event;

use super::trial::{System, Trial, run};
use crate::firmware::tools::root;

const UART: &str = "link { transport = uart; unit = USART3; baud = 460800; }";
const USB: &str = "";
const SECONDS: u64 = 10;

/// An example on the whole Discovery board, with a link of one's choice.
fn on_discovery(example: &str, link: &str) -> String {
    let path = root().join("examples").join(format!("{example}.sense"));
    let text = format!("\n{}", std::fs::read_to_string(path).unwrap());
    let (before, board) = text.split_once("\nboard ").unwrap();
    let (_, inside) = board.split_once('{').unwrap();
    let is_link = |line: &&str| line.trim_start().starts_with("link {");
    let inside: Vec<&str> = inside.lines().filter(|line| !is_link(line)).collect();
    format!("{before}\nboard STM32F407G_DISC1 {{\n{link}{}\n", inside.join("\n"))
}

fn world(name: &str) -> String {
    std::fs::read_to_string(root().join(format!("examples/worlds/{name}.toml"))).unwrap()
}

/// All values agree with the world, all pads with the wiring, and no unit is used that the twin does not have or that has
/// no clock.
#[track_caller]
fn assert_agrees(what: &str, trial: &Trial) {
    assert!(
        trial.halt.is_none() && trial.misled.is_empty(),
        "{what}: {:?} {:?}",
        trial.halt,
        trial.misled
    );
    let told = trial.told.iter().filter(|one| !matches!(one, Event::Reset { .. }));
    let told: Vec<&Event> = told.collect();
    assert!(told.is_empty(), "{what}: {told:?}");
    assert!(trial.wrong().is_empty(), "{what}: {:#?}", trial.wrong());
    let silent = trial.judged.iter().filter(|one| one.reports == 0);
    let silent: Vec<&str> = silent.map(|one| one.name.as_str()).collect();
    assert!(silent.is_empty(), "{what}: nothing of {silent:?}");
    let values: u64 = trial.judged.iter().map(|one| one.reports).sum();
    eprintln!("{what}: {values} values of {SECONDS} s agree");
}

fn agrees(system: System, example: &str, world_name: &str, link: &str) {
    let text = on_discovery(example, link);
    let which = if link == USB { "usb" } else { "uart" };
    let what = format!("example_{example}_{which}_{system:?}");
    let Some(image) = system.image(&what, &text) else { return };
    assert_agrees(&what, &run(system, (&text, &world(world_name)), &image, SECONDS, &[]));
}

/// Both links on both targets.
fn agrees_everywhere(example: &str, world_name: &str) {
    if !sensedsl_tests::is_exhaustive() {
        return;
    }
    for system in [System::Chibios, System::Embassy] {
        for link in [UART, USB] {
            agrees(system, example, world_name, link);
        }
    }
}

#[test]
fn fig2() {
    // What no other test of Embassy runs: the host that enumerates it.
    agrees(System::Embassy, "fig2", "fig2", USB);
    agrees_everywhere("fig2", "fig2");
}

#[test]
fn the_car() {
    agrees_everywhere("miniature_car", "car");
}

#[test]
fn the_line_follower() {
    agrees_everywhere("line_follower", "line_follower");
}

#[test]
fn the_quadcopter() {
    agrees_everywhere("quadcopter", "quadcopter");
}

#[test]
fn all_kinds() {
    agrees_everywhere("all_kinds", "all_kinds");
}
