//! Promises about the single files that commands write: links, modes, devices and pipes are
//! respected. The others are in `scripts/single_files.txt`.

use std::fs;

use sensedsl_tests::{TempDir, read, sensedsl};

const FIG2: &str = "examples/fig2.sense";
const UNTIDY: &str = "board   STM32F4DiscoveryBoard { }";
const PROJECT: &str = "Mcu.Name=STM32F407V(E-G)Tx\nMcu.UserName=STM32F407VGTx\n\
    PA1.Signal=ADCx_IN1\nSH.ADCx_IN1.0=ADC1_IN1,IN1\n";

/// The names in a folder, in order.
fn names(scratch: &TempDir) -> Vec<String> {
    let entries = fs::read_dir(scratch.path()).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[cfg(unix)]
#[test]
fn links_stay_links_and_modes_stay_modes() {
    use std::os::unix::fs::{PermissionsExt as _, symlink};
    let scratch = TempDir::new("links");
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
    let scratch = TempDir::new("pipes");
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
fn new_goes_on_where_one_was_killed_and_prints_what_a_shell_takes() {
    let scratch = TempDir::new("new-killed");
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
