//! No input makes the tool panic: seeded mutations of all examples and tables are resolved, solved
//! and generated in this process.
//!
//! The default is every eighth seed and 30 mutations, and all seeds and 20,000 with `SENSEDSL_THOROUGH=1`;
//! `SENSEDSL_MUTATIONS=1000000` is for a long run (with `--release`). An input that panics is
//! printed; it belongs in `tests/corpus/err` or `tests/corpus/ok`.

use std::fmt::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread;

use sensedsl_diagnostics::render;
use sensedsl_generate::Selection;
use sensedsl_model::{FileRequest, Files, ReadError, Request, apply_allows, resolve};
use sensedsl_report::{csv, human, json, sheet, svg};
use sensedsl_tests::{Random, files, is_exhaustive, is_thorough, one_in, read, root};
use sensedsl_wiring::{Search, Solved, Wiring};

/// One input: a `.sense` text, and the table that its board is read from.
#[derive(Clone, Debug)]
struct Input {
    sense: String,
    table: Option<String>,
}

struct Memory<'a>(&'a Input);

impl Files for Memory<'_> {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        let table = self.0.table.as_ref().filter(|_| wanted.path.ends_with(".csv"));
        table.cloned().ok_or(ReadError::Missing)
    }
}

/// Runs the stages of the commands on an input.
fn pipeline(input: &Input) {
    let board = input.table.is_some().then_some("table.csv");
    let request = Request { path: "robot.sense", text: &input.sense, board, target: None };
    let resolved = resolve(&request, &Memory(input));
    let mut diagnostics = resolved.diagnostics;
    let places = diagnostics.iter().map(|one| one.primary.span);
    for place in places {
        let text = resolved.sources.text(place.file);
        assert!(text.get(place.range()).is_some(), "{place:?} is no place in the text");
    }
    if let Some(design) = &resolved.design {
        let wiring = Wiring::new(design, None);
        diagnostics.extend(wiring.check());
        if diagnostics.iter().all(|one| one.severity != sensedsl_diagnostics::Severity::Error) {
            match wiring.solve(&Search::default()) {
                Solved::Wired(assignment) => {
                    diagnostics.extend(wiring.warnings(&assignment));
                    let _ = human::human(design, &assignment, false);
                    let _ = csv::csv(design, &assignment);
                    let _ = sheet::markdown::markdown(design, &assignment);
                    let _ = svg::svg(design, &assignment);
                    let _ = json::wired(design, &assignment);
                    let _ =
                        sensedsl_generate::project("mutant", design, &assignment, &Selection::ALL);
                }
                Solved::Infeasible(conflict) => {
                    diagnostics.push(conflict.diagnostic(design));
                    let _ = json::infeasible(design, &conflict);
                }
                Solved::Failed(failure) => panic!("{}", failure.message),
            }
        }
        apply_allows(design, &mut diagnostics);
    }
    diagnostics.truncate(3);
    let _ = render::human(&diagnostics, &resolved.sources, false);
    let _ = render::json(&diagnostics, &resolved.sources);
    if let Ok(laid_out) = sensedsl_syntax::format(&input.sense) {
        assert_eq!(sensedsl_syntax::format(&laid_out).as_ref(), Ok(&laid_out), "not idempotent");
    }
}

/// Everything that ships, and both corpora: the well-formed one and the malformed one.
fn seeds() -> Vec<Input> {
    let mut seeds = Vec::new();
    let tables: Vec<String> = sensedsl_board::catalog::all()
        .iter()
        .map(|board| board.csv().to_owned())
        .chain(files(&root().join("tests/corpus/err"), "csv").iter().map(|path| read(path)))
        .collect();
    for folder in ["examples", "crates/model/drivers", "tests/corpus/ok", "tests/corpus/err"] {
        let texts = files(&root().join(folder), "sense");
        seeds.extend(texts.iter().map(|path| Input { sense: read(path), table: None }));
    }
    let fig2 = read(&root().join("examples/fig2.sense"));
    seeds.extend(tables.into_iter().map(|table| Input { sense: fig2.clone(), table: Some(table) }));
    seeds
}

/// Words with a meaning somewhere in the language, separated by `|`.
const WORDS: &str = "\
    board|spare|on|sensor|actuator|returns|accepts|driver|for|chip|connection|reading|command|\
    const|use|link|prefer|avoid|reserve|release|allow|{|}|[|]|=|;|,|\"|/*|*/|//|-|+|*|/|(|)|..|\
    1..5|3 V..5 V|-(1 + N)|0|1|254|255|256|-1|0x|0xE6|0b2|1e308|1e999|0.0001|NaN|\
    18446744073709551615|18446744073709551616|us|ms|s|Hz|kHz|MHz|id|type|delay|prio|pin|unit|\
    side|header|label|scale|min|max|address|speed|exclusive|true|trigger|wait|register|length|\
    order|mode|edge|resolution|pulse|analog|i2c|icu|encoder|digital|uart|spi|pwm|dac|can|bool|\
    uint8|uint16|int64|float64|[1024]|srf08|hcsr04|PA1|PB0|PZ99|ADC1|TIM3|I2C1|\
    STM32F4DiscoveryBoard|STM32F407G_DISC1|ü|\u{feff}|\u{a0}|\r\n|\0|𝄞|W0602|E0401|# mcu = |\
    STM32F407VGT6|STM32F103C8T6|Pin|Position|AF|Onboard|TIM1_CH1@1|ADC123-IN9|I²C1-SCL|@|@16|\
    :bus|:care";

/// A text with a few changes.
fn mutate(random: &mut Random, text: &str, other: &str) -> String {
    let words: Vec<&str> = WORDS.split('|').collect();
    let mut text: Vec<char> = text.chars().collect();
    for _ in 0..=random.below(4) {
        let at = random.below(text.len() + 1);
        let end = (at + random.below(24)).min(text.len());
        match random.below(9) {
            0 => drop(text.drain(at..end)),
            1 => {
                let copy: Vec<char> = text[at..end].to_vec();
                let to = random.below(text.len() + 1);
                text.splice(to..to, copy);
            }
            2 | 3 => {
                let word = random.pick(&words).unwrap();
                text.splice(at..at, word.chars());
            }
            4 => {
                let word = random.pick(&words).unwrap();
                text.splice(at..end, word.chars());
            }
            5 => {
                // Moves whole lines: properties, devices, rows.
                let lines: String = text.iter().collect();
                let mut lines: Vec<&str> = lines.split_inclusive('\n').collect();
                let (from, to) = (random.below(lines.len()), random.below(lines.len()));
                if let Some(line) = lines.get(from).copied() {
                    lines.insert(to, line);
                }
                text = lines.concat().chars().collect();
            }
            6 => {
                let other: Vec<char> = other.chars().collect();
                let from = random.below(other.len());
                let to = (from + random.below(200)).min(other.len());
                text.splice(at..at, other[from..to].iter().copied());
            }
            7 => text.truncate(at),
            _ => {
                if let Some(c) = text.get_mut(at) {
                    *c = char::from_u32(u32::try_from(random.below(0x250)).unwrap()).unwrap_or('?');
                }
            }
        }
    }
    // Inputs that grow without end are slow and find nothing new.
    text.truncate(20_000);
    text.into_iter().collect()
}

/// The mutation with a number, which is the same on every machine.
fn mutation(number: u64, seeds: &[Input]) -> Input {
    let mut random = Random::new(number);
    let (seed, other) = (random.below(seeds.len()), random.below(seeds.len()));
    let (seed, other) = (&seeds[seed], &seeds[other]);
    let mut input = seed.clone();
    match &mut input.table {
        Some(table) if random.below(4) > 0 => {
            *table = mutate(&mut random, table, other.table.as_deref().unwrap_or(&other.sense));
        }
        Some(_) | None => input.sense = mutate(&mut random, &input.sense, &other.sense),
    }
    input
}

/// Runs the mutations with these numbers; returns those that panic.
fn panics(numbers: impl Iterator<Item = u64>, seeds: &[Input]) -> String {
    let mut panics = String::new();
    for number in numbers {
        let input = mutation(number, seeds);
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| pipeline(&input))) {
            let why = panic.downcast_ref::<String>().map(String::as_str);
            let why = why.or(panic.downcast_ref::<&str>().copied()).unwrap_or("?");
            let _ = writeln!(panics, "mutation {number}: {why}\n{input:#?}");
        }
    }
    panics
}

#[test]
fn mutated_examples_and_tables() {
    let usual = match (is_exhaustive(), is_thorough()) {
        (true, _) => 20_000,
        (false, true) => 8_000,
        (false, false) => 30,
    };
    let mutations: u64 = std::env::var("SENSEDSL_MUTATIONS")
        .map_or(usual, |number| number.parse().expect("SENSEDSL_MUTATIONS is a number"));
    let seeds = seeds();
    for seed in one_in(8, &seeds) {
        pipeline(seed);
    }
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let found: Vec<String> = thread::scope(|scope| {
        let started: Vec<_> = (0..threads as u64)
            .map(|first| (first..mutations).step_by(threads))
            .map(|numbers| scope.spawn(|| panics(numbers, &seeds)))
            .collect();
        started.into_iter().map(|thread| thread.join().unwrap()).collect()
    });
    assert!(found.iter().all(String::is_empty), "{}", found.concat());
}
