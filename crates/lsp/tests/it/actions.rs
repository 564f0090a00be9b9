//! Code actions: what is offered where, and what the text is after it.

use std::collections::BTreeSet;

use sensedsl_diagnostics::Severity;
use sensedsl_lsp::{Message, Request};
use sensedsl_model::design::{Design, Device};
use sensedsl_model::kind::KindName;
use sensedsl_session::{Ask, Goal, On, Snapshot, Workspace, has_errors};
use sensedsl_syntax::ast;
use sensedsl_syntax::parse;
use sensedsl_wiring::Cancel;
use serde_json::{Value, json};

use crate::corpus::{Disk, good, is_exhaustive, some, texts};
use crate::session::{FILE, Session, Stored, edited, unmarked};

const PATH: &str = "/robot/a.sense";

/// The actions in a range of a file.
fn offered(session: &mut Session, uri: &str, range: [&Value; 2], only: Option<&str>) -> Vec<Value> {
    let [start, end] = range;
    let context = only.map_or_else(
        || json!({ "diagnostics": [] }),
        |only| json!({ "diagnostics": [], "only": [only] }),
    );
    let params = json!({
        "textDocument": { "uri": uri },
        "range": { "start": start, "end": end },
        "context": context,
    });
    session.ask("textDocument/codeAction", params).as_array().unwrap().clone()
}

/// The actions at the marks of a text: at one, or from the first to the second.
fn at_marks(marked: &str) -> (String, Vec<Value>) {
    let (mut session, places) = Session::of(marked);
    let range = [places.first().unwrap(), places.last().unwrap()];
    (unmarked(marked).0, offered(&mut session, FILE, range, None))
}

fn titles(actions: &[Value]) -> Vec<&str> {
    actions.iter().map(|one| one["title"].as_str().unwrap()).collect()
}

fn find<'a>(actions: &'a [Value], title: &str) -> &'a Value {
    let found = actions.iter().find(|one| one["title"] == title);
    found.unwrap_or_else(|| panic!("no {title:?} in {:?}", titles(actions)))
}

/// A text after an action that changes only this file.
fn after(text: &str, action: &Value) -> String {
    let changes = action["edit"]["changes"].as_object().unwrap();
    assert_eq!(changes.len(), 1, "{action}");
    edited(text, changes.values().next().unwrap())
}

fn snapshot(path: &str, text: &str) -> Snapshot {
    let mut workspace = Workspace::default();
    workspace.open(path, text);
    workspace.snapshot(path, On::default(), &Disk)
}

/// The wires of all devices: name, board and pin.
fn rows(snapshot: &Snapshot, goal: Goal<'_>) -> BTreeSet<String> {
    let answer = snapshot.solve(&Ask { goal, partly: true, ..Ask::default() });
    let (design, wiring) = answer.wired().expect("a wiring");
    let boards = wiring.used(design);
    let rows = boards.flat_map(|(on, board)| {
        on.devices.iter().flat_map(move |one| {
            let device = design.device(one.device).unwrap();
            one.wires.iter().map(move |wire| {
                let pin = &wire.pin(board).unwrap().name;
                format!("{} {} {} {pin}", device.name.value, wire.name(design), board.name.value)
            })
        })
    });
    rows.collect()
}

fn device_keys(design: &Design) -> Vec<(String, u8, String, KindName)> {
    let key = |one: &Device| {
        (one.name.value.clone(), one.id.value, one.value.value.to_string(), one.kind.name())
    };
    let mut keys: Vec<_> = design.devices.iter().map(key).collect();
    keys.sort_by(|one, other| one.0.cmp(&other.0));
    keys
}

const WRONG: &str = "board B on STM32F4DiscoveryBoard {\n    /* größer 🤖 */ sensor Light returns uint16 { id = 1; type = anal$0ogue; }\n}\n";

#[test]
fn a_misspelled_word_is_corrected() {
    let (text, actions) = at_marks(WRONG);
    let fix = find(&actions, "Change to `analog`");
    assert_eq!((&fix["kind"], &fix["isPreferred"]), (&json!("quickfix"), &json!(true)));
    assert_eq!(fix["diagnostics"][0]["code"], "E0207");
    assert_eq!(after(&text, fix), text.replace("analogue", "analog"));
    // Elsewhere there is nothing to correct.
    let (_, actions) = at_marks(&WRONG.replace("$0", "").replace("board B", "bo$0ard B"));
    assert!(!titles(&actions).contains(&"Change to `analog`"), "{:?}", titles(&actions));
}

#[test]
fn a_client_gets_the_kinds_that_it_wants() {
    let good = WRONG.replace("anal$0ogue", "anal$0og");
    for (only, wanted) in [
        ("refactor", Some("refactor.rewrite")),
        ("refactor.rewrite", Some("refactor.rewrite")),
        ("", Some("refactor.rewrite")),
        ("refactor.extract", None),
        ("refact", None),
        ("quickfix", None),
    ] {
        let (mut session, places) = Session::of(&good);
        let actions = offered(&mut session, FILE, [&places[0], &places[0]], Some(only));
        let kinds: BTreeSet<&str> =
            actions.iter().map(|one| one["kind"].as_str().unwrap()).collect();
        assert_eq!(kinds, wanted.into_iter().collect(), "{only}");
    }
    let (mut session, places) = Session::of(WRONG);
    let actions = offered(&mut session, FILE, [&places[0], &places[0]], Some("source"));
    assert_eq!(titles(&actions), ["Fix everything that has one way out"]);
}

#[test]
fn of_several_ways_out_none_is_preferred() {
    let text = "board B on STM32F4DiscoveryBoard {\n    sensor Light returns uint16 { id = 1; i$0d = 2; type = analog; }\n}\n";
    let (text, actions) = at_marks(text);
    let first = find(&actions, "Remove the first one");
    assert_eq!(first["isPreferred"], Value::Null);
    assert_eq!(after(&text, first), text.replace(" id = 1;", ""));
    assert_eq!(after(&text, find(&actions, "Remove this one")), text.replace(" id = 2;", ""));
}

#[test]
fn a_line_is_removed_with_its_line_break() {
    let text = "board B on STM32F4DiscoveryBoard {\n    sensor Light returns uint16 {\n        id = 1;\n        colour$0 = red; // no use\n        type = analog;\n    }\n}\n";
    let (text, actions) = at_marks(text);
    let removed = after(&text, find(&actions, "Remove the line"));
    assert_eq!(removed, text.replace("colour = red; ", ""));
    let (text, actions) = at_marks(&text.replace("colour = red; // no use", "$0colour = red;"));
    let removed = after(&text, find(&actions, "Remove the line"));
    assert_eq!(removed, text.replace("        colour = red;\n", ""));
}

#[test]
fn all_of_a_code_are_corrected_at_once() {
    let text = "board B on STM32F4DiscoveryBoard {\n    sensor One returns uint16 { id = 1; type = an$0alogue; }\n    sensor Two returns uint16 { id = 2; type = analogg; }\n}\n";
    let (text, actions) = at_marks(text);
    let all = find(&actions, "Fix all 2 of E0207 in the file");
    let fixed = after(&text, all);
    assert_eq!(fixed, text.replace("analogue", "analog").replace("analogg", "analog"));
    // Where each would get the same number, all at once is no way out.
    let text = "board B on STM32F4DiscoveryBoard {\n    sensor One returns uint16 { id = 1; type = analog; }\n    sensor Two returns uint16 { id = 1$0; type = analog; }\n    sensor Three returns uint16 { id = 1; type = analog; }\n}\n";
    let (text, actions) = at_marks(text);
    assert!(titles(&actions).iter().all(|one| !one.starts_with("Fix all 2")), "{actions:?}");
    assert!(
        after(&text, find(&actions, "Change to 2")).contains("sensor Two returns uint16 { id = 2;")
    );
}

#[test]
fn a_used_file_is_corrected_where_it_is_open() {
    let legs = "file:///robot/legs.sense";
    let mut session = Session::with(Stored::default(), &json!({}));
    session.open(FILE, "use \"legs.sense\";\nboard B on STM32F4DiscoveryBoard {}\n");
    let text = "sensor Leg returns uint16 { id = 1; type = $0analogue; }";
    let places = session.open(legs, text);
    let actions = offered(&mut session, legs, [&places[0], &places[0]], None);
    let fixed = after(&unmarked(text).0, find(&actions, "Change to `analog`"));
    assert_eq!(fixed, "sensor Leg returns uint16 { id = 1; type = analog; }");
}

#[test]
fn nothing_is_offered_where_there_is_nothing() {
    for marked in
        ["$0", "$0\n", "board $0", "}$0", "board B on STM32F4DiscoveryBoard {$0}", "// 🤖$0"]
    {
        let (text, actions) = at_marks(marked);
        for action in &actions {
            after(&text, action);
        }
        let (mut session, _) = Session::of(marked);
        let end = json!({ "line": 9, "character": 9 });
        offered(&mut session, FILE, [&json!({ "line": 0, "character": 0 }), &end], None);
    }
    let (_, actions) = at_marks("$0");
    assert_eq!(titles(&actions), Vec::<&str>::new());
}

#[test]
fn every_place_of_a_text_with_mistakes_has_an_answer() {
    for (path, text) in some(texts("tests/corpus/err", "sense"), 24) {
        let mut session = Session::new();
        session.open(FILE, &text);
        session.settle();
        for (line, written) in text.lines().enumerate() {
            let units = written.encode_utf16().count();
            // Both ends of each line, and a place within.
            for column in BTreeSet::from([0, units / 2, units]) {
                let at = json!({ "line": line, "character": column });
                for action in offered(&mut session, FILE, [&at, &at], Some("refactor")) {
                    let new = after(&text, &action);
                    let (before, after) = (snapshot(&path, &text), snapshot(&path, &new));
                    let errors = |all: &Snapshot| {
                        let all = all.diagnostics().iter();
                        all.filter(|one| one.severity == Severity::Error).count()
                    };
                    assert!(
                        errors(&after) <= errors(&before),
                        "{path}: {}:\n{new}",
                        action["title"]
                    );
                }
            }
        }
    }
}

/// Texts without a wiring, and a repair that each is offered.
const CONFLICTS: &[(&str, &str, &str)] = &[
    (
        "Remove the fixed pins or place of Two",
        "board B on STM32F4DiscoveryBoard {\n    sensor One returns uint16 { id = 1; type = analog; pin = PA1; }\n    sensor Two returns uint16 { id = 2; type = analog; delay = 5; pin = $0PA1; }\n}\n",
        "sensor Two returns uint16 { id = 2; type = analog; delay = 5; }",
    ),
    (
        "Leave out Two",
        "board B on STM32F4DiscoveryBoard {\n    sensor One returns uint16 { id = 1; type = analog; pin = PA1; }\n    sensor Two returns uint16 { id = 2; type = analog; pin = $0PA1; }\n}\n",
        "pin = PA1; }\n}\n",
    ),
    (
        "Move Two to C",
        "board B on STM32F4DiscoveryBoard {\n    sensor $0One returns uint16 { type = i2c; address = 0x10; exclusive = true; }\n    sensor Two returns uint16 {\n        type = i2c;\n        address = 0x11;\n        exclusive = true;\n    }\n    sensor Three returns uint16 { type = i2c; address = 0x12; exclusive = true; }\n    sensor Four returns uint16 { type = i2c; address = 0x13; exclusive = true; }\n}\nspare board C on STM32F4DiscoveryBoard {\n}\n",
        "board C on STM32F4DiscoveryBoard {\n    sensor Two returns uint16 {\n        type = i2c;\n        address = 0x11;\n        exclusive = true;\n    }\n}\n",
    ),
    (
        "Let One and Two share a bus",
        "board B on STM32F4DiscoveryBoard {\n    sensor $0One returns uint16 { type = i2c; address = 0x10; exclusive = true; }\n    sensor Two returns uint16 { type = i2c; address = 0x11; exclusive = true; }\n    sensor Three returns uint16 { type = i2c; address = 0x12; exclusive = true; }\n    sensor Four returns uint16 { type = i2c; address = 0x13; exclusive = true; }\n}\n",
        "address = 0x11; exclusive = false; }",
    ),
    (
        "Run Two at 50 Hz",
        "board B on STM32F407G_DISC1 {\n    actuator $0One accepts uint16 { type = pwm; unit = TIM4; }\n    actuator Two accepts uint16 { type = pwm; unit = TIM4; frequency = 20 kHz; }\n}\n",
        "frequency = 50 Hz; }",
    ),
    (
        "Do not reserve PA4",
        "board B on NUCLEO_F446RE {\n    reserve PC1, PA4, PA5;\n    actuator $0One accepts uint16 { type = dac; }\n}\n",
        "reserve PC1, PA5;",
    ),
    (
        "Release CS43L22",
        "board B on STM32F407G_DISC1 {\n    actuator $0One accepts uint16 { type = dac; }\n}\n",
        "release CS43L22",
    ),
    (
        "Write `link { transport = none; }` in B",
        "board B on STM32F407G_DISC1 {\n    link {\n        transport = uart;\n        unit = USART2;\n        baud = 9600;\n    }\n    sensor $0One returns uint16 { type = uart; unit = USART2; }\n}\n",
        "link { transport = none; }",
    ),
];

#[test]
fn repairs_give_a_wiring() {
    for (title, marked, expected) in CONFLICTS {
        let (text, actions) = at_marks(marked);
        let action = find(&actions, title);
        assert_eq!(action["diagnostics"][0]["code"], "E0401");
        let after = after(&text, action);
        assert!(after.contains(expected), "{after}");
        let after = snapshot(PATH, &after);
        rows(&after, Goal::Any);
    }
}

#[test]
fn what_was_not_tried_is_not_offered() {
    let (_, marked, _) = CONFLICTS.first().unwrap();
    let (mut session, places) = Session::of(marked);
    session.settle();
    let params = json!({
        "textDocument": { "uri": FILE },
        "range": { "start": places[0], "end": places[0] },
        "context": { "diagnostics": [], "only": ["quickfix"] },
    });
    let mut ask = |cancel: Cancel<'_>| {
        let request = Request::new(77.into(), "textDocument/codeAction".to_owned(), params.clone());
        let answers = session.server.handle(Message::Request(request), cancel);
        let [Message::Response(answer)] = answers.as_slice() else { panic!("{answers:?}") };
        answer.response_result.clone().unwrap().as_array().unwrap().len()
    };
    assert!(ask(Cancel::NEVER) > 0);
    assert_eq!(ask(Cancel::when(&|| true)), 0);
}

#[test]
fn every_repair_of_the_corpus_helps() {
    let mut kinds = BTreeSet::new();
    let conflicts = texts("tests/corpus/err", "sense").into_iter();
    for (path, text) in conflicts.filter(|(path, _)| path.contains("/E0401_")) {
        let mut session = Session::new();
        session.open(FILE, &text);
        session.settle();
        let told = &session.told[FILE].clone();
        let place = &told.iter().find(|one| one["code"] == "E0401").unwrap()["range"]["start"];
        let actions = offered(&mut session, FILE, [place, place], Some("quickfix"));
        let of_wiring = actions.iter().filter(|one| one["diagnostics"][0]["code"] == "E0401");
        for action in of_wiring {
            let title = action["title"].as_str().unwrap();
            kinds.insert(title.split(' ').next().unwrap().to_owned());
            let after = snapshot(&path, &after(&text, action));
            assert!(!has_errors(after.diagnostics()), "{path}: {title}");
            rows(&after, Goal::Any);
        }
    }
    assert!(kinds.len() >= 2, "{kinds:?}");
}

/// All actions that are offered at the beginning, in each part, and for the whole text.
fn everywhere(path: &str, text: &str) -> Vec<Value> {
    let uri = format!("file://{path}");
    let mut session = Session::new();
    session.open(&uri, text);
    session.settle();
    let place = |offset: usize| {
        let before = &text[..offset];
        let column = before.rsplit('\n').next().unwrap().encode_utf16().count();
        json!({ "line": before.matches('\n').count(), "character": column })
    };
    let tree = parse(text).ast();
    let boards = tree.boards().flat_map(|board| board.parts().collect::<Vec<_>>());
    let parts = tree.parts().chain(boards).map(|part| match part {
        ast::Item::Device(one) => one.name().unwrap().range().end(),
        ast::Item::Chip(one) => one.name().unwrap().range().end(),
        ast::Item::Controller(one) => one.name().unwrap().range().end(),
    });
    let parts: Vec<Value> = parts.map(|at| place(at.into())).collect();
    let (start, end) = (place(0), place(text.len()));
    let mut all = offered(&mut session, &uri, [&start, &start], None);
    all.extend(offered(&mut session, &uri, [&start, &end], None));
    for part in &parts {
        all.extend(offered(&mut session, &uri, [part, part], None));
    }
    all.sort_by_key(Value::to_string);
    all.dedup();
    all
}

/// Whether a row is of a device of that part.
fn is_of_part(design: &Design, row: &str, part: &str) -> bool {
    let device = row.split(' ').next().unwrap();
    let of = design.devices.iter().find(|one| one.name.value == device).unwrap().part;
    design.part_name(of) == part
}

#[test]
fn actions_keep_good_designs_as_they_are() {
    let mut seen = BTreeSet::new();
    for (path, text) in some(good(), 30) {
        let before = snapshot(&path, &text);
        let Some(design) = before.design() else { continue };
        let answer = before.solve(&Ask { partly: true, ..Ask::default() });
        if answer.wired().is_none() {
            continue;
        }
        let rows_before = rows(&before, Goal::Best);
        for action in everywhere(&path, &text) {
            let title = action["title"].as_str().unwrap();
            let first = title.split(' ').next().unwrap().to_owned();
            if action["kind"] == "quickfix" || action["kind"] == "source.fixAll" {
                continue;
            }
            seen.insert(first);
            let new = after(&text, &action);
            assert!(parse(&new).errors().is_empty(), "{path}: {title}:\n{new}");
            let after = snapshot(&path, &new);
            assert!(!has_errors(after.diagnostics()), "{path}: {title}: {:?}", after.diagnostics());
            let after_design = after.design().unwrap();
            assert_eq!(device_keys(after_design), device_keys(design), "{path}: {title}");
            if title == "Fix all pins" {
                assert_eq!(rows(&after, Goal::Any), rows_before, "{path}: {title}");
                let all = after_design.connections.iter();
                let wired = all.filter(|one| !one.placement.pins.is_empty()).count();
                assert!(wired > 0, "{path}");
            } else if title.starts_with("Fix") {
                let name = title.rsplit(' ').next().unwrap();
                let of_part = |row: &&String| is_of_part(design, row, name);
                let (rows, before): (BTreeSet<String>, BTreeSet<String>) = (
                    rows(&after, Goal::Any).iter().filter(of_part).cloned().collect(),
                    rows_before.iter().filter(of_part).cloned().collect(),
                );
                assert_eq!(rows, before, "{path}: {title}");
            } else if title.starts_with("Write") || title.starts_with("Extract") {
                assert_eq!(rows(&after, Goal::Best), rows_before, "{path}: {title}");
            }
        }
    }
    let expected: &[&str] =
        if is_exhaustive() { &["Extract", "Fix", "Release", "Write"] } else { &["Fix"] };
    assert!(expected.iter().all(|one| seen.contains(*one)), "{seen:?}");
}

#[test]
fn pins_are_fixed_and_released() {
    let marked = "board B on STM32F407G_DISC1 {\n    sensor Light$0 returns uint16 { id = 1; type = analog; }\n    sensor Line returns uint16[3] {\n        id = 2;\n        type = analog;\n    }\n    chip Left {\n        driver = gearmotor_tb6612;\n        in1 = PD3;\n        connection encoder { unit = TIM3; }\n        actuator Speed accepts int16 { id = 3; }\n        sensor Position returns int32 { id = 4; }\n    }\n}\n";
    let (text, actions) = at_marks(marked);
    let fixed = after(&text, find(&actions, "Fix pin of Light"));
    assert!(
        fixed.contains("sensor Light returns uint16 { id = 1; type = analog; pin = P"),
        "{fixed}"
    );
    let (text, actions) = at_marks(&marked.replace("$0", "").replace("board", "$0board"));
    let fixed = after(&text, find(&actions, "Fix all pins"));
    assert!(fixed.contains("\n        type = analog;\n        pin = [P"), "{fixed}");
    assert!(fixed.contains("connection encoder { unit = TIM3; a = P"), "{fixed}");
    assert!(fixed.contains("in1 = PD3;") && fixed.contains("\n        in2 = P"), "{fixed}");
    let again = fixed.replace("chip Left", "chip$0 Left");
    let (text, actions) = at_marks(&again);
    assert!(titles(&actions).iter().all(|one| !one.starts_with("Fix")), "{:?}", titles(&actions));
    let released = after(&text, find(&actions, "Release pins of Left"));
    assert!(released.contains("connection encoder { unit = TIM3; }"), "{released}");
    assert!(!released.contains("in1 =") && !released.contains("in2 ="), "{released}");
}

#[test]
fn identifiers_are_written_where_they_are_missing() {
    let (text, actions) = at_marks(
        "board B on STM32F4DiscoveryBoard {\n    sensor One$0 returns uint16 { type = analog; }\n    sensor Two returns uint16 {\n        type = analog;\n    }\n    sensor Three returns uint16 { id = 7; type = analog; }\n}\n",
    );
    let written = after(&text, find(&actions, "Write identifiers"));
    assert!(written.contains("sensor One returns uint16 { id = 8; type = analog; }"), "{written}");
    assert!(written.contains("uint16 {\n        id = 9;\n        type = analog;"), "{written}");
    let (_, actions) = at_marks(&written.replace("One", "One$0"));
    assert!(!titles(&actions).contains(&"Write identifiers"));
}

#[test]
fn devices_of_one_part_become_a_chip() {
    let marked = "board B on STM32F407G_DISC1 {\n    $0sensor Turning returns int16[3] { id = 1; driver = mpu6050; reading = rate; address = 0x68; delay = 10; }\n    sensor Pull returns int16[3] { id = 2; driver = mpu6050; reading = acceleration; address = 0x68; }\n$0    sensor Other returns uint16 { id = 3; type = analog; }\n}\n";
    let (text, actions) = at_marks(marked);
    let made = after(&text, find(&actions, "Make a chip `Mpu6050` of these 2 devices"));
    let expected = "    chip Mpu6050 {\n        driver = mpu6050;\n        address = 0x68;\n        sensor Turning returns int16[3] { id = 1; reading = rate; delay = 10; }\n        sensor Pull returns int16[3] { id = 2; reading = acceleration; }\n    }\n    sensor Other";
    assert!(made.contains(expected), "{made}");
    rows(&snapshot(PATH, &made), Goal::Any);
    // Another address is another part.
    let other = marked.replacen("0x68; }", "0x69; }", 1);
    let (_, actions) = at_marks(&other);
    assert!(titles(&actions).iter().all(|one| !one.starts_with("Make")), "{:?}", titles(&actions));
}

#[test]
fn a_protocol_becomes_a_driver() {
    let marked = "// A room.\nboard B on STM32F407G_DISC1 {\n    sensor RoomAir$0 returns int16 {\n        id = 1;\n        type = i2c;\n        address = 0x48;\n        register = 0x00;\n        length = 2;\n        quantity = degC;\n        scale = 1 / 256;\n        delay = 500 ms;\n    }\n}\n";
    let (text, actions) = at_marks(marked);
    let extracted = after(&text, find(&actions, "Extract a driver `room_air`"));
    let expected = "driver room_air for i2c {\n    register = 0x00;\n    length = 2;\n    quantity = degC;\n    scale = 1 / 256;\n}\n// A room.\nboard B on STM32F407G_DISC1 {\n    sensor RoomAir returns int16 {\n        id = 1;\n        driver = room_air;\n        address = 0x48;\n        delay = 500 ms;\n    }\n}\n";
    assert_eq!(extracted, expected);
    let (before, after) = (snapshot(PATH, &text), snapshot(PATH, &extracted));
    let shown = |snapshot: &Snapshot| {
        let device = snapshot.design().unwrap().devices.first().unwrap().clone();
        let i2c = device.kind.i2c().unwrap().clone();
        let bus = (i2c.address, i2c.register, i2c.length_bytes, i2c.speed_hz, i2c.trigger);
        format!("{bus:?} {:?} {:?} {:?}", device.shown.scale, device.shown.quantity, device.coding)
    };
    assert_eq!(shown(&before), shown(&after));
    assert_eq!(rows(&before, Goal::Best), rows(&after, Goal::Best));
}
