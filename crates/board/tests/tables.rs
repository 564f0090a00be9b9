//! Board tables from text: what is understood, what is reported, and that nothing else can happen.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing, reason = "a test may panic")]

use proptest::prelude::*;
use sensedsl_board::finding::FindingKind;
use sensedsl_board::pin::PinName;
use sensedsl_board::signal::Signal;
use sensedsl_board::table::{self, Occupation, Table, load};

const TABLE_1: &str = include_str!("../boards/STM32F4DiscoveryBoard/pins.csv");

/// Every finding as `ROW:COLUMN TEXT KIND`.
fn findings(text: &str) -> Vec<String> {
    load(text)
        .findings
        .iter()
        .map(|finding| {
            let column = finding.column.as_deref().unwrap_or("-");
            let place = &text[finding.range.clone()];
            format!("{}:{column} `{place}` {:?}", finding.row, finding.kind)
        })
        .collect()
}

/// Asserts the findings, by the start of each line.
fn check(text: &str, expected: &[&str]) -> Table {
    let found = findings(text);
    let agree = found.len() == expected.len()
        && found.iter().zip(expected).all(|(found, expected)| found.starts_with(expected));
    assert!(agree, "in {text:?}\nfound    {found:#?}\nexpected {expected:#?}");
    load(text).board
}

fn pin<'a>(table: &'a Table, name: &str) -> &'a table::Pin {
    table.pin(&PinName::parse(name).unwrap()).unwrap()
}

/// A table as `PA1=TIM2_CH2+TIM5_CH2 …`.
fn summary(table: &Table) -> String {
    let row = |pin: &table::Pin| {
        let usages: Vec<&str> = pin.usages.iter().map(|usage| usage.signal.name()).collect();
        format!("{}={}", pin.name, usages.join("+"))
    };
    table.pins.iter().map(row).collect::<Vec<_>>().join(" ")
}

#[test]
fn table_1_of_the_paper() {
    let table = check(TABLE_1, &[]);
    assert_eq!(table.pins.len(), 26);
    assert_eq!(table.pins.iter().map(table::Pin::cost).sum::<u32>(), 33);
    assert_eq!(pin(&table, "PA1").cost(), 3);
    assert_eq!(pin(&table, "PB0").cost(), 1);
    let expensive = |pin: &&table::Pin| pin.cost() > 1;
    let names: Vec<&str> = table.pins.iter().filter(expensive).map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["PA1", "PA2", "PA3", "PB7", "PB8", "PC6"]);
    let usage = &pin(&table, "PB0").usages[0];
    assert_eq!((usage.spelled.as_str(), usage.signal.name()), ("ADC12-IN8", "ADC12_IN8"));
    assert_eq!(&TABLE_1[usage.range.clone()], "ADC12-IN8");
    assert_eq!(table.to_csv(), TABLE_1);
    assert_eq!(table.mcu, None);
}

#[test]
fn pins_are_in_natural_order_and_places_are_kept() {
    let table = check("pin;Use\r\nPB0;a\r\nPA10;b c\r\nPA2;-\r\n", &[]);
    assert_eq!(summary(&table), "PA2= PA10=B+C PB0=A");
    assert_eq!(pin(&table, "PA10").row, 3);
    assert_eq!(pin(&table, "PA10").range, 16..20);
}

#[test]
fn described_pins() {
    let text = "# mcu = STM32F407VGT6\n# revision = C\n# free text\n\
        Position,Pin,SIDE,Header,Label,Voltage,Onboard,Note,I2C,AF\n\
        92,PB6,left,P2,D10,5V,CS43L22:bus,\"audio, too\",I2C1_SCL,4\n\
        23,PA0,left,P1,,,LED:care,,-,\n\
        7,PC13,right,P1,,,Button,,,-\n";
    let table = check(text, &[]);
    assert_eq!(table.mcu.as_deref(), Some("STM32F407VGT6"));
    assert_eq!(table.property("Revision"), Some("C"));
    let pb6 = pin(&table, "PB6");
    assert_eq!(
        (pb6.sides(), pb6.headers(), pb6.position_at("p2")),
        (vec!["left"], vec!["P2"], Some("92"))
    );
    assert_eq!(pb6.label.as_deref(), Some("D10"));
    assert_eq!(pb6.voltage.as_deref(), Some("5V"));
    assert_eq!(pb6.note.as_deref(), Some("audio, too"));
    assert_eq!(pb6.usages[0].alternate, Some(4));
    assert_eq!(pb6.cost(), 1);
    let onboard = |name| {
        let onboard = pin(&table, name).onboard.clone().unwrap();
        (onboard.part, onboard.how)
    };
    assert_eq!(onboard("PB6"), ("CS43L22".to_owned(), Occupation::Bus));
    assert_eq!(onboard("PA0"), ("LED".to_owned(), Occupation::Care));
    assert_eq!(onboard("PC13"), ("Button".to_owned(), Occupation::Taken));
    assert_eq!(pin(&table, "PA0").label, None);
}

#[test]
fn pins_with_several_places() {
    let text = "# form = nucleo64\nPin,Label,Places\nPA0,A0,CN7.28 CN8.1\nPB1,,CN10.24? CN5.6=D13\nPB2,,\n\
        ,GND,CN7.8 CN7.19\n,NRST,CN6.3=RESET\n";
    let table = check(text, &[]);
    let pa0 = pin(&table, "PA0");
    assert_eq!(
        (pa0.headers(), pa0.sides(), pa0.labels()),
        (vec!["CN7", "CN8"], vec!["left"], vec!["A0"])
    );
    let pb1 = pin(&table, "PB1");
    assert_eq!((pb1.sides(), pb1.labels()), (vec!["right"], vec!["D13"]));
    assert!(pb1.places[0].is_inferred && !pb1.places[1].is_inferred);
    assert_eq!(pin(&table, "PB2").places, []);
    let contacts: Vec<String> = table
        .contacts
        .iter()
        .map(|one| format!("{} {}", one.signal, one.place.contact().unwrap()))
        .collect();
    assert_eq!(contacts, ["GND CN7.8", "GND CN7.19", "NRST CN6.3"]);
    assert_eq!(table.to_csv(), text);
}

#[test]
fn wrong_places_are_reported() {
    let text = "# form = nucleo65\nPin,Label,Places\nPA0,,CN7.1 x\nPA1,,CN7.1 CN7.4\n,GND,CN7.2 CN7.4\n,,CN7.3\n,GND,CN7.2 cn7.1\n";
    check(
        text,
        &[
            "1:- `nucleo65` UnknownForm { spelled: \"nucleo65\", nearest: Some(\"nucleo64\")",
            "3:Places `x` BadPlace",
            "5:Places `CN7.4` ContactTwice { contact: \"CN7.4\", first: \"PA1\"",
            "6:Pin `,,CN7.3` MissingPin",
            "7:Places `cn7.1` ContactTwice",
        ],
    );
    let text = "# form = nucleo32\nPin,Places\nPA0,CN3.16 CN3.15\nPA1,J1.99\n";
    check(text, &["3:Places `CN3.16` NoContact { contact: \"CN3.16\", form: \"nucleo32\""]);
}

#[test]
fn buttons_and_leds_have_places() {
    let names = |table: &Table| -> Vec<String> {
        table.landmarks().iter().map(|one| format!("{} {:?}", one.name, one.at_mm)).collect()
    };
    let text =
        "# form = bluepill\n# buttons = RESET 3 4.5\n# leds = RGB LED 5 6; LED 1 2\nPin\nPA0\n";
    let table = check(text, &[]);
    // Those of the form come last, but not the one that the table has itself.
    let expected = ["RESET [3.0, 4.5]", "RGB LED [5.0, 6.0]", "LED [1.0, 2.0]", "PWR [14.8, 45.4]"];
    assert_eq!(names(&table), expected);
    assert_eq!(table.to_csv(), text);
    // A table of no form has no place to show them, and a line with a mistake is not read.
    assert_eq!(names(&check("# leds = LED 1 2\nPin\nPA0\n", &[])), [""; 0]);
    let wrong = "# form = nucleo32\n# leds = LED 1 2; LD9 x 3\nPin\nPA0\n";
    let table =
        check(wrong, &["2:- `LED 1 2; LD9 x 3` BadLandmark { kind: Led, spelled: \"LD9 x 3\""]);
    assert_eq!(names(&table), [""; 0]);
}

#[test]
fn alternate_functions() {
    let alternates = |text: &str, expected: &[&str]| -> Vec<Option<u8>> {
        let table = check(text, expected);
        table.pins[0].usages.iter().map(|usage| usage.alternate).collect()
    };
    let some = |numbers: &[u8]| numbers.iter().map(|n| Some(*n)).collect::<Vec<_>>();
    assert_eq!(alternates("Pin,T\nPA1,TIM2_CH2@1 TIM5_CH2@AF2", &[]), some(&[1, 2]));
    assert_eq!(alternates("AF,Pin,T\n1 2,PA1,TIM2_CH2 TIM5_CH2", &[]), some(&[1, 2]));
    assert_eq!(alternates("Pin,T,AF\nPA1,TIM2_CH2 x,x=3 tim2-ch2=1", &[]), some(&[1, 3]));
    let analog = alternates("Pin,A,T,AF\nPA1,ADC1_IN1,TIM2_CH2,1", &[]);
    assert_eq!(analog, [None, Some(1)]);
    let over =
        alternates("Pin,T,AF\nPA1,TIM2_CH2@1,TIM2_CH2=2", &["2:AF `TIM2_CH2=2` AlternateConflict"]);
    assert_eq!(over, some(&[1]));
    alternates(
        "Pin,T,AF\nPA1,TIM2_CH2,1 2",
        &["2:AF `1 2` AlternateCount { expected: 1, found: 2"],
    );
    let meant =
        "2:AF `TIM2_CH3=1` UnknownAlternate { signal: \"TIM2_CH3\", nearest: Some(\"TIM2_CH2";
    alternates("Pin,T,AF\nPA1,TIM2_CH2,TIM2_CH3=1", &[meant]);
    alternates("Pin,T,AF\nPA1,TIM2_CH2,16", &["2:AF `16` BadAlternate"]);
    let bad = ["2:T `TIM2_CH2@x` BadAlternate", "2:T `@3` BadAlternate"];
    assert_eq!(alternates("Pin,T\nPA1,TIM2_CH2@x @3", &bad), [None]);
}

#[test]
fn mistakes_in_the_shape() {
    check("", &["1:- `` EmptyTable"]);
    check("# mcu = RP2040\n\n", &["3:- `` EmptyTable"]);
    check("Pin,ADC\n,\n", &["1:- `Pin,ADC` EmptyTable"]);
    check("Pim,ADC\nPA1,x\n", &["1:- `Pim,ADC` NoPinColumn { nearest: Some(\"Pim\")"]);
    check("ADC,I2C\nPA1,x\n", &["1:- `ADC,I2C` NoPinColumn { nearest: None"]);
    let table =
        check("Pin,A,a,B\nPA1,x,y,z\n", &["1:a `a` DuplicateColumn { header: \"a\", first: 4..5"]);
    assert_eq!(summary(&table), "PA1=X+Z");
    let table = check("Pin,,A\nPA1,x,y\n", &["1:- `` UnnamedColumn"]);
    assert_eq!(summary(&table), "PA1=Y");
    check("Pin,,A\nPA1,,y\n", &[]);
    let table = check(
        "Pin,A,B\nPA1,x\nPA2,x,y,z\nPA3,x,y,,\n",
        &[
            "2:- `PA1,x` RaggedRow { expected: 3, found: 2",
            "3:- `PA2,x,y,z` RaggedRow { expected: 3, found: 4",
        ],
    );
    assert_eq!(summary(&table), "PA1=X PA2=X+Y PA3=X+Y");
    check("Pin,A\nPA1,\"x\nPA2,y\n", &["2:- `\"` BadQuote"]);
    check("Pin,A\nPA1,\"x\"y\n", &["2:- `\"x\"y` BadQuote"]);
}

#[test]
fn mistakes_in_the_rows() {
    let table = check(
        "Pin,A\nPA1,x\n,y\nVDD,z\npa01,v\n",
        &[
            "3:Pin `,y` MissingPin",
            "4:Pin `VDD` BadPinName { spelled: \"VDD\"",
            "5:Pin `pa01` DuplicatePin { pin: PinName(\"PA1\"), first: 6..9",
        ],
    );
    assert_eq!(summary(&table), "PA1=X");
    let table = check(
        "Pin,ICU,PWM\nPA1,TIM2_CH2 tim2-ch2,TIM2_CH2\n",
        &[
            "2:ICU `tim2-ch2` DuplicateUsage { spelled: \"tim2-ch2\", first: 16..24",
            "2:PWM `TIM2_CH2` DuplicateUsage",
        ],
    );
    assert_eq!(summary(&table), "PA1=TIM2_CH2");
    let table = check(
        "Pin,ADC,Any\nPA1,ADC12IN8,SDIO_CK foo\nPA2,-,I2C1-SLC\n",
        &[
            "2:ADC `ADC12IN8` MalformedSignal { spelled: \"ADC12IN8\", nearest: Some(\"ADC12_IN8\"",
            "3:Any `I2C1-SLC` MalformedSignal { spelled: \"I2C1-SLC\", nearest: Some(\"I2C1_SCL\"",
        ],
    );
    assert_eq!(pin(&table, "PA1").cost(), 3);
    let table = check(
        "Pin,Onboard\nPA1,Codec:buss\n",
        &["2:Onboard `Codec:buss` BadOccupation { spelled: \"buss\", nearest: Some(\"bus\""],
    );
    assert_eq!(pin(&table, "PA1").onboard.as_ref().unwrap().how, Occupation::Taken);
}

#[test]
fn mistakes_in_the_comments() {
    check(
        "# mcu = SMT32F407VGT6\nPin\nPA1\n",
        &[
            "1:- `SMT32F407VGT6` UnknownMcu { spelled: \"SMT32F407VGT6\", nearest: Some(\"STM32F407VGT6",
        ],
    );
    check("# mcu =\nPin\nPA1\n", &["1:- `` UnknownMcu { spelled: \"\", nearest: None"]);
    let table = check(
        "# mcu = RP2040\n# MCU = RP2350\nPin\nPA1\n# mcu = x\n",
        &["2:- `RP2350` DuplicateProperty { key: \"mcu\""],
    );
    assert_eq!(table.mcu.as_deref(), Some("RP2040"));
    let table = check("\"# mcu = RP2040\",,\r\nPin,A,B\r\nGP0,x,y\r\n", &[]);
    assert_eq!(table.mcu.as_deref(), Some("RP2040"));
}

#[test]
fn invisible_characters_are_found_and_left_out() {
    let table = check(
        "Pin\u{a0},A\nPA1\u{200b},\u{a0}x\u{a0}y\n",
        &[
            "1:Pin `\u{a0}` InvisibleCharacter { character: '\\u{a0}' }",
            "2:Pin `\u{200b}` InvisibleCharacter",
            "2:A `\u{a0}` InvisibleCharacter",
        ],
    );
    assert_eq!(summary(&table), "PA1=X+Y");
}

#[test]
fn a_wide_table_stays_fast() {
    let mut text = String::from("Pin,A,B\n");
    for pin in 0..2000 {
        text.push_str(&format!("D{pin},TIM1_CH1 TIM2_CH2 a b c,ADC1_IN3\n"));
    }
    assert_eq!(load(&text).board.pins.len(), 2000);
}

/// A table without its places.
fn bare(table: &Table) -> String {
    format!("{:?}", (table.mcu.clone(), table.to_csv(), summary(table)))
}

/// What must hold for any text.
fn hold(text: &str) -> Result<(), TestCaseError> {
    let loaded = load(text);
    prop_assert_eq!(&loaded, &load(text));
    let lines = text.lines().count().max(1) + text.matches('\r').count() + 1;
    for finding in &loaded.findings {
        prop_assert!(text.get(finding.range.clone()).is_some(), "{finding:?}");
        prop_assert!((1..=lines).contains(&finding.row), "{finding:?}");
    }
    for pair in loaded.board.pins.windows(2) {
        prop_assert!(pair[0].name < pair[1].name);
    }
    for pin in &loaded.board.pins {
        prop_assert!(text.get(pin.range.clone()).is_some());
        let signals: std::collections::BTreeSet<&Signal> =
            pin.usages.iter().map(|usage| &usage.signal).collect();
        prop_assert_eq!(signals.len(), pin.usages.len());
        for usage in &pin.usages {
            prop_assert!(text.get(usage.range.clone()).is_some());
        }
    }
    let again = load(&loaded.board.to_csv()).board;
    if !loaded.board.pins.is_empty() {
        prop_assert_eq!(bare(&again), bare(&loaded.board));
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_read(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        hold(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn any_table_like_text_is_read(text in "(#|Pin|Places|Label|Header|CN7.[0-9]|PA[0-9]{1,2}|AF|Onboard|TIM[0-9]_CH[0-9]|ADC12IN8|mcu|[=@:,;\t\"\r\n -]|\u{a0}|x){0,60}") {
        hold(&text)?;
    }

    #[test]
    fn any_mutation_of_table_1_is_read(
        edits in prop::collection::vec((0..TABLE_1.len(), 0..4_usize, "[,;\"\r\n@#A-Z0-9\u{a0}-]{0,3}"), 1..8)
    ) {
        let mut text = TABLE_1.to_owned();
        for (at, length, insert) in edits {
            let start = (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap();
            let end = (start + length).min(text.len());
            let end = (end..=text.len()).find(|at| text.is_char_boundary(*at)).unwrap();
            text.replace_range(start..end, &insert);
        }
        hold(&text)?;
    }
}

#[test]
fn kinds_are_told_apart_as_data() {
    let finding = load("Pin,A\nPA1,TIM_CH1\n").findings.remove(0);
    let expected = FindingKind::MalformedSignal {
        spelled: "TIM_CH1".to_owned(),
        nearest: Some("TIM1_CH1".to_owned()),
    };
    assert_eq!(finding.kind, expected);
    assert_eq!((finding.row, finding.range), (2, 10..17));
}

#[test]
fn what_reading_takes_off_is_not_written() {
    let mut table = load("Pin,Label,Note\nPA1,x,y\n").board;
    table.pins[0].label = Some("front\u{ad}left ".into());
    table.pins[0].note = Some("a\u{a0}b".into());
    let csv = table.to_csv();
    assert_eq!(csv, "Pin,Label,Note\nPA1,frontleft,a b\n");
    assert_eq!(load(&csv).board.to_csv(), csv);
}

/// Commas and slashes separate usages where each piece is the name of a signal.
#[test]
fn usages_are_separated_where_that_is_meant() {
    let text = "Pin;Any\nPA0;ADC1_IN0,TIM2_CH1@1\nPA1;ADC1_IN1/TIM2_ETR\nPA2;ADC1_IN2, TIM2_CH3\n\
                PA3;USART1_RTS/DE\nPA4;ETH_A/RMII_B\n";
    let loaded = load(text);
    assert!(loaded.findings.is_empty(), "{:?}", loaded.findings);
    let usages = loaded.board.pins.iter().map(|pin| {
        let spelled = pin.usages.iter().map(|usage| usage.spelled.as_str());
        spelled.collect::<Vec<_>>().join(" ")
    });
    let expected = [
        "ADC1_IN0 TIM2_CH1",
        "ADC1_IN1 TIM2_ETR",
        "ADC1_IN2 TIM2_CH3",
        "USART1_RTS/DE",
        "ETH_A/RMII_B",
    ];
    assert_eq!(usages.collect::<Vec<_>>(), expected);
    let timer = &loaded.board.pins[0].usages[1];
    assert_eq!((&text[timer.range.clone()], timer.alternate), ("TIM2_CH1@1", Some(1)));
}
