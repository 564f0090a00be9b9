//! Texts that `import` reads: tables, projects of other tools, XML.

use sensedsl_tests::{TempDir, is_thorough};

use super::{expect, refuses, repeat};

const MCU: &str = "MCU STM32F4xx STM32F405xx\n";

#[test]
fn hwdef_includes_end_and_stay_inside() {
    let folder = TempDir::new("limits");
    let own = format!("{MCU}{}PA0 UART4_TX UART4\n", "include hwdef.dat\n".repeat(6));
    folder.write("a/b/hwdef.dat", own);
    expect(&folder, &["import", "a/b/hwdef.dat"], 1, "E0808");
    let out =
        format!("{MCU}include ../../../etc/passwd\ninclude /etc/passwd\nPA0 UART4_TX UART4\n");
    folder.write("a/c/hwdef.dat", out);
    expect(&folder, &["import", "a/c/hwdef.dat"], 1, "E0809");
    folder.write("a/other/common.inc", "PA1 UART4_RX UART4\n");
    let beside = format!("{MCU}include ../other/common.inc\nPA0 UART4_TX UART4\n");
    folder.write("a/d/hwdef.dat", beside);
    expect(&folder, &["import", "a/d/hwdef.dat"], 0, "");
}

#[test]
fn hwdef_lines() {
    refuses("hwdef.dat", format!("{MCU}{}", "PA0 X ADC1\n".repeat(350_000)), "E0807");
    let lines = repeat(150_000, |at| format!("L{at} 1\nundef L{at}\n"));
    refuses("hwdef.dat", format!("{MCU}PA0 UART4_TX UART4\n{lines}"), "E0807");
}

#[test]
fn hwdef_mcus() {
    if !is_thorough() {
        return;
    }
    // Each name is the prefix of hundreds of parts, which are searched for the pin's input.
    let lines = ["", "F", "L", "H", "G", "U"];
    let mcu = |at: usize| format!("MCU STM32 STM32{}XX\nPA0 X ADC1\n", lines[at]);
    refuses("hwdef.dat", repeat(6, mcu), "E0807");
    let folder = TempDir::new("limits");
    folder.write("four.hwdef.dat", format!("{}PA1 UART4_RX UART4\n", repeat(4, mcu)));
    expect(&folder, &["import", "four.hwdef.dat"], 0, "");
}

#[test]
fn ioc_keys() {
    let keys = repeat(160_000, |at| format!("P{at}.Signal=GPIO_Input\nX{at}.Signal=A\n"));
    refuses("a.ioc", format!("Mcu.Name=STM32F407VGTx\n{keys}"), "E0807");
}

#[test]
fn dbc_parts() {
    if !is_thorough() {
        return;
    }
    let head = "BU_: A\nBO_ 1 M: 8 A\n";
    let signal = |at: usize| format!(" SG_ s{at} : 0|8@1+ (1,0) [0|0] \"\" A\n");
    refuses("signals.dbc", format!("{head}{}", repeat(110_000, signal)), "E0807");
    let one = signal(0).trim_end().to_owned();
    refuses("receivers.dbc", format!("{head}{one}{}\n", ",A".repeat(2_000_000)), "E0807");
    refuses("nodes.dbc", format!("BU_:{}\nBO_ 1 M: 8 A\n", " A".repeat(2_000_000)), "E0807");
    let words = repeat(350_000, |at| format!(" {at} \"w\""));
    refuses("words.dbc", format!("{head}{one}\nVAL_ 1 s0{words} ;\n"), "E0807");
    let message = |at: usize| format!("BO_ {} M: 8 A\n", at + (1 << 31));
    refuses("messages.dbc", format!("BU_: A\n{}", repeat(180_000, message)), "E0801");
}

/// Lines that name signals look them up instead of searching for them.
#[test]
fn dbc_lines_that_name_signals() {
    let signal = |at: usize| format!(" SG_ s{at} : 0|8@1+ (1,0) [0|0] \"\" A\n");
    let text = format!(
        "BU_: A\nBO_ 1 M: 8 A\n{}{}",
        repeat(40_000, signal),
        "VAL_ 1 s39999 1 \"a\";\n".repeat(100_000)
    );
    let folder = TempDir::new("limits");
    folder.write("found.dbc", text);
    expect(&folder, &["import", "found.dbc"], 0, "W0804");
}

#[test]
fn dbc_lines_that_are_wrong() {
    if !is_thorough() {
        return;
    }
    refuses("wrong.dbc", format!("BU_: A\n{}", "BO_ x\n".repeat(690_000)), "E0810");
    refuses("large.dbc", format!("BU_: A\n{}", "CM_ \"x\";\n".repeat(500_000)), "E0807");
}

#[test]
fn xml() {
    let attributes = repeat(300_000, |at| format!(" a{at}=\"\""));
    refuses("a.xml", format!("<Mcu RefName=\"X\"{attributes}/>"), "E0807");
    refuses("n.xml", format!("<Mcu RefName=\"X\">{}", "<a>".repeat(800_000)), "E0807");
    refuses("e.xml", format!("<Mcu RefName=\"X\">{}</Mcu>", "<a/>".repeat(1_000_000)), "E0807");
    let entity = "<!DOCTYPE Mcu [<!ENTITY a \"aa\">]><Mcu RefName=\"&a;\"/>";
    refuses("d.xml", entity, "E0801");
}

#[test]
fn tables_in_other_encodings() {
    if !is_thorough() {
        return;
    }
    let text = format!("Pin,ADC\n{}", "PA1,x\n".repeat(300_000));
    let wide: Vec<u8> =
        "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    refuses("wide.csv", wide, "E0317");
    refuses("latin.csv", [&b"Pin,ADC\n"[..], &b"PA1,\xe4\n".repeat(600_000)].concat(), "E0317");
    // The text is all guesses, one for each byte.
    refuses("guesses.csv", [&b"Pin,ADC\nPA1,"[..], &b"\xe4 ".repeat(1_000_000)].concat(), "E0117");
}

#[test]
fn long_tables() {
    if !is_thorough() {
        return;
    }
    let pin =
        |at: usize| format!("P{}{}", char::from(b'A' + u8::try_from(at % 20).unwrap()), at % 16);
    let row = |at: usize| format!("{},S{at}\n", pin(at));
    refuses("long.csv", format!("Pin,Signal\n{}", repeat(190_000, row)), "E0317");
    let folder = TempDir::new("limits");
    folder.write("fewer.csv", format!("Pin,Signal\n{}", repeat(49_000, row)));
    expect(&folder, &["import", "fewer.csv"], 0, "");
    let names = repeat(500_000, |at| format!("s{at} "));
    refuses("cell.csv", format!("Pin,Signal\nPA1,{names}\nPA1,x\n"), "E0317");
}
