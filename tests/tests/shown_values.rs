//! Values that people write are in the units that are shown: tests the raw values that firmware
//! gets, and how `fmt --migrate` changes files whose values were raw codes.
#![expect(clippy::unwrap_used, reason = "a test reads its data, and a panic is its failure")]

use sensedsl_tests::{TempDir, read, sensedsl, text};

/// The failsafes in the firmware of a file, in order.
fn failsafes(text: &str) -> Vec<String> {
    let folder = TempDir::new("shown-values");
    let file = folder.write("robot.sense", text);
    let out = folder.join("out");
    let call = sensedsl(["generate", "-q", "--without", "host", "-o"]).arg(&out).arg(&file);
    let _ = call.run().exits(0);
    let code = read(&out.join("firmware/STM32F407G_DISC1/generated/sense_hw.c"));
    let body = code.split("void sense_failsafe(void) {").nth(1).unwrap();
    let body = body.split("\n}").next().unwrap();
    let number = |line: &str| {
        let of_value = line.split("INT64_C(").nth(1).and_then(|rest| rest.split(')').next());
        let of_level = line.split("_pwm, ").nth(1).and_then(|rest| rest.split('U').next());
        of_value.or(of_level).map(str::to_owned)
    };
    let mut found: Vec<String> = body.lines().filter_map(number).collect();
    found.sort();
    found
}

#[test]
fn firmware_gets_the_codes_of_shown_values() {
    let found = failsafes(&text("tests/corpus/ok/shown_values.sense"));
    assert_eq!(found, ["-2000", "-2000", "-40", "2048", "307", "307", "307", "5000", "5000"]);
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
    let folder = TempDir::new("shown-migrated");
    let file = folder.write("robot.sense", OLD);
    let ran = sensedsl(["check"]).arg(&file).run().exits(1);
    assert!(ran.stderr.contains("E0234"), "{}", ran.stderr);
    let ran = sensedsl(["fmt", "--migrate", "--check"]).arg(&file).run().exits(1);
    assert!(ran.stdout.contains("values are not as they are today"), "{}", ran.stdout);
    let _ = sensedsl(["fmt", "--migrate"]).arg(&file).run().exits(0);
    let migrated = read(&file);
    let expected = OLD.replace("= 307;", "= raw 307;").replace("= 5_000;", "= raw 5_000;");
    assert_eq!(migrated, expected);
    let ran = sensedsl(["check"]).arg(&file).run().exits(0);
    assert!(!ran.stderr.contains("W0612"), "{}", ran.stderr);
    assert_eq!(failsafes(&migrated), ["0", "307", "5000", "5000"]);
    let _ = sensedsl(["fmt", "--migrate", "--check"]).arg(&file).run().exits(0);
}
