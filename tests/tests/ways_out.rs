//! The line that a message proposes solves the problem, for mistakes that people make.

use sensedsl_tests::sensedsl;

fn said(text: &str) -> String {
    let ran = sensedsl(["check", "-"]).stdin(text).run();
    assert_eq!(ran.status, 1, "{text}\n{}", ran.stderr);
    ran.stderr
}

fn on_nucleo(line: &str) -> String {
    said(&format!("board R on NUCLEO_F446RE {{\n    {line}\n}}\n"))
}

#[test]
fn a_board_without_on_is_told_to_say_it() {
    let said = said("board R {\n    sensor A returns uint16 { type = analog; }\n}\n");
    assert!(said.contains("write `board R on BOARD {`"), "{said}");
}

#[test]
fn an_mcu_that_is_not_supported_can_be_a_table() {
    let said =
        said("board R on ESP32_DevKit {\n    sensor A returns uint16 { type = analog; }\n}\n");
    assert!(said.contains("for another MCU name a table of its pins"), "{said}");
}

#[test]
fn a_kind_with_several_wires_names_each() {
    let said = on_nucleo("sensor G returns uint8 { type = uart; pin = PA3; }");
    assert!(said.contains("write `tx = …;` or `rx = …;`"), "{said}");
    // For a kind whose wires have no names of their own, the message still advises removing the
    // line.
    let said = on_nucleo("sensor A returns uint16 { type = analog; address = 0x40; }");
    assert!(said.contains("remove the line"), "{said}");
}

#[test]
fn an_address_is_proposed_that_the_part_has() {
    let said = on_nucleo("sensor M returns uint16 { driver = as5600; }");
    assert!(said.contains("add a line such as `address = 0x36;`"), "{said}");
}

#[test]
fn a_part_may_have_an_address_that_others_may_not() {
    let file = |driver: &str| {
        format!(
            "board R on NUCLEO_F446RE {{\n    sensor M returns uint16 {{ {driver} address = 0x06; }}\n}}\n"
        )
    };
    let ran = sensedsl(["check", "-"]).stdin(file("driver = mt6701;")).run();
    assert_eq!(ran.status, 0, "{}", ran.stderr);
    let said = said(&file("type = i2c; length = 2;"));
    assert!(said.contains("error[E0215]"), "{said}");
}

#[test]
fn more_edges_than_interrupt_lines_are_counted() {
    let said = on_nucleo("sensor A returns bool[20] { type = digital; edge = both; }");
    assert!(said.contains("`A` needs 20, and the board has only 16 interrupt lines"), "{said}");
}

#[test]
fn an_array_longer_than_a_timer_reads_well() {
    let said = on_nucleo(
        "actuator A accepts uint16[6] { type = pwm; frequency = 50 Hz; together = unit; }",
    );
    assert!(
        said.contains("`A` needs 6, and no unit has more than 4 `out` pins of a pwm device (TIM1"),
        "{said}"
    );
}

#[test]
fn an_unknown_part_can_be_searched_for() {
    let said = on_nucleo("sensor T returns float32 { driver = dht22; }");
    assert!(said.contains("`sensedsl drivers --search WORD`"), "{said}");
}

/// A label that the board does not have must not lead to the proposal of a pin without a converter.
#[test]
fn a_pin_that_is_proposed_can_be_the_wire() {
    let said = on_nucleo("sensor A returns uint16 { type = analog; pin = A9; }");
    assert!(said.contains("R has no pin A9") && !said.contains("PA9"), "{said}");
    assert!(said.contains("did you mean `A0`?"), "{said}");
    let said = on_nucleo("actuator A accepts bool { type = digital; pin = PA99; }");
    assert!(said.contains("did you mean `PA9`?"), "{said}");
    let said = on_nucleo("sensor A returns uint16[3] { type = i2c; address = 0x40; scl = PB16; }");
    assert!(said.contains("did you mean `PB6`?"), "{said}");
}
