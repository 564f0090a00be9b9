//! `fmt --ids`: writes the identifiers that the tool assigns into the file.
#![expect(
    clippy::indexing_slicing,
    clippy::unwrap_used,
    reason = "a test reads its data, and a panic is its failure"
)]

use sensedsl_tests::{RunOutput, TempDir, sensedsl};

const BEFORE: &str = "// A robot.
board Robot on NUCLEO_F446RE {
  chip Imu { // on the mast
    driver = mpu6050;
  }
  chip Weather {

    /* on the roof */
    driver = bme280;
    sensor Temperature returns int32 {}
    sensor Pressure returns uint32 { id = 40; delay = 1 s; }
  }
  chip Power { driver = ina219; id = 60; sensor Bus returns uint16 { reading = voltage; } }
  sensor Line returns uint16[2] {
    // from the left
    type = analog;
  }
  sensor Door returns bool { /* a reed */ type = digital; }
}
";

/// The names and identifiers that a program reads from the answer.
fn ids(folder: &TempDir, file: &str) -> Vec<(String, u64)> {
    let ran = sensedsl(["solve", "--format", "json", file]).within(folder.path()).run();
    let value = ran.exits(0).json();
    let boards = value["boards"].as_array().unwrap().clone();
    let devices = boards.iter().flat_map(|board| board["devices"].as_array().unwrap().clone());
    let id = |device: &serde_json::Value| {
        Some((device["name"].as_str()?.to_owned(), device["id"].as_u64()?))
    };
    let mut all: Vec<_> = devices.filter_map(|device| id(&device)).collect();
    all.sort();
    all.dedup();
    all
}

fn fmt(folder: &TempDir, arguments: &[&str]) -> RunOutput {
    sensedsl(["fmt", "--ids"]).args(arguments).within(folder.path()).run()
}

#[test]
fn the_numbers_of_the_design_are_written() {
    let folder = TempDir::new("ids");
    let file = folder.write("robot.sense", BEFORE);
    let before = ids(&folder, "robot.sense");
    let _ = fmt(&folder, &["--check", "robot.sense"]).exits(1);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), BEFORE);
    let reported = fmt(&folder, &["robot.sense"]).exits(0);
    assert_eq!(reported.stdout, "robot.sense: identifiers written\n");
    let after = std::fs::read_to_string(&file).unwrap();
    let wanted = "// A robot.
board Robot on NUCLEO_F446RE {
    chip Imu { // on the mast
        id = 61;
        driver = mpu6050;
    }
    chip Weather {
        /* on the roof */
        driver = bme280;
        sensor Temperature returns int32 { id = 64; }
        sensor Pressure returns uint32 { id = 40; delay = 1 s; }
    }
    chip Power {
        driver = ina219;
        id = 60;
        sensor Bus returns uint16 { reading = voltage; }
    }
    sensor Line returns uint16[2] {
        id = 65;
        // from the left
        type = analog;
    }
    sensor Door returns bool { /* a reed */
        id = 66;
        type = digital;
    }
}
";
    assert_eq!(after, wanted);
    assert_eq!(ids(&folder, "robot.sense"), before);
    // A second run changes nothing.
    assert_eq!(fmt(&folder, &["robot.sense"]).exits(0).stdout, "");
    let _ = fmt(&folder, &["--check", "robot.sense"]).exits(0);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), wanted);
}

#[test]
fn a_file_with_errors_is_left_alone() {
    let folder = TempDir::new("ids_errors");
    let text = BEFORE.replace("mpu6050", "mpu6051").replace("= 60", "= 40");
    let file = folder.write("robot.sense", &text);
    let reported = fmt(&folder, &["robot.sense"]).exits(1);
    assert!(
        reported.stderr.contains("E0216") && reported.stderr.contains("E0203"),
        "{}",
        reported.stderr
    );
    assert!(reported.stderr.contains("no identifiers are written"), "{}", reported.stderr);
    assert_eq!(std::fs::read_to_string(&file).unwrap(), text);
    // Without `--ids`, the file is only formatted.
    let _ = sensedsl(["fmt", "robot.sense"]).within(folder.path()).run().exits(0);
}

#[test]
fn used_files_are_left_alone_and_what_moves_there_is_told() {
    let folder = TempDir::new("ids_use");
    let other = "sensor Light returns uint16 {\n    type = analog;\n}\n";
    folder.write("other.sense", other);
    let main = "use \"other.sense\";\nboard Robot on NUCLEO_F446RE {\n    sensor Dark returns uint16 {\n        type = analog;\n    }\n}\n";
    let file = folder.write("robot.sense", main);
    let before = ids(&folder, "robot.sense");
    let reported = fmt(&folder, &["robot.sense"]).exits(0);
    assert_eq!(std::fs::read_to_string(folder.join("other.sense")).unwrap(), other);
    let after = ids(&folder, "robot.sense");
    let number = |all: &[(String, u64)], name: &str| {
        all.iter().find(|(device, _)| device == name).unwrap().1
    };
    assert_eq!(number(&after, "Dark"), number(&before, "Dark"));
    let written = std::fs::read_to_string(&file).unwrap();
    assert!(written.contains(&format!("id = {};", number(&before, "Dark"))), "{written}");
    let has_moved = number(&after, "Light") != number(&before, "Light");
    assert_eq!(reported.stderr.contains("Light"), has_moved, "{}", reported.stderr);
}

#[test]
fn the_standard_input_is_printed() {
    let text = "board Robot on NUCLEO_F446RE { sensor A returns uint16 { type = analog; } }";
    let reported = sensedsl(["fmt", "--ids", "-"]).stdin(text).run().exits(0);
    assert!(
        reported.stdout.contains("A returns uint16 { id = 1; type = analog; }"),
        "{}",
        reported.stdout
    );
}
