//! `sensedsl-verify` accepts what `solve --proof` writes, and refuses it after any change.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{TempDir, answered, design, read, sensedsl, verifier};

const BOARD: &str = "STM32F4DiscoveryBoard";

/// The exit status and the output of the verifier.
fn verify(certificate: &Path) -> (i32, String) {
    ran(Command::new(verifier()).arg(certificate))
}

/// Like [`verify`], against given files.
fn verify_for(certificate: &Path, files: &[&PathBuf]) -> (i32, String) {
    ran(Command::new(verifier()).arg(certificate).arg("--for").args(files))
}

fn ran(verifier: &mut Command) -> (i32, String) {
    let output = verifier.output().unwrap();
    let log = [output.stdout, output.stderr].concat();
    (output.status.code().unwrap_or(-1), String::from_utf8_lossy(&log).into_owned())
}

/// Solves with a certificate and verifies it; returns the output of the verifier.
#[track_caller]
fn proved(arguments: &[&str], stdin: &str, status: i32) -> String {
    let scratch = TempDir::new("proof");
    let certificate = scratch.join("certificate.json");
    let call = sensedsl(["solve", "-q"]).arg("--proof").arg(&certificate);
    let ran = arguments.iter().fold(call, |call, argument| call.arg(argument)).stdin(stdin).run();
    assert_eq!(ran.status, status, "{arguments:?}\n{stdin}\n{}", ran.stderr);
    let (status, log) = verify(&certificate);
    assert_eq!(status, 0, "{arguments:?}\n{stdin}\n{log}");
    log
}

#[test]
fn the_examples_are_proved_on_both_boards() {
    for file in ["examples/fig2.sense", "examples/miniature_car.sense"] {
        for board in [BOARD, "STM32F407G-DISC1"] {
            for target in ["chibios", "none"] {
                let log = proved(&[file, "--board", board, "--target", target], "", 0);
                assert!(log.contains("none is better"), "{log}");
            }
        }
    }
    let log = proved(&["examples/fig2.sense"], "", 0);
    assert!(log.contains("moved 0, violated 0, shared 0, cost 5, spares 0"), "{log}");
}

#[test]
fn that_there_is_no_wiring_is_proved() {
    let bus = "i2c: address = 0x10; exclusive = true; register = 0; length = 2;";
    let cases =
        [design(BOARD, &["analog"; 10]), design(BOARD, &[bus; 4]), design(BOARD, &["icu"; 9])];
    for file in &cases {
        let log = proved(&["-"], file, 1);
        assert!(log.contains("there is no wiring"), "{log}");
    }
}

#[test]
fn buses_frequencies_wishes_and_boards_are_proved() {
    let mixed = design(
        BOARD,
        &[
            "i2c: address = 0x10; register = 0; length = 2; prefer unit = I2C1;",
            "i2c: address = 0x11; register = 0; length = 2; avoid unit = I2C1;",
            "i2c: address = 0x11; register = 0; length = 2;",
            "pwm: frequency = 50 Hz; prefer pin = PB8;",
            "pwm: frequency = 50 Hz; prefer pin = PB8;",
            "pwm: frequency = 400 Hz;",
            "icu: avoid pin = PB4;",
            "analog: prefer pin = PA3;",
        ],
    );
    let log = proved(&["-"], &mixed, 0);
    assert!(!log.contains("violated 0"), "the wishes contradict each other: {log}");
    let devices: String = (1..=12)
        .map(|id| format!("sensor S{id} returns uint16 {{ id = {id}; type = analog; }}\n"))
        .collect();
    let spare = format!("board A on {BOARD} {{ }}\nspare board B on {BOARD} {{ }}\n{devices}");
    let log = proved(&["-"], &spare, 0);
    assert!(log.contains("spares 1"), "{log}");
}

#[test]
fn moved_wires_are_proved_to_be_needed() {
    let scratch = TempDir::new("proof-moved");
    let before = design(BOARD, &["analog", "icu"]);
    let answer = sensedsl(["solve", "-q", "--format", "json", "-"]).stdin(before).run().exits(0);
    let keep = scratch.write(NAMES[3], answer.stdout);
    let after = design(BOARD, &["analog: pin = PC1;", "icu: avoid unit = TIM3;"]);
    let log = proved(&["-", "--keep", &keep.display().to_string()], &after, 0);
    assert!(log.contains("moved 1, violated 1"), "{log}");
}

/// The files of a design, and the answer to `--keep`.
const NAMES: [&str; 4] = ["robot.sense", "parts/arm.sense", "tables/own.csv", "before.json"];

#[test]
fn a_certificate_is_of_the_files_it_was_made_of() {
    let scratch = TempDir::new("proof-for");
    let table = "# mcu = STM32F407VGT6\nPin,Side\nPA1,left\nPA2,left\nPB0,right\n";
    let sensor = |id: u8| format!("sensor S{id} returns uint16 {{ id = {id}; type = analog; }}\n");
    let main =
        format!("use \"parts/arm.sense\";\nboard B on \"tables/own.csv\" {{ {} }}", sensor(1));
    for folder in ["parts", "tables"] {
        std::fs::create_dir(scratch.join(folder)).unwrap();
    }
    let main = scratch.write(NAMES[0], main);
    let used = scratch.write(NAMES[1], sensor(2));
    let pins = scratch.write(NAMES[2], table);
    let answer = sensedsl(["solve", "-q", "--format", "json"]).arg(&main).run().exits(0);
    let kept = scratch.write(NAMES[3], answer.stdout);
    let (proof, plain) = (scratch.join("proof.json"), scratch.join("plain.json"));
    let solve = |proof: &Path| sensedsl(["solve", "-q", "--proof"]).arg(proof).arg(&main);
    let _ = solve(&plain).run().exits(0);
    let _ = solve(&proof).arg("--keep").arg(&kept).run().exits(0);
    let all = [&main, &used, &pins, &kept];
    let (status, log) = verify_for(&proof, &all);
    assert_eq!(status, 0, "{log}");
    for name in NAMES {
        assert!(log.contains(&format!("{name}: the same")), "{name}: {log}");
    }
    for missing in 0..4 {
        let given: Vec<_> = (0..4).filter(|at| *at != missing).map(|at| all[at]).collect();
        let (status, log) = verify_for(&proof, &given);
        assert!(status == 1 && log.contains("which is not given"), "{log}");
    }
    let (status, log) = verify_for(&plain, &all);
    assert!(status == 1 && log.contains("not of"), "nothing was kept: {log}");
    assert_eq!(verify_for(&plain, &all[..3]).0, 0);
    // The texts that `parts` prints are those that were used.
    let mut texts = Vec::new();
    for call in [&["--table", "STM32F407VGT6"][..], &["--profile", "STM32F407VGT6"]] {
        let text = sensedsl(["parts"]).args(call).run().exits(0).stdout;
        texts.push(scratch.write(&format!("text{}", texts.len()), text));
    }
    let (status, log) = verify_for(&plain, &[&main, &used, &pins, &texts[0], &texts[1]]);
    assert!(status == 0 && !log.contains("not compared"), "{log}");
    for (changed, name) in all.into_iter().zip(NAMES) {
        let before = read(changed);
        scratch.write(name, format!("{before} "));
        let (status, log) = verify_for(&proof, &all);
        assert!(status == 1 && log.contains("that was solved"), "{name}: {log}");
        scratch.write(name, before);
    }
    assert_eq!(verify_for(&proof, &all).0, 0);
    assert_eq!(verify_for(&proof, &[&scratch.join("nowhere")]).0, 2);
    assert_eq!(verify_for(&proof, &[]).0, 2);
}

#[test]
fn a_certificate_of_a_built_in_board_is_of_its_table() {
    let scratch = TempDir::new("proof-built-in");
    let proof = scratch.join("proof.json");
    let given = scratch.write("given.sense", design("STM32F407G_DISC1", &["analog"]));
    let call = sensedsl(["solve", "-q", "-", "--target", "none", "--proof"]).arg(&proof);
    let _ = call.stdin(read(&given)).run().exits(0);
    let table = sensedsl(["boards", "STM32F407G-DISC1"]).run().exits(0).stdout;
    let table = scratch.write("table", table);
    let (status, log) = verify_for(&proof, &[&given, &table]);
    assert!(status == 0 && log.contains("<stdin>: the same"), "{log}");
    assert!(log.contains("`sensedsl boards STM32F407G-DISC1`: the same"), "{log}");
    assert!(log.contains("with --target none") && !log.contains("not compared"), "{log}");
    let other = sensedsl(["boards", BOARD]).run().exits(0).stdout;
    let (status, log) = verify_for(&proof, &[&given, &scratch.write("other", other)]);
    assert!(status == 1 && log.contains("not of"), "{log}");
}

#[test]
fn changed_certificates_are_refused_and_other_files_are_unusable() {
    let scratch = TempDir::new("proof-changed");
    let certificate = scratch.join("fig2.json");
    let _ = sensedsl(["solve", "-q", "examples/fig2.sense", "--proof"])
        .arg(&certificate)
        .run()
        .exits(0);
    let text = read(&certificate);
    for (from, to, status) in [
        ("\"cost\":5,", "\"cost\":4,", 1),
        ("\"in\":\"PB0 ADC12_IN8\"", "\"in\":\"PB1 ADC12_IN9\"", 1),
        ("\"PB0\":1", "\"PB0\":2", 1),
        ("certificate 4", "certificate 3", 2),
        ("\"boards\"", "\"bords\"", 2),
        ("\"PA1\":3", "\"PA1\":-3", 2),
        ("\"PA1\":3", "\"PA1\":3,\"PA1\":3", 2),
    ] {
        let changed = text.replace(from, to);
        assert_ne!(changed, text, "{from}");
        let (got, log) = verify(&scratch.write("changed.json", &changed));
        assert_eq!(got, status, "{from} to {to}: {log}");
        assert!(!log.is_empty());
    }
    assert_eq!(verify(&scratch.join("not there")).0, 2);
    assert_eq!(verify(&scratch.write("text", "no certificate")).0, 2);
    assert_eq!(verify(&scratch.write("half", text.get(..text.len() / 2).unwrap())).0, 2);
}

#[test]
fn without_a_proof_there_is_an_answer_or_a_word() {
    let scratch = TempDir::new("proof-none");
    let path = scratch.join("none.json");
    let late = ["solve", "examples/fig2.sense", "--timeout", "0", "--proof"];
    let ran = sensedsl(late).arg(&path).run();
    assert_eq!(ran.status, 1);
    assert!(ran.stderr.contains("E0403") || ran.stderr.contains("E0404"), "{}", ran.stderr);
    assert!(!path.exists());
    for more in [
        ["--any"].as_slice(),
        &["--all"],
        &["--count"],
        &["--format", "prolog"],
        &["--format", "alloy"],
    ] {
        let call = sensedsl(["solve", "examples/fig2.sense", "--proof"]).arg(&path);
        let ran = more.iter().fold(call, |call, argument| call.arg(argument)).run();
        assert_eq!((ran.status, path.exists()), (2, false), "{more:?}");
    }
}

#[test]
fn a_certificate_is_the_result_where_it_goes_to_the_standard_output() {
    let scratch = TempDir::new("proof-stdout");
    let path = scratch.join("fig2.json");
    let to_file = sensedsl(["solve", "examples/fig2.sense", "--proof"]).arg(&path).run();
    let ran = sensedsl(["solve", "examples/fig2.sense", "--proof", "-"]).run();
    assert_eq!((to_file.status, ran.status), (0, 0), "{}", ran.stderr);
    assert_eq!(ran.stdout, read(&path));
    assert!(!std::path::Path::new("-").exists());
    let log = answered(Command::new(verifier()).arg("-"), ran.stdout);
    assert!(log.starts_with("verified"), "{log}");
}
