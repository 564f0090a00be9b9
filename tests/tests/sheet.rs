//! The sheet alone says where every wire goes: for each driver of the library, each line names a contact at the part
//! and one at the board.

use sensedsl_model::facts;
use sensedsl_tests::{is_exhaustive, one_in, read, root, sensedsl};

/// Boards with connectors of all shapes.
const BOARDS: [&str; 3] = ["NUCLEO_F446RE", "STM32F407G_DISC1", "BLACKPILL_F411CE"];

/// The lines of the tables above that of all pins, as cells.
pub(crate) fn lines(sheet: &str) -> Vec<Vec<String>> {
    let (parts, _) = sheet.split_once("### Pins").expect("a table of all pins");
    let rows = parts.lines().filter(|line| line.starts_with("| ") && !line.contains("---"));
    let cells = |row: &str| {
        let inner = row.trim_matches('|').replace('\\', "");
        inner.split(" | ").map(|cell| cell.trim().to_owned()).collect::<Vec<_>>()
    };
    rows.map(cells).filter(|cells| cells[0] != "At the part").collect()
}

/// Whether a text names a contact: a connector, a dot, a number.
pub(crate) fn names_a_contact(text: &str) -> bool {
    text.split([' ', ',']).any(|word| {
        let contact = word.rsplit_once('.');
        contact.is_some_and(|(header, number)| !header.is_empty() && number.parse::<u32>().is_ok())
    })
}

#[test]
fn every_wire_of_every_driver_can_be_plugged() {
    let (mut checked, mut asked, mut wired) = (0, 0, 0);
    let step = if is_exhaustive() { 1 } else { 4 };
    let parts = facts::all().into_iter().enumerate().step_by(step);
    for (index, part) in one_in(12, parts) {
        let board = BOARDS[index % BOARDS.len()];
        let text = facts::example_on(&part, board);
        let ran = sensedsl(["solve", "-", "-q", "--format", "markdown"]).stdin(text).run();
        asked += 1;
        if ran.status != 0 {
            // A board may lack what the part needs; `driver_tables` tells where that is wrong.
            continue;
        }
        wired += 1;
        let lines = lines(&ran.stdout);
        assert!(lines.len() >= 2, "{}:\n{}", part.name, ran.stdout);
        for line in &lines {
            let (at_part, to) = (&line[0], &line[1]);
            let is_elsewhere =
                to.starts_with("transceiver ") || to.starts_with("a supply of its own");
            assert!(is_elsewhere || names_a_contact(to), "{}: {line:?}", part.name);
            assert!(!at_part.is_empty(), "{}: {line:?}", part.name);
        }
        checked += lines.len();
    }
    assert!(wired * 10 >= asked * 9, "{wired} of {asked} are wired");
    assert!(checked >= asked * 3, "{checked} wires of {asked} parts");
}

/// The netlist joins each contact at a part with the one of the board that the sheet names.
#[test]
fn the_netlist_says_what_the_sheet_says() {
    let text = read(&root().join("examples/line_follower.sense"));
    let solve = |form| {
        let ran = sensedsl(["solve", "-", "-q", "--format", form]).stdin(text.clone()).run();
        ran.exits(0).stdout
    };
    let nets: Vec<Vec<String>> = solve("kicad")
        .split("(net (code ")
        .skip(1)
        .map(|net| {
            let nodes = net.split("(pin \"").skip(1);
            nodes.map(|node| node.split_once("\")").unwrap().0.to_owned()).collect()
        })
        .collect();
    let lines = lines(&solve("markdown"));
    assert!(lines.len() > 20, "{lines:?}");
    for line in lines {
        let contact = line[1].split([' ', ',']).find(|word| names_a_contact(word)).unwrap();
        let is_joined =
            |net: &&Vec<String>| net.iter().any(|node| node == contact) && net.contains(&line[0]);
        assert_eq!(nets.iter().filter(is_joined).count(), 1, "{line:?} in {nets:#?}");
    }
}
