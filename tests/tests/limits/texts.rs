//! Texts of the language that are nothing but more and more of one thing.

use sensedsl_tests::Scratch;

use super::{BOARD, expect, refuses, repeat};

const MI: usize = 4_000_000;

fn devices(n: usize) -> String {
    let device =
        |at| format!("sensor D{at} returns uint16 {{ id = {}; type = analog; }}\n", at % 254 + 1);
    format!("{BOARD}{}}}\n", repeat(n, device))
}

#[test]
fn signs_and_spaces() {
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
    let folder = Scratch::new("limits");
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
