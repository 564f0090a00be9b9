//! Sources of each kind in, tables and messages out: every cell that is dropped or doubtful has a
//! message with its place.

use sensedsl_board::catalog;
use sensedsl_import::{Imported, ReadError, Source, import};

fn with(name: &str, bytes: &[u8], sheet: Option<&str>, files: &[(&str, &str)]) -> Imported {
    let beside = |path: &str| {
        let found = files.iter().find(|(name, _)| *name == path);
        found.map(|(_, text)| text.as_bytes().to_vec()).ok_or(ReadError::Missing)
    };
    import(&Source { name, bytes, format: None, sheet, table: "pins.csv", beside: &beside })
}

fn imported(bytes: &[u8]) -> Imported {
    with("source", bytes, None, &[])
}

/// The `CODE message` lines of an import.
fn reported(imported: &Imported) -> Vec<String> {
    let line = |one: &sensedsl_diagnostics::Diagnostic| format!("{} {}", one.code, one.message);
    imported.diagnostics.iter().map(line).collect()
}

/// Whether a message has a code and contains all the words.
fn says(imported: &Imported, code: &str, words: &[&str]) -> bool {
    let holds = |line: &String| line.starts_with(code) && words.iter().all(|w| line.contains(w));
    reported(imported).iter().any(holds)
}

#[test]
fn workbooks_round_trip_table_1() {
    let expected = catalog::find("STM32F4DiscoveryBoard").unwrap().csv();
    for book in [&include_bytes!("data/table1.xlsx")[..], include_bytes!("data/table1.ods")] {
        let made = imported(book);
        assert_eq!(reported(&made), [""; 0]);
        assert_eq!(made.table.unwrap(), expected);
    }
}

#[test]
fn what_only_a_spreadsheet_has_is_reported_at_its_cell() {
    let xlsx = imported(include_bytes!("data/odd.xlsx"));
    let ods = imported(include_bytes!("data/odd.ods"));
    assert!(
        says(&xlsx, "W0805", &["Pins!C3:", "=CONCATENATE", "no value"]),
        "{:?}",
        reported(&xlsx)
    );
    assert!(
        says(&ods, "W0805", &["Pins!C3:", "=CONCATENATE", "`ADC1_IN1`"]),
        "{:?}",
        reported(&ods)
    );
    for made in [xlsx, ods] {
        for (code, words) in [
            ("W0804", ["Notes!B2:", "no pin table"]),
            ("W0804", ["Pins!A1:", "above the table"]),
            ("W0805", ["Pins!D4:", "merged up to D5"]),
            ("W0804", ["Pins!C5:", "date"]),
            ("W0804", ["Pins!A6:", "empty row"]),
            ("W0805", ["Pins!C7:", "number 11"]),
        ] {
            assert!(says(&made, code, &words), "{code} {words:?}: {:?}", reported(&made));
        }
        let table = made.table.unwrap();
        assert!(table.contains("\nPB6,92,-,I2C1_SCL\nPB7,93,-,-\n"), "{table}");
    }
}

#[test]
fn a_sheet_can_be_chosen() {
    let book = include_bytes!("data/odd.ods");
    let notes = with("book.ods", book, Some("Notes"), &[]);
    assert!(says(&notes, "E0802", &[]) && notes.table.is_none());
    let none = with("book.ods", book, Some("Chips"), &[]);
    assert!(says(&none, "E0803", &["Chips"]) && none.table.is_none());
    let text = with("a.csv", b"Pin,ADC\nPA1,ADC1_IN1\n", Some("Chips"), &[]);
    assert!(says(&text, "E0803", &[]));
}

#[test]
fn damaged_workbooks_are_refused() {
    for book in [&include_bytes!("data/table1.xlsx")[..], include_bytes!("data/table1.ods")] {
        for end in (4..book.len()).step_by(101) {
            let made = imported(book.get(..end).unwrap());
            assert!(made.failed() && made.table.is_none(), "{end}: {:?}", reported(&made));
        }
    }
}

#[test]
fn a_wide_table_keeps_its_columns_under_any_head() {
    let text = "my board;;\nPin name;ADC;Side\nPA1;ADC123-IN1;left\nX;;\nPB0;I2C1-SLC;\n";
    let made = imported(text.as_bytes());
    assert_eq!(made.table.as_deref(), Some("Pin,ADC,Side\nPA1,ADC123-IN1,left\nPB0,I2C1-SLC,\n"));
    assert!(says(&made, "W0804", &["A1:", "above the table"]), "{:?}", reported(&made));
    assert!(says(&made, "W0805", &["A2:", "`Pin name`"]), "{:?}", reported(&made));
    assert!(says(&made, "W0804", &["A4:", "`X`"]), "{:?}", reported(&made));
    assert!(says(&made, "W0805", &["B5:", "`I2C1-SLC`"]), "{:?}", reported(&made));
}

#[test]
fn a_long_table_is_gathered_by_pin() {
    let text = "# mcu = STM32F407VG\nGPIO,Signal,AF,Position,Speed\nPA2,USART2_TX,7,25,50\n\
                PA2,TIM2_CH3,AF1,,\nPA10,USART1_RX,17,69,\nPA2,ADC1_IN2,-,,\n?,TIM1_CH1,1,,\n";
    let made = imported(text.as_bytes());
    let expected = "# mcu = STM32F407VG\nPin,Position,ADC,TIM,UART\n\
                    PA2,25,ADC1_IN2,TIM2_CH3@1,USART2_TX@7\nPA10,69,-,-,USART1_RX\n";
    assert_eq!(made.table.as_deref(), Some(expected), "{:?}", reported(&made));
    assert!(says(&made, "W0804", &["C5:", "`17`"]), "{:?}", reported(&made));
    assert!(says(&made, "W0804", &["A7:", "`?`"]), "{:?}", reported(&made));
    assert!(says(&made, "W0804", &["E3:", "`Speed`"]), "{:?}", reported(&made));
}

#[test]
fn other_encodings_are_reported_at_their_cell() {
    let latin1 = imported(b"Pin;I\xb2C\nPB6;I2C1-SCL\n");
    assert_eq!(latin1.table.as_deref(), Some("Pin,I²C\nPB6,I2C1-SCL\n"));
    assert!(says(&latin1, "W0805", &["B1:", "byte 5 (0xB2)", "`²`"]), "{:?}", reported(&latin1));
    let utf16: Vec<u8> =
        "\u{feff}Pin,ADC\r\nPA1,ADC1_IN1\r\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let utf16 = imported(&utf16);
    assert_eq!(utf16.table.as_deref(), Some("Pin,ADC\nPA1,ADC1_IN1\n"));
    assert!(says(&utf16, "W0805", &["UTF-16LE"]), "{:?}", reported(&utf16));
}

#[test]
fn columns_of_alternate_functions_are_numbered() {
    let text = "Port,,AF0,AF1,AF7,AF15,\n,,SYS,TIM1/2,USART1/2,,ADC\n\
                PortA,PA2,,TIM2_CH3/TIM2_ETR,USART2_TX,EVENTOUT,ADC123_IN2\n";
    let made = imported(text.as_bytes());
    let expected = "Pin,ADC,TIM,UART\nPA2,ADC123_IN2,TIM2_CH3@1 TIM2_ETR@1,USART2_TX@7\n";
    assert_eq!(
        (made.table.as_deref(), reported(&made).len()),
        (Some(expected), 0),
        "{:?}",
        reported(&made)
    );
}

const HWDEF: &str = "\
# a board of our own\ninclude common.inc\nI2C_ORDER I2C2 I2C1\n\
PA2 BATT_SENS ADC1 SCALE(2)\nPC0 AIR_SENS ADC3\nPB6 I2C1_SCL I2C1\nPB7 I2C1_SDA I2C1\n\
PA5 SPI1_SCK SPI1\nPA6 SPI1_MISO SPI1\nPA7 SPI1_MOSI SPI1\nPC4 GYRO_CS CS\n\
SPIDEV gyro SPI1 DEVID1 GYRO_CS MODE3 1*MHZ 8*MHZ\nBARO XYZ I2C:1:0x77\n\
PA8 TIM1_CH1 TIM1 PWM(1) GPIO(50)\nPC7 TIM8_CH2 TIM8 RCININT PULLDOWN\nPD2 LED0 OUTPUT HIGH # blue\n\
PA11 OTG_FS_DM OTG1\nPC1 KNOB\nPE3 BUTTON INPUT\nundef PE3\n";

#[test]
fn a_hwdef_becomes_devices() {
    let files = [("common.inc", "MCU STM32F4xx STM32F405xx\nPA13 JTMS-SWDIO SWD\n")];
    let made = with("boards/demo/hwdef.dat", HWDEF.as_bytes(), None, &files);
    let program = made.program.as_deref().unwrap_or_default();
    for line in [
        "board demo on \"pins.csv\" {",
        "sensor BATT_SENS returns uint16 {",
        "address = 0x77;",
        "sensor gyro returns uint8 {",
        "cs = PC4; // gyro",
        "actuator PwmPA8 accepts uint16 {",
        "sensor CapturePC7 returns uint32 {",
        "initial = true;",
    ] {
        assert!(program.contains(line), "{line}\n{program}");
    }
    assert!(!program.contains("PE3") && !program.contains("PA11"), "{program}");
    assert!(says(&made, "W0804", &["PC1"]), "{:?}", reported(&made));
    let table = made.table.unwrap();
    assert!(table.contains("# mcu = STM32F405RG\n"), "{table}");
    assert!(table.contains("PA11,,OTG_FS_DM,"), "{table}");
    let alone = with("hwdef.dat", HWDEF.as_bytes(), None, &[]);
    assert!(says(&alone, "W0804", &["common.inc"]) && says(&alone, "E0801", &["`MCU`"]));
    assert!(alone.program.is_none());
    let round = [("common.inc", "include common.inc\nMCU STM32F4xx STM32F405xx\n")];
    assert!(says(
        &with("hwdef.dat", HWDEF.as_bytes(), None, &round),
        "E0808",
        &["include each other already"]
    ));
}

/// If firmware looks for several chips at one address, only one is wired; a chip select needs a
/// bus.
#[test]
fn what_a_hwdef_leaves_open_is_reported() {
    let hwdef = "MCU STM32H7xx STM32H743xx\ninclude ../no/pins.inc\nI2C_ORDER I2C1\n\
                 PB6 I2C1_SCL I2C1\nPB7 I2C1_SDA I2C1\nBARO DPS310 I2C:0:0x76\n\
                 BARO BMP280 I2C:0:0x76\nPC0 FLASH_CS CS\nPC2 OSD_CS CS\nPC1 SENSE ADC1\n\
                 SPIDEV flash SPI3 DEVID1 FLASH_CS MODE3 1*MHZ 8*MHZ\n";
    let made = imported(hwdef.as_bytes());
    for words in [
        &["`../no/pins.inc`"][..],
        &["BMP280 at 0x76 of I2C1", "DPS310"],
        &["flash at PC0", "SPI3"],
        &["OSD_CS at PC2"],
    ] {
        assert!(says(&made, "W0804", words), "{words:?}: {:?}", reported(&made));
    }
    let program = made.program.unwrap();
    assert!(program.contains("sensor DPS310 ") && !program.contains("BMP280"), "{program}");
}

#[test]
fn broken_descriptions_of_mcus_are_refused() {
    for (text, words) in [
        ("<Mcu RefName=\"X\"", ""),
        ("<Mcu/>", "RefName"),
        ("<Mcu RefName=\"X\"/>", "GPIO"),
        ("<Mcu RefName=\"X\"><IP Name=\"GPIO\" Version=\"v\"/></Mcu>", "IP/GPIO-v_Modes.xml"),
        ("<!DOCTYPE a [<!ENTITY b \"c\">]><Mcu RefName=\"X\"/>", ""),
    ] {
        let made = imported(text.as_bytes());
        assert!(
            says(&made, "E0801", &[words]) && made.table.is_none(),
            "{text}: {:?}",
            reported(&made)
        );
    }
}

proptest::proptest! {
    /// No input makes an importer panic, and the output can be read again.
    #[test]
    fn any_bytes_can_be_imported(
        start in "(Pin,Signal,AF\n|Port,,AF0,AF1,AF2\n|LED,PA0\n|resource MOTOR 1 A08\n|/ \\{\n|\
                  #define FC_TARGET_MCU STM32F405\n|#define LED_BUILTIN PA5\n|PinMap_ STM_PIN_DATA\n|Mcu.Name=STM32F407VG\n|MCU STM32F4xx\n|<Mcu RefName=\"X\">|\u{0}\u{0}|)",
        rest in "([PA-C0-9_.=,;@ \n\"/:#<>]|Signal|ADC1_IN|TIM2_CH|I2C1_S|INPUT|é|\\{|\\}|&usart1_tx_pa9|resource SERIAL_TX 1 A09\n|\
                 #define |MOTOR1_PIN PA8\n|pinctrl-0 = <|gpios = <&gpioa 5 0>;){0,60}",
        cut in proptest::collection::vec(proptest::num::u8::ANY, 0..6),
    ) {
        let bytes = [start.as_bytes(), rest.as_bytes(), &cut].concat();
        let made = imported(&bytes);
        proptest::prop_assert_eq!(made.failed(), made.table.is_none());
        if let Some(table) = made.table {
            let again = sensedsl_board::table::load(&table).board.to_csv();
            proptest::prop_assert_eq!(again, table);
        }
    }
}

#[test]
fn an_empty_description_of_an_mcu_is_refused_with_a_reason() {
    let source = Source {
        name: "empty.xml",
        bytes: b"",
        format: Some(sensedsl_import::Format::CubeMx),
        sheet: None,
        table: "pins.csv",
        beside: &|_| Err(ReadError::Missing),
    };
    let made = import(&source);
    assert!(made.failed() && says(&made, "E0801", &["empty.xml"]), "{:?}", reported(&made));
}

#[test]
fn a_table_of_which_no_pin_is_left_is_refused() {
    for text in ["Pin,_\n", "Pin,ADC\n???,ADC1_IN1\n", "Pin,ADC\nVDD,\n"] {
        let made = imported(text.as_bytes());
        assert!(made.failed() && says(&made, "E0802", &[]), "{text:?}: {:?}", reported(&made));
    }
}
