//! Behaviour that scripts rely on: exit statuses, the two streams, `-`, quiet and colourless
//! output, pipes that are closed, and paths that are not regular files.

use std::process::{Command, Stdio};

use sensedsl_tests::{
    TempDir, binary, files, has, is_exhaustive, one_in, read, root, sensedsl, text,
};
use serde_json::Value;

const FIG2: &str = "examples/fig2.sense";
const WRONG: &str =
    "board STM32F4DiscoveryBoard { sensor A returns uint16 { id = 0; type = analog; } }";

/// The commands that `--help` lists.
fn commands(help: &str) -> impl Iterator<Item = &str> {
    let listed = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let listed = listed.take_while(|line| !line.is_empty());
    // A long description goes on in lines that are indented further.
    let named = listed.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    named.filter_map(|line| line.split_whitespace().next()).filter(|one| *one != "help")
}

#[test]
fn every_command_has_a_call_whose_exit_status_is_checked() {
    let script = text("tests/scripts/command_line.txt");
    let rows: Vec<&str> =
        script.lines().filter_map(|line| Some(line.split_once(" | ")?.1)).collect();
    let help = sensedsl(["--help"]).run().exits(0).stdout;
    assert!(commands(&help).count() > 10, "{help}");
    for command in commands(&help) {
        let is_called = |row: &&str| row.split_whitespace().next() == Some(command);
        assert!(rows.iter().any(|row| is_called(row)), "no row of {command}");
    }
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
    let scratch = TempDir::new("fmt");
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
    let scratch = TempDir::new("new");
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

/// A shell that has read the script is given boards, drivers, MCU parts, targets, codes and files, and nothing else.
#[test]
fn shells_complete_names() {
    if !has("bash") {
        return;
    }
    let tools = binary().parent().unwrap().display().to_string();
    let path = format!("{tools}:{}", std::env::var("PATH").unwrap_or_default());
    let completed = |line: &str| {
        let typed = line.rsplit(' ').next().unwrap();
        let script = format!(
            "source <(sensedsl completions bash); COMP_WORDS=({} '{typed}'); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); \
             _clap_complete_sensedsl sensedsl '{typed}'; printf '%s\\n' \"${{COMPREPLY[@]}}\"",
            line.strip_suffix(typed).unwrap()
        );
        let mut bash = Command::new("bash");
        bash.args(["-c", &script]).current_dir(root()).env("PATH", &path);
        let output = bash.output().unwrap();
        let text = String::from_utf8(output.stdout).unwrap();
        text.lines().map(|line| line.trim().to_owned()).collect::<Vec<_>>()
    };
    for (line, wanted) in [
        ("sensedsl drivers mpu6050_", "mpu6050_acceleration mpu6050_rate"),
        ("sensedsl boards NUCLEO-F40", "NUCLEO-F401RE"),
        ("sensedsl new car --template r", "rover"),
        ("sensedsl parts --table stm32f407vg", "STM32F407VGT6"),
        ("sensedsl parts x.sense --against STM32F407G-D", "STM32F407G-DISC1"),
        ("sensedsl solve x.sense --target emb", "embassy embassy-0.6"),
        ("sensedsl explain E0203", "E0203"),
        ("sensedsl solve examples/mini", "examples/miniature_car.sense"),
    ] {
        assert_eq!(completed(line).join(" "), wanted, "{line}");
    }
}

/// The starter design has what the board can carry, and firmware if the board has any.
#[test]
fn new_works_for_every_board() {
    let scratch = TempDir::new("new_everywhere");
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
            // Boards of one kind are alike: all of them are tried where minutes do not count.
            let step = if is_exhaustive() { 1 } else { 3 };
            let chosen = one_in(6, part.iter().step_by(step));
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
    let scratch = TempDir::new("odd");
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
    // The importer guesses.
    let latin1 = sensedsl(["import", "-"]).stdin(*b"Pin;I\xb2C\nPB6;I2C1-SCL\n").run().exits(0);
    assert!(latin1.stdout.contains("I²C") && latin1.stderr.contains("B1: byte 5 (0xB2)"));
    let binary = sensedsl(["import", "-"]).stdin(*b"\x7fELF\x00\x01").run().exits(1);
    assert!(binary.stdout.is_empty() && binary.stderr.contains("E0801"));
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
    let scratch = TempDir::new("chip-explained");
    let file = scratch.write("robot.sense", text).display().to_string();
    let why = sensedsl(["explain", "wiring", &file, "Left", "-q"]).run().exits(0).stdout;
    for wire in ["pwm", "in1", "in2", "standby"] {
        assert!(why.contains(&format!("\n  {wire} ")), "{wire}: {why}");
    }
    // The most useful facts come first; `--all` prints the whole list.
    assert!(
        why.lines().count() < 34 && why.lines().all(|line| line.chars().count() <= 100),
        "{why}"
    );
    let all = sensedsl(["explain", "wiring", &file, "Left", "-q", "--all"]).run().exits(0).stdout;
    let reported = format!("`--all` lists all {} places", all.lines().count() - 1);
    assert!(all.lines().count() > 100 && why.contains(&reported), "{why}\n{all}");
    let chosen: Vec<&str> = all.lines().filter(|line| line.ends_with(" chosen")).collect();
    for (line, first) in chosen.iter().zip(why.lines().skip(1)) {
        let [role, pin] = [0, 1].map(|at| line.split_whitespace().nth(at));
        let [shown_role, shown_pin] = [0, 1].map(|at| first.split_whitespace().nth(at));
        assert_eq!((role, pin), (shown_role, shown_pin), "{why}");
    }
    let unknown = sensedsl(["explain", "wiring", &file, "Lef"]).run().exits(2).stderr;
    assert!(unknown.contains("no device or chip Lef; did you mean Left?"), "{unknown}");
}
