//! Reading worlds, and what faults do.

use crate::run::{plainly, read, with_job};

const BOARD: &str = "board STM32F4DiscoveryBoard {
    sensor Light returns uint16 { id = 1; type = analog; delay = 20; }
    sensor Percent returns uint8 { id = 2; type = analog; delay = 20; }
    sensor Rear returns uint16 { id = 3; driver = srf08; address = 0x70; delay = 100; }
    sensor Wheel returns uint32 { id = 4; type = icu; }
    sensor Pair returns uint16[2] { id = 5; type = analog; delay = 20; }
    sensor Button returns bool { id = 6; type = digital; delay = 20; }
    actuator Lamp accepts bool { id = 7; type = digital; }
    sensor Rain returns uint32 { id = 8; type = digital; edge = falling; debounce = 20 ms; delay = 50; }
}";

/// The codes and places of what is wrong with a world.
fn said(text: &str) -> Vec<(String, String)> {
    with_job(BOARD, |job| {
        let (_, said) = read(job, text, 1);
        for one in &said {
            assert!(one.help.is_some(), "{one:#?}");
        }
        let place = |one: &sensedsl_diagnostics::Diagnostic| {
            text.get(one.primary.span.range()).unwrap_or_default().to_owned()
        };
        said.iter().map(|one| (one.code.to_string(), place(one))).collect()
    })
}

fn only(text: &str, code: &str, place: &str) {
    assert_eq!(said(text), [(code.to_owned(), place.to_owned())], "{text}");
}

#[test]
fn every_mistake_is_told_with_its_place() {
    let d = "[devices]\n";
    only("[devices\nLight = 5", "E0540", "");
    only(&format!("{d}Light = \"20\""), "E0540", "\"20\"");
    only(&format!("{d}Light = {{ }}"), "E0540", "{ }");
    only(&format!("{d}Light = {{ value = 1, rate = 2 }}"), "E0540", "{ value = 1, rate = 2 }");
    only(&format!("{d}Light = {{ sine = 5 }}"), "E0540", "{ sine = 5 }");
    only("seed = -1", "E0540", "-1");
    only(&format!("{d}Ligth = 5"), "E0541", "Ligth");
    only(&format!("{d}Lamp = 1"), "E0541", "Lamp");
    only(&format!("{d}Light = {{ sinus = 5 }}"), "E0541", "sinus");
    only("[device]\nLight = 5", "E0541", "device");
    only(&format!("{d}Light = 5000"), "E0542", "5000");
    only(&format!("{d}Percent = 300"), "E0542", "300");
    only(
        &format!("{d}Light = {{ ramp = [0, -1], over = 1 }}"),
        "E0542",
        "{ ramp = [0, -1], over = 1 }",
    );
    only(&format!("{d}Pair = [1, 2, 3]"), "E0542", "[1, 2, 3]");
    let falls = "{ sine = 5, offset = 9, period = \"1 s\" }";
    only(&format!("{d}Wheel = {falls}"), "E0542", falls);
    for fast in
        ["{ rate = 25 }", "{ ramp = [0, 100], over = \"2 s\" }", "{ steps = [[0, 0], [1, 60]] }"]
    {
        only(&format!("{d}Rain = {fast}"), "E0542", fast);
    }
    assert_eq!(said(&format!("{d}Rain = {{ rate = 24 }}")), []);
    only(
        &format!("{d}Light = {{ ramp = [0, 1], over = \"1 fortnight\" }}"),
        "E0543",
        "\"1 fortnight\"",
    );
    only(&format!("{d}Light = {{ steps = [[2, 1], [1, 5]] }}"), "E0543", "[1, 5]");
    only(&format!("{d}Light = {{ csv = \"none.csv\" }}"), "E0545", "\"none.csv\"");
    only(
        &format!("{d}Light = {{ csv = \"drive.csv\", column = \"sped\" }}"),
        "E0545",
        "\"drive.csv\"",
    );
    only(
        &format!("{d}Light = {{ csv = \"bad.csv\", column = \"speed\" }}"),
        "E0545",
        "\"bad.csv\"",
    );
    let fault = |what: &str| format!("[[fault]]\nat = 1\nfor = 1\n{what}");
    only(&fault("kind = \"no_answer\"\ndevice = \"Light\""), "E0544", "\"Light\"");
    only(&fault("kind = \"silent\"\ndevice = \"Rear\""), "E0544", "\"Rear\"");
    only(&fault("kind = \"reset\"\ndevice = \"Rear\""), "E0544", "\"Rear\"");
    only(&fault("kind = \"torm\"\ndevice = \"Rear\""), "E0541", "\"torm\"");
    only(&fault("kind = \"torn\"\ndevice = \"Raer\""), "E0541", "\"Raer\"");
}

#[test]
fn samples_are_joined_by_straight_lines() {
    with_job(BOARD, |job| {
        let text = "[devices]\nLight = { csv = \"drive.csv\", column = \"speed\" }";
        let (world, said) = read(job, text, 1);
        assert!(said.is_empty(), "{said:#?}");
        let signal = &world.signals.values().next().unwrap()[0];
        assert!((signal.at(500_000_000) - 15.0).abs() < 1e-9);
        assert!((signal.at(9_000_000_000) - 20.0).abs() < 1e-9);
    });
}

/// Times at which a device was reported.
fn times(world: &str, id: u8) -> Vec<u64> {
    let run = plainly(BOARD, world, 8);
    assert!(run.wrong().is_empty(), "{world}: {:#?}", run.wrong());
    let has = |values: &crate::run::Values| values.iter().any(|(of, _)| *of == id);
    run.reports.iter().filter(|(_, values)| has(values)).map(|(at, _)| at / 1_000_000).collect()
}

#[test]
fn what_breaks_is_silent_and_comes_back() {
    for (kind, device, id) in [
        ("no_answer", "Rear", 3),
        ("stuck_sda", "Rear", 3),
        ("hang", "Rear", 3),
        ("torn", "Rear", 3),
    ] {
        let world =
            format!("[[fault]]\nkind = \"{kind}\"\ndevice = \"{device}\"\nat = 2\nfor = 2\n");
        let times = times(&world, id);
        let during = times.iter().filter(|at| (2_300..4_000).contains(*at)).count();
        assert_eq!(during, 0, "{kind}");
        assert!(times.iter().any(|at| *at < 2_000), "{kind}");
        assert!(times.iter().any(|at| *at > 6_000), "{kind} never comes back");
    }
}

#[test]
fn a_board_that_was_reset_begins_anew() {
    let times = times("[[fault]]\nkind = \"reset\"\nat = 3\nfor = \"500 ms\"\n", 1);
    assert!(!times.iter().any(|at| (3_050..3_500).contains(at)), "{times:?}");
    assert!(times.iter().any(|at| (3_500..3_700).contains(at)), "{times:?}");
}

#[test]
fn garbage_on_the_link_costs_no_wrong_value() {
    let world = "[[fault]]\nkind = \"garbage\"\nat = 2\nfor = \"200 ms\"\n";
    let run = plainly(BOARD, world, 5);
    assert!(run.wrong().is_empty(), "{:#?}", run.wrong());
    assert!(run.dropped > 50, "{}", run.dropped);
}
