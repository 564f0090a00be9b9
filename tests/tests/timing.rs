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
fn said(diagnostics: &[Diagnostic]) -> Vec<(&'static str, &str)> {
    let said = |one: &'_ Diagnostic| one.code.info().code;
    diagnostics.iter().map(|one| (said(one), one.help.as_deref().unwrap_or_default())).collect()
}

/// The shortest delay that the message proposes, after a check that it is sufficient: with this
/// delay there is no error.
fn shortest(properties: &str, ty: &str, delay_ms: u32) -> u32 {
    let device = |delay_ms: u32| sensor(1, ty, &format!("{properties} delay = {delay_ms} ms;"));
    let fast = |devices: &str| {
        on("STM32F407G_DISC1", &format!("link {{ transport = uart; baud = 2625000; }} {devices}"))
    };
    let (_, diagnostics) = fast(&device(delay_ms));
    let [("E0621", help)] = said(&diagnostics)[..] else { panic!("{diagnostics:#?}") };
    let least = help.split("`delay = ").nth(1).unwrap().split(' ').next().unwrap();
    let least_ms: u32 = least.parse().unwrap();
    let errors = |delay_ms| {
        let (_, diagnostics) = fast(&device(delay_ms));
        diagnostics.iter().any(|one| one.severity == Severity::Error)
    };
    assert!(!errors(least_ms) && errors(least_ms - 1), "{least_ms} is not the shortest");
    least_ms
}

#[test]
fn a_delay_that_cannot_be_kept_is_refused_with_the_shortest_that_can() {
    // 2048 conversions of 492 clocks at 21 MHz take 23.99 ms for a sensor.
    assert_eq!(shortest("analog; samples = 1024; sampling = 480;", "uint16", 1), 25);
    // 1027 bytes of 9 clocks and three conditions at 100 kHz take 92.5 ms, and their values take
    // 0.6 ms of processor time.
    assert_eq!(
        shortest("i2c; address = 0x20; register = 0; length = 1024;", "uint8[1024]", 10),
        94
    );
}

#[test]
fn what_shares_a_unit_is_added_up() {
    let two = |delay_ms| {
        sensor(1, "uint8[512]", &format!("i2c; address = 0x20; unit = I2C1; delay = {delay_ms};"))
            + &sensor(2, "uint8[512]", "i2c; address = 0x21; unit = I2C1; delay = 100;")
    };
    let link = |devices: &str| {
        on("STM32F407G_DISC1", &format!("link {{ transport = uart; baud = 921600; }} {devices}")).1
    };
    assert_eq!(
        said(&link(&two(150))),
        [(
            "W0623",
            "give it longer cycle times; `sensedsl explain timing` says what takes how long"
        )]
    );
    let refused = link(&two(60));
    assert_eq!(refused[0].code.info().code, "E0621");
    assert!(refused[0].message.contains("I2C1 is asked to be busy 123 %"), "{refused:#?}");
    assert!(refused[0].help.as_ref().unwrap().contains("`delay = 86 ms;`"), "{refused:#?}");
}

#[test]
fn clocks_that_cannot_be_made_are_refused_with_one_that_can() {
    let i2c = |speed: &str| sensor(1, "uint8", &format!("i2c; address = 0x20; speed = {speed};"));
    let icu = |tick: &str| sensor(1, "uint32", &format!("icu; unit = TIM4; resolution = {tick};"));
    let refused = [
        (i2c("1 kHz"), "`speed = 5250 Hz;`"),
        (icu("13 kHz"), "`resolution = 13125 Hz;`"),
        (icu("1 Hz"), "`resolution = 1344 Hz;`"),
        (sensor(1, "uint16", "analog; sampling = 481;"), "`sampling = 480;`"),
        (sensor(1, "uint8", "spi; clock = 1 kHz;"), "`clock = "),
        (sensor(1, "uint8", "uart; baud = 10000000;"), "within 2 %"),
        (sensor(1, "uint8", "can; frame = 1; bitrate = 800 kHz;"), "807692 Hz"),
    ];
    for (device, way_out) in refused {
        let (_, diagnostics) = discovery(&device);
        let [("E0620", help)] = said(&diagnostics)[..] else { panic!("{device}{diagnostics:#?}") };
        assert!(help.contains(way_out), "{help}");
    }
    for device in [i2c("300 kHz"), i2c("5250 Hz"), i2c("1 MHz"), icu("84 MHz")] {
        assert_eq!(said(&discovery(&device).1), [], "{device}");
    }
    // 79.96 MHz has no divisor for exactly one microsecond; 999,500 ticks per second are near
    // enough.
    for (tick, codes) in [("1 us", &[][..]), ("900 kHz", &["E0620"])] {
        let wheel = sensor(1, "uint32", &format!("icu; mode = width; resolution = {tick};"));
        let (_, diagnostics) = on("NUCLEO_L432KC", &wheel);
        let found: Vec<&str> = diagnostics.iter().map(|one| one.code.info().code).collect();
        assert_eq!(found, codes, "{tick}");
    }
    for baud in ["10000000", "3000000"] {
        let link = format!("link {{ transport = uart; unit = USART2; baud = {baud}; }}");
        let (_, diagnostics) = on("STM32F407G_DISC1", &(link + &sensor(1, "uint16", "analog;")));
        assert_eq!(said(&diagnostics)[0].0, "E0620", "{baud}");
    }
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

#[test]
fn a_link_that_is_too_slow_is_refused() {
    let block = sensor(1, "uint8[512]", "i2c; address = 0x20; speed = 400 kHz; delay = 20;");
    let link = |baud| format!("link {{ transport = uart; unit = USART2; baud = {baud}; }}{block}");
    assert_eq!(said(&on("STM32F407G_DISC1", &link(115_200)).1)[0].0, "E0622");
    assert_eq!(said(&on("STM32F407G_DISC1", &link(921_600)).1), []);
    // With a rate, values are left out instead.
    let rated = link(115_200).replace("}s", "rate = 10 Hz; }s");
    assert_eq!(said(&on("STM32F407G_DISC1", &rated).1), []);
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
    assert_eq!(said(&diagnostics)[0].0, "E0626");
    assert_eq!(said(&discovery(&arrays(3)).1), []);
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
    assert_eq!(said(&diagnostics), []);
    let turns = |turn: &sensedsl_timing::Turn| (turn.start_ms, turn.measuring_ms, turn.overlaps);
    let turns: Vec<_> = timing.boards[0].turns.iter().map(turns).collect();
    assert_eq!(turns, [(0, 66, false), (66, 66, false), (132, 39, false)]);

    let (_, diagnostics) = discovery(&rangers(100, ""));
    let [("W0625", help)] = said(&diagnostics)[..] else { panic!("{diagnostics:#?}") };
    assert!(help.contains("`delay = 171 ms;`"), "{help}");
    assert_eq!(said(&discovery(&rangers(171, "")).1), []);
    let stated = discovery(&rangers(100, "group = front;")).1;
    assert_eq!(said(&stated)[0].0, "E0624");
    assert_eq!(said(&discovery(&rangers(100, "group = none;")).1), []);
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
