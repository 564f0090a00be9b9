//! `sensedsl parts`: which parts and boards can carry a file, what they cost, and the lists.

use std::io::{BufRead as _, BufReader};
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

use sensedsl_tests::{TempDir, binary, design, root, sensedsl};
use serde_json::Value;

/// The lines that `parts` prints for a file.
fn carriers(file: &str, arguments: &[&str]) -> Vec<Value> {
    let call = sensedsl(["parts", "--format", "json"]).arg(file);
    let call = if arguments.contains(&"--sort") { call } else { call.args(["--sort", "cost"]) };
    let ran = arguments.iter().fold(call, |call, argument| call.arg(argument)).run().exits(0);
    assert_eq!(ran.stderr, "", "a bar is for terminals");
    ran.stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn word<'a>(line: &'a Value, key: &str) -> &'a str {
    line[key].as_str().unwrap_or_default()
}

#[test]
fn carriers_are_ranked_and_cost_what_solve_says() {
    let file = "examples/fig2.sense";
    for target in ["none", "chibios"] {
        let lines = carriers(file, &["--family", "STM32F40", "--target", target]);
        let costs: Vec<u64> = lines.iter().map(|line| line["cost"].as_u64().unwrap()).collect();
        assert!(costs.is_sorted() && costs.len() > 20, "{costs:?}");
        let boards = lines.iter().filter(|line| !line["board"].is_null());
        let parts = lines.iter().filter(|line| line["board"].is_null());
        assert!(boards.clone().any(|line| word(line, "board") == "STM32F407G-DISC1"));
        let some = boards.map(|line| (word(line, "board"), line)).take(3);
        for (name, line) in some.chain(parts.map(|line| (word(line, "part"), line)).step_by(9)) {
            assert_eq!(line["status"], "optimal");
            let solve =
                sensedsl(["solve", "-q", "--format", "json", "--target", target, "--board"]);
            let solved = solve.arg(name).arg(file).run().exits(0).json();
            assert_eq!(solved["cost"], line["cost"], "{name} for {target}");
        }
    }
}

#[test]
fn filters_leave_what_they_say() {
    let lines = carriers(
        "examples/fig2.sense",
        &["--family", "g0", "--package", "LQFP", "--max-pins", "48"],
    );
    assert!(lines.len() > 10);
    for line in &lines {
        assert!(word(line, "part").starts_with("STM32G0"), "{line}");
        assert!(["LQFP32", "LQFP48"].contains(&word(line, "package")), "{line}");
    }
}

#[test]
fn parts_that_cannot_carry_the_devices_are_left_out() {
    let scratch = TempDir::new("parts");
    let can = design("X", &["can: bitrate = 500 kHz; frame = 1;", "digital: pin = PA11;"]);
    let file = scratch.write("can.sense", can).display().to_string();
    let lines = carriers(&file, &["--family", "STM32F103", "--target", "none"]);
    assert!(lines.iter().any(|line| word(line, "part").starts_with("STM32F103C8")));
    // The 36-pin packages have CAN only on PA11 and PA12.
    assert!(!lines.iter().any(|line| word(line, "part").starts_with("STM32F103T")));
}

/// The reader of a pipe need not wait for the last part. The rows are those of the sorted list, in
/// the order of the parts, however many cores work.
#[test]
fn a_pipe_gets_each_row_as_it_is_found() {
    let file = "examples/fig2.sense";
    let arguments = ["--family", "STM32F40", "--target", "none"];
    let sorted = carriers(file, &arguments);
    let call = |format| sensedsl(["parts", "--format", format]).args(arguments).arg(file).run();
    let text = call("json").exits(0).stdout;
    let rows: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(rows.len(), sorted.len());
    assert!(sorted.iter().all(|row| rows.contains(row)));
    assert_eq!(call("json").exits(0).stdout, text);
    let human = call("human").exits(0).stdout;
    assert!(human.contains(&format!("\n{} of ", rows.len())), "{human}");

    let mut parts = Command::new(binary());
    parts.current_dir(root()).args(["parts", "--target", "none", file]).stdout(Stdio::piped());
    let mut parts = parts.spawn().unwrap();
    let mut out = BufReader::new(parts.stdout.take().unwrap());
    let mut first = String::new();
    out.read_line(&mut first).unwrap();
    first.clear();
    out.read_line(&mut first).unwrap();
    let is_running = parts.try_wait().unwrap().is_none();
    parts.kill().unwrap();
    parts.wait().unwrap();
    assert!(is_running && first.contains("pins only"), "{first}");
}

/// A mistake in the file is reported once, not once for each part.
#[test]
fn a_mistake_in_the_file_is_told() {
    let wrong = "board X {\n    sensor A returns uint16 { id = 1; type = analgo; }\n}\n";
    let ran = sensedsl(["parts", "-"]).stdin(wrong).run().exits(1);
    assert!(ran.stdout.is_empty() && ran.stderr.matches("analgo").count() <= 3, "{}", ran.stderr);
}

#[test]
fn the_first_ones_in_the_order_asked_for() {
    let fig2 = "examples/fig2.sense";
    let call = |more: &[&str]| {
        let call = sensedsl(["parts", fig2, "--family", "F4", "--format", "json"]).args(more);
        let out = call.run().exits(0).stdout;
        out.lines().map(|line| serde_json::from_str(line).unwrap()).collect::<Vec<Value>>()
    };
    let (all, first) = (call(&["--sort", "cost"]), call(&["--limit", "3"]));
    assert_eq!(first, all[..3]);
    let by_pins = call(&["--sort", "pins", "--limit", "2"]);
    assert!(by_pins[0]["cost"].as_u64() > all[0]["cost"].as_u64(), "{by_pins:?}");
    assert_eq!(all[0]["profile"], true);
    let cut = sensedsl(["parts", fig2, "--family", "F4", "--limit", "3"]).run().exits(0).stdout;
    let count =
        format!("{0} of {0} parts and boards can carry the devices; the first 3", all.len());
    assert!(cut.contains(&count), "{cut}");
}

/// Cores and memory are shown, filtered and sorted, both for the parts that carry a file and for
/// the list.
#[test]
fn cores_and_memory_narrow_and_sort() {
    let fig2 = "examples/fig2.sense";
    let large = ["--min-flash", "512", "--min-ram", "128", "--core", "cortex-m4"];
    let lines = carriers(fig2, &[&["--family", "F4", "--sort", "ram"], &large[..]].concat());
    let kb = |line: &Value, key: &str| line[key].as_u64().unwrap() / 1024;
    let rams: Vec<u64> = lines.iter().map(|line| kb(line, "ram_bytes")).collect();
    assert!(rams.len() > 50 && rams.is_sorted() && rams[0] == 128, "{rams:?}");
    assert!(lines.iter().all(|line| kb(line, "flash_bytes") >= 512));
    assert!(lines.iter().any(|line| line["board"] == "STM32F407G-DISC1"));
    assert!(lines.iter().all(|line| line["cores"] == serde_json::json!(["Cortex-M4"])));
    let list = |arguments: &[&str]| -> Vec<Value> {
        let out = sensedsl(["parts", "--format", "json"]).args(arguments).run().exits(0).stdout;
        out.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    };
    let flash = list(&["--list", "--sort", "flash"]);
    let sizes: Vec<u64> =
        flash.iter().map(|line| line["flash_bytes"].as_u64().unwrap_or(u64::MAX)).collect();
    assert!(sizes.is_sorted() && sizes[0] < 16 << 10 && sizes[sizes.len() - 1] == u64::MAX);
    assert_eq!(
        list(&["--list", "--core", "m0"]).iter().filter(|part| has_core(part, "M0+")).count(),
        0
    );
    // An RP2040 can have flash of any size; an AVR cannot.
    let many = list(&["--list", "--min-flash", "100000"]);
    assert!(
        many.iter().any(|part| part["part"] == "RP2040")
            && many.iter().all(|part| part["flash_bytes"].is_null())
    );
    let both = list(&["--list", "stm32h745zit6"]);
    assert_eq!(both[0]["cores"], serde_json::json!(["Cortex-M7", "Cortex-M4"]));
    assert_eq!(both[0]["numbers"][0], "STM32H745ZIT6");
}

fn has_core(part: &Value, name: &str) -> bool {
    part["cores"].as_array().unwrap().iter().any(|core| core.as_str().unwrap().ends_with(name))
}

/// Tables fit a terminal of 80 columns.
#[test]
fn tables_are_as_wide_as_a_terminal() {
    let list = sensedsl(["parts", "--list"]).run().exits(0).stdout;
    let found = sensedsl(["parts", "examples/fig2.sense", "--package", "64", "--target", "none"]);
    let found = found.run().exits(0).stdout;
    assert!(list.lines().count() > 2_000);
    for line in list.lines().chain(found.lines()) {
        assert!(line.chars().count() <= 80, "{line}");
    }
    let row = |start: &str| found.lines().find(|line| line.contains(start)).unwrap().to_owned();
    let words = |line: String| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let f446 = words(row("NUCLEO-F446RE "));
    assert_eq!(f446[1..], ["STM32F446RET6", "NUCLEO-F446RE", "M4", "512", "128", "pins", "only"]);
    assert_eq!(words(row("STM32F105RBT6 "))[2..6], ["LQFP64", "M3", "128", "64"]);
}

#[cfg(unix)]
#[test]
fn control_c_prints_what_there_is() {
    let mut call = Command::new(binary());
    call.args(["parts", "examples/miniature_car.sense"]).current_dir(root());
    let child = call.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // The interrupt comes long before the thousands of parts are done.
    thread::sleep(Duration::from_millis(1_500));
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let output = child.wait_with_output().unwrap();
    let (out, err) =
        (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(out.contains(" parts and boards can carry the devices"), "{out}{err}");
    assert!(err.contains("stopped: "), "{out}{err}");
    assert!(matches!(output.status.code(), Some(0 | 1)), "{:?}", output.status);
}
