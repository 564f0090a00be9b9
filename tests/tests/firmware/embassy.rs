//! Projects for Embassy, built for the board as a user builds them: no warning may come from them.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use sensedsl_tests::{TempDir, drawn, has, is_thorough, missing, printed, root, sensedsl};

use super::tools::scratch;

/// All projects are built in one folder, one at a time: each leaves its image under the same name.
pub(crate) static FOLDER: Mutex<()> = Mutex::new(());

/// A program of the only board of a design; none where the machine cannot build it, or has no time to.
pub(crate) fn program(name: &str, text: &str) -> Option<PathBuf> {
    project(name, text).map(|board| build(&board))
}

/// The project of the only board of a design; none where the machine cannot build it, or has no time to.
pub(crate) fn project(name: &str, text: &str) -> Option<PathBuf> {
    (is_thorough() && can_build()).then(|| generated(name, text))
}

/// Whether the machine has what builds a project; otherwise says so.
pub(crate) fn can_build() -> bool {
    let found = Path::new("/usr/bin/rustc").exists() && has("arm-none-eabi-ld");
    if !found {
        missing("rustc-web with rust-web-src, and arm-none-eabi-ld");
    }
    found
}

/// The project of the only board of a design, not built.
pub(crate) fn generated(name: &str, text: &str) -> PathBuf {
    let designs = TempDir::new(name);
    let file = designs.write("design.sense", text).display().to_string();
    let folder = scratch(name);
    let out = folder.display().to_string();
    let call = ["generate", &file, "--target", "embassy", "--without", "host", "-q", "-o", &out];
    let _ = sensedsl(call).run().exits(0);
    let mut boards = std::fs::read_dir(folder.join("firmware")).unwrap();
    boards.next().unwrap().unwrap().path()
}

/// Builds a project, from which no warning may come.
pub(crate) fn build(board: &Path) -> PathBuf {
    try_build(board).unwrap_or_else(|log| panic!("{log}"))
}

/// All projects have one name: in a folder that they share, cargo would take another's program for this one's, where that
/// was built later than this was written.
pub(crate) fn is_newer_than_others(board: &Path) {
    let main = std::fs::File::options().append(true).open(board.join("src/main.rs")).unwrap();
    main.set_modified(std::time::SystemTime::now()).unwrap();
}

/// What makes a build quicker, and its program longer: no optimisation at link time.
const QUICK: [&str; 2] = ["profile.release.lto=false", "profile.release.codegen-units=16"];

/// Builds a project, quickly if its program then fits in the flash; or what the compiler says against it.
pub(crate) fn try_build(board: &Path) -> Result<PathBuf, String> {
    let _alone = FOLDER.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    match compile(board, &QUICK) {
        Err(log) if log.contains("will not fit in region") => compile(board, &[]),
        other => other,
    }
}

fn compile(board: &Path, settings: &[&str]) -> Result<PathBuf, String> {
    let config = std::fs::read_to_string(board.join(".cargo/config.toml")).unwrap();
    let triple = config.split("target = \"").nth(1).unwrap().split('"').next().unwrap();
    let target = root().join("target/embassy-build");
    is_newer_than_others(board);
    let mut cargo = Command::new("cargo");
    cargo.args(["build", "--release", "-Zbuild-std=core", "--locked", "--target-dir"]).arg(&target);
    let linker = format!("target.{triple}.linker=\"arm-none-eabi-ld\"");
    for setting in std::iter::once(linker.as_str()).chain(settings.iter().copied()) {
        cargo.args(["--config", setting]);
    }
    cargo.env("RUSTC_BOOTSTRAP", "1").env("RUSTC", "/usr/bin/rustc").env_remove("RUSTFLAGS");
    let output = cargo.current_dir(board).output().unwrap();
    let log = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() || log.contains("warning") {
        return Err(log.into_owned());
    }
    let program = board.join("firmware.elf");
    let built = target.join(triple).join("release/firmware");
    let _ = std::fs::copy(built, &program).unwrap();
    Ok(program)
}

/// The cores that families have beside the Cortex-M4, whose images run on the emulated MCU: M0, M3 and M33. One of them
/// is drawn in a usual run.
#[test]
fn an_image_for_each_core_links() {
    let all = [
        ("NUCLEO_F072RB", "Tag_CPU_arch: v6S-M"),
        ("NUCLEO_F103RB", "Tag_CPU_arch: v7"),
        ("NUCLEO_H563ZI", "Tag_CPU_arch: v8-M.mainline"),
    ];
    for (board, core) in drawn("cores of images", &all, 1) {
        let text = format!(
            "board {board} {{\n\
             sensor Light returns uint16 {{ type = analog; }}\n\
             sensor Range returns uint16 {{ type = i2c; driver = srf08; address = 0x70; }}\n\
             sensor Wheel returns uint32 {{ type = icu; }}\n\
             actuator Servo accepts uint16 {{ type = pwm; frequency = 50 Hz; failsafe = 1500; }}\n}}\n"
        );
        let Some(elf) = program(&format!("core_{board}"), &text) else { return };
        let read = printed(Command::new("arm-none-eabi-readelf").args(["-hA"]).arg(&elf));
        assert!(read.contains("EXEC (Executable file)") && read.contains(core), "{board}: {read}");
    }
}
