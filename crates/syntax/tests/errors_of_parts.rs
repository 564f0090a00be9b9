//! Mistakes in expressions, ranges, constants, chips and drivers: one mistake, one report.

mod mistakes;

use mistakes::check;

#[test]
fn operands_and_operators() {
    check(&[
        ("const A = 5 * ;", &[r#"1:15 `;` Expected { expected: Value, found: Token(";") }"#]),
        ("const A = * 5;", &[r#"1:11 `*` Expected { expected: Value, found: Token("*") }"#]),
        ("const A = 2 ** 3;", &[r#"1:14 `*` Expected { expected: Value, found: Token("*") }"#]),
        (
            "const A = 5 +\nconst B = 1;",
            &[r#"1:14 `` Expected { expected: Value, found: Token("const") }"#],
        ),
        ("const A = -;", &[r#"1:12 `;` Expected { expected: Value, found: Token(";") }"#]),
        ("const A = [1 + , 2];", &[r#"1:16 `,` Expected { expected: Value, found: Token(",") }"#]),
        ("const A = N ms;", &[r#"1:13 `ms` UnitAlone { unit: "ms" }"#]),
        ("const A = (1 + 2) ms;", &[r#"1:19 `ms` UnitAlone { unit: "ms" }"#]),
        (
            "const A = N-5;",
            &[r#"1:11 `N-5` HyphenInName { name: "N-5", suggestion: "N_5", in_value: true }"#],
        ),
        (
            "const A = N-5 ms;",
            &[r#"1:11 `N-5` HyphenInName { name: "N-5", suggestion: "N_5", in_value: true }"#],
        ),
        (
            "const A = N-M + 1;",
            &[r#"1:11 `N-M` HyphenInName { name: "N-M", suggestion: "N_M", in_value: true }"#],
        ),
        ("const A = 5 min;", &[r#"1:13 `min` UnknownUnit { found: "min", suggestion: None }"#]),
        ("const A = 'x' + 1;", &["1:11 `'x'` UnexpectedCharacter { character: '\\'' }"]),
        ("const A = 1 % 2;", &["1:13 `%` UnexpectedCharacter { character: '%' }"]),
        ("const A = f(3);", &[r#"1:12 `(` Expected { expected: Semicolon, found: Token("(") }"#]),
        ("const A = 5\nconst B = 6;", &["1:12 `` MissingSemicolon"]),
        (
            "board A { x = 5 +\n id = 3; }",
            &[r#"1:18 `` Expected { expected: Value, found: Token("id") }"#],
        ),
        ("board A { x = 5\n id = 3; }", &["1:16 `` MissingSemicolon"]),
    ]);
}

#[test]
fn parentheses() {
    check(&[
        ("const A = (1 + 2;", &["1:17 `` MissingCloseParen { open: 10..11 }"]),
        ("const A = 1 + 2);", &[r#"1:16 `)` Expected { expected: Semicolon, found: Token(")") }"#]),
        ("const A = ();", &[r#"1:12 `)` Expected { expected: Value, found: Token(")") }"#]),
        ("const A = (1, 2);", &["1:11 `(` ParenthesesAroundList"]),
        ("const A = [(1 + 2, 3];", &["1:18 `` MissingCloseParen { open: 11..12 }"]),
        ("const A = [(1 + 2), 3);", &["1:22 `` MissingCloseBracket { open: 10..11 }"]),
        (
            "const A = (1..2);",
            &[r#"1:13 `..` Expected { expected: CloseParen, found: Token("..") }"#],
        ),
        ("const A = (1 + 2\nconst B = 3;", &["1:17 `` MissingCloseParen { open: 10..11 }"]),
    ]);
}

#[test]
fn ranges() {
    check(&[
        ("const A = 1..;", &[r#"1:14 `;` Expected { expected: RangeEnd, found: Token(";") }"#]),
        ("const A = ..5;", &[r#"1:11 `..` Expected { expected: Value, found: Token("..") }"#]),
        (
            "const A = 1..2..3;",
            &[r#"1:15 `..` Expected { expected: EndOfValue, found: Token("..") }"#],
        ),
        ("const A = 1...3;", &["1:14 `.` UnexpectedCharacter { character: '.' }"]),
        (
            "const A = [1.., 2];",
            &[r#"1:15 `,` Expected { expected: RangeEnd, found: Token(",") }"#],
        ),
        ("const A = [..2];", &[r#"1:12 `..` Expected { expected: Value, found: Token("..") }"#]),
        ("const A = 1… 5;", &["1:12 `…` UnexpectedCharacter { character: '…' }"]),
        ("const A = 1.;", &[r#"1:11 `1.` MissingDigits { number: "1." }"#]),
    ]);
}

#[test]
fn constants() {
    check(&[
        ("const = 5;", &["1:1 `const` NotAllowedHere { item: Property, block: File }"]),
        ("const A;", &[r#"1:8 `` MissingValue { property: "A" }"#]),
        ("const A 5;", &[r#"1:8 `` MissingEquals { property: "A" }"#]),
        ("const 5;", &[r#"1:7 `5` Expected { expected: NameOf(Const), found: Token("5") }"#]),
        (
            "const int A = 5;",
            &[r#"1:7 `int` Expected { expected: NameOf(Const), found: Token("int") }"#],
        ),
        (
            "int A = 5;",
            &[r#"1:1 `int` UnknownItem { found: "int", suggestion: Some("const"), block: File }"#],
        ),
        (
            "let A = 5;",
            &[r#"1:1 `let` UnknownItem { found: "let", suggestion: Some("const"), block: File }"#],
        ),
        (
            "constant A = 5;",
            &[
                r#"1:1 `constant` UnknownItem { found: "constant", suggestion: Some("const"), block: File }"#,
            ],
        ),
        ("A = 5;", &["1:1 `A` NotAllowedHere { item: Property, block: File }"]),
        (
            "board B { const A = 5; }",
            &["1:11 `const` NotAllowedHere { item: Const, block: Board }"],
        ),
        (
            "const A-B = 5;",
            &[r#"1:7 `A-B` HyphenInName { name: "A-B", suggestion: "A_B", in_value: false }"#],
        ),
        ("const A = 1", &["1:12 `` MissingSemicolon"]),
        ("const A == 1;", &[r#"1:10 `=` Expected { expected: Value, found: Token("=") }"#]),
        ("const A : 1;", &["1:9 `:` UnexpectedCharacter { character: ':' }"]),
    ]);
}

#[test]
fn chips() {
    check(&[
        (
            "chip { driver = x; }",
            &[r#"1:6 `{` Expected { expected: NameOf(Chip), found: Token("{") }"#],
        ),
        (
            "chip C for i2c { driver = x; }",
            &[r#"1:8 `for` Expected { expected: OpenBrace, found: Token("for") }"#],
        ),
        ("chip C = mpu6050;", &[r#"1:8 `=` Expected { expected: OpenBrace, found: Token("=") }"#]),
        (
            "chip C returns int16 { id = 1; }",
            &[r#"1:8 `returns` Expected { expected: OpenBrace, found: Token("returns") }"#],
        ),
        (
            "chp C { driver = x; }",
            &[r#"1:1 `chp` UnknownItem { found: "chp", suggestion: Some("chip"), block: File }"#],
        ),
        (
            "sensor S returns uint8 { chip C { id = 1; } }",
            &["1:26 `chip` NotAllowedHere { item: Chip, block: Sensor }"],
        ),
        (
            "chip C { chip D { id = 1; } }",
            &["1:10 `chip` NotAllowedHere { item: Chip, block: Chip }"],
        ),
        (
            "chip C { link { baud = 1; } }",
            &["1:10 `link` NotAllowedHere { item: Link, block: Chip }"],
        ),
        (
            "chip C { reading r returns int8 { id = 1; } }",
            &["1:10 `reading` NotAllowedHere { item: Reading, block: Chip }"],
        ),
        (
            "chip C {\n    driver = x;\n\nboard B { }",
            &["2:16 `` MissingCloseBrace { block: Chip, open: 7..8 }"],
        ),
        (
            "chip C { sensor S returns int[3] { id = 1; }",
            &["1:45 `` MissingCloseBrace { block: Chip, open: 7..8 }"],
        ),
        (
            "chip C { sensor S returns unsigned int { id = 1; } }",
            &[r#"1:27 `unsigned int` TypeOfWords { name: "unsigned int" }"#],
        ),
    ]);
}

#[test]
fn drivers() {
    check(&[
        (
            "driver d i2c { a = 1; }",
            &[r#"1:10 `i2c` Expected { expected: Keyword("for"), found: Token("i2c") }"#],
        ),
        (
            "driver d fro i2c { a = 1; }",
            &[r#"1:10 `fro` Expected { expected: Keyword("for"), found: Token("fro") }"#],
        ),
        ("driver d\na = 1;\n}", &[r#"1:9 `` Expected { expected: OpenBrace, found: Token("a") }"#]),
        (
            "driver d { connection { a = 1; } }",
            &[r#"1:23 `{` Expected { expected: NameOf(Connection), found: Token("{") }"#],
        ),
        (
            "driver d { connection bus i2c { a = 1; } }",
            &[r#"1:27 `i2c` Expected { expected: Keyword("for"), found: Token("i2c") }"#],
        ),
        (
            "driver d { connection for i2c { a = 1; } }",
            &[r#"1:23 `for` Expected { expected: NameOf(Connection), found: Token("for") }"#],
        ),
    ]);
}

#[test]
fn readings_and_commands() {
    check(&[
        (
            "driver d { reading r int8 { a = 1; } }",
            &[r#"1:22 `int8` Expected { expected: Keyword("returns"), found: Token("int8") }"#],
        ),
        (
            "driver d { reading returns int8 { a = 1; } }",
            &[r#"1:20 `returns` Expected { expected: NameOf(Reading), found: Token("returns") }"#],
        ),
        (
            "driver d { reading r accepts int8 { a = 1; } }",
            &[
                r#"1:22 `accepts` Expected { expected: Keyword("returns"), found: Token("accepts") }"#,
            ],
        ),
        (
            "driver d { command c returns int8 { a = 1; } }",
            &[
                r#"1:22 `returns` Expected { expected: Keyword("accepts"), found: Token("returns") }"#,
            ],
        ),
        (
            "driver d { readng r returns int8 { a = 1; } }",
            &[
                r#"1:12 `readng` UnknownItem { found: "readng", suggestion: Some("reading"), block: Driver }"#,
            ],
        ),
        (
            "driver d { sensor r returns int8 { a = 1; } }",
            &["1:12 `sensor` NotAllowedHere { item: Sensor, block: Driver }"],
        ),
        (
            "driver d { prefer a = 1; }",
            &["1:12 `prefer` NotAllowedHere { item: Rule, block: Driver }"],
        ),
        (
            "driver d { reading r returns int8 { command c accepts int8 { a = 1; } } }",
            &["1:37 `command` NotAllowedHere { item: Command, block: Reading }"],
        ),
        (
            "reading r returns int8 { a = 1; }",
            &["1:1 `reading` NotAllowedHere { item: Reading, block: File }"],
        ),
        (
            "connection c for i2c { a = 1; }",
            &["1:1 `connection` NotAllowedHere { item: Connection, block: File }"],
        ),
        (
            "driver d { init = [[1, 2], 5 ms, [3; x = 1; }",
            &["1:36 `` MissingCloseBracket { open: 33..34 }"],
        ),
    ]);
}

#[test]
fn other_languages() {
    check(&[
        ("board B { id := 5; }", &["1:14 `:` UnexpectedCharacter { character: ':' }"]),
        ("board B { id -> 5; }", &["1:15 `>` UnexpectedCharacter { character: '>' }"]),
        ("board B { id += 5; }", &[r#"1:13 `` MissingEquals { property: "id" }"#]),
        (
            "board B { label = 'front'; }",
            &["1:19 `'front'` UnexpectedCharacter { character: '\\'' }"],
        ),
        (
            "board B { label = “front”; }",
            &["1:19 `“front”` UnexpectedCharacter { character: '“' }"],
        ),
        ("board B { x = 1 # one\n }", &["1:17 `# one` UnexpectedCharacter { character: '#' }"]),
        ("board B { label = don't; }", &["1:22 `'` UnexpectedCharacter { character: '\\'' }"]),
    ]);
}
