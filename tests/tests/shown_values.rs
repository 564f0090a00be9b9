//! Values that people write are in the units that are shown: tests the raw values that firmware
//! gets, and how `fmt --migrate` changes files whose values were raw codes.
#![expect(clippy::unwrap_used, reason = "a test reads its data, and a panic is its failure")]

use std::fs;
use std::path::{Path, PathBuf};

use sensedsl_tests::{root, sensedsl};

/// An empty folder for this test run.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

/// The failsafes in the firmware of a file, in the order of its devices.
fn failsafes(name: &str, text: &str) -> Vec<String> {
    let folder = folder(name);
    let file = folder.join("robot.sense");
    fs::write(&file, text).unwrap();
    let out = folder.join("out");
    let call = sensedsl(["generate", "-q", "--without", "host", "-o"]).arg(&out).arg(&file);
    let _ = call.run().exits(0);
    let of_board = out.join("firmware/STM32F407G_DISC1/generated/sense_hw.c");
    let code = fs::read_to_string(of_board).unwrap();
    let body = code.split("void sense_failsafe(void) {").nth(1).unwrap();
    let body = body.split("\n}").next().unwrap();
    let number = |line: &str| {
        let of_value = line.split("INT64_C(").nth(1).and_then(|rest| rest.split(')').next());
        let of_level = line.split("_pwm, ").nth(1).and_then(|rest| rest.split('U').next());
        of_value.or(of_level).map(str::to_owned)
    };
    body.lines().filter_map(number).collect()
}

#[test]
fn firmware_gets_the_codes_of_shown_values() {
    let text = fs::read_to_string(root().join("tests/corpus/ok/shown_values.sense")).unwrap();
    let found = failsafes("shown-values", &text);
    let expected = ["307", "307", "307", "-2000", "-2000", "2048", "5000", "5000", "-40"];
    let (mut found, mut expected) = (found, expected.map(str::to_owned).to_vec());
    found.sort();
    expected.sort();
    assert_eq!(found, expected);
}

const OLD: &str = "board STM32F407G_DISC1 {
    chip Servos {
        driver = pca9685;
        actuator Output0 accepts uint16 {
            failsafe = 307; // the middle
        }
    }
    chip Left {
        driver = tb6612;
        actuator SpeedA accepts int16 {
            failsafe = 5_000;
        }
        actuator SpeedB accepts int16 {
            failsafe = 0;
        }
    }
    actuator Steering accepts uint16 {
        driver = servo;
        failsafe = 5000;
    }
}
";

#[test]
fn a_file_of_before_is_written_as_it_was_meant() {
    let folder = folder("shown-migrated");
    let file = folder.join("robot.sense");
    fs::write(&file, OLD).unwrap();
    let ran = sensedsl(["check"]).arg(&file).run().exits(1);
    assert!(ran.stderr.contains("E0234"), "{}", ran.stderr);
    let ran = sensedsl(["fmt", "--migrate", "--check"]).arg(&file).run().exits(1);
    assert!(ran.stdout.contains("values are not as they are today"), "{}", ran.stdout);
    let _ = sensedsl(["fmt", "--migrate"]).arg(&file).run().exits(0);
    let migrated = fs::read_to_string(&file).unwrap();
    let expected = OLD.replace("= 307;", "= raw 307;").replace("= 5_000;", "= raw 5_000;");
    assert_eq!(migrated, expected);
    let ran = sensedsl(["check"]).arg(&file).run().exits(0);
    assert!(!ran.stderr.contains("W0612"), "{}", ran.stderr);
    let mut found = failsafes("shown-migrated-firmware", &migrated);
    found.sort();
    assert_eq!(found, ["0", "307", "5000", "5000"]);
    let _ = sensedsl(["fmt", "--migrate", "--check"]).arg(&file).run().exits(0);
}
