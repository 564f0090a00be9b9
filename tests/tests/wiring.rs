//! Rules, fixed places, several boards and all kinds of devices, seen through `solve`.

use std::collections::BTreeMap;

use sensedsl_tests::{Ran, Scratch, design, device_block, sensedsl};
use serde_json::Value;

const BOARD: &str = "STM32F4DiscoveryBoard";
const FULL: &str = "STM32F407G_DISC1";

fn solve(text: impl Into<String>, arguments: &[&str]) -> Ran {
    let call = sensedsl(["solve", "-", "-q", "--format", "json", "--allow-outside"]);
    // The tables are in folders of their own.
    let call = call.arg(std::env::temp_dir());
    let call = arguments.iter().fold(call, |call, argument| call.arg(argument));
    call.stdin(text.into()).run()
}

/// The pins, by `board.device.role`.
fn pins(ran: &Ran) -> BTreeMap<String, String> {
    let mut pins = BTreeMap::new();
    for board in ran.json()["boards"].as_array().unwrap() {
        for device in board["devices"].as_array().unwrap() {
            for wire in device["wires"].as_array().unwrap() {
                let word = |value: &Value| value.as_str().unwrap().to_owned();
                let name = [&board["name"], &device["name"], &wire["role"]].map(word).join(".");
                pins.insert(name, word(&wire["pin"]));
            }
        }
    }
    pins
}

/// The pins of the best wiring of a design, in the order of devices and roles.
#[track_caller]
fn best(text: &str) -> Vec<String> {
    pins(&solve(text, &[]).exits(0)).into_values().collect()
}

fn table(rows: &str) -> (Scratch, String) {
    let scratch = Scratch::new("table");
    let path = scratch.write("table.csv", rows).display().to_string();
    (scratch, path)
}

#[test]
fn places_that_are_fixed() {
    assert_eq!(best(&design(BOARD, &["analog: pin = PC5;"])), ["PC5"]);
    assert_eq!(best(&design(BOARD, &["icu: unit = TIM1;"])), ["PE9"]);
    assert_eq!(best(&design(BOARD, &["icu: unit = tim12;"])), ["PB14"]);
    let bus = "i2c: address = 0x20; scl = PB8; sda = PB9;";
    assert_eq!(best(&design(BOARD, &[bus])), ["PB8", "PB9"]);
    assert_eq!(best(&design(BOARD, &["i2c: address = 0x20; unit = I2C2;"])), ["PB10", "PB11"]);
    // A shared bus follows the device that fixes it.
    let shared = ["i2c: address = 0x20;", "i2c: address = 0x21; scl = PB8;"];
    assert_eq!(best(&design(BOARD, &shared)), ["PB8", "PB9", "PB8", "PB9"]);
}

#[test]
fn reserved_pins_and_units_are_left_free() {
    let rules = |rules: &str, devices: &[&str]| {
        design(BOARD, devices).replacen('{', &format!("{{ {rules}"), 1)
    };
    assert_eq!(best(&rules("reserve PB0, pb1;", &["analog"])), ["PC1"]);
    assert_eq!(best(&rules("reserve TIM3;", &["icu"])), ["PB14"]);
    let buses = rules("reserve I2C3; reserve PB10;", &["i2c: address = 0x20;"]);
    let found = best(&buses);
    assert!(["PB6", "PB8"].contains(&found[0].as_str()), "{found:?}");
    let none = rules("reserve I2C1, I2C2, I2C3;", &["i2c: address = 0x20;"]);
    assert_eq!(solve(none, &[]).exits(1).json()["status"], "infeasible");
    // A reserved converter samples nothing; if all are reserved, nothing can be sampled.
    let third = solve(rules("reserve ADC1, ADC2;", &["analog"]), &[]).exits(0);
    assert_eq!(third.json()["boards"][0]["devices"][0]["unit"], "ADC3");
    let none = solve(rules("reserve ADC1, ADC2, ADC3;", &["analog"]), &[]).exits(1);
    assert_eq!(none.json()["status"], "infeasible");
}

#[test]
fn parts_of_the_board_are_spared_until_released() {
    let spared = design(FULL, &["analog: pin = PA5;"]);
    let ran = solve(spared.clone(), &[]).exits(1);
    assert!(ran.stderr.contains("release"), "{}", ran.stderr);
    let released = spared.replacen('{', "{ release PA5;", 1);
    assert_eq!(best(&released), ["PA5"]);
    let by_part = spared.replacen('{', "{ release LIS302DL;", 1);
    assert_eq!(best(&by_part), ["PA5"]);
}

/// In this design, a wiring after a repair is found quickly, but the proof that none is cheaper
/// takes long.
#[test]
fn what_helps_is_shown_even_where_its_least_cost_is_unknown() {
    let sonar = |at| format!("sensor S{at} returns uint16 {{ driver = srf02; address = 0x72; }}");
    let row = |at, pins| {
        format!("sensor R{at} returns uint16[{pins}] {{ type = analog; together = unit; }}")
    };
    let rows = format!("{} {} {} {} {}", row(0, 3), row(1, 3), row(2, 3), row(3, 3), row(4, 5));
    let boards = |one: &str, two: &str| {
        format!("board A on NUCLEO_F303RE {{{one}}} board B on NUCLEO_F303RE {{{two}}} {rows}")
    };
    let [first, second, third] = [sonar(0), sonar(1), sonar(2)];
    let ran = solve(boards(&format!("{first}{second}{third}"), ""), &[]).exits(1);
    let help = "move S2 to B, or leave out one of S0, S1 and S2";
    assert!(ran.stderr.contains(help), "{}", ran.stderr);
    let repairs = ran.json()["conflict"]["repairs"].clone();
    assert!(repairs.as_array().unwrap().iter().any(|one| one["best"] == false), "{repairs}");
    let moved = solve(boards(&format!("{first}{second}"), &third), &["--any"]);
    assert_eq!(moved.exits(0).json()["status"], "feasible");
}

/// The rules and the repairs for an impossible design.
fn conflict(text: &str, arguments: &[&str]) -> (Vec<String>, Vec<String>) {
    let value = solve(text, arguments).exits(1).json();
    let words = |list: &Value, word: &dyn Fn(&Value) -> Value| {
        let list = list.as_array().unwrap().iter();
        list.map(|one| word(one).as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    let conflict = &value["conflict"];
    (
        words(&conflict["rules"], &Clone::clone),
        words(&conflict["repairs"], &|one| one["message"].clone()),
    )
}

#[test]
fn a_conflict_names_the_rules_it_needs_and_what_helps() {
    let (_table, path) = table("Pin,ADC,Side\nPA0,ADC1_IN0,n\nPA1,ADC1_IN1,s\nPA3,ADC1_IN3,s\n");
    let text = design("t", &["analog: side = s;", "analog", "analog: pin = PA3;"]);
    let text = text.replacen('{', "{ reserve PA0; reserve PB7;", 1);
    let (rules, repairs) = conflict(&text, &["--board", &path]);
    assert_eq!(rules, ["`reserve PA0`"], "neither the side nor the fixed pin is needed");
    assert!(repairs.contains(&"do not reserve PA0".to_owned()), "{repairs:?}");
    let places = solve(text, &["--board", &path]).json()["conflict"]["places"].clone();
    assert_eq!(places[0]["line"], 3, "{places}");

    let timer = design(BOARD, &["icu: unit = TIM3;", "icu: unit = TIM3;"]);
    let (rules, _) = conflict(&timer, &[]);
    let needed = ["what the drivers of chibios-21.11 can do", "the unit of D1", "the unit of D2"];
    assert_eq!(rules, needed);

    let buses: Vec<String> =
        (0..4).map(|at| format!("i2c: address = {}; exclusive = true;", 0x20 + at)).collect();
    let buses: Vec<&str> = buses.iter().map(String::as_str).collect();
    let (_, repairs) = conflict(&design(BOARD, &buses), &[]);
    assert_eq!(repairs[0], "let D1 and D2 share a bus");

    let (_table, path) = table("# mcu = STM32F407VGT6\nPin,TIM\nPB4,TIM3_CH1\nPB5,TIM3_CH2\n");
    let outputs = ["pwm: frequency = 50 Hz;", "pwm: frequency = 60 Hz;"];
    let (_, repairs) = conflict(&design("t", &outputs), &["--board", &path]);
    assert_eq!(repairs[..2], ["run D1 at 60 Hz", "run D2 at 50 Hz"]);
}

/// On the F103, I2C2 and SPI2 have the same DMA streams.
#[test]
fn buses_share_the_streams() {
    let rows = "# mcu = STM32F103RBT6\nPin,I2C,SPI,Other\nPB10,I2C2_SCL,-,-\nPB11,I2C2_SDA,-,-\n\
                PB6,I2C1_SCL,-,X\nPB7,I2C1_SDA,-,X\nPB13,-,SPI2_SCK,-\nPB14,-,SPI2_MISO,-\n\
                PB15,-,SPI2_MOSI,-\nPC0,-,-,-\n";
    let unit = |devices: &[&str]| {
        let text = design("t", devices).replacen('{', "{ link { transport = usb; }", 1);
        let (_table, path) = table(rows);
        let answer = solve(text, &["--board", &path]).exits(0).json();
        answer["boards"][0]["devices"][0]["unit"].as_str().unwrap().to_owned()
    };
    assert_eq!(unit(&["i2c: address = 0x20;"]), "I2C2", "the cheaper one");
    assert_eq!(unit(&["i2c: address = 0x20;", "spi"]), "I2C1", "another bus beside SPI2");
}

#[test]
fn the_link_keeps_its_pins() {
    let text = |link: &str| {
        let rules = format!("{{ release PA9; link {{ {link} }}");
        design(FULL, &["pwm: frequency = 1 kHz; pin = PA9;"]).replacen('{', &rules, 1)
    };
    let kept = sensedsl(["solve", "-"]).stdin(text("transport = usb;")).run().exits(1);
    assert!(kept.stderr.contains("E0316") && kept.stderr.contains("W0604"), "{}", kept.stderr);
    let free = solve(text("transport = uart;"), &[]).exits(0);
    assert!(pins(&free).values().any(|pin| pin == "PA9"), "{}", free.stdout);
}

#[test]
fn wishes_are_fulfilled_before_costs_and_given_up_before_failing() {
    let wish = |wish: &str| design(BOARD, &[&format!("analog: {wish}")]);
    let ran = solve(wish("prefer pin = PA1;"), &[]).exits(0);
    assert_eq!(pins(&ran).into_values().next().as_deref(), Some("PA1"));
    assert_eq!((ran.json()["violated"].as_u64(), ran.json()["cost"].as_u64()), (Some(0), Some(3)));
    assert_eq!(best(&wish("avoid pin = PB0;")), ["PB1"]);
    let two = design(BOARD, &["analog: pin = PB0;", "analog: prefer pin = PB0;"]);
    let ran = solve(two, &[]).exits(0).json();
    assert_eq!(ran["violated"], 1);
    let unit = design(BOARD, &["icu: prefer unit = TIM1;"]);
    assert_eq!(best(&unit), ["PE9"]);
    let avoided = design(BOARD, &["icu: avoid unit = TIM3;"]);
    assert_eq!(best(&avoided), ["PB14"]);
    // A rule of the whole board: avoid TIM3 for every device.
    let of_board = design(BOARD, &["icu"]).replacen('{', "{ avoid unit = TIM3;", 1);
    assert_eq!(best(&of_board), ["PB14"]);
}

#[test]
fn sides_and_headers() {
    let (_scratch, path) = table(
        "# mcu = STM32F407VGT6\nPin,ADC,Side,Header\nPA1,ADC1_IN1,left,P1\nPA2,ADC1_IN2,left,P2\n\
         PA3,ADC1_IN3,right,P2\n",
    );
    let board = format!("B on \"{path}\"");
    assert_eq!(best(&design(&board, &["analog: side = right;"])), ["PA3"]);
    assert_eq!(best(&design(&board, &["analog: header = P2;"])), ["PA2"]);
    assert_eq!(best(&design(&board, &["analog: prefer side = right;"])), ["PA3"]);
    assert_eq!(best(&design(&board, &["analog: avoid header = P1;"])), ["PA2"]);
    let three = design(&board, &["analog: side = left;"; 3]);
    let answer = solve(three, &[]).exits(1).json();
    assert_eq!(answer["conflict"]["devices"].as_array().map(Vec::len), Some(3));
    let soft = design(&board, &["analog: prefer side = left;"; 3]);
    assert_eq!(solve(soft, &[]).exits(0).json()["violated"], 1);
}

#[test]
fn an_earlier_wiring_is_kept_as_far_as_it_goes() {
    let scratch = Scratch::new("keep");
    let before = design(BOARD, &["analog: pin = PC5;", "icu: unit = TIM1;"]);
    let kept = solve(before, &[]).exits(0).stdout;
    let kept = scratch.write("kept.json", kept).display().to_string();
    let free = design(BOARD, &["analog", "icu"]);
    let ran = solve(free.clone(), &["--keep", &kept]).exits(0);
    assert_eq!(pins(&ran).into_values().collect::<Vec<_>>(), ["PC5", "PE9"]);
    assert_eq!(ran.json()["moved"], 0);
    // Only what must move is moved; a new device may go anywhere.
    let more = design(BOARD, &["analog", "icu", "analog"]).replacen('{', "{ reserve PC5;", 1);
    let ran = solve(more, &["--keep", &kept]).exits(0);
    assert_eq!(ran.json()["moved"], 1);
    assert_eq!(pins(&ran)[&format!("{BOARD}.D2.in")], "PE9");
    // A wiring of another design is ignored and does no harm.
    let strange = r#"{"boards":[{"name":"X","devices":[{"name":"D1","wires":[{"role":"in","pin":"PZ9"}]}]}]}"#;
    let strange = scratch.write("strange.json", strange).display().to_string();
    let ran = solve(free, &["--keep", &strange]).exits(0);
    assert_eq!(ran.json()["boards"][0]["cost"], 2);
}

#[test]
fn several_boards_and_devices_that_float() {
    let boards = |spare: &str, devices: usize| {
        let blocks: String = (1..=devices).map(|id| device_block(id, "analog")).collect();
        format!("{blocks}board One on {BOARD} {{}}\n{spare} board Two on {BOARD} {{}}\n")
    };
    // Nine fit on one board, but that costs more than using the cheap pins of both.
    let ran = solve(boards("", 9), &[]).exits(0);
    assert_eq!(ran.json()["cost"], 9);
    let on_two = |ran: &Ran| pins(ran).keys().filter(|name| name.starts_with("Two.")).count();
    assert_eq!(on_two(&ran), 3);
    // A spare board is used only if the devices need it, whatever the cost; they need it from ten
    // on.
    let ran = solve(boards("spare", 6), &[]).exits(0);
    assert_eq!((ran.json()["cost"].as_u64(), on_two(&ran)), (Some(6), 0));
    assert!(on_two(&solve(boards("spare", 10), &[]).exits(0)) >= 1);
    let ran = solve(boards("spare", 19), &[]).exits(1).json();
    assert_eq!(ran["conflict"]["devices"].as_array().map(Vec::len), Some(19));
    let bound = format!(
        "board One on {BOARD} {{ {} }} board Two on {BOARD} {{ {} }}",
        device_block(1, "analog"),
        device_block(2, "analog")
    );
    assert_eq!(best(&bound), ["PB0", "PB0"]);
    // A bus belongs to one board.
    let buses = format!(
        "board One on {BOARD} {{ {} }} board Two on {BOARD} {{ {} }}",
        device_block(1, "i2c: address = 0x20;"),
        device_block(2, "i2c: address = 0x20;")
    );
    assert_eq!(solve(buses, &[]).exits(0).json()["cost"], 4);
}

#[test]
fn one_input_has_one_answer_whatever_the_order_of_the_table() {
    let csv = sensedsl(["boards", BOARD]).run().stdout;
    let (comments, rest): (Vec<&str>, Vec<&str>) =
        csv.lines().partition(|line| line.starts_with('#'));
    let (head, rows) = rest.split_first().unwrap();
    let devices = ["analog", "analog", "icu", "icu", "i2c: address = 0x20;", "encoder"];
    let text = design(BOARD, &devices);
    let expected = best(&text);
    let mut rows = rows.to_vec();
    for turn in 0..4 {
        rows.rotate_left(7);
        rows.swap(turn, turn + 5);
        let (_scratch, path) =
            table(&format!("{}\n{head}\n{}\n", comments.join("\n"), rows.join("\n")));
        let found = pins(&solve(text.clone(), &["--board", &path]).exits(0));
        assert_eq!(found.into_values().collect::<Vec<_>>(), expected);
    }
}

#[test]
fn every_kind_has_its_wires() {
    let cases: &[(&str, &[&str])] = &[
        ("analog", &["in"]),
        ("i2c: address = 0x20;", &["scl", "sda"]),
        ("icu", &["in"]),
        ("icu: driver = hcsr04;", &["in", "trigger"]),
        ("encoder", &["a", "b"]),
        ("digital", &["in"]),
        ("digital: edge = rising;", &["in"]),
        ("uart", &["rx", "tx"]),
        ("uart: tx = none;", &["rx"]),
        ("spi", &["cs", "miso", "mosi", "sck"]),
        ("pwm: frequency = 20 kHz;", &["out"]),
        ("dac", &["out"]),
        ("can: frame = 0x120;", &["rx", "tx"]),
    ];
    for target in ["chibios", "none"] {
        for (device, roles) in cases {
            let text = design(FULL, &[device]).replacen('{', "{ release CS43L22;", 1);
            let ran = solve(text, &["--target", target]).exits(0);
            let found: Vec<String> =
                pins(&ran).keys().map(|name| name.rsplit('.').next().unwrap().to_owned()).collect();
            assert_eq!(&found, roles, "{device} for {target}");
        }
    }
    let all: Vec<&str> = cases.iter().map(|(device, _)| *device).collect();
    let together = design(FULL, &all).replacen('{', "{ release CS43L22;", 1);
    assert_eq!(solve(together, &[]).exits(0).json()["status"], "optimal");
}

#[test]
fn units_are_told_from_signals_by_their_rules() {
    // An encoder takes a whole timer, and captures take theirs.
    let one_timer = "# mcu = STM32F407VGT6\nPin,TIM\nPB4,TIM3_CH1\nPB5,TIM3_CH2\n";
    let (_scratch, path) = table(one_timer);
    let board = format!("B on \"{path}\"");
    assert_eq!(best(&design(&board, &["encoder"])), ["PB4", "PB5"]);
    let two = design(&board, &["icu", "icu"]);
    let _ = solve(two.clone(), &[]).exits(1);
    let _ = solve(two, &["--target", "none"]).exits(0);
    // Outputs on the same timer share its frequency.
    let pwm = |other: &str| {
        design(&board, &["pwm: frequency = 50 Hz;", &format!("pwm: frequency = {other};")])
    };
    let _ = solve(pwm("50 Hz"), &[]).exits(0);
    let _ = solve(pwm("60 Hz"), &[]).exits(1);
    let _ = solve(design(&board, &["pwm", "icu"]), &[]).exits(1);
    // Each interrupt line serves one pin number, on any port.
    let (_scratch, path) = table("# mcu = STM32F407VGT6\nPin,X\nPA1,-\nPB1,-\n");
    let board = format!("B on \"{path}\"");
    let edges = design(&board, &["digital: edge = rising;", "digital: edge = both;"]);
    let _ = solve(edges.clone(), &[]).exits(1);
    let _ = solve(edges, &["--target", "none"]).exits(0);
    let _ = solve(design(&board, &["digital: edge = rising;", "digital"]), &[]).exits(0);
}

#[test]
fn signals_are_what_they_are_named_whatever_their_column() {
    let rows = "# mcu = STM32F407VGT6\nPin,Whatever,Else\nPA1,ADC123-IN1 I²C1_SCL,x\nPA2,-,I2C1-SDA\n\
                PA3,,TIM3_CH1@2 ADC1_IN3 \n";
    let (_scratch, path) = table(rows);
    let board = format!("B on \"{path}\"");
    let ran = solve(design(&board, &["i2c: address = 0x20;", "analog"]), &[]).exits(0);
    assert_eq!(pins(&ran).into_values().collect::<Vec<_>>(), ["PA1", "PA2", "PA3"]);
    // Three usages on PA1 (including the unknown `x`), one on PA2, two on PA3.
    assert_eq!(ran.json()["cost"], 6);
}

#[test]
fn tables_of_one_row_and_of_many() {
    let (_scratch, path) = table("Pin,ADC\nPA1,ADC1_IN1\n");
    let board = format!("B on \"{path}\"");
    assert_eq!(best(&design(&board, &["analog"])), ["PA1"]);
    let _ = solve(design(&board, &["analog", "analog"]), &[]).exits(1);
    let mut rows = String::from("Pin,ADC,Other\n");
    for (at, port) in ('A'..='K').enumerate() {
        for number in 0..16 {
            rows.push_str(&format!("P{port}{number},ADC1_IN{number},OTHER{at}\n"));
        }
    }
    let (_scratch, path) = table(&rows);
    let board = format!("B on \"{path}\"");
    let ran = solve(design(&board, &["analog"; 16]), &[]).exits(0);
    assert_eq!(ran.json()["cost"], 32);
    let _ = solve(design(&board, &["analog"; 17]), &[]).exits(1);
}
