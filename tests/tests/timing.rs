//! Computed times: the table, refusals with a way out, and groups that take turns.

use sensedsl_board::catalog;
use sensedsl_diagnostics::{Diagnostic, Severity};
use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_timing::{Part, Timing, check, timing};
use sensedsl_wiring::{Search, Solved, Wiring};

fn on(board: &str, devices: &str) -> (Timing, Vec<Diagnostic>) {
    let text = format!("board Bench on {board} {{ {devices} }}");
    let request = Request { path: "bench.sense", text: &text, board: None, target: None };
    let resolved = resolve(&request, &NoFiles);
    let errors = resolved.diagnostics.iter().filter(|one| one.severity == Severity::Error);
    assert_eq!(errors.count(), 0, "{:#?}", resolved.diagnostics);
    let design = resolved.design.unwrap();
    let Solved::Wired(wiring) = Wiring::new(&design, None).solve(&Search::default()) else {
        panic!("no wiring for {text}")
    };
    (timing(&design, &wiring), check(&design, &wiring))
}

fn discovery(devices: &str) -> (Timing, Vec<Diagnostic>) {
    on("STM32F407G_DISC1", &format!("link {{ transport = uart; unit = USART2; }} {devices}"))
}

fn sensor(number: usize, ty: &str, properties: &str) -> String {
    format!("sensor S{number} returns {ty} {{ id = {number}; type = {properties} }}\n")
}

/// The codes and help texts of all diagnostics.
fn reported(diagnostics: &[Diagnostic]) -> Vec<(&'static str, &str)> {
    let reported = |one: &'_ Diagnostic| one.code.info().code;
    diagnostics.iter().map(|one| (reported(one), one.help.as_deref().unwrap_or_default())).collect()
}

#[test]
fn the_exact_clock_is_in_the_table() {
    let hz = |asked: &str| {
        let device = sensor(1, "uint8", &format!("i2c; address = 0x20; speed = {asked};"));
        let (timing, _) = discovery(&device);
        let rows = timing.boards[0].rows.iter();
        rows.clone().find(|row| row.part == Part::Bus).unwrap().clock_hz
    };
    assert_eq!(hz("300 kHz"), Some(280_000));
    assert_eq!(hz("400 kHz"), Some(400_000));
}

/// Memory that the linker would refuse.
#[test]
fn what_the_memory_does_not_hold_is_refused() {
    let arrays = |count: usize| -> String {
        let array = |number: usize| {
            let properties =
                format!("i2c; address = {}; speed = 400 kHz; delay = 1 ms;", 7 + number);
            sensor(number, "float64[1024]", &properties.replace("1 ms", "3600000 ms"))
        };
        (1..=count).map(array).collect()
    };
    let (_, diagnostics) = discovery(&arrays(20));
    assert_eq!(reported(&diagnostics)[0].0, "E0626");
    assert_eq!(reported(&discovery(&arrays(3)).1), []);
}

#[test]
fn rangers_take_turns() {
    let rangers = |delay_ms: u32, extra: &str| -> String {
        let ranger = |number: usize| {
            let driver = if number == 3 { "icu; driver = hcsr04;" } else { "i2c; driver = srf08;" };
            let address =
                if number == 3 { String::new() } else { format!("address = 0x7{number};") };
            sensor(number, "uint16", &format!("{driver} {address} delay = {delay_ms}; {extra}"))
        };
        (1..=3).map(ranger).collect()
    };
    let (timing, diagnostics) = discovery(&rangers(200, ""));
    assert_eq!(reported(&diagnostics), []);
    let turns = |turn: &sensedsl_timing::Turn| (turn.start_ms, turn.measuring_ms, turn.overlaps);
    let turns: Vec<_> = timing.boards[0].turns.iter().map(turns).collect();
    assert_eq!(turns, [(0, 66, false), (66, 66, false), (132, 39, false)]);

    let (_, diagnostics) = discovery(&rangers(100, ""));
    let [("W0625", help)] = reported(&diagnostics)[..] else { panic!("{diagnostics:#?}") };
    assert!(help.contains("`delay = 171 ms;`"), "{help}");
    assert_eq!(reported(&discovery(&rangers(171, "")).1), []);
    let stated = discovery(&rangers(100, "group = front;")).1;
    assert_eq!(reported(&stated)[0].0, "E0624");
    assert_eq!(reported(&discovery(&rangers(100, "group = none;")).1), []);
}

/// If no profile states a fact, there is no figure, and nothing is refused because of it.
#[test]
fn a_fact_that_lacks_makes_no_figure() {
    let mut seen = 0;
    for entry in catalog::all() {
        let name = entry.name;
        if !name.starts_with("NUCLEO") || name.contains("F4") {
            continue;
        }
        let device =
            "sensor A returns uint16 { id = 1; type = analog; delay = 1; samples = 1024; }";
        let text = format!("board Bench on {} {{ {device} }}", name.replace('-', "_"));
        let request = Request { path: "bench.sense", text: &text, board: None, target: None };
        let Some(design) = resolve(&request, &NoFiles).design else { continue };
        let Solved::Wired(wiring) = Wiring::new(&design, None).solve(&Search::default()) else {
            continue;
        };
        let timing = timing(&design, &wiring);
        let known =
            |row: &&sensedsl_timing::Row| row.part == Part::Processor && row.busy_ns.is_some();
        assert!(!timing.boards[0].rows.iter().any(|row| known(&row)), "{name}");
        seen += 1;
    }
    assert!(seen > 5, "{seen}");
}
