//! The drivers of the library against their vectors, read by a program that shares no code with the
//! tool.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use sensedsl_tests::{TempDir, files, has, root, sensedsl};

const VECTORS: &str = "tests/vectors/drivers";

/// Runs `check.py` in a folder that is laid out like the repository.
fn check(root: &Path) -> Output {
    Command::new("python3").arg(root.join(VECTORS).join("check.py")).output().unwrap()
}

#[test]
fn drivers_agree_with_their_vectors() {
    if !has("python3") {
        return;
    }
    let ran = check(&root());
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stdout));
}

/// A wrong byte, a wrong bit and a missing vector are each reported with the driver's name.
#[test]
fn what_disagrees_is_told() {
    if !has("python3") {
        return;
    }
    let copy = TempDir::new("driver-vectors");
    let letters = "crates/twin/src/parts";
    for (folder, ending) in
        [("crates/model/drivers", "sense"), (letters, "txt"), (VECTORS, "txt"), (VECTORS, "py")]
    {
        fs::create_dir_all(copy.join(folder)).unwrap();
        for file in files(&root().join(folder), ending) {
            fs::copy(&file, copy.join(folder).join(file.file_name().unwrap())).unwrap();
        }
    }
    let change = |path: &str, from: &str, to: &str| {
        let text = fs::read_to_string(copy.join(path)).unwrap();
        assert!(text.contains(from), "{path}: {from}");
        fs::write(copy.join(path), text.replacen(from, to, 1)).unwrap();
    };
    change("tests/vectors/drivers/adxl345.txt", "00 01 00 00 00 F0", "00 01 00 00 00 F1");
    change("crates/model/drivers/position.sense", "bits = 13..0;", "bits = 12..0;");
    fs::remove_file(copy.join("tests/vectors/drivers/srf02.txt")).unwrap();
    let ran = check(copy.path());
    let log = String::from_utf8_lossy(&ran.stdout).into_owned();
    assert_eq!(ran.status.code(), Some(1), "{log}{}", String::from_utf8_lossy(&ran.stderr));
    for driver in ["adxl345:", "as5047p:", "srf02: no vectors"] {
        assert!(log.contains(driver), "{driver} in {log}");
    }
}

/// A driver to begin with is laid out, has a wiring, and runs.
#[test]
fn drivers_to_begin_with_run() {
    let folder = TempDir::new("begin");
    let kinds =
        ["i2c", "spi", "uart", "analog", "icu", "pwm", "can", "digital", "encoder", "onewire"];
    for kind in kinds {
        let text = sensedsl(["drivers", "--new", "my_part", "--kind", kind]).run().exits(0).stdout;
        let file = folder.write(&format!("{kind}.sense"), &text).display().to_string();
        let ran = sensedsl(["check", &file]).run().exits(0);
        let is_clean = ["error", "warning", "hint"].iter().all(|word| !ran.stderr.contains(word));
        assert!(is_clean, "{}", ran.stderr);
        let _ = sensedsl(["fmt", "--check", &file]).run().exits(0);
        let ran = sensedsl(["simulate", &file, "--judge", "--seconds", "2"]).run().exits(0);
        let said = format!("{}{}", ran.stdout, ran.stderr);
        let word = if kind == "pwm" { "what the design says" } else { "agree with the world" };
        assert!(said.contains(word), "{said}");
    }
}

/// The text of a driver of the library is one that can be used in its place.
#[test]
fn the_source_of_a_driver_is_a_driver() {
    let folder = TempDir::new("source");
    let text = sensedsl(["drivers", "GY-521", "--source"]).run().exits(0).stdout;
    assert!(text.starts_with("// ") && text.contains("driver mpu6050 for i2c {"), "{text}");
    let file = folder.write("mpu6050.sense", &text).display().to_string();
    let _ = sensedsl(["check", &file]).run().exits(0);
    let _ = sensedsl(["fmt", "--check", &file]).run().exits(0);
}
