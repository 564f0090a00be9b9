//! Table 2 of the paper: which element of the language is used in which output.
//!
//! The test changes each element of Fig. 2 by itself, and records the changes of the outputs in the
//! rows and columns of the paper. Where the paper has a mark, ours must have one; where ours has
//! more, a comment at the row gives the reason.

use std::collections::BTreeMap;

use sensedsl_tests::{TempDir, one_in, read, sensedsl, text, tree};
use serde_json::Value;

const COLUMNS: [&str; 8] = [
    "pin assignment",
    "ADC",
    "I2C",
    "ICU",
    "storing",
    "serialization",
    "task scheduling",
    "deserialization",
];

/// A row: the element, its replacements in Fig. 2, the paper's marks and ours.
struct Row {
    element: &'static str,
    changes: &'static [(&'static str, &'static str)],
    paper: &'static str,
    ours: &'static str,
}

/// `#` is a mark; `+` is a mark that the paper does not have.
const ROWS: &[Row] = &[
    // The firmware's folder is named after the board, and so is the host application.
    Row {
        element: "board's name",
        changes: &[("board STM32F4DiscoveryBoard", "board Robot on STM32F4DiscoveryBoard")],
        paper: "........",
        ours: ".......+",
    },
    // Every table of the firmware identifies its values by this name.
    Row {
        element: "name",
        changes: &[("IRFront ", "IRLeft "), ("USRear", "USLeft"), ("WheelEncoder", "Wheel")],
        paper: "..####.#",
        ours: ".+####.#",
    },
    // Drivers measure in the width of the hardware; the type matters only when a value is stored.
    Row {
        element: "return type",
        changes: &[("IRFront returns uint16", "IRFront returns uint32"), ("uint8", "uint16")],
        paper: "...###.#",
        ours: "....##.#",
    },
    // The host tells values apart by the identifier; the paper's text says so, its table does not.
    Row {
        element: "identifier",
        changes: &[("id = 17", "id = 27"), ("id = 18", "id = 28")],
        paper: ".....#..",
        ours: ".....#++",
    },
    // The fields in memory keep the order of the file. Captures have no cycle, and the host uses
    // the cycle to know when a value is overdue.
    Row {
        element: "type",
        changes: &[
            ("type = analog; // infrared", "type = icu;"),
            ("type = icu;\n    }\n}", "type = i2c; address = 0x48; register = 0;\n    }\n}"),
        ],
        paper: "####..#.",
        ours: "####..#+",
    },
    Row { element: "address", changes: &[("0xE6", "0xE4")], paper: "..#.....", ours: "..#....." },
    // Analog sensors with the same cycle time share one conversion group; the host reports overdue
    // values.
    Row {
        element: "delay",
        changes: &[("delay = 60", "delay = 1000"), ("delay = 40", "delay = 45")],
        paper: "......#.",
        ours: ".++...#+",
    },
    Row {
        element: "prio",
        changes: &[("prio = +2", "prio = +3")],
        paper: "......#.",
        ours: "..+...#.",
    },
    // Only rules move the pins. Threads are named after their units.
    Row {
        element: "inferred pin",
        changes: &[("Board {\n", "Board {\n    reserve PB0, PB1, I2C3, TIM3;\n")],
        paper: ".###....",
        ours: "+###..+.",
    },
];

/// Marks of the paper that ours lacks, with the reason.
const NOT_OURS: &[(&str, &str)] = &[
    // The callbacks and configuration of a capture do not depend on the type; the value is
    // converted when it is stored.
    ("return type", "ICU"),
];

/// C code without comments and without the spaces that align it.
fn code(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("/*") {
        out.push_str(before);
        rest = comment.split_once("*/").map_or("", |(_, after)| after);
    }
    out.push_str(rest);
    let lines = out.lines().map(|line| line.split("//").next().unwrap_or(line).trim());
    lines.filter(|line| !line.is_empty()).collect::<Vec<_>>().join("\n")
}

/// The section of a C file that begins with `/* ---- title ---- */`.
fn section<'a>(text: &'a str, title: &str) -> &'a str {
    let head = format!("/* ---- {title} ---- */");
    let Some((_, after)) = text.split_once(&head) else { return "" };
    after.split_once("/* ----").map_or(after, |(section, _)| section)
}

/// The text of each output column for a design.
fn columns(design: &str) -> BTreeMap<&'static str, String> {
    let scratch = TempDir::new("trace");
    let file = scratch.write("robot.sense", design);
    let call = sensedsl(["generate", "-q"]).arg(&file).arg("-o").arg(scratch.join("out"));
    let _ = call.run().exits(0);
    let out = scratch.join("out");
    let answer: Value = serde_json::from_str(&read(&out.join("assignment.json"))).unwrap();
    let board = &answer["boards"][0];
    let pins: Vec<String> = board["devices"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|device| device["wires"].as_array().unwrap())
        .map(|wire| format!("{} {}", wire["pin"], wire["signal"]))
        .collect();
    let firmware = out.join("firmware").join(board["name"].as_str().unwrap());
    let hardware = read(&firmware.join("generated/sense_hw.c"));
    let pads = code(section(&hardware, "pads"));
    let pads = |mark: &str| -> String {
        let lines = pads.lines().filter(|line| line.contains(mark));
        lines.collect::<Vec<_>>().join("\n")
    };
    // A bus and the devices on it have sections of their own.
    let part = |titles: &[&str], mark: &str| {
        let all = hardware.split("/* ---- ").filter_map(|one| one.split_once(" ---- */"));
        let own = all.filter(|(title, _)| titles.iter().any(|wanted| title.contains(wanted)));
        let own: String = own.map(|(_, section)| code(section)).collect();
        assert!(!own.is_empty(), "no section {titles:?}");
        format!("{}\n{own}", pads(mark))
    };
    let host: String = tree(&out.join("host"))
        .into_iter()
        .filter(|(name, _)| !name.ends_with(".md"))
        .map(|(name, bytes)| format!("{name}\n{}\n", code(&String::from_utf8_lossy(&bytes))))
        .collect();
    let model = |name: &str| code(&read(&firmware.join("generated").join(name)));
    let all = [
        pins.join("\n"),
        part(&["analog sensors"], "ANALOG"),
        part(&["I2C", ": srf08", "USRear"], "OPENDRAIN"),
        part(&["input capture"], "ALTERNATE(2)"),
        model("sense_model.h"),
        model("sense_model.c"),
        code(section(&hardware, "threads")),
        host,
    ];
    COLUMNS.into_iter().zip(all).collect()
}

#[test]
fn elements_are_used_where_the_paper_says() {
    let fig2 = text("examples/fig2.sense");
    let before = columns(&fig2);
    let mut differ = Vec::new();
    for row in one_in(4, ROWS) {
        let mut changed = fig2.clone();
        for (from, to) in row.changes {
            assert!(changed.contains(from), "Fig. 2 has no {from}");
            changed = changed.replacen(from, to, 1);
        }
        let after = columns(&changed);
        let mut found = String::new();
        for (column, paper) in COLUMNS.into_iter().zip(row.paper.chars()) {
            let uses = before[column] != after[column];
            found.push(match (uses, paper) {
                (true, '#') => '#',
                (true, _) => '+',
                (false, _) => '.',
            });
            let excused = NOT_OURS.contains(&(row.element, column));
            assert!(uses || paper != '#' || excused, "{} does not reach {column}", row.element);
        }
        if found != row.ours {
            differ.push(format!("{}: {found} instead of {}", row.element, row.ours));
        }
    }
    assert!(differ.is_empty(), "{}", differ.join("\n"));
}
