//! The screen as text: what stands where, for windows, boards and troubles of all sorts. `SENSEDSL_BLESS=1` writes the
//! texts in `expected/` and the pictures of `docs/monitor.md` again.

mod bench;

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::time::Duration;

use ratatui_core::buffer::Buffer;
use ratatui_core::style::{Color, Modifier};
use sensedsl_record::Past;
use sensedsl_wire::{Causes, Scalar, Status};

use super::picture::svg;
use super::style::Look;
use crate::commands::monitor::face::Ask;
use bench::{Bench, REPORT_MS, arguments, greenhouse, rover, text};

/// Compares a text with a file, or writes it.
fn blessed(path: &str, text: &str) {
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    if std::env::var_os("SENSEDSL_BLESS").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
    }
    let expected = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(expected == text, "{}: SENSEDSL_BLESS=1\n{text}", path.display());
}

fn is_all_shown(buffer: &Buffer) -> bool {
    buffer.content.iter().all(|cell| !cell.symbol().chars().any(char::is_control))
}

#[test]
fn four_sensors() {
    let (args, boards) = (arguments(), [rover("Rover")]);
    let mut bench = Bench::new(&args, &boards);
    bench.run(12_000, &[]);
    bench.health(0, &[]);
    blessed("src/commands/monitor/screen/expected/four-80x24.txt", &bench.text(80, 24));
    blessed("src/commands/monitor/screen/expected/four-200x60.txt", &bench.text(200, 60));
    let _ = bench.press(" «down» «down» ");
    bench.run(1_000, &[]);
    blessed("src/commands/monitor/screen/expected/plots-80x24.txt", &bench.text(80, 24));
    blessed("src/commands/monitor/screen/expected/plots-200x60.txt", &bench.text(200, 60));
}

#[test]
fn sixty_sensors() {
    let (args, boards) = (arguments(), [greenhouse(60)]);
    let mut bench = Bench::new(&args, &boards);
    bench.run(12_000, &[]);
    bench.health(0, &[]);
    blessed("src/commands/monitor/screen/expected/sixty-80x24.txt", &bench.text(80, 24));
    blessed("src/commands/monitor/screen/expected/sixty-200x60.txt", &bench.text(200, 60));
    let _ = bench.press("«end»");
    assert!(bench.text(80, 24).contains("Temperature59"));
    let _ = bench.press("«home»«page-down»");
    assert!(!bench.text(80, 24).contains("Temperature00"));
    let _ = bench.press("/e3«enter»");
    let found = bench.text(80, 24);
    assert!(found.contains("Temperature39") && !found.contains("Temperature03"), "{found}");
    let _ = bench.press("/x");
    assert!(bench.text(80, 24).contains("no device has `e3x` in its name"));
    let _ = bench.press("«esc»");
    assert!(bench.text(80, 24).contains("Temperature00"));
}

#[test]
fn several_boards_with_faults() {
    let (args, boards) = (arguments(), [rover("Left"), rover("Right")]);
    let mut bench = Bench::new(&args, &boards);
    bench.run(6_000, &[]);
    let timed_out = Causes { timed_out: 3, ..Causes::default() };
    let invalid = Causes { invalid: 1, ..Causes::default() };
    bench.health(
        0,
        &[
            (0, Status::Failed, timed_out),
            (1, Status::Good, invalid),
            (2, Status::Stale, Causes::default()),
        ],
    );
    let why = serde_json::json!({ "why": "the device is gone" });
    bench.replay(1, Past::Event(why));
    bench.run(4_000, &[1]);
    let shown = bench.text(100, 24);
    for expected in
        ["OFFLINE: the device is gone", "failed: 3 timed out", "1 invalid", "stale", "Right/Servo"]
    {
        assert!(shown.contains(expected), "{expected}:\n{shown}");
    }
    blessed("src/commands/monitor/screen/expected/faults-100x24.txt", &shown);
    blessed("src/commands/monitor/screen/expected/faults-80x24.txt", &bench.text(80, 24));
    // One that is silent while its board reports is overdue.
    bench.now_ms += 400;
    assert_eq!(bench.text(120, 30).matches("overdue").count(), 4);
}

#[test]
fn a_held_plot_stays_as_it_is() {
    let (args, boards) = (arguments(), [rover("Rover")]);
    let mut bench = Bench::new(&args, &boards);
    bench.run(30_000, &[]);
    let _ = bench.press(" «enter»f");
    let plot = |bench: &mut Bench<'_>| -> String {
        let text = bench.text(80, 24);
        text.lines().filter(|line| line.contains('│')).map(|line| format!("{line}\n")).collect()
    };
    let held = plot(&mut bench);
    blessed("src/commands/monitor/screen/expected/held-80x24.txt", &bench.text(80, 24));
    bench.run(5_000, &[]);
    assert_eq!(plot(&mut bench), held);
    let now = |bench: &mut Bench<'_>| bench.text(80, 24);
    assert!(now(&mut bench).contains("held, 5.0 s ago"));
    // The cursor tells the value that was there.
    let _ = bench.press("c");
    let at = bench.state.view.cursor.unwrap();
    let made = at.as_secs_f64() - (at.as_millis() as u64 / REPORT_MS * 7 % 5 + 1) as f64 / 1e3;
    let expected = 0.5 + 0.5 * (TAU * made / 8.0).sin();
    let expected =
        format!("a Distance {:.1}", f64::from((300.0 + 2_700.0 * expected) as u16) / 10.0);
    assert!(now(&mut bench).contains(&expected), "{expected}\n{}", now(&mut bench));
    let _ = bench.press("«esc»f");
    assert_ne!(plot(&mut bench), held);
    // More time, scrolled back, and to its oldest.
    let _ = bench.press("-«left»«left»");
    assert!(bench.state.view.is_frozen() && now(&mut bench).contains("held, 10.0 s ago"));
    let _ = bench.press("«end»");
    assert!(!bench.state.view.is_frozen());
    // How much a row of the axis is.
    let row = |bench: &mut Bench<'_>| -> f64 {
        let text = bench.text(80, 24);
        let all = text.lines().enumerate().filter_map(|(row, line)| {
            Some((row as f64, line.split_once('│')?.0.trim().parse::<f64>().ok()?))
        });
        let all: Vec<(f64, f64)> = all.collect();
        (all[0].1 - all[all.len() - 1].1) / (all[all.len() - 1].0 - all[0].0)
    };
    let whole = row(&mut bench);
    let _ = bench.press(">");
    let part = row(&mut bench);
    assert!((whole / part - 2.0).abs() < 0.2, "{whole} {part}");
    let _ = bench.press("v");
    assert_eq!(bench.state.view.magnified, 0);
}

#[test]
fn commands_are_checked_before_they_are_sent() {
    let (args, boards) = (arguments(), [rover("Left"), rover("Right")]);
    let mut bench = Bench::new(&args, &boards);
    bench.run(2_000, &[]);
    let sent = |asks: Vec<Ask>| -> Vec<(String, String)> {
        let texts = asks.into_iter().map(|ask| match ask {
            Ask::Set { name, text } => (name, text),
            Ask::Quit => ("quit".into(), String::new()),
        });
        texts.collect()
    };
    let of = |name: &str, text: &str| vec![(name.to_owned(), text.to_owned())];
    let asks = bench.press(":Left/Se«tab»45.5«enter»");
    assert_eq!(sent(asks), of("Left/Servo", "45.5"));
    // What is wrong stays, and is told below.
    let asks = bench.press(":Right/Servo=181«enter»");
    assert!(asks.is_empty());
    let shown = bench.text(80, 24);
    assert!(shown.ends_with(":Right/Servo=181\n181 deg is above the maximum of 180\n"), "{shown}");
    assert_eq!(sent(bench.press("«backspace»«backspace»0«enter»")), of("Right/Servo", "10"));
    let _ = bench.press(":Servo 1");
    assert!(bench.text(80, 24).contains("several boards have it: Left/Servo, Right/Servo"));
    let _ = bench.press("«esc»:Left/Lamp «tab»");
    assert!(bench.text(80, 24).contains("Enter sends true"));
    assert_eq!(sent(bench.press("«tab»«enter»")), of("Left/Lamp", "false"));
    // Keys that set the chosen actuator, from what it was set to last.
    let _ = bench.press("«down»«down»«down»«down»");
    assert_eq!(sent(bench.press("]")), of("Left/Servo", "2"));
    bench.replay(
        0,
        Past::Value { device: 4, stamp: None, latency: None, value: vec![Scalar::Unsigned(900)] },
    );
    assert_eq!(sent(bench.press("}")), of("Left/Servo", "110"));
    assert_eq!(sent(bench.press("[")), of("Left/Servo", "88"));
    assert_eq!(sent(bench.press("95«enter»")), of("Left/Servo", "95"));
    let _ = bench.press("«up»]");
    assert!(bench.text(80, 24).contains("choose an actuator"));
    assert_eq!(sent(bench.press("«ctrl-c»")), of("quit", ""));
    assert_eq!(sent(bench.press(":«ctrl-c»")), of("quit", ""));
    assert_eq!(sent(bench.press("«esc»q")), of("quit", ""));
}

#[test]
fn any_window_will_do() {
    let (args, boards) = (arguments(), [rover("Left"), rover("Right"), greenhouse(60)]);
    let mut bench = Bench::new(&args, &boards);
    bench.run(3_000, &[]);
    bench.state.notes.say(
        Duration::ZERO,
        "\u{1b}[2J a sentence with \u{202e} in it, which is longer than windows are wide",
    );
    for keys in [
        "",
        "    ",
        " «down» ",
        "«enter»",
        "fc",
        "«esc»«esc»?",
        "«down»«down»",
        "«esc»n",
        "«esc»/e",
        "«esc»:Left/Se",
        "rvo 1",
    ] {
        let _ = bench.press(keys);
        for (wide, high) in [
            (1, 1),
            (2, 2),
            (5, 3),
            (20, 5),
            (20, 1),
            (1, 20),
            (79, 7),
            (80, 24),
            (200, 60),
            (500, 200),
        ] {
            let buffer = bench.draw(wide, high);
            assert!(is_all_shown(&buffer), "{wide}x{high} after {keys}");
        }
    }
    let _ = bench.press("«esc»");
    let small = bench.text(20, 5);
    assert!(small.contains("3 boards") && small.contains(" cm"), "{small}");
}

#[test]
fn colours_are_those_of_the_terminal_or_none() {
    let (args, boards) = (arguments(), [rover("Rover")]);
    let mut bench = Bench::new(&args, &boards);
    bench.run(3_000, &[]);
    bench.health(0, &[(0, Status::Failed, Causes::default())]);
    let _ = bench.press(" ");
    let colours = |buffer: &Buffer| -> Vec<Color> {
        buffer
            .content
            .iter()
            .flat_map(|cell| [cell.fg, cell.bg])
            .filter(|colour| *colour != Color::Reset)
            .collect()
    };
    let with = colours(&bench.draw(120, 40));
    assert!(with.contains(&Color::Red) && with.contains(&Color::Green));
    assert!(!with.iter().any(|colour| matches!(colour, Color::Rgb(..) | Color::Indexed(_))));
    bench.look = Look { has_colours: false, has_shapes: false };
    let without = bench.draw(120, 40);
    assert!(colours(&without).is_empty());
    assert!(without.content.iter().any(|cell| cell.modifier.contains(Modifier::REVERSED)));
    let is_plain = |letter: char| letter.is_ascii() || "…›│↑↓←→".contains(letter);
    assert!(text(&without).chars().all(is_plain), "{}", text(&without));
    assert!(text(&without).contains(".:'"), "{}", text(&without));
}

/// The pictures of the documentation.
#[test]
fn pictures_are_of_this_screen() {
    let (args, boards) = (arguments(), [rover("Rover")]);
    let mut bench = Bench::new(&args, &boards);
    bench.run(34_000, &[]);
    bench.health(0, &[(1, Status::Good, Causes { timed_out: 2, ..Causes::default() })]);
    let _ = bench.press(" «down» ");
    bench.replay(
        0,
        Past::Value { device: 4, stamp: None, latency: None, value: vec![Scalar::Unsigned(455)] },
    );
    bench.state.notes.say(bench.moment().run, "sent: Servo = 455 (45.5 deg)");
    bench.run(2_500, &[]);
    let picture = svg(&bench.draw(110, 30), "A table and plots in a terminal");
    blessed("../../docs/pictures/monitor-screen.svg", &picture);
    let _ = bench.press("«enter»fc«left»");
    bench.run(4_000, &[]);
    let _ = bench.press(":Servo 181");
    let picture =
        svg(&bench.draw(110, 30), "A plot that is held, its cursor, and a command that is refused");
    blessed("../../docs/pictures/monitor-held.svg", &picture);
}
