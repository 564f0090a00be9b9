//! Completion: what is offered at a place, and what comes of it.

use sensedsl_model::kind::KindName;
use sensedsl_model::{NoFiles, Request, facts, resolve};
use sensedsl_wire::Direction;
use serde_json::{Value, json};

use crate::corpus::some;
use crate::session::{FILE, Session, Stored, edited, unmarked};

/// A session of an editor that knows snippets.
pub(crate) fn able() -> Session {
    let item = json!({ "snippetSupport": true });
    let capabilities = json!({ "textDocument": { "completion": { "completionItem": item } } });
    Session::with(Stored::default(), &capabilities)
}

/// What is offered at the mark.
fn offered(marked: &str) -> Vec<Value> {
    let list = list(&mut able(), marked);
    assert_eq!(list["isIncomplete"], false, "{marked}");
    list["items"].as_array().unwrap().clone()
}

pub(crate) fn list(session: &mut Session, marked: &str) -> Value {
    let places = session.open(FILE, marked);
    session.settle();
    session.at("textDocument/completion", &places[0])
}

pub(crate) fn labels(items: &[Value]) -> Vec<&str> {
    items.iter().map(|item| item["label"].as_str().unwrap()).collect()
}

fn item<'i>(items: &'i [Value], label: &str) -> &'i Value {
    let found = items.iter().find(|item| item["label"] == label);
    found.unwrap_or_else(|| panic!("no {label} in {:?}", labels(items)))
}

/// The text after an item is taken, its places filled with what stands in them.
pub(crate) fn taken(marked: &str, item: &Value) -> String {
    let mut plain = item["textEdit"].clone();
    if item["insertTextFormat"] == 2 {
        plain["newText"] = filled(plain["newText"].as_str().unwrap()).into();
    }
    edited(&unmarked(marked).0, &json!([plain]))
}

/// A snippet as a person leaves it who types nothing.
fn filled(snippet: &str) -> String {
    let (mut out, mut rest) = (String::new(), snippet);
    while let Some(at) = rest.find(['$', '\\']) {
        out.push_str(&rest[..at]);
        if rest[at..].starts_with('\\') {
            out.push_str(&rest[at + 1..at + 2]);
            rest = &rest[at + 2..];
        } else if let Some(place) = rest[at..].strip_prefix("${") {
            let end = place.find('}').unwrap();
            out.push_str(place[..end].split_once(':').unwrap().1);
            rest = &place[end + 1..];
        } else {
            rest = &rest[at + 2..];
        }
    }
    out + rest
}

/// The codes of the errors of a text.
fn errors(text: &str) -> Vec<String> {
    let request = Request { path: "a.sense", text, ..Request::default() };
    let all = resolve(&request, &NoFiles).diagnostics;
    let errors = all.into_iter().filter(|one| one.code.name().starts_with('E'));
    errors.map(|one| format!("{} {}", one.code, one.message)).collect()
}

fn head(kind: KindName, way: Direction) -> String {
    match way {
        Direction::Sensor => format!("sensor X returns {}", kind.spec().natural),
        Direction::Actuator => format!("actuator X accepts {}", kind.spec().natural),
    }
}

#[test]
fn every_property_of_every_kind_is_offered_in_an_empty_device_of_it() {
    for kind in KindName::ALL {
        let mut all: Vec<String> = Vec::new();
        for way in kind.spec().directions {
            let head = head(kind, *way);
            let marked = format!(
                "board B on STM32F407G_DISC1 {{\n    {head} {{\n        type = {kind};\n        $0\n    }}\n}}\n"
            );
            let items = offered(&marked);
            assert!(!labels(&items).contains(&"type"), "it is there already");
            for name in kind.spec().properties {
                if let Some(item) = items.iter().find(|item| item["label"] == *name) {
                    assert_eq!(item["textEdit"]["newText"], format!("{name} = $1;"));
                    let text = item["documentation"]["value"].as_str().unwrap();
                    assert!(text.contains(&format!("{name} = ")), "{text}");
                }
            }
            all.extend(labels(&items).into_iter().map(str::to_owned));
        }
        for name in kind.spec().properties {
            assert!(all.iter().any(|one| one == name), "{kind}: {name}");
        }
    }
}

#[test]
fn a_half_typed_property_is_completed() {
    let marked = "sensor X returns uint16 { ty$0";
    let items = offered(marked);
    assert_eq!(items[0]["label"], "type");
    assert_eq!(taken(marked, item(&items, "type")), "sensor X returns uint16 { type = ;");
    // In the middle of a name whose value is there only the name is replaced.
    let marked = "sensor X returns uint16 { ty$0pe = analog; }";
    let items = offered(marked);
    assert_eq!(
        taken(marked, item(&items, "driver")),
        "sensor X returns uint16 { driver = analog; }"
    );
}

#[test]
fn before_a_statement_another_one_is_begun() {
    let marked = "sensor X returns uint16 { $0type = analog; }";
    let items = offered(marked);
    let text = taken(marked, item(&items, "delay"));
    assert_eq!(text, "sensor X returns uint16 { delay = ;type = analog; }");
    // A value is another one's place.
    let marked = "sensor X returns uint16 { type = $0analog; }";
    let text = taken(marked, item(&offered(marked), "icu"));
    assert_eq!(text, "sensor X returns uint16 { type = icu; }");
}

#[test]
fn a_missing_semicolon_ends_with_its_line() {
    let marked = "board B on STM32F407G_DISC1 {\n    sensor X returns uint16 {\n        type = analog\n        sam$0\n    }\n}\n";
    let items = offered(marked);
    assert!(labels(&items).contains(&"samples"));
    assert!(!labels(&items).contains(&"type"));
}

#[test]
fn kinds_are_those_of_the_direction() {
    let items = offered("µ: sensor X returns uint16 { type = $0 }".trim_start_matches("µ: "));
    assert_eq!(labels(&items)[..3], ["analog", "i2c", "icu"]);
    assert!(!labels(&items).contains(&"pwm"));
    let marked = "/* µ😀 */ actuator X accepts uint16 { type = \"p$0\"; }";
    let items = offered(marked);
    assert!(!labels(&items).contains(&"analog"));
    let text = taken(marked, item(&items, "pwm"));
    assert_eq!(text, "/* µ😀 */ actuator X accepts uint16 { type = \"pwm\"; }");
}

#[test]
fn types_are_those_of_the_kind() {
    assert!(labels(&offered("sensor X returns $0")).contains(&"float32"));
    let items = offered("sensor X returns $0 { type = digital; }");
    assert!(labels(&items).contains(&"bool") && !labels(&items).contains(&"float32"));
    let items = offered("sensor X returns u$0 { type = analog; }");
    assert!(!labels(&items).contains(&"bool"));
}

#[test]
fn parts_are_found_by_what_people_call_them() {
    let marked = "chip Imu { driver = GY$0; }";
    let items = offered(marked);
    let part = item(&items, "mpu6050");
    assert!(part["filterText"].as_str().unwrap().contains("gy-521"), "{part}");
    assert!(part["detail"].as_str().unwrap().ends_with('.'), "{part}");
    assert_eq!(taken(marked, part), "chip Imu { driver = mpu6050; }");
    // One that names no values cannot be a chip.
    assert!(!labels(&items).contains(&"mpu6050_rate"));
    let shown = able().ask("completionItem/resolve", part.clone());
    assert!(shown["documentation"]["value"].as_str().unwrap().contains("MPU-6050"), "{shown}");
    let device = offered("sensor R returns int16[3] { type = i2c; driver = $0; }");
    assert!(labels(&device).contains(&"mpu6050_rate") && !labels(&device).contains(&"hcsr04"));
}

#[test]
fn drivers_of_the_file_come_first() {
    let driver = "driver mine for i2c { address = 0x20; about = \"Mine.\"; reading level returns uint16 { register = 1; quantity = cm; } reading heat returns int16 { register = 3; } command on accepts bool { register = 2; } }\n";
    let items = offered(&format!("{driver}chip C {{ driver = $0 }}"));
    assert_eq!((&items[0]["label"], &items[0]["detail"]), (&json!("mine"), &json!("Mine.")));
    let chip = format!(
        "{driver}chip C {{ driver = mine; sensor Level returns uint16 {{ }} sensor X returns int16 {{ reading = $0 }} }}"
    );
    let items = offered(&chip);
    assert_eq!(labels(&items), ["level", "heat"]);
    assert_eq!(items[0]["detail"], "uint16 in cm");
    let items = offered(&format!(
        "{driver}chip C {{ driver = mine; sensor Level returns uint16 {{ }} $0 }}"
    ));
    assert!(!labels(&items).contains(&"sensor level"), "it is there already");
    let heat = item(&items, "sensor heat");
    assert_eq!(heat["textEdit"]["newText"], "sensor Heat returns int16 { $0 }");
    assert!(labels(&items).contains(&"actuator on") && labels(&items).contains(&"address"));
}

#[test]
fn pins_come_by_what_they_cost_and_who_has_them() {
    let text = "board B on STM32F407G_DISC1 {
    sensor Fixed returns uint16 { type = analog; pin = PA1; }
    sensor Free returns uint16 { type = analog; }
    sensor New returns uint16 { type = analog; pin = $0 }
}
";
    let items = offered(text);
    let found = labels(&items);
    let place = |name: &str| found.iter().position(|one| *one == name).unwrap();
    assert!(!found.contains(&"PE2"), "it has no converter: {found:?}");
    assert!(item(&items, "PA1")["detail"].as_str().unwrap().starts_with("Fixed is fixed to it"));
    let free: Vec<usize> = (0..found.len())
        .filter(|at| items[*at]["detail"].as_str().unwrap().starts_with("free"))
        .collect();
    assert!(free.len() > 3 && free.iter().all(|at| *at < place("PA1")), "{found:?}");
    let moved =
        items.iter().find(|one| one["detail"].as_str().unwrap().starts_with("Free is on it"));
    assert!(moved.is_some(), "{items:?}");
    assert!(item(&items, "PA1")["documentation"]["value"].as_str().unwrap().contains("`ADC"));
    // Of an array each pin once.
    let items = offered(
        "board B on STM32F407G_DISC1 { sensor A returns uint16[2] { type = analog; pin = [PA1, $0] } }",
    );
    assert!(!labels(&items).contains(&"PA1") && labels(&items).contains(&"PA2"));
    let items = offered(
        "board B on STM32F407G_DISC1 { sensor T returns uint16 { type = i2c; address = 0x40; scl = $0 } }",
    );
    assert!(labels(&items).contains(&"PB6") && !labels(&items).contains(&"PB7"));
}

/// A serial link that is wired on the board keeps its pins.
#[test]
fn pins_of_the_link_come_last() {
    let items =
        offered("board B on NUCLEO_F446RE { sensor A returns bool { type = digital; pin = $0 } }");
    for pin in ["PA2", "PA3"] {
        let detail = item(&items, pin)["detail"].as_str().unwrap();
        assert!(detail.starts_with("kept back: the link"), "{detail}");
    }
    assert!(items.last().unwrap()["detail"].as_str().unwrap().starts_with("kept back"));
}

#[test]
fn what_the_driver_leaves_open_comes_first() {
    let of = |driver: &str| {
        let items = offered(&format!("chip C {{ driver = {driver}; $0 }}"));
        labels(&items)[0].to_owned()
    };
    assert_eq!(of("mpu6050"), "sensor acceleration");
    assert_eq!(of("srf08"), "address");
}

#[test]
fn labels_and_connections_find_pins() {
    let text = "board B on NUCLEO_F446RE { chip M { driver = gearmotor_tb6612; in1 = $0 actuator Speed accepts int16 { } } }";
    let items = offered(text);
    let filter = item(&items, "PA5")["filterText"].as_str().unwrap().to_owned();
    assert!(filter.contains("D13"), "{filter}");
    let items = offered(&text.replace("in1 = $0", "$0"));
    assert!(labels(&items).contains(&"in1") && labels(&items).contains(&"connection"));
    let items = offered(&text.replace("in1 = $0", "connection $0"));
    assert!(labels(&items).contains(&"encoder"));
    let items = offered(&text.replace("in1 = $0", "connection encoder { $0 }"));
    assert!(labels(&items).contains(&"counts") && labels(&items).contains(&"a"));
}

#[test]
fn boards_are_found_by_their_aliases_and_mcus() {
    let list = list(&mut able(), "board B on nucleo_f446$0 { }");
    assert_eq!(list["isIncomplete"], true);
    let items = list["items"].as_array().unwrap();
    assert_eq!(items[0]["label"], "NUCLEO_F446RE");
    let marked = "board B on STM32F446RE$0 { }";
    let list = self::list(&mut able(), marked);
    let items = list["items"].as_array().unwrap();
    assert!(labels(items).contains(&"NUCLEO_F446RE"), "by its MCU");
    let mcu = labels(items).into_iter().find(|one| one.starts_with("STM32F446RE")).unwrap();
    assert_eq!(errors(&taken(marked, item(items, mcu))), [] as [&str; 0]);
    let board = able().ask("completionItem/resolve", item(items, "NUCLEO_F446RE").clone());
    assert!(board["documentation"]["value"].as_str().unwrap().contains("MCU STM32F446RET6, "));
    let part = able().ask("completionItem/resolve", item(items, mcu).clone());
    assert!(part["documentation"]["value"].as_str().unwrap().contains("Cortex-M4 in "), "{part}");
    assert!(items.len() <= 200);
}

#[test]
fn units_stand_after_numbers() {
    let of = |text: &str| labels(&offered(text)).join(" ");
    let device = |line: &str| format!("actuator X accepts uint16 {{ type = pwm; {line} }}");
    assert_eq!(of(&device("delay = 10 $0;")), "us ms s");
    let marked = device("delay = 10m$0;");
    let items = offered(&marked);
    assert_eq!(taken(&marked, item(&items, "ms")), device("delay = 10ms;"));
    assert_eq!(of(&device("delay = 10$0;")), "");
    assert_eq!(of(&device("frequency = 50 $0")), "Hz kHz MHz");
    assert_eq!(of(&device("failsafe = 50 $0;")), "% us ms");
    assert_eq!(of("sensor X returns uint16 { level = 5 $0; }"), "V mV");
    assert_eq!(of("const A = 1;\nsensor X returns uint16 { divider = [33 $0] }"), "Ohm kOhm");
}

#[test]
fn words_are_those_of_the_reader() {
    let of = |text: &str| labels(&offered(text)).join(" ");
    assert_eq!(of("board B { link { checksum = $0 } }"), "none crc16 crc32");
    assert_eq!(of("sensor X returns bool { type = digital; edge = $0; }"), "rising falling both");
    let marked = "sensor X returns uint8 { type = uart; frame = $0; }";
    let items = offered(marked);
    let text = taken(marked, item(&items, "8E1"));
    assert_eq!(text, "sensor X returns uint8 { type = uart; frame = \"8E1\"; }");
    assert_eq!(
        of("const N = 3;\nsensor X returns uint8 { type = analog; samples = 2 * $0; }"),
        "N"
    );
    assert_eq!(of("const N = 3;\nsensor X returns uint8[$0] { type = analog; }"), "N");
    assert_eq!(of("driver d for i2c { compensate = $0; }"), "bmp280 bme280 ntc tsl2561 hx711");
    let frames = "driver d for can { frame = 1; reading page returns uint8 { } reading a returns uint8 { mux = $0; } }";
    assert_eq!(of(frames), "page");
    assert!(taken(frames, &offered(frames)[0]).contains("mux = page = ;"));
    assert!(of("board B { target = $0; }").contains("embassy"));
    assert!(of("sensor X returns uint8 { quantity = $0; }").contains("deg/s"));
    assert!(of("sensor X returns uint8 { group = $0; }").contains("ultrasonic"));
}

#[test]
fn rules_name_properties_resources_and_codes() {
    let board = |line: &str| format!("board B on STM32F407G_DISC1 {{ {line} }}");
    let items = offered(&board("prefer $0"));
    assert!(labels(&items).contains(&"side") && !labels(&items).contains(&"delay"));
    assert!(labels(&offered(&board("prefer unit = $0"))).contains(&"ADC1"));
    let list = list(&mut able(), &board("reserve PA$0"));
    assert!(labels(list["items"].as_array().unwrap()).contains(&"PA0"));
    let items = offered(&board("release $0"));
    assert!(items.iter().any(|one| one["detail"].as_str().is_some()), "{items:?}");
    let marked = board("allow $0");
    let items = offered(&marked);
    assert_eq!(item(&items, "W0602")["detail"], "the device is slower than asked for");
    assert!(!labels(&items).contains(&"E0201"));
    assert_eq!(taken(&marked, item(&items, "W0602")), board("allow W0602 \"reason\";"));
}

#[test]
fn open_files_of_the_folder_can_be_used() {
    let mut session = able();
    session.open("file:///robot/parts.sense", "");
    session.open("file:///robot/sub/more.sense", "");
    session.open("file:///other/far.sense", "");
    let list = list(&mut session, "use \"$0\";");
    let items = list["items"].as_array().unwrap();
    assert_eq!(labels(items), ["parts.sense", "sub/more.sense"]);
    assert_eq!(taken("use \"$0\";", &items[0]), "use \"parts.sense\";");
}

#[test]
fn what_a_used_file_has_is_known() {
    let mut session = able();
    session.open(
        "file:///robot/parts.sense",
        "const N = 3;\ndriver mine for i2c { address = 0x20; reading level returns uint16 { register = 1; } }",
    );
    let list = list(&mut session, "use \"parts.sense\";\nchip C { driver = mine; delay = $0 }");
    assert_eq!(labels(list["items"].as_array().unwrap()), ["N"]);
    let list =
        self::list(&mut session, "use \"parts.sense\";\nchip C { driver = mine; sensor $0 }");
    assert_eq!(labels(list["items"].as_array().unwrap()), ["Level returns uint16"]);
}

#[test]
fn there_is_nothing_in_comments_numbers_and_texts() {
    for marked in [
        "// typ$0",
        "sensor X returns uint16 { /* t$0 */ }",
        "sensor X returns uint16 { id = 1$0; }",
        "sensor X returns uint16 { address = 0x1F$0; }",
        "sensor X returns uint16 { label = \"a$0\"; }",
        "sensor X$0",
        "sensor X returns uint16 { type = analog $0 }",
    ] {
        assert_eq!(labels(&offered(marked)), [] as [&str; 0], "{marked}");
    }
    let mut session = able();
    let at = session.open(FILE, "board B {\n    $0\n}").remove(0);
    let params = json!({
        "textDocument": { "uri": FILE }, "position": at,
        "context": { "triggerKind": 2, "triggerCharacter": " " },
    });
    let list = session.ask("textDocument/completion", params);
    assert_eq!(list["items"], json!([]), "a space that indents asks for nothing");
}

#[test]
fn an_empty_file_is_begun() {
    let mut session = able();
    let list = list(&mut session, "$0");
    let items = list["items"].as_array().unwrap();
    assert!(
        ["board", "use", "sensor analog", "mpu6050"].iter().all(|one| labels(items).contains(one))
    );
    assert_eq!(labels(items)[0], "board");
    // Who types `ana` finds it before the parts whose names begin with these letters among others.
    assert_eq!(item(items, "sensor analog")["filterText"], "analog sensor analog");
}

/// A text of whole devices of every kind, and of every part of the library, has no errors.
#[test]
fn whole_devices_and_chips_resolve() {
    let mut found = 0;
    for kind in KindName::ALL {
        for word in ["sensor", "actuator"] {
            let marked = format!("board Robot on STM32F407G_DISC1 {{\n{word} {kind}$0\n}}\n");
            let mut session = able();
            let at = session.open(FILE, &marked.replace(&format!("{word} {kind}"), "")).remove(0);
            let list = session.at("textDocument/completion", &at);
            let all = list["items"].as_array().unwrap();
            let label = format!("{word} {kind}");
            let Some(item) = all.iter().find(|one| one["label"] == label) else { continue };
            let text = taken(&marked.replace(&format!("{word} {kind}"), ""), item);
            assert_eq!(errors(&text), [] as [&str; 0], "{text}");
            found += 1;
        }
    }
    assert_eq!(found, KindName::ALL.iter().map(|kind| kind.spec().directions.len()).sum::<usize>());
    for part in some(facts::all(), 10) {
        let board = facts::example_board(&part);
        let marked = format!("board Robot on {board} {{\n{}$0\n}}\n", part.name);
        let list = list(&mut able(), &marked);
        let item = item(list["items"].as_array().unwrap(), &part.name).clone();
        let text = taken(&marked, &item);
        assert_eq!(errors(&text), [] as [&str; 0], "{text}");
    }
}

#[test]
fn clients_without_snippets_get_plain_text() {
    let (mut session, at) = Session::of("sensor X returns uint16 { type = analog; $0 }");
    let list = session.at("textDocument/completion", &at[0]);
    let items = list["items"].as_array().unwrap();
    let samples = item(items, "samples");
    assert_eq!(
        (&samples["insertTextFormat"], &samples["textEdit"]["newText"]),
        (&json!(1), &json!("samples = ;"))
    );
}
