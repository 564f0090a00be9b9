//! What programs read is as its JSON Schema in `docs/schemas` says, for the examples and the corpus. The judge is Python's
//! `jsonschema`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{TempDir, answered, few, has_python, read, root, sensedsl, text};
use serde_json::{Value, json};

/// Validates texts, each a JSON object or one a line, and prints what does not fit.
const JUDGE: &str = r"
import json, sys
from jsonschema import Draft202012Validator
told = 0
for name, text in json.load(sys.stdin):
    validator = Draft202012Validator(json.load(open(sys.argv[1] + '/' + name + '.json')))
    try:
        all = [json.loads(text)]
    except ValueError:
        all = [json.loads(line) for line in text.splitlines()]
    for value in all:
        told += 1
        for error in validator.iter_errors(value):
            print(name, list(error.absolute_path), error.message[:300])
print(told, file=sys.stderr)
";

/// Tests of which rules hold, are violated, and are not known.
const TESTS: &str = "board Oven on NUCLEO_F446RE {
    sensor Heat returns uint16 { type = analog; delay = 10 ms; quantity = \"degC\"; scale = 0.1; }
    actuator Fan accepts uint16 { type = pwm; failsafe = 0; }
}
test Warm {
    for = 2 s;
    at 500 ms set Fan = 30 %;
    always Heat < 1000;
    always Fan < 20 % from 100 ms;
    when rising(Fan > 0) then Fan == 0 within 100 ms;
    eventually Fan == 30 % within 1 s;
}
test Dead { for = 1 s; fault torn of Heat at 0 s for 1 s; always health(Heat) == good; }
";

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(root().join(folder)).unwrap();
    let mut all: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    all.retain(|path| path.extension().is_some_and(|end| end == "sense"));
    all.sort();
    all
}

/// What a command prints with these arguments and `--format json`; nothing if it has no answer.
fn json_of(words: &[&str], file: &Path) -> String {
    let file = file.display().to_string();
    let words = words.iter().copied().chain([file.as_str(), "--format", "json"]);
    sensedsl(words).run().stdout
}

#[test]
fn what_is_printed_is_as_its_schema_says() {
    if !has_python("jsonschema") {
        return;
    }
    let (examples, mistakes) = (files("examples"), files("tests/corpus/err"));
    let mut all: Vec<(&str, String)> = Vec::new();
    for file in examples.iter().chain(few(&mistakes, 40)) {
        all.push(("check", json_of(&["check"], file)));
        all.push(("solve", json_of(&["solve", "--timeout", "10"], file)));
    }
    for file in few(&examples, 3) {
        all.push(("solve", json_of(&["solve", "--count", "--timeout", "10"], file)));
        all.push(("solve", json_of(&["solve", "--limit", "2", "--timeout", "10"], file)));
        all.push(("timing", json_of(&["explain", "timing"], file)));
        all.push(("capacity", json_of(&["capacity", "--timeout", "5"], file)));
        let file = file.display().to_string();
        let call = ["monitor", "simulate", &file, "--seconds", "0.3", "--format", "ndjson"];
        all.push(("values", sensedsl(call).run().exits(0).stdout));
    }
    let folder = TempDir::new("schemas");
    let fig2 = root().join("examples/fig2.sense");
    let out = folder.join("out").display().to_string();
    let call = ["generate", &fig2.display().to_string(), "-q", "--without", "firmware", "-o", &out];
    let _ = sensedsl(call).run().exits(0);
    all.push(("schema", read(&folder.join("out/schema.json"))));
    let old = folder.join("out/assignment.json").display().to_string();
    all.push(("solve", read(Path::new(&old))));
    let moved = folder.write(
        "moved.sense",
        text("examples/fig2.sense").replace("id = 17;", "id = 17; pin = PA1;"),
    );
    let new = folder.write("new.json", json_of(&["solve"], &moved));
    all.push(("diff", json_of(&["diff", &old], &new)));
    all.push(("parts", json_of(&["parts", "--family", "STM32F4", "--timeout", "10"], &fig2)));
    all.push(("drivers", sensedsl(["drivers", "--format", "json"]).run().exits(0).stdout));
    let tests = folder.write("tests.sense", TESTS);
    all.push(("test", json_of(&["test"], &tests)));
    all.push(("doctor", sensedsl(["doctor", "--format", "json"]).run().exits(0).stdout));
    all.retain(|(_, text)| !text.is_empty());

    let names: BTreeSet<String> = all.iter().map(|(name, _)| format!("{name}.json")).collect();
    let entries = std::fs::read_dir(root().join("docs/schemas")).unwrap();
    let known: BTreeSet<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    assert_eq!(names, known, "a schema that nothing is held to");
    let texts: Vec<Value> = all.iter().map(|(name, text)| json!([name, text])).collect();
    let mut python = Command::new("python3");
    python.args(["-c", JUDGE]).arg(root().join("docs/schemas"));
    assert_eq!(answered(&mut python, Value::from(texts).to_string()), "");
}
