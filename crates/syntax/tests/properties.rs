//! What holds for every text: the tree spells it, parsing does not panic or take long, and the
//! layout keeps the tokens and is stable.
#![expect(clippy::disallowed_methods, reason = "a test that measures time")]

mod invariants;

use invariants::check;
use proptest::prelude::*;
use sensedsl_syntax::{SyntaxErrorKind, parse, parse_within};

/// Pieces that texts of the language are made of, and some that are not.
fn piece() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "board",
        "sensor",
        "actuator",
        "driver",
        "link",
        "use",
        "spare",
        "on",
        "returns",
        "accepts",
        "for",
        "prefer",
        "avoid",
        "reserve",
        "release",
        "allow",
        "id",
        "A",
        "PA0",
        "uint8",
        "{",
        "}",
        "[",
        "]",
        "=",
        ";",
        ",",
        "+",
        "-",
        "17",
        "0xE6",
        "0b12",
        "1.5e3",
        "1.",
        "ms",
        "\"a\"",
        "\"b",
        "\"\\q\"",
        "// c\n",
        "/* d */",
        "/* e\n f */",
        "/*",
        "\n",
        "\n\n\n",
        "\r\n",
        "\r",
        " ",
        "\t",
        "@",
        ":",
        "#",
        "é",
        "\u{feff}",
        "sensr",
        "brd",
        "=",
        ";",
        "{",
        "}",
        " ",
        " ",
        " ",
    ])
}

/// White space and comments that may stand anywhere.
fn trivia() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        " ",
        "  ",
        "\n",
        "\n\n",
        "\r\n\r\n\r\n",
        "\t",
        " // c \n",
        "/* d */",
        " /* e\n   f */ ",
        "\n// g\n",
        "\n\n/* h */\n",
        "/**//**/",
        "\r",
        "//\r\n",
    ])
}

/// The tokens of one correct item.
fn item() -> impl Strategy<Value = Vec<&'static str>> {
    let value = prop::sample::select(vec![
        vec!["17"],
        vec!["+", "2"],
        vec!["-", "1.051e-3"],
        vec!["60", "ms"],
        vec!["0x10", "us"],
        vec!["analog"],
        vec!["\"a \\\" // b\""],
        vec!["[", "]"],
        vec!["[", "0x00", ",", "0x51", "]"],
        vec!["[", "a", ",", "[", "-", "1", "]", ",", "\"s\"", "]"],
    ]);
    let name = prop::sample::select(vec!["id", "driver", "on", "sensor", "reserve", "link"]);
    let property =
        (name, value).prop_map(|(name, value)| [vec![name, "="], value, vec![";"]].concat());
    let rule = (prop::sample::select(vec!["prefer", "avoid"]), property.clone())
        .prop_map(|(keyword, property)| [vec![keyword], property].concat());
    let other_rule = prop::sample::select(vec![
        vec!["reserve", "PA0", ",", "PA1", ";"],
        vec!["release", "PA0", ";"],
        vec!["allow", "W0301", "\"known\"", ";"],
    ]);
    let content = prop_oneof![4 => property.clone(), 1 => rule, 1 => other_rule];
    let head = prop::sample::select(vec![
        vec!["sensor", "X", "returns", "uint8", "{"],
        vec!["actuator", "board", "accepts", "float32", "[", "4", "]", "{"],
    ]);
    let device = (head, prop::collection::vec(content.clone(), 0..4))
        .prop_map(|(head, content)| [head, content.concat(), vec!["}"]].concat());
    let link = prop::collection::vec(property.clone(), 0..2)
        .prop_map(|content| [vec!["link", "{"], content.concat(), vec!["}"]].concat());
    let board_head = prop::sample::select(vec![
        vec!["board", "A", "{"],
        vec!["spare", "board", "on", "on", "\"t.csv\"", "{"],
        vec!["board", "B", "on", "STM32F407VGT6", "{"],
    ]);
    let board_content = prop_oneof![2 => device.clone(), 1 => content, 1 => link];
    let board = (board_head, prop::collection::vec(board_content, 0..4))
        .prop_map(|(head, content)| [head, content.concat(), vec!["}"]].concat());
    let driver = prop::collection::vec(property, 0..3).prop_map(|content| {
        [vec!["driver", "for", "for", "i2c", "{"], content.concat(), vec!["}"]].concat()
    });
    prop_oneof![board, device, driver, Just(vec!["use", "\"lib.sense\"", ";"])]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

    #[test]
    fn any_sequence_of_pieces(pieces in prop::collection::vec(piece(), 0..60)) {
        check(&pieces.concat())?;
        check(&pieces.join(" "))?;
    }

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        check(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn any_characters(text in "\\PC*") {
        check(&text)?;
    }

    #[test]
    fn correct_files_are_laid_out(
        items in prop::collection::vec(item(), 0..4),
        spaces in prop::collection::vec(trivia(), 1..20),
    ) {
        let mut spaces = spaces.into_iter().cycle();
        let mut text = String::new();
        for token in items.concat() {
            text.push_str(token);
            // Numbers and units excepted, a line break is as good as a space.
            let space = spaces.next().unwrap_or(" ");
            let in_number = token.starts_with(|c: char| c.is_ascii_digit());
            text.push_str(if in_number { " " } else { space });
        }
        let parsed = parse(&text);
        prop_assert_eq!(parsed.errors(), &[], "{}", text);
        check(&text)?;
        prop_assert!(sensedsl_syntax::format(&text).is_ok());
    }

    #[test]
    fn correct_files_with_one_token_lost(items in prop::collection::vec(item(), 1..4), at in any::<prop::sample::Index>()) {
        let mut tokens = items.concat();
        tokens.remove(at.index(tokens.len()));
        check(&tokens.join(" "))?;
        check(&tokens.join("\n"))?;
    }
}

#[test]
fn hostile_texts_take_linear_time_and_little_stack() {
    let pieces = [
        "[",
        "]",
        "{",
        "}",
        "a=[",
        "a=[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
        "board a{",
        "sensor ",
        "sensor a returns b{",
        "a-",
        "x=1 a-a-a-a-a-a-a-a-",
        "a ",
        "a=",
        "a;",
        "1 ",
        "\"",
        "\"\n",
        "/*",
        "/**/",
        "@ ",
        "=",
        "reserve a,",
        "reserve ",
        "prefer ",
        "link{",
        "\u{feff}",
        "\\",
        "\"\\u{",
        "é",
        "a=1\n",
        "for ",
        "use ",
        "+",
        "a=1 b ",
    ];
    for piece in pieces {
        let text = piece.repeat(1_000_000 / piece.len());
        let start = std::time::Instant::now();
        let parsed = parse_within(&text, usize::MAX);
        assert!(parsed.syntax().text() == text.as_str(), "{piece:?} is not spelled whole");
        // Linear time is some 100 ms here; quadratic time would be minutes.
        assert!(start.elapsed().as_secs() < 5, "{piece:?} takes {:?}", start.elapsed());
    }
}

#[test]
fn deep_nesting_is_reported_and_takes_little_stack() {
    for (open, close) in [("board a {", "}"), ("sensor a returns b {", "}"), ("a = [", "];")] {
        let text = format!("{}{}", open.repeat(20_000), close.repeat(20_000));
        let parsed = parse(&text);
        assert_eq!(parsed.syntax().text(), text.as_str());
        let too_deep = SyntaxErrorKind::NestingTooDeep { limit: 32 };
        // `a = [a = [` is not nested: there the `]` is missing.
        let expected = usize::from(close == "}");
        let reported = parsed.errors().iter().filter(|error| error.kind == too_deep).count();
        assert_eq!(reported, expected, "{open}");
    }
    let lists = format!("board a {{ b = {}{}; }}", "[".repeat(100_000), "]".repeat(100_000));
    let parsed = parse(&lists);
    let [error] = parsed.errors() else { panic!("one error") };
    assert_eq!(error.kind, SyntaxErrorKind::NestingTooDeep { limit: 32 });
}
