//! Board tables of a `.sense` file.

use sensedsl_tests::{TempDir, is_thorough};

use super::{expect, repeat};

/// `check` must refuse a design on this table with this code.
#[track_caller]
fn refused(table: &str, code: &str) {
    let folder = TempDir::new("limits");
    folder.write("t.csv", table);
    let board = "board B on \"t.csv\" { sensor A returns uint16 { id = 1; type = analog; } }\n";
    folder.write("t.sense", board);
    expect(&folder, &["check", "t.sense"], 1, code);
}

#[test]
fn many_rows_and_columns() {
    refused(&format!("Pin,ADC\n{}", "PA1,x\n".repeat(600_000)), "E0317");
    refused(&format!("Pin,ADC\n{}", "PA1,x\n".repeat(40_000)), "E0304");
    refused(&format!("Pin,ADC\n{}", repeat(300_000, |at| format!("A{at},x\n"))), "E0317");
    refused(&format!("Pin,ADC\n{}", ",".repeat(4_000_000)), "E0317");
    let columns = ",".repeat(150_000);
    refused(&format!("Pin,{columns}\n{}", "PA1\n".repeat(150_000)), "E0317");
}

#[test]
fn many_usages() {
    if !is_thorough() {
        return;
    }
    let usages = repeat(500_000, |at| format!("a{at} "));
    refused(&format!("Pin,ADC\nPA1,{usages}\n"), "E0317");
    let usages = repeat(900, |at| format!("a{at:x} "));
    refused(&format!("Pin,ADC\n{}", repeat(900, |at| format!("P{at}A,{usages}\n"))), "E0317");
}

#[test]
fn properties_and_quotes() {
    let properties = repeat(350_000, |at| format!("#a{at}=1\n"));
    refused(&format!("{properties}Pin,ADC\nPA1,x\n"), "E0317");
    refused(&format!("Pin,ADC\n{}", "\"x,".repeat(1_300_000)), "W0606");
}

#[test]
fn one_table_of_many_boards() {
    let folder = TempDir::new("limits");
    folder.write("t.csv", format!("Pin,ADC\n{}", repeat(2_000, |at| format!("A{at},x y z\n"))));
    folder.write("t.sense", repeat(253, |at| format!("board B{at} on \"t.csv\" {{}}\n")));
    expect(&folder, &["check", "t.sense"], 1, "E0225");
}
