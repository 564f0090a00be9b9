//! Real certificates of small problems, edited token by token: what is still verified is true, and of
//! files with the hashes that are stated.
//!
//! Edits may reach the problem as well. What is claimed of it is then compared with all its wirings
//! ([`crate::truth`]).

use std::collections::BTreeSet;
use std::sync::OnceLock;

use sensedsl_certify::{Subject, sha256};
use sensedsl_model::{FileRequest, Files, ReadError, Request, resolve};
use sensedsl_proof::subject::compare;
use sensedsl_proof::{Verified, read, verify};
use sensedsl_wiring::{Keep, Wiring};

use crate::draw::Draw;
use crate::reached::{Stage, count};
use crate::truth::{Truth, parts, truth};

/// Small boards: everything about these problems can be tried.
const TABLE: &str = "# mcu = STM32F407VGT6\nPin,Usages\n\
    PA1,ADC123_IN1 TIM2_CH2@1\nPA2,ADC123_IN2 TIM9_CH1@3 USART2_TX@7\nPB6,I2C1_SCL@4 TIM4_CH1@2\n\
    PB7,I2C1_SDA@4 TIM4_CH2@2\nPB10,I2C2_SCL@4\nPB11,I2C2_SDA@4 x\nPC1,ADC123_IN11\n";

/// A sensor of that number.
fn sensor(id: usize, properties: &str) -> String {
    format!("sensor D{id} returns uint16 {{ id = {id}; {properties} }}\n")
}

/// Designs whose certificates are the start: sharing, rules, spares, DMA, moves, no wiring.
fn designs() -> Vec<(String, bool)> {
    let board = |rules: &str, devices: &[&str]| {
        let devices: String =
            devices.iter().enumerate().map(|(at, device)| sensor(at + 1, device)).collect();
        format!("board B on \"t.csv\" {{ link {{ transport = usb; }} {rules} {devices} }}\n")
    };
    let i2c = |address: u8| format!("type = i2c; address = 0x{address:x}; register = 1;");
    let mut designs = vec![
        board("", &["type = analog;", "type = analog;"]),
        board("", &[&i2c(0x40), &i2c(0x41)]),
        board("", &[&i2c(0x40), &i2c(0x40)]),
        board("avoid pin = PC1; prefer unit = I2C2;", &["type = analog;", &i2c(0x20)]),
        board("", &["type = icu;", "type = icu;", "type = icu; avoid pin = PB6;"]),
        board("", &["type = analog;", "type = analog;", "type = analog;", "type = analog;"]),
        board("", &[&i2c(0x40), &i2c(0x40), &i2c(0x40)]),
        board("reserve PB6, PB7;", &[&i2c(0x40), "type = encoder;"]),
    ];
    let spare = "spare board S on \"t.csv\" { link { transport = usb; } }\n";
    designs.push(format!("{}{spare}{}", board("", &["type = icu;"]), sensor(9, &i2c(0x33))));
    let full = board("reserve PB6, PB10;", &["type = analog;"]);
    designs.push(format!("{full}{spare}{}", sensor(9, &i2c(0x33))));
    let mut all: Vec<(String, bool)> = designs.into_iter().map(|text| (text, false)).collect();
    all.push((board("", &["type = analog;", &i2c(0x40)]), true));
    all
}

struct Table;

impl Files for Table {
    fn read(&self, _: &FileRequest<'_>) -> Result<String, ReadError> {
        Ok(TABLE.into())
    }
}

/// What a design was made of.
fn subject(text: &str) -> Subject {
    let file = ("robot.sense".to_owned(), sha256(text.as_bytes()));
    let table = ("t.csv".to_owned(), sha256(TABLE.as_bytes()));
    Subject { tool: "sensedsl".to_owned(), files: vec![file, table], ..Subject::default() }
}

/// A certificate cut into its tokens, and what is true of its problem.
#[derive(Debug)]
struct Start {
    tokens: Vec<String>,
    problem: String,
    truth: Truth,
    /// The files that it is of, with their hashes.
    files: Vec<(String, String)>,
}

fn starts() -> &'static [Start] {
    static STARTS: OnceLock<Vec<Start>> = OnceLock::new();
    STARTS.get_or_init(|| designs().iter().map(|(text, keep)| start(text, *keep)).collect())
}

fn start(text: &str, keep: bool) -> Start {
    let request = Request { path: "robot.sense", text, board: None, target: None };
    let resolved = resolve(&request, &Table);
    let design = resolved.design.unwrap_or_else(|| panic!("{text}\n{:?}", resolved.diagnostics));
    let mut before = Keep::default();
    before.add("D1", "in", "B", "PA1");
    before.add("D2", "scl", "B", "PB10");
    before.add("D2", "sda", "B", "PB7");
    let wiring = Wiring::new(&design, keep.then_some(&before));
    let certificate = wiring.solve_with_proof(&subject(text)).certificate;
    let certificate = certificate.expect("an answer").expect("a certificate");
    let read = read(&certificate).expect("a certificate is read");
    let truth = truth(&read.problem);
    let verified = verify(&read).expect("a certificate proves its claim");
    assert!(holds(&verified, truth), "{verified:?}, but {truth:?}\n{text}");
    let files = subject(text).files;
    compare(&read.subject, &files).expect("a certificate is of its files");
    Start { tokens: tokens(&certificate), problem: format!("{:?}", read.problem), truth, files }
}

/// The tokens of a JSON text, without space.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '"' => rest[1..].find('"').map_or(rest.len(), |end| end + 2),
            '{' | '}' | '[' | ']' | ',' | ':' => 1,
            _ => rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len()).max(1),
        };
        let (token, after) = rest.split_at(length);
        tokens.push(token.to_owned());
        rest = after.trim_start();
    }
    tokens
}

/// Where the value that begins at `at` ends.
fn value_end(tokens: &[String], at: usize) -> usize {
    let mut depth = 0_usize;
    for (index, token) in tokens.iter().enumerate().skip(at) {
        match token.as_str() {
            "{" | "[" => depth += 1,
            "}" | "]" => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth == 0 {
            return index + 1;
        }
    }
    tokens.len()
}

/// One edit: of a number, a name, a value, a member.
fn edit(draw: &mut Draw<'_>, tokens: &mut Vec<String>) {
    if tokens.is_empty() {
        return;
    }
    let word = |token: &String| !matches!(token.as_str(), "{" | "}" | "[" | "]" | "," | ":");
    let words: Vec<usize> = (0..tokens.len()).filter(|at| word(&tokens[*at])).collect();
    if words.is_empty() {
        return;
    }
    let at = words[draw.below(words.len())];
    let other = words[draw.below(words.len())];
    let number: Option<u32> = tokens[at].parse().ok();
    match (draw.below(8), number) {
        (0..=2, Some(number)) => {
            let next = [
                number.wrapping_add(1),
                number.wrapping_sub(1),
                0,
                1,
                u32::MAX,
                number ^ (1 << draw.below(32)),
                number / 2,
            ];
            tokens[at] = draw.pick(&next).to_string();
        }
        (0..=3, _) => tokens[at] = tokens[other].clone(),
        (4, _) => tokens.swap(at, other),
        (5, _) => {
            // A value, or a member with its name, is left out, and the comma with it.
            let named = tokens.get(at + 1).is_some_and(|next| next == ":");
            let end = value_end(tokens, if named { at + 2 } else { at });
            let end = end + usize::from(tokens.get(end).is_some_and(|next| next == ","));
            tokens.drain(at..end.min(tokens.len()));
        }
        (6, _) => {
            // A member is put elsewhere as well.
            let named = tokens.get(at + 1).is_some_and(|next| next == ":");
            let end = value_end(tokens, if named { at + 2 } else { at }).min(tokens.len());
            let mut copy = tokens[at..end].to_vec();
            copy.push(",".into());
            tokens.splice(other..other, copy);
        }
        _ => {
            let values =
                ["null", "true", "false", "{}", "[]", "\"own\"", "4294967296", "-1", "1.5"];
            tokens[at] = (*draw.pick(&values)).to_owned();
        }
    }
}

fn holds(verified: &Verified, truth: Truth) -> bool {
    match (verified, truth) {
        (_, Truth::Unknown) => true,
        (Verified::Best(claimed), Truth::Best(best)) => parts(*claimed) == best,
        (Verified::NoWiring, Truth::NoWiring) => true,
        (Verified::Best(_), Truth::NoWiring) | (Verified::NoWiring, Truth::Best(_)) => false,
    }
}

/// The body of the target: which certificate, and which edits.
///
/// # Panics
/// When something untrue is verified.
pub fn run(bytes: &[u8]) {
    count(Stage::Run);
    let mut draw = Draw::new(bytes);
    let start = draw.pick(starts());
    let mut tokens = start.tokens.clone();
    for _ in 0..16 {
        edit(&mut draw, &mut tokens);
        if draw.is_done() {
            break;
        }
    }
    let text = tokens.concat();
    let Ok(certificate) = read(&text) else { return };
    count(Stage::Resolved);
    if compare(&certificate.subject, &start.files).is_ok() {
        let stated: BTreeSet<&String> = certificate.subject.files.values().collect();
        let texts: BTreeSet<&String> = certificate.subject.built_in.values().collect();
        let given: BTreeSet<&String> = start.files.iter().map(|(_, hash)| hash).collect();
        let known = given.iter().all(|hash| stated.contains(hash) || texts.contains(hash));
        assert!(known && stated.is_subset(&given), "it is of other files\n{text}");
    }
    let Ok(verified) = verify(&certificate) else { return };
    count(Stage::Certified);
    let same = format!("{:?}", certificate.problem) == start.problem;
    let truth = if same { start.truth } else { truth(&certificate.problem) };
    assert!(holds(&verified, truth), "verified: {verified:?}, but {truth:?}\n{text}");
}
