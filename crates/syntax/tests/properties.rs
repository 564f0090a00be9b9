//! What holds for every text: the tree spells it, parsing does not panic or take long, and the
//! layout keeps the tokens and is stable.
#![expect(clippy::disallowed_methods, reason = "a test that measures time")]

mod invariants;

use invariants::check;
use proptest::prelude::*;
use sensedsl_syntax::{SyntaxErrorKind, parse, parse_within};

/// Pieces of the language, and some that are not.
fn piece() -> impl Strategy<Value = &'static str> {
    let names = words(
        "board sensor actuator driver chip connection reading command const link use spare on returns accepts for \
         prefer avoid reserve release allow id A PA0 uint8",
    );
    let marks = words(r#"{ } [ ] = ; , + - * / ( ) .. ... 17 0xE6 0b12 1.5e3 1. ms "a" "b "\q""#);
    let comments = ["// c\n", "/* d */", "/* e\n f */", "/*"];
    let spaces = ["\n", "\n\n\n", "\r\n", "\r", " ", "\t"];
    let others = words("@ : # é \u{feff} sensr brd = ; { }");
    let pieces = [&names, &marks, &comments[..], &spaces, &others, &[" "; 3]];
    prop::sample::select(pieces.concat())
}

/// The words of a text, with a space between any two.
fn words(text: &'static str) -> Vec<&'static str> {
    text.split(' ').collect()
}

/// White space and comments, which are allowed anywhere.
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

/// The tokens of one correct value.
fn value() -> impl Strategy<Value = Vec<&'static str>> + Clone {
    prop::sample::select(vec![
        vec!["17"],
        words("+ 2"),
        words("- 1.051e-3"),
        words("60 ms"),
        words("0x10 us"),
        vec!["analog"],
        vec!["\"a \\\" // b\""],
        words("[ ]"),
        words("[ 0x00 , 0x51 ]"),
        words("[ a , [ - 1 ] , \"s\" ]"),
        words("5 .. N"),
        words("- 3 V .. 5 V"),
        words("N * 2 .. ( N - 1 )"),
        words("- ( 1 + N ) / 4 ms - - 2"),
        words("[ [ 1 .. 2 ] , 100 ms , + - N ]"),
    ])
}

/// The tokens of one correct item.
fn item() -> impl Strategy<Value = Vec<&'static str>> {
    let name = prop::sample::select(words(
        "id driver on sensor reserve link const chip reading command connection",
    ));
    let property =
        (name, value()).prop_map(|(name, value)| [vec![name, "="], value, vec![";"]].concat());
    let rule = (prop::sample::select(words("prefer avoid")), property.clone())
        .prop_map(|(keyword, property)| [vec![keyword], property].concat());
    let other_rule = prop::sample::select(vec![
        words("reserve PA0 , PA1 ;"),
        words("release PA0 ;"),
        words("allow W0301 \"known\" ;"),
    ]);
    let content = prop_oneof![4 => property.clone(), 1 => rule, 1 => other_rule];
    let head = prop::sample::select(vec![
        words("sensor X returns uint8 {"),
        words("actuator board accepts float32 [ 4 ] {"),
        words("sensor chip returns uint8 [ const ] {"),
    ]);
    let device = (head, prop::collection::vec(content.clone(), 0..4))
        .prop_map(|(head, content)| [head, content.concat(), vec!["}"]].concat());
    let link = prop::collection::vec(property.clone(), 0..2)
        .prop_map(|content| [words("link {"), content.concat(), vec!["}"]].concat());
    let board_head = prop::sample::select(vec![
        words("board A {"),
        words("spare board on on \"t.csv\" {"),
        words("board B on STM32F407VGT6 {"),
    ]);
    let connection_head = prop::sample::select(vec![
        words("connection bus for i2c {"),
        words("connection for for digital {"),
        words("connection connection {"),
    ]);
    let block = |head, content| [head, content, vec!["}"]].concat();
    let properties = || prop::collection::vec(property.clone(), 0..3).prop_map(|all| all.concat());
    let connection = (connection_head, properties()).prop_map(move |(h, c)| block(h, c));
    let chip_content =
        prop_oneof![2 => device.clone(), 1 => content.clone(), 1 => connection.clone()];
    let chip = prop::collection::vec(chip_content, 0..4)
        .prop_map(move |content| block(words("chip chip {"), content.concat()));
    let value_head = prop::sample::select(vec![
        words("reading reading returns int16 [ 3 ] {"),
        words("command c accepts bool {"),
    ]);
    let reading = (value_head, properties()).prop_map(move |(h, c)| block(h, c));
    let constant = (Just(vec!["const"]), property.clone()).prop_map(|(h, c)| [h, c].concat());
    let board_content =
        prop_oneof![2 => device.clone(), 1 => content, 1 => link, 1 => chip.clone()];
    let board = (board_head, prop::collection::vec(board_content, 0..4))
        .prop_map(|(head, content)| [head, content.concat(), vec!["}"]].concat());
    let driver_head =
        prop::sample::select(vec![words("driver for for i2c {"), words("driver d {")]);
    let driver_content = prop_oneof![2 => property, 1 => connection, 2 => reading];
    let driver = (driver_head, prop::collection::vec(driver_content, 0..4))
        .prop_map(move |(head, content)| block(head, content.concat()));
    prop_oneof![board, device, driver, chip, constant, Just(words("use \"lib.sense\" ;"))]
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
            // Except in numbers and before units, a line break is as good as a space.
            let space = spaces.next().unwrap_or(" ");
            let in_number = token.starts_with(|c: char| c.is_ascii_digit());
            text.push_str(if in_number { " " } else { space });
            // A division that touches a comment would begin one.
            if token == "/" && space.starts_with('/') {
                text.insert(text.len() - space.len(), ' ');
            }
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

/// Pieces that take long where something is quadratic, and much stack where something recurses.
const HOSTILE: [&[&str]; 2] = [
    &[
        "[", "]", "{", "}", "a=[", "board a{", "sensor ", "a-", "a ", "a=", "a;", "1 ", "\"",
        "\"\n", "/*", "/**/", "@ ", "=", "reserve ", "prefer ", "link{", "\u{feff}", "\\",
        "\"\\u{", "é", "a=1\n", "for ", "use ", "+", "a=1 b ", "(", ")", "a=(", "a=(1,", "a=1+",
        "1+", "a=1", "*", "-", "a=-", "..", "a=1..", "chip c{", "const a=", "const a ", "const ",
        "a b=", "chip c=", "'", "' a", "\u{201c}", "...", "a=N ms ",
    ],
    &[
        "a=[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
        "sensor a returns b{",
        "x=1 a-a-a-a-a-a-a-a-",
        "reserve a,",
        "a=((((((((((((((((((((((((((((((((((",
        "driver d{reading r returns b{",
        "connection c for i",
        "sensor a returns b c ",
        "sensor a returns b[1+",
    ],
];

#[test]
fn hostile_texts_take_linear_time_and_little_stack() {
    let is_thorough = std::env::var("SENSEDSL_THOROUGH").is_ok();
    let most_bytes = if is_thorough { 1_000_000 } else { 50_000 };
    for piece in HOSTILE.concat() {
        let text = piece.repeat(most_bytes / piece.len());
        // Linear time is about 100 ms here; quadratic time would be minutes. Other load on the
        // machine may cost seconds once, but not three times.
        let is_quick = (0..3).any(|_| {
            let start = std::time::Instant::now();
            let parsed = parse_within(&text, usize::MAX);
            assert!(parsed.syntax().text() == text.as_str(), "{piece:?} is not spelled whole");
            start.elapsed().as_secs() < 5
        });
        assert!(is_quick, "{piece:?}");
    }
}

#[test]
fn deep_nesting_is_reported_and_takes_little_stack() {
    for (open, close) in [("board a {", "}"), ("sensor a returns b {", "}"), ("a = [", "];")] {
        let text = format!("{}{}", open.repeat(20_000), close.repeat(20_000));
        let parsed = parse(&text);
        assert_eq!(parsed.syntax().text(), text.as_str());
        let too_deep = SyntaxErrorKind::NestingTooDeep { limit: 32 };
        // `a = [a = [` is not nested: its `]` is missing.
        let expected = usize::from(close == "}");
        let reported = parsed.errors().iter().filter(|error| error.kind == too_deep).count();
        assert_eq!(reported, expected, "{open}");
    }
    let too_deep = SyntaxErrorKind::NestingTooDeep { limit: 32 };
    let deep = ["(1+", "-", "2*-(", "1+", "1*2-", "[1+", "[(", "1*(2+"];
    for piece in deep {
        let text = format!("const A = {}1;\nconst B = 2;", piece.repeat(20_000));
        let parsed = parse(&text);
        assert_eq!(parsed.errors().first().map(|error| &error.kind), Some(&too_deep), "{piece}");
        assert!(parsed.errors().len() <= 2, "{piece}: {:?}", parsed.errors());
        assert_eq!(parsed.ast().constants().count(), 2, "{piece}");
        let ancestors = |node: sensedsl_syntax::SyntaxNode| node.ancestors().count();
        let height = parsed.syntax().descendants().map(ancestors).max();
        assert!(height < Some(40), "{piece}: {height:?}");
    }
    let sum = |terms: usize| format!("const A = {}0;", "1 + ".repeat(terms));
    assert_eq!(parse(&sum(32)).errors(), &[]);
    assert_eq!(parse(&sum(33)).errors().len(), 1);
    let lists = format!("board a {{ b = {}{}; }}", "[".repeat(100_000), "]".repeat(100_000));
    let parsed = parse(&lists);
    let [error] = parsed.errors() else { panic!("one error") };
    assert_eq!(error.kind, SyntaxErrorKind::NestingTooDeep { limit: 32 });
}
