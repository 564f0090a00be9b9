//! Bit times of CAN buses: the runtime produces every rate that the tool accepts for a board from
//! the board's clock, within half a per cent and with the sample point late in the bit; for bxCAN
//! and for FDCAN.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use sensedsl_board::catalog;
use sensedsl_tests::{answered, has, is_thorough, one_in, root, run, text};

use super::stubs;
use super::tools::scratch;

/// Usual rates, the least and the greatest that a design may request, and some that no clock
/// divides to.
const RATES: [u32; 24] = [
    10_000, 20_000, 33_333, 47_619, 50_000, 62_500, 83_333, 95_238, 100_000, 125_000, 200_000,
    250_000, 307_692, 333_333, 400_000, 500_000, 600_000, 666_666, 700_000, 750_000, 800_000,
    842_105, 900_000, 1_000_000,
];

/// The runtime with the registers of one kind of controller, compiled once for all tests.
fn program(is_fdcan: bool) -> &'static Path {
    static PROGRAMS: [OnceLock<PathBuf>; 2] = [const { OnceLock::new() }; 2];
    PROGRAMS[usize::from(is_fdcan)].get_or_init(|| compile(is_fdcan))
}

fn compile(is_fdcan: bool) -> PathBuf {
    let name = if is_fdcan { "fdcan" } else { "bxcan" };
    let folder = scratch(&format!("can-{name}"));
    for file in ["chconf.h", "halconf.h", "mcuconf.h"] {
        std::fs::write(folder.join(file), "").unwrap();
    }
    let sizes = "#define UP_CAN_BUSES 10000U\n#define UP_VALUE_BYTES_MAX 8U\n\
                 #define UP_LINK_USB 0\n#define UP_HAS_BUTTON 0\n#define UP_HAS_CONTROL 0\n";
    std::fs::write(folder.join("up_conf.h"), sizes).unwrap();
    let program = folder.join("can");
    let mut cc = Command::new("cc");
    cc.args(["-std=gnu11", "-O1", "-ffunction-sections", "-Wl,--gc-sections", "-Wall", "-Werror"]);
    cc.args(["-DHAL_USE_CAN=1", "-DHAL_USE_SERIAL=1", "-DTRUE=1", "-DFALSE=0", "-DUP_SHELL=0"]);
    cc.args(["-DSTUB_ADC=2", "-DSTUB_I2C=2", "-DSTUB_SPI=1", "-DSTUB_GPIO=2", "-DSTUB_USART=1"]);
    cc.args(["-DSTUB_CORTEX=4", "-DSTUB_WINDOWED=0"]);
    cc.args(if is_fdcan { vec!["-DSTUB_G4", "-DSTUB_FDCAN"] } else { vec!["-DSTUB_F4"] });
    cc.arg("-I").arg(&folder);
    for path in
        ["tests/firmware/stubs", "crates/firmware-c/runtime", "crates/firmware-chibios/runtime"]
    {
        cc.arg("-I").arg(root().join(path));
    }
    cc.arg(root().join("tests/firmware/can/main.c"))
        .arg(root().join("crates/firmware-chibios/runtime/up_can.c"));
    run(cc.arg("-o").arg(&program));
    program
}

/// The runtime's bit times for each request: prescaler, steps before and after the sample point,
/// jump width; `None` if it halts.
fn bit_times(is_fdcan: bool, asked: &[(u32, u32)]) -> Vec<Option<[u32; 4]>> {
    let lines: String = asked.iter().map(|(clock, rate)| format!("{clock} {rate}\n")).collect();
    let output = answered(&mut Command::new(program(is_fdcan)), lines);
    let numbers = |line: &str| {
        let numbers: Vec<u32> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
        <[u32; 4]>::try_from(numbers).ok()
    };
    let made: Vec<_> = output.lines().map(numbers).collect();
    assert_eq!(made.len(), asked.len());
    made
}

/// The mistake in a bit time; `None` if it is right.
fn fault(is_fdcan: bool, (clock, rate): (u32, u32), time: [u32; 4]) -> Option<String> {
    let [prescaler, before, behind, jump] = time;
    let steps = 1 + before + behind;
    let made = f64::from(clock) / f64::from(prescaler * steps);
    let off = (made - f64::from(rate)).abs() / f64::from(rate);
    let sample = f64::from(1 + before) / f64::from(steps);
    let prescalers = if is_fdcan { 512 } else { 1024 };
    // Half a per cent, plus the rounding to whole numbers.
    let is_right = off <= 0.005 + 2.0 / f64::from(rate)
        && (0.77..=0.875).contains(&sample)
        && (8..=25).contains(&steps)
        && prescaler <= prescalers
        && before <= 16
        && behind <= 8
        && jump <= behind
        && jump <= 4;
    (!is_right).then(|| format!("{rate} of {clock}: {time:?}, {made} Hz, sample at {sample}"))
}

/// The CAN clock of each board, and whether its controller is an FDCAN.
fn clocks() -> Vec<(String, u32, bool)> {
    let mut seen = BTreeSet::new();
    let mut clocks = Vec::new();
    for entry in catalog::all() {
        let Some(profile) = stubs::profile_of(entry.mcu) else { continue };
        let board = entry.board().unwrap();
        let clock = profile.cans.first().and_then(|unit| unit.clock.clone());
        let facts = board.system.get("chibios");
        let hz = clock.and_then(|clock| facts?.clocks_hz.get(&clock).copied());
        let is_fdcan = profile.cans.iter().any(|unit| unit.name.starts_with("FDCAN"));
        let Some(hz) = hz.filter(|hz| seen.insert((*hz, is_fdcan))) else { continue };
        clocks.push((entry.name.replace('-', "_"), hz, is_fdcan));
    }
    clocks
}

#[test]
fn every_bit_rate_that_is_accepted_is_made() {
    if !has("cc") {
        return;
    }
    let design = text("tests/firmware/kinds/can.sense");
    let (mut wrong, mut made, mut refused) = (Vec::new(), [0, 0], 0);
    for is_fdcan in [false, true] {
        let mut asked = Vec::new();
        let mut accepted = Vec::new();
        let clocks = clocks().into_iter().filter(|(.., own)| *own == is_fdcan);
        for (board, hz, _) in one_in(8, clocks) {
            for rate in RATES {
                let text = design.replace("BOARD", &board);
                let text = text.replace("bitrate = 500 kHz", &format!("bitrate = {rate} Hz"));
                match stubs::codes(&text).as_slice() {
                    [] => accepted.push(true),
                    ["E0620"] => accepted.push(false),
                    // The board lacks such pins, or its link takes them.
                    _ => continue,
                }
                asked.push((hz, rate));
            }
        }
        for ((asked, time), is_accepted) in
            asked.iter().zip(bit_times(is_fdcan, &asked)).zip(accepted)
        {
            match (time, is_accepted) {
                (Some(time), true) => {
                    made[usize::from(is_fdcan)] += 1;
                    wrong.extend(fault(is_fdcan, *asked, time));
                }
                (None, false) => refused += 1,
                (None, true) => wrong.push(format!("{asked:?} halts the board")),
                (Some(time), false) => wrong.push(format!("{asked:?} is refused, {time:?}")),
            }
        }
    }
    eprintln!("made {made:?}, refused {refused}");
    assert!(wrong.is_empty(), "{wrong:#?}");
    let least = if is_thorough() { [100, 15] } else { [10, 2] };
    assert!(made[0] >= least[0] && made[1] >= least[1] && refused > 0, "{made:?} {refused}");
}

/// Every whole number of steps with every prescaler of a clock, so that no rate between them is
/// forgotten.
#[test]
fn every_rate_that_a_clock_divides_to_is_made_exactly() {
    if !has("cc") {
        return;
    }
    for is_fdcan in [false, true] {
        let mut asked = BTreeSet::new();
        for clock in [8_000_000_u32, 24_000_000, 36_000_000, 42_000_000, 48_000_000, 80_000_000] {
            for steps in 8..=21 {
                for prescaler in 1..=if is_fdcan { 512 } else { 1024 } {
                    let rate = clock / (steps * prescaler);
                    if clock % (steps * prescaler) == 0 && (10_000..=1_000_000).contains(&rate) {
                        let _ = asked.insert((clock, rate));
                    }
                }
            }
        }
        let asked: Vec<_> = asked.into_iter().collect();
        assert!(asked.len() > 250, "{}", asked.len());
        for (asked, time) in asked.iter().zip(bit_times(is_fdcan, &asked)) {
            let time = time.unwrap_or_else(|| panic!("{asked:?} halts"));
            assert_eq!(fault(is_fdcan, *asked, time), None);
            assert_eq!(asked.0, asked.1 * time[0] * (1 + time[1] + time[2]), "{asked:?}");
        }
    }
}
