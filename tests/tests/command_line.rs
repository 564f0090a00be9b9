//! Behaviour that scripts rely on: exit statuses, the two streams, `-`, quiet and colourless
//! output, pipes that are closed, and paths that are not regular files.

use std::process::{Command, Stdio};

use sensedsl_tests::{Scratch, binary, design, files, is_thorough, read, root, sensedsl, text};
use serde_json::Value;

const FIG2: &str = "examples/fig2.sense";
const WRONG: &str =
    "board STM32F4DiscoveryBoard { sensor A returns uint16 { id = 0; type = analog; } }";

/// Checks the exit status of a call with this standard input.
#[track_caller]
fn exits(arguments: &[&str], stdin: &str, status: i32) {
    let ran = sensedsl(arguments).stdin(stdin).run();
    let (out, err) = (&ran.stdout, &ran.stderr);
    assert_eq!(ran.status, status, "{arguments:?}\nstdout: {out}\nstderr: {err}");
    if status == 2 {
        assert!(!err.is_empty(), "{arguments:?} fails without a word");
    }
}

/// The commands that `--help` lists.
fn commands(help: &str) -> impl Iterator<Item = &str> {
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let listed = listed.take_while(|line| !line.is_empty());
    // A long description goes on in lines that are indented further.
    let named = listed.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    named.filter_map(|line| line.split_whitespace().next()).filter(|one| *one != "help")
}

#[test]
fn exit_status_of_every_command() {
    let scratch = Scratch::new("status");
    let path = |name: &str| scratch.join(name).display().to_string();
    let ten = design("STM32F4DiscoveryBoard", &["analog"; 10]);
    let (new, out) = (path("new"), path("out"));
    let full = path("full");
    scratch.write("full/mine.txt", "mine");
    let folder = scratch.path().display().to_string();
    let cases: &[(&[&str], &str, i32)] = &[
        (&["check", FIG2], "", 0),
        (&["check", "-"], WRONG, 1),
        (&["check", "-"], &ten, 1),
        (&["check", FIG2, "examples/miniature_car.sense"], "", 0),
        (&["check"], "", 2),
        (&["check", "no such file"], "", 2),
        (&["check", &folder], "", 2),
        (&["check", FIG2, "--format", "yaml"], "", 2),
        (&["solve", FIG2], "", 0),
        (&["solve", "-"], WRONG, 1),
        (&["solve", "-"], &ten, 1),
        (&["solve", "-", "--any"], &ten, 1),
        (&["solve", "-", "--count"], &ten, 1),
        (&["solve", "-", "--all"], &ten, 1),
        (&["solve", "no such file"], "", 2),
        (&["solve", FIG2, "--keep", "no such file"], "", 2),
        (&["solve", FIG2, "--keep", FIG2], "", 2),
        (&["solve", FIG2, "--board", "no/such.csv"], "", 2),
        (&["solve", FIG2, "--board", "nosuch"], "", 2),
        (&["solve", FIG2, "--target", "nosuch"], "", 2),
        (&["solve", FIG2, "--all", "--count"], "", 2),
        (&["solve", FIG2, "--limit", "many"], "", 2),
        (&["generate", FIG2, "-o", &out], "", 0),
        (&["generate", FIG2, "-o", &out, "--check"], "", 0),
        (&["generate", "examples/miniature_car.sense", "-o", &out, "--check"], "", 1),
        (&["generate", "-", "-o", &out], WRONG, 1),
        (&["generate", "-", "-o", &out], &ten, 1),
        (&["generate", FIG2, "-o", &full], "", 1),
        (&["generate", FIG2, "-o", &out, "--host", "nosuch"], "", 2),
        (&["generate", FIG2, "-o", FIG2], "", 2),
        (&["generate", FIG2], "", 2),
        (&["explain"], "", 0),
        (&["explain", "E0203"], "", 0),
        (&["explain", "e0203"], "", 0),
        (&["explain", "E9999"], "", 2),
        (&["boards"], "", 0),
        (&["boards", "STM32F407G-DISC1"], "", 0),
        (&["boards", "nosuch"], "", 2),
        (&["fmt", "-"], WRONG, 0),
        (&["fmt", "-"], "board {", 1),
        (&["fmt", "-", "--check"], WRONG, 1),
        (&["fmt", FIG2, "--check"], "", 0),
        (&["fmt", "no such file"], "", 2),
        (&["new", &new], "", 0),
        (&["new", &new], "", 0),
        (&["new", &full], "", 2),
        (&["new", &path("car.sense")], "", 2),
        (&["new", &path("other"), "--board", "nosuch"], "", 2),
        (&["build", "no such file"], "", 2),
        (&["flash", "no such file"], "", 2),
        (&["simulate", "-"], WRONG, 1),
        (&["capacity", "-"], WRONG, 1),
        (&["diff", "no such file", "no such file"], "", 2),
        (&["parts", "-"], WRONG, 1),
        (&["drivers"], "", 0),
        (&["drivers", "nosuch"], "", 2),
        (&["import", "no such file"], "", 2),
        (&["completions", "bash"], "", 0),
        (&["completions", "cobol"], "", 2),
        (&["man"], "", 0),
        (&["nosuch"], "", 2),
        (&["--version"], "", 0),
        (&["--help"], "", 0),
        (&[], "", 2),
    ];
    let help = sensedsl(["--help"]).run().exits(0).stdout;
    for command in commands(&help) {
        assert!(cases.iter().any(|case| case.0.first() == Some(&command)), "no case of {command}");
    }
    for (arguments, stdin, status) in cases {
        exits(arguments, stdin, *status);
    }
}

/// Shells complete built-in boards where only a board can come, and any name of a board is
/// accepted.
#[test]
fn names_of_boards_are_completed() {
    let script = sensedsl(["completions", "bash"]).run().exits(0).stdout;
    let lists = script.lines().filter(|line| line.contains("ARDUINO-UNO-R3")).count();
    assert_eq!(lists, 2, "`boards NAME` and `new --board`");
    let help = sensedsl(["new", "--help"]).run().exits(0).stdout;
    assert!(!help.contains("ARDUINO-UNO-R3"), "{help}");
    let of_alias = sensedsl(["boards", "uno_r3"]).run().exits(0).stdout;
    assert_eq!(of_alias, sensedsl(["boards", "ARDUINO-UNO-R3"]).run().exits(0).stdout);
}

#[test]
fn result_and_messages_go_to_their_own_streams() {
    let ran = sensedsl(["solve", FIG2, "--format", "json"]).run().exits(0);
    assert!(ran.json().is_object());
    assert!(ran.stderr.contains("W0602"), "{}", ran.stderr);
    let quiet = sensedsl(["solve", FIG2, "--format", "json", "-q"]).run().exits(0);
    assert_eq!(quiet.stdout, ran.stdout);
    assert_eq!(quiet.stderr, "");
    let check = sensedsl(["check", FIG2, "--format", "json"]).run().exits(0);
    assert_eq!(check.stderr, "");
    let quiet = sensedsl(["-q", "check", FIG2]).run().exits(0);
    assert_eq!((quiet.stdout.as_str(), quiet.stderr.as_str()), ("", ""));
    let quiet = sensedsl(["check", "-", "-q"]).stdin(WRONG).run().exits(1);
    assert!(quiet.stderr.contains("error[E0211]"), "errors are said even so: {}", quiet.stderr);
}

#[test]
fn diagnostics_as_json_have_the_fixed_form() {
    let ran = sensedsl(["check", "-", "--format", "json"]).stdin(WRONG).run().exits(1);
    let value = ran.json();
    let one = &value["diagnostics"][0];
    let keys: Vec<&str> = one.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(keys[..7], ["code", "severity", "message", "file", "start", "end", "help"]);
    assert_eq!(one["code"], "E0211");
    assert_eq!(one["severity"], "error");
    assert_eq!(one["file"], "<stdin>");
    assert_eq!(one["start"], serde_json::json!({ "line": 1, "column": 62 }));
    assert_eq!(one["end"], serde_json::json!({ "line": 1, "column": 63 }));
    let clean = design("STM32F4DiscoveryBoard", &["analog"]);
    let ran = sensedsl(["check", "-", "--format", "json"]).stdin(clean).run().exits(0);
    assert_eq!(ran.json(), serde_json::json!({ "diagnostics": [] }));
}

#[test]
fn sarif_and_github_say_the_same_places() {
    let sarif = sensedsl(["check", "-", "--format", "sarif"]).stdin(WRONG).run().exits(1).json();
    assert_eq!(sarif["version"], "2.1.0");
    let result = &sarif["runs"][0]["results"][0];
    assert_eq!(result["ruleId"], "E0211");
    let region = &result["locations"][0]["physicalLocation"]["region"];
    assert_eq!((region["startLine"].as_u64(), region["startColumn"].as_u64()), (Some(1), Some(62)));
    let github = sensedsl(["check", "-", "--format", "github"]).stdin(WRONG).run().exits(1).stdout;
    assert!(github.starts_with("::error file=<stdin>,line=1,endLine=1,col=62"), "{github}");
    let two = sensedsl(["check", FIG2, FIG2, "--format", "sarif"]).run().exits(0).json();
    assert_eq!(two["runs"].as_array().map(Vec::len), Some(2));
}

#[test]
fn the_standard_input_is_a_file_like_any_other() {
    let from_file = sensedsl(["solve", FIG2, "-q"]).run().exits(0).stdout;
    let from_stdin = sensedsl(["solve", "-", "-q"]).stdin(text(FIG2)).run().exits(0).stdout;
    assert_eq!(from_file, from_stdin);
    let table = text("crates/board/boards/STM32F4DiscoveryBoard/pins.csv");
    let ran = sensedsl(["solve", FIG2, "-q", "--board", "-"]).stdin(table).run().exits(0);
    assert_eq!(ran.stdout, from_file);
    let kept = sensedsl(["solve", FIG2, "-q", "--format", "json"]).run().exits(0).stdout;
    let ran = sensedsl(["solve", FIG2, "-q", "--keep", "-"]).stdin(kept).run().exits(0);
    assert_eq!(ran.stdout, from_file);
}

#[test]
fn colours_only_where_asked_for() {
    for forced in [false, true] {
        let call = sensedsl(["check", "-"]).stdin(WRONG);
        let call = if forced { call.env("CLICOLOR_FORCE", "1") } else { call };
        let ran = call.run().exits(1);
        assert_eq!(ran.stderr.contains('\u{1b}'), forced, "{:?}", ran.stderr);
        let call = sensedsl(["check", "-"]).stdin(WRONG).env("NO_COLOR", "1");
        assert!(!call.run().stderr.contains('\u{1b}'));
    }
}

#[test]
fn a_reader_that_has_seen_enough_is_no_failure() {
    let arguments = ["solve", FIG2, "-q", "--all", "--target", "none", "--format", "json"];
    let mut child = Command::new(binary())
        .args(arguments)
        .current_dir(root())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

#[test]
fn the_layout_is_canonical_once_and_for_all() {
    let scratch = Scratch::new("fmt");
    let ugly = "/* a */board   B on STM32F4DiscoveryBoard{sensor A returns uint16\n{id=1;// one\n type=analog;}}";
    let file = scratch.write("ugly.sense", ugly);
    let name = file.display().to_string();
    let _ = sensedsl(["fmt", "--check", &name]).run().exits(1);
    assert_eq!(read(&file), ugly, "--check changes nothing");
    let _ = sensedsl(["fmt", &name]).run().exits(0);
    let pretty = read(&file);
    assert!(pretty.contains("/* a */") && pretty.contains("// one"), "{pretty}");
    let _ = sensedsl(["fmt", "--check", &name]).run().exits(0);
    let _ = sensedsl(["fmt", &name]).run().exits(0);
    assert_eq!(read(&file), pretty);
    assert_eq!(sensedsl(["fmt", "-"]).stdin(ugly).run().exits(0).stdout, pretty);
    assert_eq!(sensedsl(["fmt", "-"]).stdin(pretty.clone()).run().exits(0).stdout, pretty);
    for path in shipped() {
        let name = path.display().to_string();
        let _ = sensedsl(["fmt", "--check", &name]).run().exits(0);
    }
}

/// All `.sense` files that ship with the tool.
fn shipped() -> Vec<std::path::PathBuf> {
    let mut all = files(&root().join("examples"), "sense");
    all.extend(files(&root().join("crates/model/drivers"), "sense"));
    assert!(all.len() >= 6);
    all
}

#[test]
fn what_new_makes_works_at_once() {
    let scratch = Scratch::new("new");
    for board in ["STM32F4DiscoveryBoard", "STM32F407G-DISC1"] {
        let dir = scratch.join(board);
        let folder = dir.display().to_string();
        let ran = sensedsl(["new", &folder, "--board", board]).run().exits(0);
        assert!(ran.stdout.contains("sensedsl solve"), "{}", ran.stdout);
        let file = dir.join("robot.sense").display().to_string();
        let check = sensedsl(["check", &file, "--format", "json"]).run().exits(0).json();
        // An LED on a pin of the complete board gives a warning, whatever is connected.
        let other = |one: &Value| one["code"] != "W0605";
        assert!(!check["diagnostics"].as_array().unwrap().iter().any(other), "{check:#}");
        let _ = sensedsl(["fmt", "--check", &file]).run().exits(0);
        let _ = sensedsl(["solve", &file]).run().exits(0);
        let build = dir.join("build").display().to_string();
        let _ = sensedsl(["generate", &file, "-o", &build]).run().exits(0);
    }
}

/// The starter design has what the board can carry, and firmware if the board has any.
#[test]
fn new_works_for_every_board() {
    let scratch = Scratch::new("new_everywhere");
    let boards = sensedsl_board::catalog::all();
    let works = |name: &str| {
        let dir = scratch.join(name);
        let folder = dir.display().to_string();
        let _ = sensedsl(["new", &folder, "--board", name]).run().exits(0);
        let file = dir.join("robot.sense").display().to_string();
        let _ = sensedsl(["check", "-q", &file]).run().exits(0);
        let _ = sensedsl(["fmt", "--check", &file]).run().exits(0);
        let answer = sensedsl(["solve", "-q", &file, "--format", "json"]).run().exits(0).json();
        let devices = answer["boards"][0]["devices"].as_array().unwrap().len();
        assert!(devices >= 2, "{name} begins with {devices} devices");
        let readme = std::fs::read_to_string(dir.join("README.md")).unwrap();
        if readme.contains("sensedsl build") {
            let build = dir.join("build").display().to_string();
            let _ = sensedsl(["generate", "-q", &file, "-o", &build]).run().exits(0);
        }
    };
    std::thread::scope(|scope| {
        for part in boards.chunks(boards.len().div_ceil(4)) {
            let chosen = part.iter().step_by(if is_thorough() { 1 } else { 3 });
            scope.spawn(|| chosen.for_each(|board| works(board.name)));
        }
    });
}

#[test]
fn every_code_is_explained() {
    let list = sensedsl(["explain"]).run().exits(0).stdout;
    assert!(list.lines().count() > 50);
    for line in list.lines() {
        let (code, title) = line.split_once("  ").unwrap();
        let long = sensedsl(["explain", code]).run().exits(0).stdout;
        assert!(long.starts_with(&format!("{code}: {title}")), "{long}");
        assert!(long.contains("Way out:"), "{long}");
    }
    let near = sensedsl(["explain", "E203"]).run().exits(2).stderr;
    assert!(near.contains("did you mean E0203?"), "{near}");
}

#[test]
fn files_that_are_none_are_refused_in_words() {
    let scratch = Scratch::new("odd");
    let cases: &[(&str, &[u8], &str)] = &[
        ("latin1.sense", b"// K\xfchler\n", "UTF-8"),
        ("binary.sense", &[0xff, 0xfe, 0x00], "UTF-8"),
    ];
    for (name, bytes, why) in cases {
        let path = scratch.write(name, bytes).display().to_string();
        let ran = sensedsl(["check", &path]).run().exits(2);
        assert!(ran.stderr.contains(why) && ran.stderr.contains(name), "{}", ran.stderr);
    }
    let table = scratch.write("latin1.csv", b"Pin,ADC\nPA1,K\xfchler\n").display().to_string();
    let ran = sensedsl(["solve", FIG2, "--board", &table]).run().exits(2);
    assert!(ran.stderr.contains("E0302") && ran.stderr.contains("UTF-8"), "{}", ran.stderr);
    let endless = sensedsl(["check", "/dev/zero"]).run().exits(2);
    assert!(endless.stderr.contains("it is a device"), "{}", endless.stderr);
}

#[test]
fn byte_order_marks_and_line_ends_of_windows_are_read() {
    let unix = text(FIG2);
    let expected = sensedsl(["solve", FIG2, "-q"]).run().exits(0).stdout;
    let windows = unix.replace('\n', "\r\n");
    for text in [format!("\u{feff}{unix}"), windows.clone(), format!("\u{feff}{windows}")] {
        assert_eq!(sensedsl(["solve", "-", "-q"]).stdin(text).run().exits(0).stdout, expected);
    }
    let table = sensedsl(["boards", "STM32F4DiscoveryBoard"]).run().stdout;
    let table = format!("\u{feff}{}", table.replace('\n', "\r\n"));
    let ran = sensedsl(["solve", FIG2, "-q", "--board", "-"]).stdin(table).run().exits(0);
    assert_eq!(ran.stdout, expected);
}

#[test]
fn a_file_of_nothing_but_mistakes_is_answered_briefly() {
    let devices = "sensor A returns uint16 { id = 1; type = analog; }\n".repeat(1_500);
    let ran = sensedsl(["check", "-"]).stdin(devices).run().exits(1);
    assert!(ran.stderr.len() < 100_000, "{} bytes", ran.stderr.len());
    assert!(ran.stderr.contains(" more ("), "says that there is more");
    let open = "[".repeat(100_000);
    for text in [open.clone(), format!("driver a for i2c {{ trigger = {open}"), "/*".repeat(50_000)]
    {
        let _ = sensedsl(["check", "-"]).stdin(text).run().exits(1);
    }
}

/// A chip is explained by its name, with the pins of all its connections, including those without a
/// value.
#[test]
fn a_chip_is_explained() {
    let text = "board STM32F407G_DISC1 { chip Left { driver = gearmotor_tb6612; actuator Speed accepts int16 {} } }";
    let scratch = Scratch::new("chip-explained");
    let file = scratch.write("robot.sense", text).display().to_string();
    let why = sensedsl(["explain", "wiring", &file, "Left", "-q"]).run().exits(0).stdout;
    for wire in ["pwm", "in1", "in2", "standby"] {
        assert!(why.contains(&format!("\n  {wire} ")), "{wire}: {why}");
    }
    // The most useful facts come first; `--all` prints the whole list.
    assert!(
        why.lines().count() < 30 && why.lines().all(|line| line.chars().count() <= 100),
        "{why}"
    );
    let all = sensedsl(["explain", "wiring", &file, "Left", "-q", "--all"]).run().exits(0).stdout;
    let told = format!("`--all` lists all {} places", all.lines().count() - 1);
    assert!(all.lines().count() > 100 && why.contains(&told), "{why}\n{all}");
    let chosen: Vec<&str> = all.lines().filter(|line| line.ends_with(" chosen")).collect();
    for (line, first) in chosen.iter().zip(why.lines().skip(1)) {
        let [role, pin] = [0, 1].map(|at| line.split_whitespace().nth(at));
        let [shown_role, shown_pin] = [0, 1].map(|at| first.split_whitespace().nth(at));
        assert_eq!((role, pin), (shown_role, shown_pin), "{why}");
    }
    let unknown = sensedsl(["explain", "wiring", &file, "Lef"]).run().exits(2).stderr;
    assert!(unknown.contains("no device or chip Lef; did you mean Left?"), "{unknown}");
}

/// Without a system, a timer's channel is a signal by itself, and rules about units apply to the
/// timer that it names.
#[test]
fn a_wish_for_a_timer_decides_between_the_signals_of_a_pin() {
    let of = |wish: &str| {
        let text = format!(
            "board STM32F407G_DISC1 {{ target = none; actuator P accepts uint16 {{ type = pwm; pin = PA1; {wish} }} }}"
        );
        let ran = sensedsl(["solve", "-", "-q", "--format", "json"]).stdin(text).run().exits(0);
        let answer = ran.json();
        let wire = answer["boards"][0]["devices"][0]["wires"][0]["signal"].clone();
        (wire.as_str().unwrap_or_default().to_owned(), answer["violated"].clone())
    };
    for (wish, signal) in [
        ("", "TIM2_CH2"),
        ("prefer unit = TIM5;", "TIM5_CH2"),
        ("avoid unit = TIM2;", "TIM5_CH2"),
        ("avoid unit = TIM5;", "TIM2_CH2"),
    ] {
        let (found, violated) = of(wish);
        assert_eq!(found, signal, "{wish}: {violated}");
    }
}
