//! `sensedsl flash` to drives that take a program as a file: those of boot loaders and of ST-LINKs are folders here,
//! and cargo is a small script.
#![cfg(unix)]

use std::fs;

use sensedsl_tests::RunOutput;

use super::building::{Machine, elf_of};

const ST: &str = "board STM32F407G_DISC1 { target = embassy; \
                  sensor Light returns uint16 { id = 1; type = analog; } }";
const ELF_OF_ST: &str =
    "build/firmware/STM32F407G_DISC1/target/thumbv7em-none-eabihf/release/firmware";

/// A board with RP2040 or RP2350: its name, the triple of its core, the family, what its boot loader calls it.
type Chip = (&'static str, &'static str, u32, &'static str);
const PICO: Chip = ("RASPBERRYPI_PICO", "thumbv6m-none-eabi", 0xE48B_FF56, "RPI-RP2");
const PICO_2: Chip = ("RASPBERRYPI_PICO_2", "thumbv8m.main-none-eabihf", 0xE48B_FF59, "RP2350");

/// A machine with a cargo that builds nothing, and a design for each board.
fn machine() -> Machine {
    let machine = Machine::new();
    machine.tool("cargo", "echo \"$@\" >> \"$LOG\"");
    machine.tool("rustc", "echo /usr/bin");
    for (board, ..) in [PICO, PICO_2] {
        let text = format!(
            "board {board} {{ target = embassy; sensor Light returns uint16 {{ id = 1; type = analog; }} }}"
        );
        let _ = machine.file(&format!("{board}.sense"), &text);
    }
    let _ = machine.file("st.sense", ST);
    machine
}

/// The program that cargo has built before.
fn elf(machine: &Machine, (board, triple, ..): Chip) -> String {
    let elf = format!("build/firmware/{board}/target/{triple}/release/firmware");
    let _ = machine.scratch.write(&elf, elf_of(0x1000_0000, &[0x5A; 700]));
    elf
}

/// Makes a folder that looks like the drive of a boot loader.
fn drive(machine: &Machine, name: &str, board_id: &str) -> String {
    let info = format!("UF2 Bootloader v3.0\r\nModel: Raspberry Pi\r\nBoard-ID: {board_id}\r\n");
    machine.file(&format!("media/{name}/INFO_UF2.TXT"), &info);
    machine.scratch.join("media").join(name).display().to_string()
}

/// Runs with the drives that are mounted.
fn run(machine: &Machine, arguments: &[&str], drives: &[&str]) -> RunOutput {
    let drives = std::env::join_paths(drives).unwrap().into_string().unwrap();
    let none = [("CARGO", ""), ("RUSTC", ""), ("CARGO_UNSTABLE_BUILD_STD", "")];
    machine.run(arguments, &[&none[..], &[("SENSEDSL_DRIVES", &drives)]].concat())
}

/// The call must end with this code and these words, before anything is built.
#[track_caller]
fn refused(ran: RunOutput, code: &str, words: &[&str]) {
    let ran = ran.exits(2);
    assert!(ran.stderr.contains(&format!("error[{code}]")), "{code}: {}", ran.stderr);
    for word in words {
        assert!(ran.stderr.contains(word), "{word} is missing in {}", ran.stderr);
    }
}

#[test]
fn a_build_ends_in_a_uf2_file() {
    for chip in [PICO, PICO_2] {
        let machine = machine();
        let (board, _, family, _) = chip;
        let elf = elf(&machine, chip);
        let ran = run(&machine, &["build", &format!("{board}.sense")], &[]).exits(0);
        assert!(ran.stdout.contains(&format!("built {elf}.uf2")), "{}", ran.stdout);
        let file = fs::read(machine.scratch.join(&format!("{elf}.uf2"))).unwrap();
        let last = &file[file.len() - 512..];
        assert_eq!(last[28..32], family.to_le_bytes());
        assert_eq!(last[32..32 + 188], [0x5A; 188]);
        let count = if board == "RASPBERRYPI_PICO" { 3 } else { 4 };
        assert_eq!(file.len(), count * 512);
    }
    // The boot loaders of other boards do not take such files.
    let machine = machine();
    let _ = run(&machine, &["build", "st.sense"], &[]).exits(0);
    assert!(!machine.scratch.join(&format!("{ELF_OF_ST}.uf2")).exists());
}

#[test]
fn a_program_is_copied_to_the_drive_of_its_board() {
    for chip in [PICO, PICO_2] {
        let machine = machine();
        let (board, _, _, board_id) = chip;
        let elf = elf(&machine, chip);
        let drive = drive(&machine, "me/BOARD", board_id);
        let file = format!("{board}.sense");
        let ran = run(&machine, &["flash", &file], &["/nowhere", &drive]).exits(0);
        assert!(ran.stdout.contains(&format!("copy {elf}.uf2 to {drive}")), "{}", ran.stdout);
        assert!(ran.stdout.contains(&format!("flashed {board}")), "{}", ran.stdout);
        let copy = fs::read(format!("{drive}/firmware.uf2")).unwrap();
        assert_eq!(copy, fs::read(machine.scratch.join(&format!("{elf}.uf2"))).unwrap());
        // The same for the folder of the board.
        fs::remove_file(format!("{drive}/firmware.uf2")).unwrap();
        let folder = format!("build/firmware/{board}");
        let _ = run(&machine, &["flash", &folder, "--with", "drive"], &[&drive]).exits(0);
        assert_eq!(fs::read(format!("{drive}/firmware.uf2")).unwrap(), copy);
    }
}

#[test]
fn another_chip_s_drive_is_left_alone() {
    let machine = machine();
    let _ = elf(&machine, PICO);
    let other = drive(&machine, "RP2350", "RP2350");
    let pico = ["flash", "RASPBERRYPI_PICO.sense"];
    let words = ["an RP2350", "RASPBERRYPI_PICO has an RP2040", "plug in a board with an RP2040"];
    refused(run(&machine, &pico, &[&other]), "E0527", &words);
    let named = [&pico[..], &["--drive", &other]].concat();
    refused(run(&machine, &named, &[]), "E0527", &words);
    let named = [&pico[..], &["--drive", "bin"]].concat();
    refused(run(&machine, &named, &[]), "E0527", &["bin is not a drive", "INFO_UF2.TXT"]);
    let strange = drive(&machine, "FEATHER", "SAMD21");
    refused(run(&machine, &pico, &[&strange]), "E0527", &["calls itself `SAMD21`"]);
    for drive in [other, strange] {
        assert_eq!(fs::read_dir(drive).unwrap().count(), 1);
    }
    // Where the right one is there as well, it is taken.
    let own = drive(&machine, "RPI-RP2", "RPI-RP2");
    let both = ["media/RP2350", "media/RPI-RP2"].map(|name| machine.scratch.join(name));
    let both = both.map(|path| path.display().to_string());
    let _ = run(&machine, &pico, &[&both[0], &both[1]]).exits(0);
    assert!(fs::exists(format!("{own}/firmware.uf2")).unwrap());
}

#[test]
fn several_boards_are_told_and_one_is_named() {
    let machine = machine();
    let _ = elf(&machine, PICO);
    let (first, second) =
        (drive(&machine, "RPI-RP2", "RPI-RP2"), drive(&machine, "RPI-RP21", "RPI-RP2"));
    let pico = ["flash", "RASPBERRYPI_PICO.sense"];
    refused(run(&machine, &pico, &[&first, &second]), "E0528", &["2 drives", &first, &second]);
    let named = [&pico[..], &["--drive", &second]].concat();
    let _ = run(&machine, &named, &[&first, &second]).exits(0);
    assert!(!fs::exists(format!("{first}/firmware.uf2")).unwrap());
    assert!(fs::exists(format!("{second}/firmware.uf2")).unwrap());
}

#[test]
fn how_a_board_gets_ready_is_told() {
    let machine = machine();
    let pico = ["flash", "RASPBERRYPI_PICO_2.sense"];
    let ready =
        ["hold BOOTSEL while you plug the board in", "a drive appears", "no tool is needed"];
    refused(run(&machine, &pico, &[]), "E0518", &ready);
    assert!(!machine.scratch.join("build").exists());
    let xiao = "board XIAO_RP2040 { target = embassy; sensor Light returns bool { id = 1; type = digital; } }";
    let _ = machine.file("xiao.sense", xiao);
    let words = ["hold the button B (BOOT)", "picotool (not installed)"];
    refused(run(&machine, &["flash", "xiao.sense"], &[]), "E0518", &words);
    let with = [&pico[..], &["--with", "st-flash"]].concat();
    refused(run(&machine, &with, &[]), "E0518", &["st-flash (does not write to such a board)"]);
    let pill = "board BLACKPILL_F411CE { target = embassy; sensor Light returns bool { id = 1; type = digital; } }";
    let _ = machine.file("pill.sense", pill);
    let words = ["hold BOOT0, press and release NRST", "dfu-util (not installed)"];
    refused(run(&machine, &["flash", "pill.sense"], &[]), "E0518", &words);
}

/// Its program goes behind a boot loader that no other tool brings.
#[test]
fn an_esp32_is_written_by_its_own_tool() {
    let machine = machine();
    let text = "board XIAO_ESP32C3 { target = embassy; sensor Light returns bool { id = 1; type = digital; } }";
    let _ = machine.file("esp.sense", text);
    machine.tool("st-info", "echo Found 1 stlink programmers");
    machine.tool("openocd", "echo \"$@\" >> \"$LOG\"");
    let words = ["espflash (not installed)", "install it: `cargo install espflash`"];
    refused(run(&machine, &["flash", "esp.sense"], &[]), "E0518", &words);
    machine.tool("espflash", "echo \"$@\" >> \"$LOG\"");
    let elf = elf(&machine, ("XIAO_ESP32C3", "riscv32imc-unknown-none-elf", 0, ""));
    let _ = run(&machine, &["flash", "esp.sense"], &[]).exits(0);
    let calls = machine.calls();
    assert!(calls.ends_with(&format!("flash --chip esp32c3 {elf}\n")), "{calls}");
}

#[test]
fn a_tool_that_finds_the_board_comes_first() {
    let machine = machine();
    let elf = elf(&machine, PICO);
    let drive = drive(&machine, "RPI-RP2", "RPI-RP2");
    let found = "case $1 in info) echo 'Program Information';; *) echo \"$@\" >> \"$LOG\";; esac";
    machine.tool("picotool", found);
    // This one is for other boards.
    machine.tool("st-info", "echo Found 1 stlink programmers");
    machine.tool("st-flash", "echo \"$@\" >> \"$LOG\"");
    let pico = ["flash", "RASPBERRYPI_PICO.sense"];
    let _ = run(&machine, &pico, &[&drive]).exits(0);
    let calls = machine.calls();
    assert!(calls.ends_with(&format!("load -u -v -x -t elf {elf}\n")), "{calls}");
    let _ = run(&machine, &[&pico[..], &["--with", "drive"]].concat(), &[&drive]).exits(0);
    assert!(fs::exists(format!("{drive}/firmware.uf2")).unwrap());
}

#[test]
fn an_st_link_takes_raw_bytes() {
    let machine = machine();
    let _ = machine.scratch.write(ELF_OF_ST, elf_of(0x0800_0000, &[0xA5; 0x20]));
    let st_link = |name: &str| {
        machine.file(&format!("media/{name}/MBED.HTM"), "<html>");
        machine.file(&format!("media/{name}/DETAILS.TXT"), "Version: 0221\nBuild: 1\n");
        machine.scratch.join("media").join(name).display().to_string()
    };
    let (own, other) = (st_link("DIS_F407VG"), st_link("NODE_F401RE"));
    let flash = ["flash", "st.sense"];
    let words = ["an ST-LINK with an STM32F401RE", "has an STM32F407VGT6"];
    refused(run(&machine, &flash, &[&other]), "E0527", &words);
    // A probe of another make is not asked.
    let daplink = st_link("DAPLINK");
    machine.file("media/DAPLINK/DETAILS.TXT", "# DAPLink Firmware\n");
    refused(run(&machine, &flash, &[&daplink]), "E0518", &["a drive of the board (none)"]);
    let _ = run(&machine, &flash, &[&other, &own]).exits(0);
    assert_eq!(fs::read(format!("{own}/firmware.bin")).unwrap(), [0xA5; 0x20]);
    assert!(!fs::exists(format!("{other}/firmware.bin")).unwrap());
}

#[test]
fn a_drive_that_takes_nothing_is_told() {
    let machine = machine();
    let _ = elf(&machine, PICO);
    let drive = drive(&machine, "RPI-RP2", "RPI-RP2");
    fs::create_dir(format!("{drive}/firmware.uf2")).unwrap();
    let flash = ["flash", "RASPBERRYPI_PICO.sense"];
    let words = ["did not take the program", "you may write to the drive"];
    refused(run(&machine, &flash, &[&drive]), "E0522", &words);
}
