//! The examples as firmware for both targets, over both links, judged for ten virtual seconds like
//! `simulate --firmware IMAGE --judge` does, with the generated host program at the other end.

use sensedsl_machine::Event;
use sensedsl_tests::root;

use super::hosted::Host;
use super::trial::{System, Trial, run, run_with};

pub(super) const UART: &str =
    "link { transport = uart; unit = USART3; baud = 460800; checksum = crc32; }";
pub(super) const USB: &str = "";
const SECONDS: u64 = 10;

/// An example on the complete Discovery board, with the given link.
pub(super) fn on_discovery(example: &str, link: &str) -> String {
    on_board(example, "STM32F407G_DISC1", link)
}

/// An example on any board, with the given link.
pub(super) fn on_board(example: &str, board: &str, link: &str) -> String {
    let path = root().join("examples").join(format!("{example}.sense"));
    let text = format!("\n{}", std::fs::read_to_string(path).unwrap());
    let (before, rest) = text.split_once("\nboard ").unwrap();
    let (_, inside) = rest.split_once('{').unwrap();
    let is_link = |line: &&str| line.trim_start().starts_with("link {");
    let inside: Vec<&str> = inside.lines().filter(|line| !is_link(line)).collect();
    format!("{before}\nboard {board} {{\n{link}{}\n", inside.join("\n"))
}

fn world(name: &str) -> String {
    std::fs::read_to_string(root().join(format!("examples/worlds/{name}.toml"))).unwrap()
}

/// All values must agree with the world and all pads with the wiring, and the program must use no
/// unit that the twin lacks or that has no clock.
#[track_caller]
fn assert_agrees(what: &str, trial: &Trial) {
    assert!(
        trial.halt.is_none() && trial.mismatches.is_empty(),
        "{what}: {:?} {:?}",
        trial.halt,
        trial.mismatches
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

/// Motor controllers, a CANopen node and frames with several contents on one bus of a board whose
/// crystal differs from the Discovery's: 12 MHz.
fn can_agrees(system: System) {
    let text = sensedsl_tests::text("tests/can/bus.sense");
    let Some(image) = system.image(&format!("can_bus_{system:?}"), &text) else { return };
    assert_agrees(
        &format!("CAN, {system:?}"),
        &run(system, (&text, ""), &image, SECONDS, &[3_000]),
    );
}

#[test]
fn can_on_chibios() {
    can_agrees(System::Chibios);
}

#[test]
fn can_on_embassy() {
    can_agrees(System::Embassy);
}

/// The cases that always run; an exhaustive run draws from the others, because they take many minutes.
const ALWAYS: [(&str, System, &str); 3] = [
    ("fig2", System::Embassy, USB),
    ("miniature_car", System::Embassy, UART),
    ("all_kinds", System::Embassy, UART),
];

fn agrees(system: System, (example, world_name): (&str, &str), link: &str) {
    let which = if link == USB { "usb" } else { "uart" };
    let what = format!("example_{example}_{which}_{system:?}");
    if !ALWAYS.contains(&(example, system, link)) && !sensedsl_tests::is_drawn(&what) {
        return;
    }
    let text = on_discovery(example, link);
    let Some(image) = system.image(&what, &text) else { return };
    let world = world(world_name);
    let design = (text.as_str(), world.as_str());
    let trial = match Host::start(&what, &text) {
        Some(mut host) => {
            let trial = run_with(system, design, &image, SECONDS, |ms, reported, _| {
                host.pass(ms, reported)
            });
            host.assert_shows(&what, &trial);
            trial
        }
        None => run(system, design, &image, SECONDS, &[]),
    };
    assert_agrees(&what, &trial);
    // Only garbage in the world costs bytes.
    assert_eq!(trial.dropped > 0, world.contains("garbage"), "{what}: {}", trial.dropped);
}

/// Runs both links of both targets for each example, in the world of that name.
macro_rules! agree {
    ($($name:ident: $example:literal in $world:literal,)*) => {
        $(
            mod $name {
                use super::{System, UART, USB, agrees};

                const EXAMPLE: (&str, &str) = ($example, $world);

                #[test]
                fn chibios_uart() {
                    agrees(System::Chibios, EXAMPLE, UART);
                }

                #[test]
                fn chibios_usb() {
                    agrees(System::Chibios, EXAMPLE, USB);
                }

                #[test]
                fn embassy_uart() {
                    agrees(System::Embassy, EXAMPLE, UART);
                }

                #[test]
                fn embassy_usb() {
                    agrees(System::Embassy, EXAMPLE, USB);
                }
            }
        )*
    };
}

agree! {
    fig2: "fig2" in "fig2",
    the_car: "miniature_car" in "car",
    the_line_follower: "line_follower" in "line_follower",
    the_quadcopter: "quadcopter" in "quadcopter",
    all_kinds: "all_kinds" in "all_kinds",
}
