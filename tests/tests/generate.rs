//! Promises of `generate` about the folder that it writes: bytes, times, links and modes. The others are in
//! `scripts/generate.txt`.

use std::collections::BTreeMap;
use std::fs;
#[cfg(unix)]
use std::path::Path;
#[cfg(unix)]
use std::process::Command;

use sensedsl_tests::{RunOutput, TempDir, few, read, sensedsl, tree};

const FIG2: &str = "examples/fig2.sense";
const CAR: &str = "examples/miniature_car.sense";
const FIRMWARE: &str = "firmware/STM32F4DiscoveryBoard";

fn generate(file: &str, scratch: &TempDir, arguments: &[&str]) -> RunOutput {
    let call = sensedsl(["generate", file, "-q", "-o"]).arg(scratch.join("out"));
    arguments.iter().fold(call, |call, argument| call.arg(argument)).run()
}

fn out(scratch: &TempDir) -> BTreeMap<String, Vec<u8>> {
    tree(&scratch.join("out"))
}

#[test]
fn the_same_input_gives_the_same_bytes_wherever_it_is() {
    for file in few(&[CAR, FIG2], 1) {
        let (one, other) = (TempDir::new("one"), TempDir::new("other-name"));
        let _ = generate(file, &one, &[]).exits(0);
        let _ = generate(file, &other, &[]).exits(0);
        let first = out(&one);
        assert_eq!(first, out(&other));
        let _ = generate(file, &one, &[]).exits(0);
        assert_eq!(first, out(&one), "and a second run changes nothing");
        // The design is named after its file, wherever that is.
        let name = file.rsplit('/').next().unwrap_or(file);
        let copy = other.write(&format!("elsewhere/{name}"), sensedsl_tests::text(file));
        let third = TempDir::new("third");
        let _ = generate(&copy.display().to_string(), &third, &[]).exits(0);
        assert_eq!(first, out(&third), "no path of the input is in the output");
        for (name, bytes) in &first {
            let text = String::from_utf8_lossy(bytes);
            let own = one.path().display().to_string();
            assert!(!text.contains(&own), "{name} names the folder it is in");
            assert!(!text.contains('\r'), "{name} has line ends of Windows");
            assert!(text.is_empty() || text.ends_with('\n'), "{name} does not end its last line");
        }
    }
}

#[test]
fn a_file_that_needs_no_change_is_not_written_again() {
    let scratch = TempDir::new("times");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let time = |name: &str| fs::metadata(scratch.join(name)).unwrap().modified().unwrap();
    let makefile = format!("out/{FIRMWARE}/Makefile");
    let before = time(&makefile);
    std::thread::sleep(std::time::Duration::from_millis(20));
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    assert_eq!(time(&makefile), before, "make would build all again");
}

/// The user's code is never changed: what to change in it is said, once, when what it gets or gives is another.
#[test]
fn whoever_wrote_a_controller_is_told_what_it_gets_now() {
    let scratch = TempDir::new("interface");
    let design = |reads: &str, sets: &str| {
        let board = "board Robot on NUCLEO_F446RE {
    sensor Line returns uint16[8] { type = analog; }
    sensor Front returns uint16 { type = analog; }
    actuator Left accepts int16 { type = pwm; }
    controller Follow every 5 ms { reads = [READS]; sets = [SETS]; }
}";
        let _ = scratch.write("a.sense", board.replace("READS", reads).replace("SETS", sets));
    };
    for (target, own) in [("chibios", "user/follow.c"), ("embassy", "src/user/follow.rs")] {
        let run = || {
            let (file, out) = (scratch.join("a.sense"), scratch.join(target));
            let call = sensedsl(["generate", "--target", target, "-o"]).arg(out).arg(file);
            call.run().exits(0).stderr
        };
        design("Line", "");
        assert!(!run().contains("change "));
        let file = scratch.join(&format!("{target}/firmware/Robot/{own}"));
        fs::write(&file, "mine").unwrap();
        design("Front", "Left");
        let wanted = format!(
            "change firmware/Robot/{own}: its step gets Front (uint16); no longer gets Line (uint16[8]); sets Left (int16)\n"
        );
        let said = run();
        assert!(said.contains(&wanted), "{said}");
        assert!(!run().contains("change "), "it is said once");
        assert_eq!(read(&file), "mine");
    }
}

#[test]
fn a_list_that_lies_does_no_harm() {
    let scratch = TempDir::new("lies");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let outside = scratch.write("outside.txt", "precious");
    let list = read(&scratch.join("out/.sensedsl-files"));
    let lies = "../outside.txt\n/etc/hostname\nfirmware/../../outside.txt\n\n";
    scratch.write("out/.sensedsl-files", format!("{list}{lies}"));
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    assert_eq!(read(&outside), "precious");
    assert!(!read(&scratch.join("out/.sensedsl-files")).contains("outside"));
}

#[cfg(unix)]
#[test]
fn links_are_not_followed_out_of_the_folder() {
    let scratch = TempDir::new("links");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let outside = scratch.write("outside/precious.txt", "precious");
    std::os::unix::fs::symlink(scratch.join("outside"), scratch.join("out/linked")).unwrap();
    let ran = generate(FIG2, &scratch, &[]).exits(1);
    assert!(ran.stderr.contains("linked"), "{}", ran.stderr);
    fs::remove_file(scratch.join("out/linked")).unwrap();
    fs::remove_file(scratch.join("out/wiring.md")).unwrap();
    std::os::unix::fs::symlink(&outside, scratch.join("out/wiring.md")).unwrap();
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    assert_eq!(read(&outside), "precious", "written through a link");
    assert!(read(&scratch.join("out/wiring.md")).contains("WheelEncoder"));
}

#[cfg(unix)]
#[test]
fn a_folder_stays_the_one_it_is() {
    use std::os::unix::fs::{MetadataExt as _, PermissionsExt as _, symlink};
    let scratch = TempDir::new("same");
    // The folder is named by a link, and the user's files in it include links and have modes of
    // their own.
    fs::create_dir(scratch.join("real")).unwrap();
    symlink("real", scratch.join("out")).unwrap();
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let user = scratch.write(&format!("out/{FIRMWARE}/user/run.sh"), "#!/bin/sh\n");
    fs::set_permissions(&user, fs::Permissions::from_mode(0o750)).unwrap();
    symlink("run.sh", user.with_file_name("link")).unwrap();
    fs::hard_link(&user, scratch.join("second-name")).unwrap();
    let other = scratch.write("elsewhere/other.c", "int other;\n");
    symlink("../../../../elsewhere", scratch.join(&format!("out/{FIRMWARE}/build"))).unwrap();
    let makefile = scratch.join(&format!("out/{FIRMWARE}/Makefile"));
    fs::write(&makefile, "all: broken\n").unwrap();
    fs::set_permissions(&makefile, fs::Permissions::from_mode(0o600)).unwrap();
    let before = [scratch.join("real"), user.clone()].map(|path| fs::metadata(path).unwrap());
    let _ = generate(CAR, &scratch, &[]).exits(0);
    let after = [scratch.join("real"), user.clone()].map(|path| fs::metadata(path).unwrap());
    for (before, after) in before.iter().zip(&after) {
        assert_eq!((before.ino(), before.mode()), (after.ino(), after.mode()));
    }
    assert_eq!(before[1].ctime_nsec(), after[1].ctime_nsec(), "not even touched");
    assert!(fs::symlink_metadata(scratch.join("out")).unwrap().is_symlink());
    assert_eq!(fs::read_link(user.with_file_name("link")).unwrap(), Path::new("run.sh"));
    assert_eq!(read(&other), "int other;\n");
    assert_eq!(fs::metadata(&makefile).unwrap().mode() & 0o777, 0o600, "modes are kept");
    let _ = generate(CAR, &scratch, &["--check"]).exits(0);
    // A shell that works in the folder can continue to work in it.
    let file = sensedsl_tests::root().join(FIG2).display().to_string();
    let within = scratch.join("out/firmware");
    let script =
        format!("'{}' generate -q '{file}' -o .. && ls STM32F4DiscoveryBoard/user/run.sh", {
            sensedsl_tests::binary().display()
        });
    let shell = Command::new("sh").arg("-c").arg(script).current_dir(&within).output().unwrap();
    assert!(shell.status.success(), "{}", String::from_utf8_lossy(&shell.stderr));
    let mut names: Vec<_> =
        fs::read_dir(scratch.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["elsewhere", "out", "real", "second-name"], "nothing is left beside it");
}

#[cfg(unix)]
#[test]
fn a_pipe_in_the_place_of_a_file_is_replaced_and_nobody_waits_for_it() {
    let scratch = TempDir::new("pipe");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let sheet = scratch.join("out/wiring.md");
    fs::remove_file(&sheet).unwrap();
    assert!(Command::new("mkfifo").arg(&sheet).status().unwrap().success());
    let ran = generate(FIG2, &scratch, &["--check"]).exits(1);
    assert!(ran.stderr.contains("different: wiring.md"), "{}", ran.stderr);
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    assert!(read(&sheet).contains("WheelEncoder"));
}

#[cfg(unix)]
#[test]
fn a_link_to_nowhere_is_said() {
    let scratch = TempDir::new("none");
    std::os::unix::fs::symlink("nowhere", scratch.join("out")).unwrap();
    let ran = generate(FIG2, &scratch, &[]).exits(2);
    assert!(ran.stderr.contains("link to a folder that does not exist"), "{}", ran.stderr);
}
