//! Input within the limits takes time in proportion to its size. The real program runs on an input,
//! on one twice as large and on one four times as large. It should take about twice and four times
//! the processor time of the first; with a nested loop it would take four and sixteen times.
//!
//! Only runs of one test are compared with each other. A run that seems too slow is repeated,
//! because the machine does other things too.

use std::fs::{self, File};
use std::process::{Command, Stdio};

use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
use sensedsl_tests::{TempDir, binary, is_thorough};

use super::{BOARD, repeat};

const TIMES: usize = 4;
/// Allows for a logarithmic factor and for other work on the machine, at twice and four times the
/// size.
const RATIO_MAX: f64 = 1.6;
/// The difference between two runs on the same input.
const NOISE_MS: f64 = 25.0;
const RUNS: usize = 5;

/// Writes the inputs that `make` gives for each size, and compares the runs on them.
#[track_caller]
fn grows(command: &str, n: usize, name: &str, make: impl Fn(usize) -> Vec<(&'static str, String)>) {
    let folder = TempDir::new("scaling");
    let [none, once, twice, more] = [1, n, 2 * n, TIMES * n].map(|n| {
        make(n).into_iter().for_each(|(file, text)| {
            folder.write(&format!("{n}/{file}"), text);
        });
        folder.join(&n.to_string())
    });
    let folders = [&none, &once, &twice, &more];
    let mut least_ms = [f64::MAX; 4];
    let mut reported = String::new();
    for _ in 0..RUNS {
        for (least, folder) in least_ms.iter_mut().zip(folders) {
            *least = least.min(cpu_ms(folder, command, name));
        }
        let [none_ms, once_ms, twice_ms, more_ms] = least_ms;
        reported = format!(
            "{name}: {none_ms:.0} ms for 1, {once_ms:.0} for {n}, {twice_ms:.0} for twice, \
             {more_ms:.0} for {TIMES} times as many"
        );
        let grown = |ms: f64, times: f64| {
            ms - none_ms <= RATIO_MAX * times * (once_ms - none_ms) + NOISE_MS
        };
        if grown(twice_ms, 2.0) && grown(more_ms, TIMES as f64) {
            println!("{reported}");
            return;
        }
    }
    panic!("{reported}");
}

/// The processor time that the program takes on a file in the folder.
fn cpu_ms(folder: &std::path::Path, command: &str, name: &str) -> f64 {
    let mut call = Command::new(binary());
    call.args([command, name]).current_dir(folder).stdin(Stdio::null());
    call.stdout(File::create(folder.join(".out")).unwrap());
    call.stderr(File::create(folder.join(".err")).unwrap());
    let mut child = call.spawn().unwrap();
    let pid = Pid::from_child(&child);
    // The kernel keeps the figures until the parent waits for the child.
    waitid(WaitId::Pid(pid), WaitIdOptions::EXITED | WaitIdOptions::NOWAIT).unwrap();
    let figures = fs::read_to_string(format!("/proc/{}/schedstat", child.id())).unwrap();
    let status = child.wait().unwrap();
    assert!(status.code().is_some_and(|code| code < 2), "{name}: {status}");
    figures.split(' ').next().unwrap().parse::<f64>().unwrap() / 1e6
}

/// Like [`grows`], for an input of one file.
#[track_caller]
fn one_grows(command: &str, n: usize, name: &'static str, make: impl Fn(usize) -> String) {
    grows(command, n, name, |n| vec![(name, make(n))]);
}

/// A design on the table `t.csv`.
fn on_table(items: &str) -> (&'static str, String) {
    ("t.sense", format!("board Bd on \"t.csv\" {{\n{items}}}\n"))
}

fn device(at: usize) -> String {
    format!("sensor Dev{at}x returns uint16 {{ id = {}; type = analog; }}\n", at % 254 + 1)
}

#[test]
fn texts() {
    if !is_thorough() {
        return;
    }
    let table = || ("t.csv", "Pin,ADC\nPA1,ADC1_IN1\n".to_owned());
    grows("check", 450, "t.sense", |n| vec![on_table(&repeat(n, device)), table()]);
    grows("check", 450, "t.sense", |n| vec![on_table(&device(1).repeat(n)), table()]);
    let properties = |n, property: &dyn Fn(usize) -> String| {
        let all = repeat(n, property);
        format!("{BOARD}sensor A returns uint16 {{ id = 1; type = analog;\n{all}}}}}\n")
    };
    one_grows("check", 1_800, "p.sense", |n| properties(n, &|at| format!("p{at} = 1;\n")));
    one_grows("check", 1_800, "d.sense", |n| properties(n, &|_| "delay = 1 s;\n".to_owned()));
    one_grows("check", 1_800, "names.sense", |n| {
        format!("{BOARD}reserve PA0{};}}\n", repeat(n, |at| format!(", PX{at}")))
    });
    one_grows("check", 50_000, "comments.sense", |n| "// x\n".repeat(n));
}

#[test]
fn rules() {
    // Rules, pins that they name and warnings about rules without effect all grow. One pin is left.
    grows("check", 450, "t.sense", |n| {
        let rule =
            |at| format!("reserve PX{at}; reserve P{at}A; release PART{at}; allow W0604 \"x\";\n");
        let pin = |at| format!("P{at}A,ADC1_IN1,PART{at}:bus\n");
        let items = repeat(n, rule) + &device(0);
        let table = format!("Pin,ADC,Onboard\nPA1,ADC1_IN2,\n{}", repeat(n, pin));
        vec![on_table(&items), ("t.csv", table)]
    });
}

#[test]
fn tables() {
    if !is_thorough() {
        return;
    }
    let pin = |at: usize| format!("P{}{}", ["A", "B", "C", "D"][at % 4], at / 4 % 16);
    one_grows("import", 4_000, "long.csv", |n| {
        format!("Pin,Signal\n{}", repeat(n, |at| format!("{},S{at}\n", pin(at % 2_000))))
    });
    let usages = repeat(40, |at| format!("S{at} "));
    one_grows("import", 500, "usages.csv", |n| {
        format!("Pin,GPIO\n{}", repeat(n, |at| format!("P{at}A,{usages}\n")))
    });
    one_grows("import", 12_000, "same.csv", |n| format!("Pin,ADC\n{}", "PA1,x\n".repeat(n)));
    one_grows("import", 4_000, "hwdef.dat", |n| {
        let lines = repeat(n, |at| format!("{} ADC1_IN{at} ADC1\n", pin(at)));
        format!("MCU STM32F4xx STM32F405xx\n{lines}")
    });
}

#[test]
fn xml() {
    one_grows("import", 6_000, "pins.xml", |n| {
        let pin = |at| format!("<Pin Name=\"P{at}A\" Position=\"{at}\" Type=\"I/O\"/>");
        format!("<Mcu RefName=\"STM32F405RGTx\">{}</Mcu>", repeat(n, pin))
    });
    // The reader compares the attributes of an element in pairs; an element has few of them.
    one_grows("import", 200, "attributes.xml", |n| {
        let attributes = repeat(60, |at| format!(" a{at}=\"\""));
        format!("<Mcu RefName=\"X\">{}</Mcu>", format!("<a{attributes}/>").repeat(n))
    });
}
