//! The judge reports nothing as wrong that is right. Each built-in board gets a design with all
//! kinds that it can carry, and each driver of the library runs alone and with as many others as
//! fit, judged as in `simulate --judge` of this program.
//!
//! A small random selection always runs; `SENSEDSL_THOROUGH=1` runs all, and prints how much was
//! compared.

use std::collections::VecDeque;
use std::sync::Mutex;

use sensedsl_model::kind::KindName;
use sensedsl_tests::{Random, is_exhaustive, is_thorough, sensedsl, text};

/// A link that frees a board's wires. [`INVERTING_BOARD`] is for drivers whose serial port is
/// inverted.
const SERIAL_LINK: &str = "link { transport = uart; }";
const BOARD: &str = "STM32F407G_DISC1";
const INVERTING_BOARD: &str = "NUCLEO_F303RE";
/// The number of drivers that are first tried together.
const TOGETHER: usize = 24;

/// The number of comparisons of a judge.
#[derive(Clone, Copy, Debug, Default)]
struct Compared {
    designs: u64,
    values: u64,
    looks: u64,
}

/// The number after `all` in a line of the verdict.
fn count(stdout: &str, what: &str) -> u64 {
    let line = stdout.lines().find(|line| line.contains(what));
    let number = line.and_then(|line| line.split("all ").nth(1)?.split(' ').next()?.parse().ok());
    number.unwrap_or(0)
}

/// Judges a design; the error says what is wrong with it.
fn judge(text: &str, target: &str) -> Result<Compared, String> {
    let ran = sensedsl(["simulate", "-", "--judge", "--target", target]).stdin(text).run();
    let (values, looks) =
        (count(&ran.stdout, "agree with the world"), count(&ran.stdout, "looks at outputs"));
    if ran.status == 0 && values + looks > 0 {
        return Ok(Compared { designs: 1, values, looks });
    }
    Err(format!("{target}: {text}\n{}\n{}", ran.stdout, ran.stderr))
}

pub(crate) fn is_wired(text: &str, target: &str) -> bool {
    sensedsl(["solve", "-", "--target", target]).stdin(text).run().status == 0
}

/// A few items, drawn with a fixed seed; all in a thorough run.
fn drawn<T>(mut all: Vec<T>, count: usize) -> Vec<T> {
    let mut random = Random::new(25);
    while !is_thorough() && all.len() > count {
        let place = random.below(all.len());
        drop(all.swap_remove(place));
    }
    all
}

/// Works on all items with two threads; panics with everything that was wrong.
fn each<T: Send>(all: Vec<T>, work: impl Fn(T) -> Vec<Result<Compared, String>> + Sync) {
    let left = Mutex::new(VecDeque::from(all));
    let found = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                loop {
                    let Some(next) = left.lock().unwrap().pop_front() else { break };
                    let results = work(next);
                    found.lock().unwrap().extend(results);
                }
            });
        }
    });
    let (mut sum, mut wrong) = (Compared::default(), Vec::new());
    for one in found.into_inner().unwrap() {
        match one {
            Ok(Compared { designs, values, looks }) => {
                sum.designs += designs;
                sum.values += values;
                sum.looks += looks;
            }
            Err(why) => wrong.push(why),
        }
    }
    assert!(wrong.is_empty(), "{} false alarms: {}", wrong.len(), wrong.join("\n\n"));
    assert!(sum.designs > 0 && sum.values + sum.looks > 0, "{sum:?}");
    eprintln!("{sum:?}");
}

fn of_kinds(board: &str, kinds: &[&str], rule: &str) -> String {
    let inside = kinds.iter().map(|kind| {
        let design = text(&format!("tests/firmware/kinds/{kind}.sense"));
        let (_, rest) = design.split_once("{\n").unwrap();
        rest.rsplit_once('}').unwrap().0.to_owned()
    });
    format!("board {board} {{\n{rule}\n{}}}\n", inside.collect::<String>())
}

/// Designs for all kinds that a board can carry: as many as fit together in one, and each of the
/// others by itself.
fn designs(board: &str, target: &str) -> Vec<String> {
    let (mut taken, mut all) = (Vec::new(), Vec::new());
    for kind in KindName::wired().map(KindName::name) {
        taken.push(kind);
        if !is_wired(&of_kinds(board, &taken, ""), target) {
            let _ = taken.pop();
            let alone = ["", SERIAL_LINK].map(|rule| of_kinds(board, &[kind], rule));
            all.extend(alone.into_iter().find(|design| is_wired(design, target)));
        }
    }
    if !taken.is_empty() {
        all.push(of_kinds(board, &taken, ""));
    }
    all
}

#[test]
fn no_board_with_all_kinds_is_called_wrong() {
    let listed = sensedsl(["boards", "--quiet"]).run().exits(0);
    let names = listed.stdout.lines().filter_map(|line| {
        let name = line.split_whitespace().next()?.replace('-', "_");
        let target = ["chibios", "embassy"].into_iter().find(|target| line.contains(target));
        Some((name, target.unwrap_or("none")))
    });
    let all: Vec<(String, &str)> = names.collect();
    assert!(all.len() >= 120, "{}", all.len());
    // Boards of one kind are alike: all of them are judged where minutes do not count.
    let all = all.into_iter().step_by(if is_exhaustive() { 1 } else { 8 }).collect();
    each(drawn(all, 1), |(board, target)| {
        let designs = designs(&board, target);
        assert!(!designs.is_empty(), "{board} carries nothing");
        designs.iter().map(|design| judge(design, target)).collect()
    });
}

/// The library's drivers, each as the text of its devices for the inside of a board.
pub(crate) fn drivers() -> Vec<String> {
    let ran = sensedsl(["drivers", "--quiet", "--format", "json"]).run().exits(0);
    let json = ran.json();
    let all = json["drivers"].as_array().unwrap();
    (1..).zip(all).map(|(node, one)| part(one, node)).collect()
}

fn part(one: &serde_json::Value, node: usize) -> String {
    let name = one["name"].as_str().unwrap();
    let values = one["values"].as_array().unwrap();
    if values.len() == 1 && values[0]["name"].is_null() {
        let example = one["example"].as_str().unwrap();
        let (_, inside) = example.split_once('{').unwrap();
        return inside.rsplit_once('}').unwrap().0.to_owned();
    }
    let address = one["addresses"].get(0).filter(|_| one["address"].is_null());
    let address = address.map(|first| format!("address = {first};")).unwrap_or_default();
    // Controllers of the same make are distinguished by a number of their own.
    let notes = one["notes"].as_array().map_or(&[][..], Vec::as_slice);
    let is_numbered = notes.iter().any(|note| note.as_str().unwrap().contains("`node` is"));
    let node = if is_numbered { format!("node = {node};") } else { String::new() };
    // What must rest between two readings has that cycle by itself.
    let rests = one["kinds"].as_array().unwrap().iter().any(|kind| kind == "onewire");
    let delay = if rests { "" } else { "delay = 100 ms;" };
    format!("    chip Part_{name} {{ driver = {name}; {address} {node} {delay} }}\n")
}

fn of_parts(parts: &[String]) -> String {
    let on = |board: &str| format!("board {board} {{\n{}}}\n", parts.concat());
    let first = on(BOARD);
    if is_wired(&first, "chibios") { first } else { on(INVERTING_BOARD) }
}

#[test]
fn no_driver_is_called_wrong() {
    let all = drivers();
    assert!(all.len() >= 102, "{}", all.len());
    each(drawn(all, 8), |part| vec![judge(&of_parts(&[part]), "chibios")]);
}

#[test]
fn checksums_among_values_are_part_of_a_transfer() {
    let driver = "chip Air { driver = sht31; delay = 100 ms; }".to_owned();
    each(vec![driver], |part| vec![judge(&of_parts(&[part]), "chibios")]);
}

/// Groups of parts that can be wired together: if a group cannot, each half of it is tried.
fn groups(parts: &[String]) -> Vec<String> {
    let together = of_parts(parts);
    if parts.len() < 2 || is_wired(&together, "chibios") {
        return vec![together];
    }
    let (one, other) = parts.split_at(parts.len() / 2);
    [groups(one), groups(other)].concat()
}

#[test]
fn no_drivers_together_are_called_wrong() {
    let mut all = drivers();
    let mut random = Random::new(7);
    for place in (1..all.len()).rev() {
        all.swap(place, random.below(place + 1));
    }
    let parts: Vec<Vec<String>> = all.chunks(TOGETHER).map(<[String]>::to_vec).collect();
    each(drawn(parts, 1), |parts| {
        groups(&parts).iter().map(|design| judge(design, "chibios")).collect()
    });
}
