//! `sensedsl build` and `flash`: whatever is missing is reported with its code before anything is
//! written or built. Here, make, compiler and flashing tools are small scripts, and the tree is a
//! few empty files; the real ones are tried if `CHIBIOS` names a tree.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::{Path, PathBuf};

use sensedsl_tests::{RunOutput, TempDir, sensedsl};

use super::applications::{FIG2, TWO};

const GCC: &str = "arm-none-eabi-gcc";

/// A machine with a ChibiOS tree, make and a compiler, all of which do nothing.
pub(super) struct Machine {
    pub(super) scratch: TempDir,
}

impl Machine {
    pub(super) fn new() -> Self {
        let machine = Self { scratch: TempDir::new("building") };
        let release = "#define CH_VERSION_STABLE 1\n#define CH_VERSION \"2021.11.5\"\n";
        machine.file("tree/os/license/chversion.h", release);
        for path in wanted_by_fig2() {
            machine.file(&format!("tree/{path}"), "");
        }
        machine.tool("make", "echo GNU Make 4.3; echo \"$@\" >> \"$LOG\"; exit ${MAKE_ENDS:-0}");
        machine.compiler("12.2.1", "/usr/lib/libc.a");
        machine.tool("arm-none-eabi-objcopy", "");
        machine.file("fig2.sense", FIG2);
        machine.file("two.sense", TWO);
        machine
    }

    pub(super) fn file(&self, path: &str, text: &str) -> PathBuf {
        self.scratch.write(path, text)
    }

    fn remove(&self, path: &str) {
        fs::remove_file(self.scratch.join(path)).unwrap();
    }

    pub(super) fn tool(&self, name: &str, script: &str) {
        let path = self.file(&format!("bin/{name}"), &format!("#!/bin/sh\n{script}\n"));
        fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
    }

    fn compiler(&self, version: &str, library: &str) {
        let script = format!("case $1 in -dumpversion) echo {version};; *) echo {library};; esac");
        self.tool(GCC, &script);
    }

    /// Runs the program in the machine's folder, with its tools and its tree.
    pub(super) fn run(&self, arguments: &[&str], settings: &[(&str, &str)]) -> RunOutput {
        let path = |name: &str| self.scratch.join(name).display().to_string();
        let mut call = sensedsl(arguments).within(self.scratch.path());
        call = call.env("PATH", &path("bin")).env("LOG", &path("log"));
        call = call.env("CHIBIOS", &path("tree"));
        // Boards of the one who runs this are left alone.
        call = call.env("SENSEDSL_DRIVES", &path("no drives"));
        for (name, value) in settings {
            call = call.env(name, value);
        }
        call.run()
    }

    /// The command must be refused with this code before anything is written or built.
    #[track_caller]
    pub(super) fn refuses(
        &self,
        arguments: &[&str],
        settings: &[(&str, &str)],
        code: &str,
        words: &[&str],
    ) {
        let ran = self.run(arguments, settings).exits(2);
        assert!(ran.stderr.contains(&format!("error[{code}]")), "{code}: {}", ran.stderr);
        for word in words {
            assert!(ran.stderr.contains(word), "{word} is missing in {}", ran.stderr);
        }
        assert!(!self.scratch.join("build").exists(), "{code}: something was written");
        assert_eq!(self.calls(), "", "{code}: something was built");
    }

    /// The arguments of make in its calls that build.
    pub(super) fn calls(&self) -> String {
        let log = fs::read_to_string(self.scratch.join("log")).unwrap_or_default();
        log.lines().filter(|line| *line != "--version").map(|line| format!("{line}\n")).collect()
    }
}

/// The files that the board of Fig. 2 is built from, according to its Makefile.
fn wanted_by_fig2() -> Vec<String> {
    let makefile = super::applications::files(FIG2)["STM32F4DiscoveryBoard/Makefile"].clone();
    let mut wanted: Vec<String> = makefile
        .lines()
        .filter_map(|line| Some(line.trim().split_once("$(CHIBIOS)/")?.1.to_owned()))
        .filter(|path| path.ends_with(".mk"))
        .collect();
    let cfg = makefile.lines().find_map(|line| line.strip_prefix("BASE_CFG := $(CHIBIOS)/"));
    let files = ["chconf.h", "halconf.h", "mcuconf.h"];
    wanted.extend(files.iter().map(|file| format!("{}/{file}", cfg.unwrap())));
    let rules = makefile.lines().find_map(|line| line.strip_prefix("RULESPATH := $(CHIBIOS)/"));
    wanted
        .extend(["rules.mk", "arm-none-eabi.mk"].map(|file| format!("{}/{file}", rules.unwrap())));
    wanted
}

/// A design for Embassy.
const RUST: &str = "board STM32F407G_DISC1 {\n    target = embassy;\n    \
                    sensor Light returns uint16 { id = 1; type = analog; }\n}\n";

#[test]
fn a_board_for_embassy_is_built_by_cargo() {
    let machine = Machine::new();
    machine.file("rust.sense", RUST);
    let build = ["build", "rust.sense"];
    machine.refuses(&build, &[("CARGO", "")], "E0531", &["firmware for Embassy", "rustup.rs"]);
    machine.tool("cargo", "echo \"$@\" >> \"$LOG\"; exit ${CARGO_ENDS:-0}");
    machine.tool("rustc", "echo \"$LIBRARY\"");
    let add = "rustup target add thumbv7em-none-eabihf";
    let gone = ("LIBRARY", "/nowhere");
    machine.refuses(&build, &[("CARGO", ""), ("RUSTC", ""), gone], "E0523", &[add]);
    let here = ("LIBRARY", "/usr/bin");
    let settings = [("CARGO", ""), ("RUSTC", ""), ("CARGO_TARGET_DIR", ""), here];
    let _ = machine.run(&build, &settings).exits(0);
    let elf = "build/firmware/STM32F407G_DISC1/target/thumbv7em-none-eabihf/release/firmware";
    assert_eq!(machine.calls(), "build --release --locked --target-dir target\n");
    let failed = machine.run(&build, &[&settings[..], &[("CARGO_ENDS", "101")]].concat()).exits(1);
    assert!(failed.stderr.contains("error[E0521]"), "{}", failed.stderr);
    assert!(failed.stderr.contains("cargo ended with status 101"), "{}", failed.stderr);
    // A tool that does not read ELF files gets the contents of one as plain bytes.
    machine.tool("st-info", "echo Found 1 stlink programmers");
    machine.tool("st-flash", "echo \"$@\" >> \"$LOG\"");
    machine.scratch.write(elf, elf_of(0x0800_0000, &[0xA5; 0x20]));
    let _ = machine.run(&["flash", "build/firmware/STM32F407G_DISC1"], &settings).exits(0);
    assert_eq!(fs::read(machine.scratch.join(&format!("{elf}.bin"))).unwrap(), [0xA5; 0x20]);
    assert!(machine.calls().contains(&format!("--reset write {elf}.bin 0x08000000")));
}

/// An ELF file that loads these bytes at an address.
pub(super) fn elf_of(address: u32, bytes: &[u8]) -> Vec<u8> {
    let mut program = vec![0x7F, b'E', b'L', b'F', 1, 1, 1];
    program.resize(0x54, 0);
    let mut word =
        |at: usize, value: u32| program[at..at + 4].copy_from_slice(&value.to_le_bytes());
    word(0x10, 0x0028_0002);
    word(0x1C, 0x34);
    word(0x28, 0x0020_0034);
    word(0x2C, 1);
    let size = u32::try_from(bytes.len()).unwrap();
    for (at, value) in [1, 0x54, address, address, size, size].into_iter().enumerate() {
        word(0x34 + 4 * at, value);
    }
    program.extend(bytes);
    program
}

const BUILD: &[&str] = &["build", "fig2.sense"];
const FLASH: &[&str] = &["flash", "fig2.sense"];

#[test]
fn a_tree_that_will_not_do_is_told() {
    let machine = Machine::new();
    let clone = "git clone --depth 1 -b stable_21.11.x https://github.com/ChibiOS/ChibiOS.git";
    machine.refuses(BUILD, &[("CHIBIOS", "")], "E0512", &["--chibios", clone]);
    machine.refuses(BUILD, &[("CHIBIOS", "nowhere")], "E0513", &["no such folder", clone]);
    machine.refuses(BUILD, &[("CHIBIOS", "fig2.sense")], "E0513", &["it is a file"]);
    machine.refuses(BUILD, &[("CHIBIOS", "bin")], "E0513", &["os/rt/rt.mk"]);
    // The command line takes precedence over the variable.
    machine.refuses(&["build", "fig2.sense", "--chibios", "bin"], &[], "E0513", &["`bin`"]);
    machine.file("with space/os/rt/rt.mk", "");
    machine.refuses(BUILD, &[("CHIBIOS", "with space")], "E0513", &["make cannot read", "link"]);
}

#[test]
fn another_release_is_told() {
    let machine = Machine::new();
    let version = "tree/os/license/chversion.h";
    machine.file(version, "#define CH_VERSION \"2020.3.4\"\n");
    let words = ["ChibiOS 2020.3.4", "needs 21.11", "stable_21.11.x"];
    machine.refuses(BUILD, &[], "E0514", &words);
    machine.remove(version);
    machine.file("tree/os/rt/include/ch.h", "#define CH_KERNEL_VERSION       \"6.1.4\"\n");
    machine.refuses(BUILD, &[], "E0514", &["kernel 6.1.4"]);
}

#[test]
fn a_tree_with_holes_is_told() {
    for path in wanted_by_fig2() {
        // Without these files it is not a tree at all.
        if path == "os/rt/rt.mk" || path.contains("compilers/GCC/mk/") {
            continue;
        }
        let machine = Machine::new();
        machine.remove(&format!("tree/{path}"));
        machine.refuses(BUILD, &[], "E0515", &[&path, "STM32F4DiscoveryBoard"]);
    }
}

#[test]
fn missing_tools_are_told() {
    let apt = "sudo apt install make gcc-arm-none-eabi libnewlib-arm-none-eabi";
    for tool in ["make", GCC, "arm-none-eabi-objcopy"] {
        let machine = Machine::new();
        machine.remove(&format!("bin/{tool}"));
        machine.refuses(BUILD, &[], "E0516", &[tool, apt, "brew install", "WSL"]);
    }
    let machine = Machine::new();
    machine.tool("make", "echo bmake");
    machine.refuses(BUILD, &[], "E0516", &["`make` is missing: GNU make"]);
    let machine = Machine::new();
    machine.compiler("12.2.1", "libc.a");
    machine.refuses(BUILD, &[], "E0516", &["`newlib` is missing", apt]);
}

#[test]
fn an_old_compiler_is_told_with_both_versions() {
    let machine = Machine::new();
    machine.compiler("8.3.1", "/usr/lib/libc.a");
    machine.refuses(BUILD, &[], "E0517", &["version 8.3.1", "needs 9 or later"]);
    machine.compiler("9.2.1", "/usr/lib/libc.a");
    let _ = machine.run(BUILD, &[]).exits(0);
}

#[test]
fn boards_are_told_apart() {
    let machine = Machine::new();
    let board = ["build", "two.sense", "--board", "Middle"];
    machine.refuses(&board, &[], "E0519", &["`Middle`", "Front, Rear"]);
    machine.refuses(&["flash", "two.sense"], &[], "E0519", &["2 boards", "Front, Rear"]);
    let _ = machine.run(&["build", "two.sense", "--board", "Rear", "--production"], &[]).exits(0);
    let calls = machine.calls();
    assert!(calls.contains("-C build/firmware/Rear ") && !calls.contains("Front"), "{calls}");
    assert!(calls.contains("UP_MODE=production") && calls.contains("/tree "), "{calls}");
    let _ = machine.run(&["build", "two.sense"], &[]).exits(0);
    assert!(machine.calls().contains("-C build/firmware/Front "), "{}", machine.calls());
}

#[test]
fn a_place_without_firmware_is_told() {
    let machine = Machine::new();
    machine.refuses(&["build", "tree"], &[], "E0520", &["`tree`", ".sense"]);
    // There are two files, and none is named.
    machine.refuses(&["build"], &[], "E0520", &["name a `.sense` file"]);
    let made = ["generate", "fig2.sense", "-o", "made", "--without", "firmware"];
    let _ = machine.run(&made, &[]).exits(0);
    machine.refuses(&["build", "made"], &[], "E0520", &["without firmware"]);
    let ran = machine.run(&["build", "none.sense"], &[]).exits(2);
    assert!(ran.stderr.contains("E0111"), "{}", ran.stderr);
    machine.file("due.sense", "board ARDUINO_DUE { sensor A returns uint16 { type = analog; } }");
    let ran = machine.run(&["build", "due.sense"], &[]).exits(1);
    assert!(ran.stderr.contains("E0504"), "{}", ran.stderr);
    assert_eq!(machine.calls(), "");
}

#[test]
fn a_folder_is_built_from_wherever_it_is_named() {
    let machine = Machine::new();
    let _ = machine.run(&["generate", "fig2.sense", "-o", "made"], &[]).exits(0);
    let board = "made/firmware/STM32F4DiscoveryBoard";
    for path in ["made", board] {
        let ran = machine.run(&["build", path], &[]).exits(0);
        assert!(ran.stdout.contains(&format!("next: sensedsl flash {board}\n")), "{}", ran.stdout);
    }
    let ran = machine.run(&["build", "made", "-o", "other"], &[]).exits(2);
    assert!(ran.stderr.contains("is a folder"), "{}", ran.stderr);
    let tree = machine.scratch.join("tree").display().to_string();
    let here = sensedsl(["build", "--chibios", &tree]).within(&machine.scratch.join(board));
    let here = here.env("PATH", &machine.scratch.join("bin").display().to_string());
    let _ = here.env("LOG", &machine.scratch.join("log").display().to_string()).run().exits(0);
    assert_eq!(machine.calls().matches("-C").count(), 3, "{}", machine.calls());
}

#[test]
fn a_build_that_fails_is_told_and_not_flashed() {
    let machine = Machine::new();
    machine.tool("st-info", "echo Found 1 stlink programmers");
    machine.tool("st-flash", "case $1 in --version) ;; *) echo flashed >> \"$LOG\";; esac");
    let ran = machine.run(FLASH, &[("MAKE_ENDS", "2")]).exits(1);
    assert!(
        ran.stderr.contains("error[E0521]") && ran.stderr.contains("status 2"),
        "{}",
        ran.stderr
    );
    assert!(!machine.calls().contains("flashed"), "{}", machine.calls());
}

#[test]
fn nothing_to_flash_with_is_told_before_the_build() {
    let machine = Machine::new();
    let all = ["st-flash", "probe-rs", "dfu-util", "openocd", "sudo apt install stlink-tools"];
    machine.refuses(FLASH, &[], "E0518", &all);
    machine.tool("st-info", "echo Found 0 stlink programmers");
    machine.tool("st-flash", "");
    machine.tool("dfu-util", "echo dfu-util 0.11");
    machine.tool("openocd", "");
    let asked =
        ["st-info --probe (none)", "dfu-util --list (none)", "probe-rs (not installed)", "BOOT0"];
    machine.refuses(FLASH, &[], "E0518", &asked);
    let with = ["flash", "fig2.sense", "--with", "probe-rs"];
    machine.refuses(&with, &[], "E0518", &["looked for probe-rs (not installed)"]);
}

/// Flashes with the available tools, and returns the arguments of the last call.
fn flashed(machine: &Machine, with: &[&str]) -> String {
    let ran = machine.run(&[FLASH, with].concat(), &[]).exits(0);
    assert!(ran.stdout.contains("flashed STM32F4DiscoveryBoard"), "{}", ran.stdout);
    let last = machine.calls().lines().last().unwrap_or_default().to_owned();
    last.replace("build/firmware/STM32F4DiscoveryBoard/build/development/", "")
}

#[test]
fn the_first_tool_that_finds_a_board_flashes() {
    let machine = Machine::new();
    let log = "echo \"$@\" >> \"$LOG\"";
    machine.tool("openocd", &format!("case $1 in --version) ;; *) {log};; esac"));
    let by_openocd = flashed(&machine, &[]);
    let openocd =
        "-f interface/stlink.cfg -f target/stm32f4x.cfg -c program {sense.elf} verify reset exit";
    assert_eq!(by_openocd, openocd);
    let dfu =
        format!("case $1 in --list) echo 'Found DFU: [0483:df11] ver=2200';; *) {log};; esac");
    machine.tool("dfu-util", &dfu);
    assert_eq!(flashed(&machine, &[]), "-a 0 -s 0x08000000:leave -D sense.bin");
    let probe = format!("case $1 in list) echo '[0]: STLink V2-1';; *) {log};; esac");
    machine.tool("probe-rs", &probe);
    let download = "download --chip STM32F407VGTx --verify sense.elf";
    assert_eq!(flashed(&machine, &[]), download);
    machine.tool("st-info", "echo Found 1 stlink programmers");
    machine.tool("st-flash", &format!("case $1 in --version) ;; *) {log};; esac"));
    assert_eq!(flashed(&machine, &[]), "--reset write sense.bin 0x08000000");
    assert_eq!(flashed(&machine, &["--with", "probe-rs"]), download);
    assert_eq!(flashed(&machine, &["--with", "openocd"]), openocd);
}

#[test]
fn a_tool_that_fails_and_an_mcu_that_is_not_known_are_told() {
    let machine = Machine::new();
    machine.tool("st-info", "echo Found 1 stlink programmers");
    machine.tool("st-flash", "case $1 in --version) ;; *) echo no target >&2; exit 1;; esac");
    let ran = machine.run(FLASH, &[]).exits(2);
    assert!(
        ran.stderr.contains("error[E0522]") && ran.stderr.contains("no target"),
        "{}",
        ran.stderr
    );
    // The folder of a board by itself does not give the MCU, which OpenOCD needs.
    machine.tool("openocd", "");
    let board = "build/firmware/STM32F4DiscoveryBoard";
    fs::rename(machine.scratch.join(board), machine.scratch.join("moved")).unwrap();
    let ran = machine.run(&["flash", "moved", "--with", "openocd"], &[]).exits(2);
    assert!(ran.stderr.contains("error[E0522]") && ran.stderr.contains("MCU"), "{}", ran.stderr);
}

/// Builds with the real tree and the real tools.
#[test]
fn fig2_is_built_with_the_real_tree() {
    let Some(tree) = super::chibios::tree() else { return };
    let scratch = TempDir::new("really-building");
    let file = scratch.write("fig2.sense", FIG2).display().to_string();
    let call = sensedsl(["build", &file]).env("CHIBIOS", &tree.display().to_string());
    let ran = call.run().exits(0);
    let elf = scratch.join("build/firmware/STM32F4DiscoveryBoard/build/development/sense.elf");
    assert!(is_elf(&elf), "{}\n{}", ran.stdout, ran.stderr);
    assert!(ran.stdout.contains("sense.elf"), "{}", ran.stdout);
}

fn is_elf(path: &Path) -> bool {
    fs::read(path).is_ok_and(|bytes| bytes.starts_with(b"\x7fELF"))
}
