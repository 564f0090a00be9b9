//! Texts of the language that repeat one construct without end.

use sensedsl_tests::{TempDir, is_thorough};

use super::{BOARD, expect, refuses, repeat};

const MI: usize = 4_000_000;

fn devices(n: usize) -> String {
    let device =
        |at| format!("sensor D{at} returns uint16 {{ id = {}; type = analog; }}\n", at % 254 + 1);
    format!("{BOARD}{}}}\n", repeat(n, device))
}

#[test]
fn signs_and_spaces() {
    if !is_thorough() {
        return;
    }
    refuses("newlines.sense", "\n".repeat(MI), "E0315");
    refuses("open.sense", "{".repeat(MI), "E0116");
    refuses("close.sense", "}".repeat(MI), "E0101");
    refuses("brackets.sense", format!("board B {{ x = {}", "[".repeat(MI)), "E0116");
    refuses("semicolons.sense", ";".repeat(MI), "E0101");
    refuses("unknown.sense", "@ a ".repeat(MI / 4), "E0102");
}

#[test]
fn strings_and_comments() {
    refuses("strings.sense", "\"x\n".repeat(MI / 3), "E0103");
    refuses("comment.sense", format!("/*{}*/", "x".repeat(MI)), "E0315");
    refuses("comments.sense", "//\n".repeat(MI / 3), "E0116");
}

#[test]
fn long_words() {
    refuses("name.sense", format!("board {} {{ }}", "A".repeat(MI / 4)), "E0221");
    refuses("number.sense", format!("board B {{ x = {}; }}", "9".repeat(MI / 4)), "E0106");
}

#[test]
fn the_list_of_mistakes_ends() {
    let folder = TempDir::new("limits");
    folder.write("unknown.sense", "@ a ".repeat(MI / 4));
    expect(&folder, &["check", "--format", "json", "unknown.sense"], 1, "E0117");
}

#[test]
fn many_devices_and_boards() {
    refuses("devices.sense", devices(60_000), "E0225");
    refuses("fewer.sense", devices(1_900), "E0203");
    let board = |at| format!("board B{at} on STM32F4DiscoveryBoard {{}}\n");
    refuses("boards.sense", repeat(300, board), "E0225");
    refuses("nested.sense", "board A { ".repeat(300_000), "E0105");
}

#[test]
fn many_properties_and_rules() {
    let properties = |n| {
        let list = repeat(n, |at| format!("p{at} = 1;\n"));
        format!("{BOARD}sensor A returns uint16 {{ id = 1; type = analog;\n{list}}}}}\n")
    };
    refuses("properties.sense", properties(100_000), "E0225");
    refuses("fewer.sense", properties(7_000), "E0201");
    let pins = repeat(100_000, |at| format!(", PA{at}"));
    refuses("reserve.sense", format!("{BOARD}reserve PA0{pins}; }}\n"), "E0225");
}

#[test]
fn constants_that_grow() {
    let chain = repeat(7_000, |at| format!("const C{at} = C{} + 1;\n", at + 1));
    refuses("chain.sense", format!("{chain}const C7000 = 1;\n"), "E0315");
    // Each list holds the one before it ten times.
    let tens = repeat(12, |at| {
        format!("const L{} = [{}];\n", at + 1, vec![format!("L{at}"); 10].join(", "))
    });
    refuses("lists.sense", format!("const L0 = [1];\n{tens}"), "E0227");
    let label = |at| format!("sensor D{at} returns uint16 {{ type = analog; label = LONG; }}\n");
    let long = format!("const LONG = \"{}\";\n{BOARD}", "x".repeat(MI / 4));
    refuses("label.sense", format!("{long}{}}}\n", repeat(1_900, label)), "E0211");
    let driver = format!("driver d for analog {{ label = \"{}\"; }}\n{BOARD}", "x".repeat(MI / 4));
    let device = |at| format!("sensor D{at} returns uint16 {{ type = analog; driver = d; }}\n");
    refuses("driver.sense", format!("{driver}{}}}\n", repeat(1_900, device)), "E0211");
}

#[test]
fn chips_and_arrays_that_multiply() {
    let readings =
        repeat(900, |at| format!("reading r{at} returns uint8 {{ register = {}; }}\n", at % 256));
    let chips = repeat(900, |at| format!("chip C{at} {{ driver = d; address = 0x40; }}\n"));
    let driver = format!("driver d for i2c {{\n{readings}}}\n{BOARD}");
    refuses("readings.sense", format!("{driver}{chips}}}\n"), "E0229");
    let chips = repeat(1_900, |at| format!("chip C{at} {{ driver = pca9685; address = 0x40; }}\n"));
    refuses("chips.sense", format!("{BOARD}{chips}}}\n"), "E0225");
    let array = |at| format!("sensor A{at} returns uint16[128] {{ type = digital; }}\n");
    refuses("arrays.sense", format!("{BOARD}{}}}\n", repeat(1_900, array)), "E0225");
    let wishes = repeat(7_000, |at| format!("prefer unit = ADC{};\n", at % 3 + 1));
    let one = format!("sensor A returns uint16[128] {{ type = digital;\n{wishes}}}\n");
    refuses("wishes.sense", format!("{BOARD}{one}}}\n"), "E0225");
}
