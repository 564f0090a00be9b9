//! Signature help: what the property takes that is being written.

use serde_json::{Value, json};

use crate::session::Session;

fn help(marked: &str) -> Value {
    let (mut session, places) = Session::of(marked);
    session.at("textDocument/signatureHelp", &places[0])
}

fn label(marked: &str) -> String {
    let help = help(marked);
    let signature = &help["signatures"][0];
    let part = signature["parameters"][0]["label"].as_str().unwrap();
    assert!(signature["label"].as_str().unwrap().contains(part), "{help}");
    signature["label"].as_str().unwrap().to_owned()
}

#[test]
fn a_value_is_told_what_it_may_be() {
    let device = |line: &str| format!("/* µ😀 */ sensor X returns uint16 {{ type = uart; {line}");
    assert_eq!(label(&device("baud = $0")), "baud = a whole number from 300 to 10000000");
    assert_eq!(label(&device("baud = 96$000; }")), "baud = a whole number from 300 to 10000000");
    assert_eq!(
        label(&device("start = [0x24, $0")),
        "start = 0 to 16 bytes, as a list of numbers or as a text"
    );
    assert_eq!(label(&device("delay = 10 $0; }")), "delay = a time from 1 ms to 1 h");
    let shown = help(&device("checksum = $0"));
    let text = shown["signatures"][0]["documentation"]["value"].as_str().unwrap();
    assert!(text.contains("`nmea`") && text.contains("Default: `none`"), "{text}");
}

#[test]
fn drivers_and_links_are_told_too() {
    assert_eq!(
        label("driver d for i2c { identity = [$0"),
        "identity = a register and the bytes that must be read there, such as [0x75, 0x68]"
    );
    assert_eq!(
        label("driver d for can { reading r returns bool { bit = $0"),
        "bit = a whole number from 0 to 63"
    );
    assert_eq!(label("board B { link { silence = $0 } }"), "silence = a time from 10 ms to 1 h");
    assert_eq!(label("board B { prefer side = $0 }"), "side = a side of the board");
    assert_eq!(label("chip M { driver = gearmotor_tb6612; in1 = $0 }"), "in1 = a pin");
}

#[test]
fn outside_of_values_there_is_no_help() {
    for marked in
        ["$0", "sensor X returns $0", "sensor X { baud = 3; $0 }", "// baud = $0", "const A = $0"]
    {
        assert_eq!(help(marked), json!(null), "{marked}");
    }
}

#[test]
fn the_name_of_a_property_is_explained_where_one_points_at_it() {
    let said = |marked: &str| {
        let (mut session, places) = Session::of(marked);
        let hover = session.at("textDocument/hover", &places[0]);
        hover["contents"]["value"].as_str().unwrap_or_default().to_owned()
    };
    let text = said("sensor X returns uint16 { type = icu; re$0solution = 1 us; }");
    assert!(text.starts_with("The tick of the timer."), "{text}");
    assert!(text.contains("resolution = 1 us;") && text.contains("10 kHz to count"), "{text}");
    let text = said("board B { avoid si$0de = left; }");
    assert!(text.starts_with("Every wire of the device"), "{text}");
    assert_eq!(said("sensor X returns uint16 { type = icu; re$0solutions = 1 us; }"), "");
}
