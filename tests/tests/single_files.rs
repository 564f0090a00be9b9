//! Promises about the single files that commands write: a file is written completely or not at all,
//! no file of the user's is replaced without `--force`, and links, modes, devices and pipes are
//! respected.

use std::fs;
use std::path::Path;

use sensedsl_tests::{Scratch, read, sensedsl};

const FIG2: &str = "examples/fig2.sense";
const UNTIDY: &str = "board   STM32F4DiscoveryBoard { }";
const PROJECT: &str = "Mcu.Name=STM32F407V(E-G)Tx\nMcu.UserName=STM32F407VGTx\n\
    PA1.Signal=ADCx_IN1\nSH.ADCx_IN1.0=ADC1_IN1,IN1\n";

/// The names in a folder, in order.
fn names(scratch: &Scratch) -> Vec<String> {
    let entries = fs::read_dir(scratch.path()).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn import_replaces_nothing_unasked() {
    let scratch = Scratch::new("import-over");
    let project = scratch.write("rover.ioc", PROJECT);
    let out = scratch.join("out.sense");
    let import = || sensedsl(["import", "-q"]).arg(&project).arg("-o").arg(&out);
    // The table beside the result is not replaced either, and then no file is written at all.
    let table = scratch.write("out.csv", "years of work");
    let ran = import().run().exits(2);
    assert!(
        ran.stderr.contains("error[E0508]") && ran.stderr.contains("out.csv"),
        "{}",
        ran.stderr
    );
    assert!(ran.stderr.contains("--force"), "{}", ran.stderr);
    assert_eq!((read(&table).as_str(), out.exists()), ("years of work", false));
    let _ = import().arg("--force").run().exits(0);
    assert!(read(&table).starts_with("# mcu") && out.exists(), "{}", read(&table));
    // Importing the same again is no conflict; nor is a missing file of the two, nor an empty one.
    let _ = import().run().exits(0);
    fs::remove_file(&out).unwrap();
    let _ = import().run().exits(0);
    fs::write(&table, "").unwrap();
    let _ = import().run().exits(0);
    fs::write(&out, "mine").unwrap();
    let ran = import().run().exits(2);
    assert!(ran.stderr.contains("out.sense"), "{}", ran.stderr);
    assert_eq!(read(&out), "mine");
    assert_eq!(names(&scratch), ["out.csv", "out.sense", "rover.ioc"]);
    // A result that cannot be written leaves the table unwritten.
    let folder = scratch.join("folder.sense");
    fs::create_dir(&folder).unwrap();
    let ran = sensedsl(["import", "-q", "--force"]).arg(&project).arg("-o").arg(&folder).run();
    assert_eq!((ran.status, scratch.join("folder.csv").exists()), (2, false), "{}", ran.stderr);
    let printed = sensedsl(["import", "-q"]).arg(&project).args(["-o", "-"]).run().exits(0).stdout;
    assert_eq!(printed, sensedsl(["import", "-q"]).arg(&project).run().exits(0).stdout);
}

#[test]
fn new_replaces_nothing_unasked() {
    let scratch = Scratch::new("new-over");
    let dir = scratch.join("robot");
    let new = || sensedsl(["new", "-q"]).arg(&dir);
    let _ = new().run().exits(0);
    let first = read(&dir.join("robot.sense"));
    let _ = new().run().exits(0);
    scratch.write("robot/robot.sense", "mine");
    let ran = new().run().exits(2);
    assert!(ran.stderr.contains("error[E0508]"), "{}", ran.stderr);
    assert_eq!(read(&dir.join("robot.sense")), "mine");
    scratch.write("robot/robot.sense", &first);
    scratch.write("robot/notes.txt", "notes");
    let ran = new().run().exits(2);
    assert!(ran.stderr.contains("notes.txt") && ran.stderr.contains("--force"), "{}", ran.stderr);
    scratch.write("robot/robot.sense", "mine");
    let _ = new().arg("--force").run().exits(0);
    assert_eq!(read(&dir.join("robot.sense")), first);
    assert_eq!(read(&dir.join("notes.txt")), "notes");
}

#[test]
fn a_certificate_replaces_a_certificate_and_nothing_else() {
    let scratch = Scratch::new("proof-over");
    let proof = scratch.join("proof.json");
    let solve = || sensedsl(["solve", "-q", FIG2, "--proof"]).arg(&proof);
    let _ = solve().run().exits(0);
    let _ = solve().arg("--keep").arg(scratch.write("a.json", answer())).run().exits(0);
    fs::write(&proof, "{ \"mine\": true }").unwrap();
    let ran = solve().run().exits(2);
    assert!(ran.stderr.contains("error[E0508]") && ran.stdout.is_empty(), "{}", ran.stderr);
    assert_eq!(read(&proof), "{ \"mine\": true }");
    let _ = solve().arg("--force").run().exits(0);
    assert!(read(&proof).contains("SenseDSL certificate"));
}

fn answer() -> String {
    sensedsl(["solve", "-q", FIG2, "--format", "json"]).run().exits(0).stdout
}

#[cfg(unix)]
#[test]
fn links_stay_links_and_modes_stay_modes() {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    let scratch = Scratch::new("links");
    let real = scratch.write("elsewhere/real.sense", UNTIDY);
    fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).unwrap();
    symlink("elsewhere/real.sense", scratch.join("one.sense")).unwrap();
    symlink("one.sense", scratch.join("two.sense")).unwrap();
    let _ = sensedsl(["fmt", "-q"]).arg(scratch.join("two.sense")).run().exits(0);
    for link in ["one.sense", "two.sense"] {
        assert!(fs::symlink_metadata(scratch.join(link)).unwrap().is_symlink(), "{link}");
    }
    assert_ne!(read(&real), UNTIDY);
    assert_eq!(fs::metadata(&real).unwrap().permissions().mode() & 0o777, 0o640);
    // A link to a missing file leads to where the file is created.
    symlink("elsewhere/proof.json", scratch.join("proof.json")).unwrap();
    let solve = sensedsl(["solve", "-q", FIG2, "--proof"]);
    let _ = solve.arg(scratch.join("proof.json")).run().exits(0);
    assert!(scratch.join("elsewhere/proof.json").is_file());
    assert!(fs::symlink_metadata(scratch.join("proof.json")).unwrap().is_symlink());
    // A link to itself is reported.
    symlink("loop.json", scratch.join("loop.json")).unwrap();
    let solve = sensedsl(["solve", "-q", FIG2, "--proof"]);
    let _ = solve.arg(scratch.join("loop.json")).run().exits(2);
}

#[cfg(target_os = "linux")]
#[test]
fn devices_and_pipes_are_written_to() {
    use std::os::unix::fs::FileTypeExt as _;
    use std::process::Command;
    let device = |path: &str| fs::metadata(path).unwrap().file_type().is_char_device();
    assert!(device("/dev/full"));
    let ran = sensedsl(["solve", "-q", FIG2, "--proof", "/dev/full"]).run().exits(2);
    assert!(ran.stderr.contains("/dev/full: No space left"), "{}", ran.stderr);
    assert!(device("/dev/full"), "replaced by a file");
    let _ = sensedsl(["solve", "-q", FIG2, "--proof", "/dev/null"]).run().exits(0);
    assert!(device("/dev/null"), "replaced by a file");
    let ran = sensedsl(["solve", "-q", FIG2, "--proof", "/dev/stdout"]).run().exits(0);
    assert!(ran.stdout.contains("opportunity cost 5") && ran.stdout.contains("certificate 4"));
    let scratch = Scratch::new("pipes");
    let project = scratch.write("rover.ioc", PROJECT);
    let printed = sensedsl(["import", "-q"]).arg(&project).run().exits(0).stdout;
    let ran = sensedsl(["import", "-q"]).arg(&project).args(["-o", "/dev/stdout"]).run().exits(0);
    assert_eq!(ran.stdout, printed);
    let pipe = scratch.join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let reader = {
        let pipe = pipe.clone();
        std::thread::spawn(move || read(&pipe))
    };
    let _ = sensedsl(["import", "-q"]).arg(&project).arg("-o").arg(&pipe).run().exits(0);
    assert_eq!(reader.join().unwrap(), printed);
    assert!(fs::metadata(&pipe).unwrap().file_type().is_fifo());
    assert_eq!(names(&scratch), ["pipe", "rover.ioc"]);
}

#[test]
fn what_was_left_behind_is_removed_by_the_next_who_writes_the_file() {
    let scratch = Scratch::new("leftovers");
    let file = scratch.write("robot.sense", UNTIDY);
    scratch.write(".robot.sense.sensedsl-part-1-0", "half of i");
    scratch.write(".other.sense.sensedsl-part-1-0", "somebody else's");
    let _ = sensedsl(["fmt", "-q"]).arg(&file).run().exits(0);
    assert_eq!(names(&scratch), [".other.sense.sensedsl-part-1-0", "robot.sense"]);
    assert!(Path::new(&file).is_file());
}

#[test]
fn new_goes_on_where_one_was_killed_and_prints_what_a_shell_takes() {
    let scratch = Scratch::new("new-killed");
    let name = "$(touch evil) it's";
    for part in [".robot.sense.sensedsl-part-1-0", ".README.md.sensedsl-part-1-1"] {
        scratch.write(&format!("{name}/{part}"), "half of i");
    }
    let ran = sensedsl(["new"]).arg(scratch.join(name)).run().exits(0);
    assert!(ran.stdout.contains("'\\''s/robot.sense'"), "{} {}", ran.stdout, ran.stderr);
    let mut names: Vec<_> = fs::read_dir(scratch.join(name)).unwrap().collect();
    names.retain(|entry| entry.as_ref().unwrap().file_name().to_string_lossy().contains("part"));
    assert!(names.is_empty(), "{names:?}");
}
