//! Malformed texts and exactly what is reported for each: `line:column`, the marked text (empty
//! where something is missing) and the kind of mistake.

mod mistakes;

use mistakes::check;
use sensedsl_syntax::parse;

#[test]
fn blocks() {
    check(&[
        ("id = 1;", &["1:1 `id` NotAllowedHere { item: Property, block: File }"]),
        (";", &[r#"1:1 `;` StrayToken { found: Token(";"), block: File }"#]),
        ("}", &["1:1 `}` StrayCloseBrace"]),
        ("{ id = 1; }", &[r#"1:1 `{` StrayToken { found: Token("{"), block: File }"#]),
        ("board A {", &["1:10 `` MissingCloseBrace { block: Board, open: 8..9 }"]),
        (
            "board A { sensor X returns uint8 { id = 1; }",
            &["1:45 `` MissingCloseBrace { block: Board, open: 8..9 }"],
        ),
        (
            "board A {\n    sensor X returns uint8 {\n        id = 1;\n    sensor Y returns uint8 {\n        id = 2;\n    }\n}",
            &["3:16 `` MissingCloseBrace { block: Sensor, open: 37..38 }"],
        ),
        (
            "board A {\n    id = 1;\n\nboard B {\n}",
            &["2:12 `` MissingCloseBrace { block: Board, open: 8..9 }"],
        ),
        ("board A { board B { } }", &["1:11 `board` NotAllowedHere { item: Board, block: Board }"]),
        (
            "board A { sensor X returns uint8 { sensor Y returns uint8 { id = 2; } } }",
            &["1:36 `sensor` NotAllowedHere { item: Sensor, block: Sensor }"],
        ),
        ("board A { } }", &["1:13 `}` StrayCloseBrace"]),
    ]);
}

#[test]
fn misplaced_items() {
    check(&[
        (
            "board A { use \"x.sense\"; }",
            &["1:11 `use` NotAllowedHere { item: Use, block: Board }"],
        ),
        ("link { baud = 9600; }", &["1:1 `link` NotAllowedHere { item: Link, block: File }"]),
        ("reserve PA0;", &["1:1 `reserve` NotAllowedHere { item: Rule, block: File }"]),
        (
            "board A { driver srf for i2c { delay = 1; } }",
            &["1:11 `driver` NotAllowedHere { item: Driver, block: Board }"],
        ),
        (
            "sensor X returns uint8 { link { baud = 9600; } }",
            &["1:26 `link` NotAllowedHere { item: Link, block: Sensor }"],
        ),
        (
            "driver D for i2c { prefer side = left; }",
            &["1:20 `prefer` NotAllowedHere { item: Rule, block: Driver }"],
        ),
    ]);
}

#[test]
fn misspelled_keywords() {
    check(&[
        (
            "motor X\n{ id = 1; }\nboard A { foo\n{ id 1; } }",
            &[
                r#"1:1 `motor` UnknownItem { found: "motor", suggestion: None, block: File }"#,
                r#"3:11 `foo` UnknownItem { found: "foo", suggestion: None, block: Board }"#,
            ],
        ),
        (
            "sensr X returns uint8 { id = 1; }",
            &[
                r#"1:1 `sensr` UnknownItem { found: "sensr", suggestion: Some("sensor"), block: File }"#,
            ],
        ),
        (
            "board A { Sensor X returns uint8 { id = 1; } }",
            &[
                r#"1:11 `Sensor` UnknownItem { found: "Sensor", suggestion: Some("sensor"), block: Board }"#,
            ],
        ),
        (
            "board A { acutator M acepts uint8 { id = 1; } }",
            &[
                r#"1:11 `acutator` UnknownItem { found: "acutator", suggestion: Some("actuator"), block: Board }"#,
                r#"1:22 `acepts` Expected { expected: Keyword("accepts"), found: Token("acepts") }"#,
            ],
        ),
        (
            "baord A { }",
            &[
                r#"1:1 `baord` UnknownItem { found: "baord", suggestion: Some("board"), block: File }"#,
            ],
        ),
        (
            "motor X accepts uint8 { id = 1; }\nsensor Y returns uint8 { id = 2; }",
            &[r#"1:1 `motor` UnknownItem { found: "motor", suggestion: None, block: File }"#],
        ),
        (
            "board A { foo bar baz; id = 1; }",
            &[r#"1:11 `foo` UnknownItem { found: "foo", suggestion: None, block: Board }"#],
        ),
        (
            "board A { resrve PA0, PA1; }",
            &[
                r#"1:11 `resrve` UnknownItem { found: "resrve", suggestion: Some("reserve"), block: Board }"#,
            ],
        ),
    ]);
}

#[test]
fn device_heads() {
    check(&[
        (
            "sensor X return uint8 { id = 1; }",
            &[r#"1:10 `return` Expected { expected: Keyword("returns"), found: Token("return") }"#],
        ),
        (
            "sensor X accepts uint8 { id = 1; }",
            &[
                r#"1:10 `accepts` Expected { expected: Keyword("returns"), found: Token("accepts") }"#,
            ],
        ),
        (
            "sensor X uint8 { id = 1; }",
            &[r#"1:10 `uint8` Expected { expected: Keyword("returns"), found: Token("uint8") }"#],
        ),
        (
            "sensor X returns { id = 1; }",
            &[r#"1:18 `{` Expected { expected: Type, found: Token("{") }"#],
        ),
        (
            "sensor X returns uint8[] { id = 1; }",
            &[r#"1:24 `]` Expected { expected: ArrayLength, found: Token("]") }"#],
        ),
        (
            "sensor X returns uint8[1.5] { id = 1; }",
            &[r#"1:24 `1.5` Expected { expected: ArrayLength, found: Token("1.5") }"#],
        ),
        (
            "sensor X returns uint8[2 * N] { id = 1; }",
            &[r#"1:26 `*` Expected { expected: ArrayLength, found: Token("*") }"#],
        ),
        ("sensor X returns uint8[4 { id = 1; }", &["1:25 `` MissingCloseBracket { open: 22..23 }"]),
        (
            "sensor returns uint8 { id = 1; }",
            &[r#"1:8 `returns` Expected { expected: NameOf(Sensor), found: Token("returns") }"#],
        ),
        (
            "sensor 2nd returns uint8 { id = 1; }",
            &[r#"1:8 `2` Expected { expected: NameOf(Sensor), found: Token("2") }"#],
        ),
        (
            "sensor \"X\" returns uint8 { id = 1; }",
            &[r#"1:8 `"X"` Expected { expected: NameOf(Sensor), found: Token("\"X\"") }"#],
        ),
        (
            "sensor Größe returns uint8 { id = 1; }",
            &[r#"1:8 `Größe` NonAsciiName { name: "Größe" }"#],
        ),
    ]);
}

#[test]
fn board_heads() {
    check(&[
        (
            "board A-B;",
            &[
                r#"1:7 `A-B` HyphenInName { name: "A-B", suggestion: "A_B", in_value: false }"#,
                r#"1:10 `;` Expected { expected: OpenBrace, found: Token(";") }"#,
            ],
        ),
        (
            "board STM32F407G-DISC1 { }",
            &[
                r#"1:7 `STM32F407G-DISC1` HyphenInName { name: "STM32F407G-DISC1", suggestion: "STM32F407G_DISC1", in_value: false }"#,
            ],
        ),
        (
            "board A on STM32F407G-DISC1-2 { }",
            &[
                r#"1:12 `STM32F407G-DISC1-2` HyphenInName { name: "STM32F407G-DISC1-2", suggestion: "STM32F407G_DISC1_2", in_value: false }"#,
            ],
        ),
        ("board { }", &[r#"1:7 `{` Expected { expected: NameOf(Board), found: Token("{") }"#]),
        (
            "board on X { }",
            &[r#"1:7 `on` Expected { expected: NameOf(Board), found: Token("on") }"#],
        ),
        ("board A on { }", &[r#"1:12 `{` Expected { expected: BoardSource, found: Token("{") }"#]),
        ("board A;", &[r#"1:8 `;` Expected { expected: OpenBrace, found: Token(";") }"#]),
        (
            "board A\n    id = 1;\n}",
            &[r#"1:8 `` Expected { expected: OpenBrace, found: Token("id") }"#],
        ),
        (
            "board A \"x.csv\" { id = 1; }",
            &[r#"1:9 `"x.csv"` Expected { expected: OpenBrace, found: Token("\"x.csv\"") }"#],
        ),
        ("spare A { }", &[r#"1:7 `A` Expected { expected: Keyword("board"), found: Token("A") }"#]),
    ]);
}

#[test]
fn driver_heads_and_uses() {
    check(&[
        (
            "driver for i2c { }",
            &[r#"1:8 `for` Expected { expected: NameOf(Driver), found: Token("for") }"#],
        ),
        (
            "driver D i2c { }",
            &[r#"1:10 `i2c` Expected { expected: Keyword("for"), found: Token("i2c") }"#],
        ),
        ("driver D for { }", &[r#"1:14 `{` Expected { expected: Kind, found: Token("{") }"#]),
        ("use foo;", &[r#"1:5 `foo` Expected { expected: FilePath, found: Token("foo") }"#]),
        ("use \"a.sense\"", &["1:14 `` MissingSemicolon"]),
        ("use", &["1:4 `` Expected { expected: FilePath, found: EndOfFile }"]),
    ]);
}

#[test]
fn statements() {
    check(&[
        ("sensor X returns uint8 { id = 17 }", &["1:33 `` MissingSemicolon"]),
        (
            "sensor X returns uint8 { id = 17\n type = analog\n }",
            &["1:33 `` MissingSemicolon", "2:15 `` MissingSemicolon"],
        ),
        ("sensor X returns uint8 { id = 17 type = analog; }", &["1:33 `` MissingSemicolon"]),
        (
            "sensor X returns uint8 { id = 17 18; type = analog; }",
            &[r#"1:34 `18` StrayToken { found: Token("18"), block: Sensor }"#],
        ),
        (
            "sensor X returns uint8 { id = ; type = analog; }",
            &[r#"1:30 `` MissingValue { property: "id" }"#],
        ),
        (
            "sensor X returns uint8 { id =\n type = analog; }",
            &[r#"1:30 `` MissingValue { property: "id" }"#],
        ),
        ("sensor X returns uint8 { id = }", &[r#"1:30 `` MissingValue { property: "id" }"#]),
        (
            "sensor X returns uint8 { id 17; type analog; }",
            &[
                r#"1:28 `` MissingEquals { property: "id" }"#,
                r#"1:37 `` MissingEquals { property: "type" }"#,
            ],
        ),
        (
            "sensor X returns uint8 { id; type\n delay = 3; }",
            &[
                r#"1:28 `` MissingValue { property: "id" }"#,
                r#"1:34 `` MissingValue { property: "type" }"#,
            ],
        ),
        (
            "sensor X returns uint8 { id == 17; }",
            &[r#"1:30 `=` Expected { expected: Value, found: Token("=") }"#],
        ),
        (
            "sensor X returns uint8 { id: 17; }",
            &["1:28 `:` UnexpectedCharacter { character: ':' }"],
        ),
        (
            "sensor X returns uint8 { = 17; id = 1; }",
            &[r#"1:26 `=` StrayToken { found: Token("="), block: Sensor }"#],
        ),
    ]);
}

#[test]
fn numbers_and_units() {
    check(&[
        (
            "sensor X returns uint8 { delay = 60 mss; }",
            &[r#"1:37 `mss` UnknownUnit { found: "mss", suggestion: Some("ms") }"#],
        ),
        (
            "sensor X returns uint8 { delay = 60 msec; }",
            &[r#"1:37 `msec` UnknownUnit { found: "msec", suggestion: Some("ms") }"#],
        ),
        (
            "sensor X returns uint8 { delay = 60µs; }",
            &[r#"1:36 `µs` UnknownUnit { found: "µs", suggestion: Some("us") }"#],
        ),
        (
            "sensor X returns uint8 { delay = 60 khz; }",
            &[r#"1:37 `khz` UnknownUnit { found: "khz", suggestion: Some("kHz") }"#],
        ),
        (
            "sensor X returns uint8 { prio = + ; }",
            &[r#"1:35 `;` Expected { expected: Value, found: Token(";") }"#],
        ),
        (
            "sensor X returns uint8 { prio = -\n id = 3; }",
            &[r#"1:34 `` Expected { expected: Value, found: Token("id") }"#],
        ),
    ]);
}

#[test]
fn lists() {
    check(&[
        (
            "sensor X returns uint8 { trigger = [1, 2; }",
            &["1:41 `` MissingCloseBracket { open: 35..36 }"],
        ),
        ("sensor X returns uint8 { trigger = [1 2]; }", &["1:38 `` MissingComma"]),
        (
            "sensor X returns uint8 { trigger = [1,, 2]; }",
            &[r#"1:39 `,` Expected { expected: Value, found: Token(",") }"#],
        ),
        ("sensor X returns uint8 { trigger = [1, 2,]; }", &["1:41 `,` TrailingComma"]),
        (
            "sensor X returns uint8 { trigger = [1, 2\n id = 3; }",
            &["1:41 `` MissingCloseBracket { open: 35..36 }"],
        ),
        (
            "sensor X returns uint8 { trigger = 1, 2]; }",
            &[r#"1:37 `,` StrayToken { found: Token(","), block: Sensor }"#],
        ),
    ]);
}

#[test]
fn rules() {
    check(&[
        (
            "sensor X returns uint8 { prefer left; avoid = 3; prefer; }",
            &[
                r#"1:37 `` MissingValue { property: "left" }"#,
                r#"1:56 `;` Expected { expected: PropertyName, found: Token(";") }"#,
            ],
        ),
        (
            "sensor X returns uint8 { prefer side left; }",
            &[r#"1:37 `` MissingEquals { property: "side" }"#],
        ),
        (
            "board A { reserve ; release PA0,; reserve PA0 PA1; reserve PA0,, PA1; }",
            &[
                r#"1:19 `;` Expected { expected: ResourceName, found: Token(";") }"#,
                "1:32 `,` TrailingComma",
                "1:46 `` MissingComma",
                r#"1:64 `,` Expected { expected: ResourceName, found: Token(",") }"#,
            ],
        ),
        (
            "board A { allow W0301; allow \"x\"; allow; }",
            &[
                r#"1:22 `;` Expected { expected: Reason, found: Token(";") }"#,
                r#"1:30 `"x"` Expected { expected: Code, found: Token("\"x\"") }"#,
                r#"1:40 `;` Expected { expected: Code, found: Token(";") }"#,
            ],
        ),
    ]);
}

#[test]
fn tokens() {
    check(&[
        ("board A { };", &[r#"1:12 `;` StrayToken { found: Token(";"), block: File }"#]),
        (
            "sensor X returns uint8 { id = 1;; }",
            &[r#"1:33 `;` StrayToken { found: Token(";"), block: Sensor }"#],
        ),
        (
            "sensor X returns uint8 { max-rate = 3; id = 1; }",
            &[
                r#"1:26 `max-rate` HyphenInName { name: "max-rate", suggestion: "max_rate", in_value: false }"#,
            ],
        ),
        (
            "sensor X returns uint8 { id = 300000000000000000000; }",
            &[r#"1:31 `300000000000000000000` NumberTooLarge { number: "300000000000000000000" }"#],
        ),
        ("sensor X returns uint8 { label = \"abc; }\n}", &[r#"1:34 `"abc; }` UnterminatedString"#]),
        ("sensor X returns uint8 { id = 1; /* rest }", &["1:34 `/*` UnterminatedComment"]),
        (
            "sensor X returns uint8 { id = 1 # comment\n }",
            &["1:33 `# comment` UnexpectedCharacter { character: '#' }"],
        ),
        (
            "sensor X returns uint8 { id = 1 ( ) type = 2; }",
            &[r#"1:33 `(` StrayToken { found: Token("("), block: Sensor }"#],
        ),
        (
            "sensor X returns uint8 { a = [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]; id = ; }",
            &[
                "1:61 `[` NestingTooDeep { limit: 32 }",
                r#"1:105 `` MissingValue { property: "id" }"#,
            ],
        ),
    ]);
}

#[test]
fn each_mistake_of_a_file_is_reported_at_its_place() {
    let text = r#"use "library.sense"
board Rover on STM32F407G-DISC1 {
    sensr Front returns uint16 {
        id = 17
        type analog;
        delay = 60 msec;
    }
    board Inner { }
    sensor Rear return uint8 {
        id = ;
        type = i2c;
        trigger = [0x00 0x51];
        label = "rear \q";
    }
    reserve PA0 PA1;
}
}
sensor Last returns uint32 {
    id = 20;
"#;
    check(&[(
        text,
        &[
            "1:20 `` MissingSemicolon",
            r#"2:16 `STM32F407G-DISC1` HyphenInName { name: "STM32F407G-DISC1", suggestion: "STM32F407G_DISC1", in_value: false }"#,
            r#"3:5 `sensr` UnknownItem { found: "sensr", suggestion: Some("sensor"), block: Board }"#,
            "4:16 `` MissingSemicolon",
            r#"5:13 `` MissingEquals { property: "type" }"#,
            r#"6:20 `msec` UnknownUnit { found: "msec", suggestion: Some("ms") }"#,
            "8:5 `board` NotAllowedHere { item: Board, block: Board }",
            r#"9:17 `return` Expected { expected: Keyword("returns"), found: Token("return") }"#,
            r#"10:13 `` MissingValue { property: "id" }"#,
            "12:24 `` MissingComma",
            r#"13:23 `\q` UnknownEscape { escape: "\\q" }"#,
            "15:16 `` MissingComma",
            "17:1 `}` StrayCloseBrace",
            "19:13 `` MissingCloseBrace { block: Sensor, open: 357..358 }",
        ],
    )]);
}

/// The parts of a broken file that are understood appear in the views as if the file were correct.
#[test]
fn mistakes_leave_the_rest_intact() {
    let text = "board A { Sensor X return uint8 { id 17; delay = 60 mss } reserve PA0 PA1; }";
    let board = parse(text).ast().boards().next().expect("a board");
    let device = board.devices().next().expect("a device");
    let names: Vec<_> = device
        .properties()
        .filter_map(|property| property.name())
        .map(|name| name.text().to_owned())
        .collect();
    assert_eq!(names, ["id", "delay"]);
    assert!(device.properties().all(|property| property.value().is_some()));
    assert_eq!(device.ty().and_then(|ty| ty.scalar()).expect("a type").text(), "uint8");
    assert_eq!(board.rules().count(), 1);
}
