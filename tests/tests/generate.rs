//! Promises of `generate` about the folder that it writes.

use std::collections::BTreeMap;
use std::fs;
#[cfg(unix)]
use std::path::Path;
#[cfg(unix)]
use std::process::Command;

use sensedsl_tests::{Ran, Scratch, design, read, sensedsl, tree};

const FIG2: &str = "examples/fig2.sense";
const CAR: &str = "examples/miniature_car.sense";
const FIRMWARE: &str = "firmware/STM32F4DiscoveryBoard";

fn generate(file: &str, scratch: &Scratch, arguments: &[&str]) -> Ran {
    let call = sensedsl(["generate", file, "-q", "-o"]).arg(scratch.join("out"));
    arguments.iter().fold(call, |call, argument| call.arg(argument)).run()
}

fn out(scratch: &Scratch) -> BTreeMap<String, Vec<u8>> {
    tree(&scratch.join("out"))
}

#[test]
fn all_the_fixed_files_are_there() {
    let scratch = Scratch::new("files");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let files = out(&scratch);
    for name in ["assignment.json", "schema.json", "wiring.md", "pinout.svg"] {
        assert!(files.contains_key(name), "{name}");
    }
    for name in ["Makefile", "cfg/mcuconf.h", "generated/sense_model.c", "user/user.c"] {
        assert!(files.contains_key(&format!("{FIRMWARE}/{name}")), "{name}");
    }
    for folder in ["firmware/STM32F4DiscoveryBoard/uproxy/", "host/cpp/", "host/libcluon/"] {
        assert!(files.keys().any(|file| file.starts_with(folder)), "{folder}");
    }
    for folder in ["host/opendavinci/", "host/opendavinci2014/"] {
        assert!(files.keys().any(|file| file.starts_with(folder)), "{folder}");
    }
    let solved = sensedsl(["solve", FIG2, "-q", "--format", "json"]).run().exits(0).stdout;
    assert_eq!(read(&scratch.join("out/assignment.json")), solved, "as solve prints it");
    let markdown = sensedsl(["solve", FIG2, "-q", "--format", "markdown"]).run().exits(0).stdout;
    assert_eq!(read(&scratch.join("out/wiring.md")), markdown);
    let picture = sensedsl(["solve", FIG2, "-q", "--format", "svg"]).run().exits(0).stdout;
    assert_eq!(read(&scratch.join("out/pinout.svg")), picture);
}

#[test]
fn the_same_input_gives_the_same_bytes_wherever_it_is() {
    for file in [FIG2, CAR] {
        let (one, other) = (Scratch::new("one"), Scratch::new("other-name"));
        let _ = generate(file, &one, &[]).exits(0);
        let _ = generate(file, &other, &[]).exits(0);
        let first = out(&one);
        assert_eq!(first, out(&other));
        let _ = generate(file, &one, &[]).exits(0);
        assert_eq!(first, out(&one), "and a second run changes nothing");
        // The design is named after its file, wherever that is.
        let name = file.rsplit('/').next().unwrap_or(file);
        let copy = other.write(&format!("elsewhere/{name}"), sensedsl_tests::text(file));
        let third = Scratch::new("third");
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
    let scratch = Scratch::new("times");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let time = |name: &str| fs::metadata(scratch.join(name)).unwrap().modified().unwrap();
    let makefile = format!("out/{FIRMWARE}/Makefile");
    let before = time(&makefile);
    std::thread::sleep(std::time::Duration::from_millis(20));
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    assert_eq!(time(&makefile), before, "make would build all again");
}

#[test]
fn check_compares_and_writes_nothing() {
    let scratch = Scratch::new("check");
    let ran = generate(FIG2, &scratch, &["--check"]).exits(1);
    assert!(ran.stderr.contains("error[E0503]"), "{}", ran.stderr);
    assert!(!scratch.join("out").exists());
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let _ = generate(FIG2, &scratch, &["--check"]).exits(0);
    scratch.write("out/wiring.md", "changed");
    let ran = generate(FIG2, &scratch, &["--check"]).exits(1);
    assert!(ran.stderr.contains("different: wiring.md"), "{}", ran.stderr);
    assert_eq!(read(&scratch.join("out/wiring.md")), "changed");
    fs::remove_file(scratch.join("out/schema.json")).unwrap();
    let ran = generate(FIG2, &scratch, &["--check"]).exits(1);
    assert!(ran.stderr.contains("missing: schema.json"), "{}", ran.stderr);
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let _ = generate(FIG2, &scratch, &["--check"]).exits(0);
    let ran = generate(FIG2, &scratch, &["--check", "--host", "cpp"]).exits(1);
    assert!(ran.stderr.contains("no longer made: host/"), "{}", ran.stderr);
    // A file of the user's is accepted with any content.
    scratch.write(&format!("out/{FIRMWARE}/user/user.c"), "mine");
    let _ = generate(FIG2, &scratch, &["--check"]).exits(0);
}

#[test]
fn foreign_files_are_left_alone_and_said() {
    let scratch = Scratch::new("foreign");
    scratch.write("out/thesis.tex", "years of work");
    scratch.write("out/wiring.md", "my own notes");
    let before = out(&scratch);
    let ran = generate(FIG2, &scratch, &[]).exits(1);
    assert!(ran.stderr.contains("error[E0502]"), "{}", ran.stderr);
    assert!(ran.stderr.contains("thesis.tex") && ran.stderr.contains("wiring.md"));
    assert_eq!(out(&scratch), before);
    fs::remove_file(scratch.join("out/thesis.tex")).unwrap();
    fs::remove_file(scratch.join("out/wiring.md")).unwrap();
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    // In folders where users and build tools keep their files, nothing counts as foreign.
    for folder in ["user", "build", ".dep"] {
        scratch.write(&format!("out/{FIRMWARE}/{folder}/more.c"), "int more;\n");
    }
    scratch.write("out/host/cpp/build/CMakeCache.txt", "cache");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    assert!(scratch.join(&format!("out/{FIRMWARE}/user/more.c")).exists());
    scratch.write("out/firmware/notes.txt", "foreign again");
    let _ = generate(FIG2, &scratch, &[]).exits(1);
}

#[test]
fn a_list_that_lies_does_no_harm() {
    let scratch = Scratch::new("lies");
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
    let scratch = Scratch::new("links");
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

#[test]
fn user_files_are_made_once() {
    let scratch = Scratch::new("user");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let user = format!("out/{FIRMWARE}/user/user.c");
    scratch.write(&user, "/* mine */\n");
    scratch.write(&format!("out/{FIRMWARE}/Makefile"), "all: broken\n");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    assert_eq!(read(&scratch.join(&user)), "/* mine */\n");
    assert!(!read(&scratch.join(&format!("out/{FIRMWARE}/Makefile"))).contains("broken"));
}

#[test]
fn what_is_no_longer_made_goes_and_the_user_s_files_stay() {
    let scratch = Scratch::new("stale");
    let named = |name: &str| design("X on STM32F4DiscoveryBoard", &["analog"]).replace('X', name);
    let robot = scratch.write("robot.sense", named("Robot")).display().to_string();
    let _ = generate(&robot, &scratch, &[]).exits(0);
    scratch.write("out/firmware/Robot/user/user.c", "/* mine */\n");
    scratch.write("robot.sense", named("Rover"));
    let _ = generate(&robot, &scratch, &["--host", "cpp"]).exits(0);
    let files = out(&scratch);
    assert!(files.contains_key("firmware/Rover/Makefile"));
    let old: Vec<&String> =
        files.keys().filter(|name| name.contains("Robot") || name.contains("libcluon")).collect();
    assert_eq!(old, ["firmware/Robot/user/user.c"]);
    assert!(!scratch.join("out/host/libcluon").exists(), "empty folders go as well");
}

#[test]
fn nothing_is_written_when_anything_is_wrong() {
    let scratch = Scratch::new("nothing");
    let ten = design("STM32F4DiscoveryBoard", &["analog"; 10]);
    let text = TEXT_OUT.to_owned();
    let empty = design("STM32F4DiscoveryBoard", &[]);
    let bad = design("STM32F4DiscoveryBoard", &["analog: delay = 0;"]);
    let cases = [(ten, "E0401"), (text, "E0501"), (empty, "E0504"), (bad, "E0211")];
    for (text, code) in cases {
        let file = scratch.write("robot.sense", text).display().to_string();
        let ran = generate(&file, &scratch, &[]).exits(1);
        assert!(ran.stderr.contains(&format!("error[{code}]")), "{code}: {}", ran.stderr);
        assert!(!scratch.join("out").exists(), "{code}");
    }
    let ran = generate(FIG2, &scratch, &["--target", "none"]).exits(1);
    assert!(ran.stderr.contains("error[E0504]"), "{}", ran.stderr);
    let _ = generate(FIG2, &scratch, &["--host", "cpp,nosuch"]).exits(2);
    let _ = generate(FIG2, &scratch, &["--board", "nosuch.csv"]).exits(2);
    let _ = generate("no such file", &scratch, &[]).exits(2);
    assert!(!scratch.join("out").exists());
    // Output that was right before stays unchanged.
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let before = out(&scratch);
    let file = scratch.join("robot.sense").display().to_string();
    let _ = generate(&file, &scratch, &[]).exits(1);
    assert_eq!(out(&scratch), before);
}

/// A number in a text can be read from a device, but cannot yet be sent to one.
const TEXT_OUT: &str = "board STM32F407G_DISC1 {
    actuator Out accepts int16 { id = 1; type = uart; end = [10]; format = decimal; field = 0; }
    sensor In returns uint16 { id = 2; type = analog; }
}
";

#[test]
fn all_kinds_come_to_firmware() {
    let kinds = ["encoder", "digital", "uart", "spi", "pwm", "dac", "can: frame = 0x120;"];
    for kind in kinds {
        let scratch = Scratch::new("kinds");
        // Both DAC outputs lead to parts on the board.
        let text = design("STM32F407G_DISC1", &[kind]).replacen('{', "{ release CS43L22;", 1);
        let file = scratch.write("robot.sense", text).display().to_string();
        let _ = generate(&file, &scratch, &[]).exits(0);
        assert!(scratch.join("out/firmware").exists(), "{kind}");
    }
}

#[test]
fn what_is_left_out_on_purpose_is_no_gap() {
    let scratch = Scratch::new("without");
    let file = scratch.write("robot.sense", TEXT_OUT).display().to_string();
    let ran = generate(&file, &scratch, &[]).exits(1);
    assert!(ran.stderr.contains("generate --without firmware"), "{}", ran.stderr);
    let ran = sensedsl(["generate", &file, "--without", "firmware", "-o"])
        .arg(scratch.join("out"))
        .run()
        .exits(0);
    assert!(
        !ran.stdout.contains("sensedsl build") && !ran.stderr.contains("next:"),
        "{}",
        ran.stderr
    );
    let files = out(&scratch);
    assert!(files.keys().all(|file| !file.starts_with("firmware/")), "{files:?}");
    assert!(files.contains_key("host/cpp/CMakeLists.txt") && files.contains_key("wiring.md"));

    let _ = generate(FIG2, &scratch, &["--without", "host"]).exits(0);
    let files = out(&scratch);
    assert!(files.keys().all(|file| !file.starts_with("host/")), "{files:?}");
    assert!(files.contains_key(&format!("{FIRMWARE}/Makefile")));
    let _ = generate(FIG2, &scratch, &["--without", "host,firmware"]).exits(0);
    let left: Vec<String> =
        out(&scratch).into_keys().filter(|name| !name.contains("/user/")).collect();
    let kept = [".sensedsl-files", "assignment.json", "pinout.svg", "schema.json", "wiring.md"];
    assert_eq!(left, kept);
    let ran = generate(FIG2, &scratch, &["--without", "host", "--host", "cpp"]).exits(2);
    assert!(
        ran.stderr.contains("--host asks for what --without host leaves out"),
        "{}",
        ran.stderr
    );
}

#[test]
fn the_wiring_can_be_kept() {
    let scratch = Scratch::new("keep");
    let one = design("STM32F4DiscoveryBoard", &["analog: pin = PC5;", "icu"]);
    let file = scratch.write("robot.sense", one).display().to_string();
    let _ = generate(&file, &scratch, &[]).exits(0);
    scratch.write("robot.sense", design("STM32F4DiscoveryBoard", &["analog", "icu", "analog"]));
    let kept = scratch.join("out/assignment.json").display().to_string();
    let _ = generate(&file, &scratch, &["--keep", &kept]).exits(0);
    let answer = read(&scratch.join("out/assignment.json"));
    assert!(answer.contains("\"PC5\"") && answer.contains("\"moved\": 0"), "{answer}");
    let free = sensedsl(["solve", &file, "-q"]).run().exits(0).stdout;
    assert!(!free.contains("PC5"), "{free}");
}

#[test]
fn the_next_command_is_said() {
    let scratch = Scratch::new("next one");
    let ran = sensedsl(["generate", FIG2, "-o"]).arg(scratch.join("out")).run().exits(0);
    let quoted = "next: sensedsl build '";
    assert!(ran.stdout.contains(quoted), "quoted where it has a space: {}", ran.stdout);
    assert!(ran.stdout.contains("' --chibios /path/to/ChibiOS\n"), "{}", ran.stdout);
    assert!(ran.stdout.contains("opportunity cost 5, proved optimal"), "{}", ran.stdout);
}

#[cfg(unix)]
#[test]
fn a_folder_stays_the_one_it_is() {
    use std::os::unix::fs::{MetadataExt as _, PermissionsExt as _, symlink};
    let scratch = Scratch::new("same");
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

#[test]
fn what_earlier_versions_left_behind_is_removed() {
    let scratch = Scratch::new("parts");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    for part in ["out/.wiring.md.part", "out/..sensedsl-files.part", "out/host/cpp/.README.md.part"]
    {
        scratch.write(part, "half of i");
    }
    let _ = generate(FIG2, &scratch, &["--check"]).exits(0);
    assert!(scratch.join("out/.wiring.md.part").exists(), "--check writes nothing");
    let _ = generate(CAR, &scratch, &[]).exits(0);
    assert!(!out(&scratch).keys().any(|name| name.ends_with(".part")));
    // A file that could be somebody's own is not removed.
    scratch.write("out/.thesis.tex.part", "years of work");
    let ran = generate(CAR, &scratch, &[]).exits(1);
    assert!(ran.stderr.contains(".thesis.tex.part"), "{}", ran.stderr);
}

#[cfg(unix)]
#[test]
fn a_pipe_in_the_place_of_a_file_is_replaced_and_nobody_waits_for_it() {
    let scratch = Scratch::new("pipe");
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    let sheet = scratch.join("out/wiring.md");
    fs::remove_file(&sheet).unwrap();
    assert!(Command::new("mkfifo").arg(&sheet).status().unwrap().success());
    let ran = generate(FIG2, &scratch, &["--check"]).exits(1);
    assert!(ran.stderr.contains("different: wiring.md"), "{}", ran.stderr);
    let _ = generate(FIG2, &scratch, &[]).exits(0);
    assert!(read(&sheet).contains("WheelEncoder"));
}

#[test]
fn folders_that_are_none_are_said() {
    let scratch = Scratch::new("none");
    scratch.write("out", "a file");
    let ran = generate(FIG2, &scratch, &[]).exits(2);
    assert!(ran.stderr.contains("is not a folder"), "{}", ran.stderr);
    #[cfg(unix)]
    {
        fs::remove_file(scratch.join("out")).unwrap();
        std::os::unix::fs::symlink("nowhere", scratch.join("out")).unwrap();
        let ran = generate(FIG2, &scratch, &[]).exits(2);
        assert!(ran.stderr.contains("link to a folder that does not exist"), "{}", ran.stderr);
    }
}
