//! The canonical layout, case by case.

use sensedsl_syntax::{format, parse};

const FIG2: &str = include_str!("../../../examples/fig2.sense");

fn check(text: &str, expected: &str) {
    assert_eq!(format(text).as_deref(), Ok(expected), "{text:?}");
    assert_eq!(format(expected).as_deref(), Ok(expected), "laid out again");
}

#[test]
fn the_papers_example_is_laid_out_already() {
    check(FIG2, FIG2);
    let squeezed: Vec<&str> = FIG2.lines().map(str::trim).collect();
    check(&squeezed.join("\n"), FIG2);
    check(&FIG2.replace('\n', "\r\n"), FIG2);
    check(&format!("\u{feff}\n\n{FIG2}\n\n"), FIG2);
}

#[test]
fn statements_and_blocks() {
    check("", "");
    check(" \n\t\n", "");
    check("board A{}", "board A {}\n");
    check(
        "spare board A on\"t.csv\"{link{transport=usb;}prio=+ 2;}",
        "spare board A on \"t.csv\" {\n    link { transport = usb; }\n    prio = +2;\n}\n",
    );
    check(
        "sensor X returns uint8 [ 4 ] {trigger=[ 0x00,0x51 , - 1 ];a=[];b=[[1],[2 ]];}",
        "sensor X returns uint8[4] { trigger = [0x00, 0x51, -1]; a = []; b = [[1], [2]]; }\n",
    );
    check(
        "board A {reserve PA0,PA1 ;prefer side=left;allow W0301\"why\";delay=60ms;clock=1_000kHz;}",
        "board A {\n    reserve PA0, PA1;\n    prefer side = left;\n    allow W0301 \"why\";\n    delay = 60 ms;\n    clock = 1_000 kHz;\n}\n",
    );
}

#[test]
fn what_is_computed() {
    let value = |text: &str, expected: &str| {
        check(&format!("const A={text};"), &format!("const A = {expected};\n"));
    };
    value("1+2*3 -4/ 5", "1 + 2 * 3 - 4 / 5");
    value("( 1+N )* -( 2 )", "(1 + N) * -(2)");
    value("5-3", "5 - 3");
    value("5 ms- -3us", "5 ms - -3 us");
    value("- - N", "--N");
    value("1 .. 5", "1..5");
    value("3V .. 5 V", "3 V..5 V");
    value("- 5 .. -3", "-5..-3");
    value("N .. N+1", "N .. N + 1");
    value("(N) .. (N+1)", "(N)..(N + 1)");
    value("[1..2,( 3 ),- N,[4*5]]", "[1..2, (3), -N, [4 * 5]]");
    value("1/ /* a */2", "1 / /* a */ 2");
    value("1 /* a */ .. /* b */ 2", "1 /* a */.. /* b */ 2");
    value("( /* a */ 1 /* b */ )", "(/* a */ 1 /* b */)");
    value("1 + // a\n2", "1 + // a\n    2");
}

#[test]
fn chips_and_drivers() {
    check(
        "chip A{driver=x;connection c{a=PA0;}sensor S returns uint8 [ N ]{id=1;}}",
        "chip A {\n    driver = x;\n    connection c { a = PA0; }\n    sensor S returns uint8[N] { id = 1; }\n}\n",
    );
    check(
        "driver d{connection c for i2c{}reading r returns int8{bits=15 .. 4;}command w accepts bool{}}",
        "driver d {\n    connection c for i2c {}\n    reading r returns int8 { bits = 15..4; }\n    command w accepts bool {}\n}\n",
    );
}

#[test]
fn a_block_on_one_line_stays_there_where_it_fits() {
    check("sensor X returns bool {id=1;\n}", "sensor X returns bool {\n    id = 1;\n}\n");
    check("sensor X\nreturns bool {id=1;}", "sensor X returns bool {\n    id = 1;\n}\n");
    check("sensor X returns bool {}", "sensor X returns bool {}\n");
    check("sensor X returns bool {id=1;/*a*/}", "sensor X returns bool {\n    id = 1; /*a*/\n}\n");
    let long = |letters: usize| {
        let label = "a".repeat(letters - "sensor X returns bool { label = \"\"; }".len());
        format!("sensor X returns bool {{ label = \"{label}\"; }}\n")
    };
    check(&long(100), &long(100));
    let wrapped = long(101).replace("{ ", "{\n    ").replace("; }", ";\n}");
    check(&long(101), &wrapped);
}

#[test]
fn blank_lines() {
    check(
        "\n\nuse \"a\";\n\n\n\nuse \"b\";\ndriver D for i2c {\n\n\na = 1;\n\n\nb = 2;\n\n\n}\n\n\n",
        "use \"a\";\n\nuse \"b\";\ndriver D for i2c {\n    a = 1;\n\n    b = 2;\n}\n",
    );
}

#[test]
fn comments_keep_their_place() {
    check(
        "//a\n\n\n//b\nboard A { // c\n// d\n\n// e\nid=1;// f  \n/* g */ id=2; /* h */ id=3;\n\n\n// i\n} // j\n// k",
        "//a\n\n//b\nboard A { // c\n    // d\n\n    // e\n    id = 1; // f\n    /* g */ id = 2; /* h */\n    id = 3;\n\n    // i\n} // j\n// k\n",
    );
    check(
        "/* a */\nboard A { /* b */ /* c */ id = 1; }",
        "/* a */\nboard A { /* b */ /* c */\n    id = 1;\n}\n",
    );
    check(
        "board A {\n/* b */\n\nid =\n\n\n// c\n\n17;\n}",
        "board A {\n    /* b */\n\n    id =\n        // c\n        17;\n}\n",
    );
    // Within a statement.
    check(
        "board A {\nid = // why\n17;\na = /* b */ 17 /* c */ ;\nl = [ /* d */ 1, // e\n2\n// f\n];\n}",
        "board A {\n    id = // why\n        17;\n    a = /* b */ 17 /* c */;\n    l = [/* d */ 1, // e\n        2\n        // f\n        ];\n}\n",
    );
    // The lines of a comment stay as they are.
    check("board A {\r\n/* a\r\n   b  \r\n */\r\n}", "board A {\n    /* a\n   b\n */\n}\n");
    check("board A { /* empty */ }", "board A { /* empty */\n}\n");
}

#[test]
fn a_text_with_mistakes_is_returned_with_them() {
    let text = "board A { id = 1 }";
    assert_eq!(format(text), Err(parse(text).errors().to_vec()));
}
