use proptest::prelude::*;

use crate::{Format, Importer, ReadError, Source};

const VESC: &str = r#"VERSION ""
NS_ :
BS_:
BU_: Robot Drive
BO_ 2147484417 SetRpm: 4 Robot
 SG_ Rpm : 7|32@0- (1,0) [-60000|60000] "rpm" Drive
BO_ 2147485953 Status: 8 Drive
 SG_ Speed : 7|32@0- (1,0) [0|0] "rpm" Robot
 SG_ Current : 39|16@0- (0.1,0) [-200|200] "A" Robot
 SG_ Duty : 55|16@0- (0.001,0) [-1|1] "" Robot
BO_ 288 Pages: 8 Drive
 SG_ Page M : 0|3@1+ (1,0) [0|7] "" Robot
 SG_ Heat m3 : 12|10@1- (0.5,-40) [-40|100] "°C" Robot
 SG_ Exact m4 : 32|32@1- (1,0) [0|0] "V" Robot
CM_ BO_ 288 "two
BO_ lines";
BA_ "GenMsgCycleTime" BO_ 2147484417 20;
VAL_ 288 Page 3 "heat" 4 "voltage" ;
SIG_VALTYPE_ 288 Exact : 1;
"#;

fn imported(text: &str, node: Option<&str>) -> (String, Vec<String>) {
    let source = Source {
        name: "bus.dbc",
        bytes: text.as_bytes(),
        format: None,
        sheet: None,
        table: "",
        beside: &|_| Err(ReadError::Missing),
    };
    let made = Importer::default().import_for(&source, node);
    let reported = made.diagnostics.iter().map(|one| {
        let place = made.sources.line_column(one.primary.span.file, one.primary.span.start);
        format!("{} {} {}", one.code, place.line, one.message)
    });
    (made.program.unwrap_or_default(), reported.collect())
}

#[test]
fn a_node_sends_and_receives() {
    let (text, reported) = imported(VESC, Some("Robot"));
    assert_eq!(reported, Vec::<String>::new());
    for wanted in [
        "actuator Rpm accepts int32 {\n    type = can;\n    frame = 0x301;\n    extended = true;\n    order = big;\n    \
         bit = 7;\n    bits = 32;\n    quantity = \"rpm\";\n    min = -60000;\n    max = 60000;\n    length = 4;\n    \
         resend = 20 ms;\n}",
        "sensor Duty returns int16 {\n    type = can;\n    frame = 0x901;\n    order = big;\n    bit = 55;\n    \
         bits = 16;\n    scale = 0.001;\n    min = -1;\n    max = 1;\n}",
        "sensor Heat returns int16 {\n    type = can;\n    frame = 0x120;\n    order = little;\n    bit = 12;\n    \
         bits = 10;\n    mux = Page = 3;\n    scale = 0.5;\n    offset = -40;\n    quantity = \"°C\";\n    min = -40;\n    max = 100;\n}",
        "sensor Exact returns float32 {",
        "    // 3: heat\n    // 4: voltage\n",
    ] {
        assert!(text.contains(wanted), "{wanted}\n\n{text}");
    }
}

#[test]
fn without_a_node_everything_is_heard() {
    let (text, _) = imported(VESC, None);
    assert_eq!(text.matches("\nsensor ").count(), 7);
    assert!(!text.contains("actuator"));
}

#[test]
fn what_is_wrong_has_its_line() {
    let (text, reported) = imported(VESC, Some("Robo"));
    assert!(text.is_empty());
    assert_eq!(reported, ["E0811 1 there is no node `Robo` in the file"]);
    for (line, why) in [
        ("BO_ 300 Short", "E0810 3 a message is `BO_ IDENTIFIER NAME: BYTES SENDER`"),
        ("BO_ x Short: 8 A", "E0810 3 `x` is not an identifier"),
        ("BO_ 1 A: 8 A\nBO_ 1 B: 8 A", "E0810 4 there are two messages of identifier 1"),
        (
            "BO_ 1 A: 8 A\n SG_ S : 0|8@2+ (1,0) [0|0] \"\" B",
            "E0810 4 the order behind `@` is 1 (little) or 0 (big)",
        ),
        ("BO_ 1 A: 8 A\n SG_ S : 0|8@1+ (a,0) [0|0] \"\" B", "E0810 4 `a` is not a number"),
    ] {
        let (text, reported) = imported(&format!("VERSION \"\"\nBU_: A B\n{line}\n"), None);
        assert!(text.is_empty());
        assert_eq!(reported, [why]);
    }
    let (_, reported) = imported(
        "BU_: A B\nBO_ 1 A: 2 A\n SG_ S : 12|8@1+ (1,0) [0|0] \"\" B\n SG_ T : 0|8@1+ (1,0) [0|0] \"\" B\n",
        None,
    );
    assert_eq!(reported, ["W0804 3 S is left out: its bits are not in the 2 bytes of its message"]);
}

/// Tools store signals without a message, and messages of other buses, under identifiers that no
/// frame can have.
#[test]
fn a_message_that_no_frame_can_be_is_left_out() {
    let (text, reported) = imported(
        "BU_: A B\nBO_ 3758096384 Pseudo: 8 A\n SG_ T : 0|8@1+ (1,0) [0|0] \"\" B\n\
         BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX\n\
         \x20SG_ Old : 0|8@1+ (1,0) [0|0] \"\" B\n\
         BO_ 1 Real: 8 A\n SG_ S : 0|8@1+ (1,0) [0|0] \"\" B\n\
         BA_ \"GenMsgCycleTime\" BO_ 3758096384 10;\nVAL_ 3758096384 T 1 \"one\" ;\n",
        Some("B"),
    );
    let why = |what, id| format!("{what} is left out: {id} is not an identifier of 11 or 29 bits");
    let pseudo = format!("W0804 2 {}", why("Pseudo", "3758096384"));
    let orphans = format!("W0804 4 {}", why("VECTOR__INDEPENDENT_SIG_MSG", "3221225472"));
    assert_eq!(reported, [pseudo, orphans]);
    assert_eq!(text.matches("\nsensor ").count(), 1);
    assert!(text.contains("sensor S returns uint8") && !text.contains("one"), "{text}");
}

/// Many real files omit bit 31, which marks a 29-bit identifier.
#[test]
fn a_great_identifier_has_29_bits() {
    let (text, reported) = imported(
        "BU_: A B\nBO_ 318291879 Side: 8 A\n SG_ S : 0|8@1+ (1,0) [0|0] \"\" B\n\
         BO_ 1073741824 VECTOR__INDEPENDENT_SIG_MSG: 0 A\n SG_ T : 0|8@1+ (1,0) [0|0] \"\" B\n",
        None,
    );
    assert!(text.contains("frame = 0x12F8BFA7;") && !text.contains("sensor T"), "{text}");
    let why = "Side is read with an identifier of 29 bits: 318291879 is more than 0x7FF, and bit 31 is not set";
    let orphans =
        "VECTOR__INDEPENDENT_SIG_MSG is left out: 1073741824 is not an identifier of 11 or 29 bits";
    assert_eq!(reported, [format!("W0805 2 {why}"), format!("W0804 4 {orphans}")]);
}

/// `SG_MUL_VAL_` is a range, a repetition of `m3`, or a word in the list at the start.
#[test]
fn only_ranges_of_selecting_values_are_left_out() {
    let (text, reported) = imported(
        "NS_ :\n\tSG_MUL_VAL_\nBU_: A B\nBO_ 1 A: 8 A\n SG_ P M : 0|8@1+ (1,0) [0|0] \"\" B\n\
         \x20SG_ S m3 : 8|8@1+ (1,0) [0|0] \"\" B\n SG_ T m : 8|8@1+ (1,0) [0|0] \"\" B\n\
         SG_MUL_VAL_ 1 S P 3-3;\nSG_MUL_VAL_ 1 S P 3-4;\n",
        None,
    );
    assert!(text.contains("mux = P = 3;"), "{text}");
    let open = "W0804 7 T is left out: its `m` has no number";
    let range = "W0804 9 a range of selecting values (`SG_MUL_VAL_`) is left out";
    assert_eq!(reported, [open, range]);
}

/// A file for a whole car has thousands of signals: those beyond the limit give one warning, with a
/// way out.
#[test]
fn signals_beyond_the_identifiers_are_counted() {
    let signal = |at: usize| format!(" SG_ S{at} : 0|8@1+ (1,0) [0|0] \"\" B\n");
    let signals: String = (0..300).map(signal).collect();
    let (text, reported) = imported(&format!("BU_: A B\nBO_ 1 M: 8 A\n{signals}"), None);
    assert_eq!(text.matches("\nsensor ").count(), 254);
    let why = "S254 and 45 more signals are left out: a file has at most 254 devices; `--node` takes those of one node";
    assert_eq!(reported, [format!("W0804 257 {why}")]);
}

proptest! {
    #[test]
    fn nothing_panics(cut in 0..VESC.len(), other in "[ -~\\n]{0,40}", at in 0..VESC.len()) {
        let mut text: String = VESC.chars().take(cut).collect();
        let at = (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
        text.insert_str(at, &other);
        for node in [None, Some("Robot")] {
            let source = Source {
                name: "bus.dbc",
                bytes: text.as_bytes(),
                format: Some(Format::Dbc),
                sheet: None,
                table: "",
                        beside: &|_| Err(ReadError::Missing),
            };
            let _ = Importer::default().import_for(&source, node);
        }
    }
}
