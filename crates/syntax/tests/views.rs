//! The typed views over correct files, and the shape of the tree.

use sensedsl_syntax::ast::{
    AstNode, BoardSource, Direction, Item, Magnitude, Name, Operator, Rule, Sign, Type, Value,
};
use sensedsl_syntax::{Unit, parse};

const FIG2: &str = include_str!("../../../examples/fig2.sense");

const EXTENDED: &str = r#"use "drivers.sense";
spare board Rover on "tables/mine.csv" {
    link {
        transport = usb;
        baud = 115_200;
    }
    reserve PA0, PA1;
    release PD12;
    allow W0301 "known \u{b5}\n";
    label = "a \"b\" \\";
    sensor Front returns uint8[4] {
        driver = srf08;
        delay = 60ms;
        prefer side = left;
        avoid pin = PA0;
        trigger = [0x00, 0x51, +1, [a, "b"]];
        offset = -1.051e-3;
        mask = 0b1010;
        clock = 100 kHz;
        top = 18446744073709551615;
    }
    actuator on accepts float32 {}
}
board B on STM32F407VGT6 {}
driver srf08 for i2c {
    sensor = board;
}
actuator Free accepts bool {}
"#;

/// A value as the views see it, if it is complete.
fn describe(value: &Value) -> Option<String> {
    Some(match value {
        Value::Number(number) => {
            let sign = number.sign().map_or("", |sign| if sign == Sign::Plus { "+" } else { "-" });
            let unit = number.unit().map_or(String::new(), |unit| format!(" {unit:?}"));
            match number.magnitude()? {
                Magnitude::Integer(integer) => format!("{sign}{integer}{unit}"),
                Magnitude::Float(float) => format!("{sign}{float:e}{unit}"),
            }
        }
        Value::Name(name) => format!("name {}", name.name()?.text()),
        Value::String(string) => format!("{:?}", string.literal()?.value()),
        Value::List(list) => {
            let values: Option<Vec<_>> = list.values().map(|value| describe(&value)).collect();
            format!("{:?}", values?)
        }
        Value::Signed(signed) => {
            let sign = if signed.sign()? == Sign::Plus { "+" } else { "-" };
            format!("{sign}<{}>", describe(&signed.value()?)?)
        }
        Value::Paren(paren) => format!("({})", describe(&paren.value()?)?),
        Value::Binary(binary) => {
            let operator = match binary.operator()? {
                Operator::Add => '+',
                Operator::Subtract => '-',
                Operator::Multiply => '*',
                Operator::Divide => '/',
            };
            format!("<{} {operator} {}>", describe(&binary.left()?)?, describe(&binary.right()?)?)
        }
        Value::Range(range) => {
            format!("{} to {}", describe(&range.first()?)?, describe(&range.last()?)?)
        }
    })
}

/// The kinds of nodes, as the tree names them.
fn kinds(nodes: impl Iterator<Item = impl AstNode>) -> String {
    let kinds = nodes.map(|node| format!("{:?}", node.syntax().kind()));
    kinds.collect::<Vec<_>>().join(" ")
}

#[test]
fn the_papers_example() {
    let parsed = parse(FIG2);
    assert_eq!(parsed.errors(), &[]);
    let board = parsed.ast().boards().next().expect("one board");
    assert_eq!(board.name().expect("a name").text(), "STM32F4DiscoveryBoard");
    assert!(!board.is_spare() && board.on().is_none());
    let devices: Vec<String> = board
        .devices()
        .map(|device| {
            let properties: Vec<String> = device
                .properties()
                .map(|p| {
                    format!(
                        "{}={}",
                        p.name().expect("a name").text(),
                        p.value().and_then(|value| describe(&value)).expect("a value")
                    )
                })
                .collect();
            let scalar = device.ty().and_then(|ty| ty.scalar()).expect("a type");
            let name = device.name().expect("a name");
            format!(
                "{:?} {} {}: {}",
                device.direction(),
                name.text(),
                scalar.text(),
                properties.join(", ")
            )
        })
        .collect();
    assert_eq!(
        devices,
        [
            "Some(Sensor) IRFront uint16: id=17, type=name analog",
            "Some(Sensor) IRFrontRight uint16: id=18, type=name analog, delay=60",
            "Some(Sensor) USRear uint8: id=19, type=name i2c, address=230, delay=40, prio=+2",
            "Some(Sensor) WheelEncoder uint32: id=20, type=name icu",
        ]
    );
}

#[test]
fn every_construct_has_its_view() {
    let parsed = parse(EXTENDED);
    assert_eq!(parsed.errors(), &[]);
    let file = parsed.ast();
    assert_eq!(kinds(file.items()), "Use Board Board Driver Device");
    assert_eq!(file.uses().next().and_then(|u| u.path()).expect("a path").value(), "drivers.sense");

    let boards: Vec<_> = file.boards().collect();
    assert!(boards[0].is_spare() && !boards[1].is_spare());
    assert!(matches!(boards[0].on(), Some(BoardSource::File(f)) if f.value() == "tables/mine.csv"));
    assert!(matches!(boards[1].on(), Some(BoardSource::Name(n)) if n.text() == "STM32F407VGT6"));
    assert_eq!(kinds(boards[0].items()), "Link Reserve Release Allow Property Device Device");
    assert_eq!(boards[0].links().next().expect("a link").properties().count(), 2);

    let driver = file.drivers().next().expect("a driver");
    assert_eq!(driver.name().expect("a name").text(), "srf08");
    assert_eq!(driver.kind().expect("a kind").text(), "i2c");
    let property = driver.properties().next().expect("a property");
    assert_eq!(property.name().expect("a name").text(), "sensor");
    assert_eq!(property.value().and_then(|value| describe(&value)).expect("a value"), "name board");
}

const PARTS: &str = r#"
const SIDE = 20;
chip Free { driver = x; }
sensor Loose returns uint8[CELLS] {}
board Rover {
    sensor Front returns uint8 { id = 1; }
    chip Imu {
        driver = mpu6050;
        prefer side = left;
        connection motion { pin = PA0; }
        sensor Rate returns int16[3] { reading = rate; }
    }
    actuator Last accepts bool {}
}
driver mpu6050 {
    part = "InvenSense MPU-6050";
    connection bus for i2c { address = 0x68; }
    connection motion for digital {}
    reading rate returns int16[3] { via = bus; }
    command wake accepts bool { via = bus; }
}
driver lm75 for i2c { reading temperature returns int16 { bits = 15..5; } }
"#;

#[test]
fn chips_and_drivers_with_readings() {
    let parsed = parse(PARTS);
    assert_eq!(parsed.errors(), &[]);
    let file = parsed.ast();
    let constant = file.constants().next().expect("a constant");
    assert_eq!(constant.name().expect("a name").text(), "SIDE");
    assert_eq!(constant.value().and_then(|value| describe(&value)).as_deref(), Some("20"));
    let part = |item: Item| match item {
        Item::Device(device) => format!("device {}", device.name().expect("a name").text()),
        Item::Chip(chip) => format!("chip {}", chip.name().expect("a name").text()),
        Item::Controller(one) => format!("controller {}", one.name().expect("a name").text()),
    };
    assert_eq!(file.parts().map(part).collect::<Vec<_>>(), ["chip Free", "device Loose"]);
    let length = |ty: Type| {
        let name = ty.length_name().map(|name| name.text().to_owned());
        (ty.is_array(), ty.length().map(|length| length.0), name)
    };
    let loose = file.devices().next().and_then(|device| device.ty()).expect("a type");
    assert_eq!(length(loose), (true, None, Some("CELLS".to_owned())));

    let board = file.boards().next().expect("a board");
    let parts: Vec<_> = board.parts().map(part).collect();
    assert_eq!(parts, ["device Front", "chip Imu", "device Last"]);
    let chip = board.chips().next().expect("a chip");
    assert_eq!(kinds(chip.items()), "Property Prefer Connection Device");
    let connection = chip.connections().next().expect("a connection");
    assert_eq!(connection.name().expect("a name").text(), "motion");
    assert!(connection.kind().is_none());
    assert_eq!((connection.properties().count(), chip.properties().count()), (1, 1));
    assert_eq!((chip.rules().count(), chip.devices().count()), (1, 1));

    let drivers: Vec<_> = file.drivers().collect();
    assert!(drivers[0].kind().is_none());
    assert_eq!(drivers[1].kind().expect("a kind").text(), "i2c");
    assert_eq!(kinds(drivers[0].items()), "Property Connection Connection Reading Command");
    let kinds: Vec<_> = drivers[0].connections().filter_map(|one| one.kind()).collect();
    assert_eq!(kinds.iter().map(Name::text).collect::<Vec<_>>(), ["i2c", "digital"]);
    let reading = drivers[0].readings().next().expect("a reading");
    assert_eq!(reading.name().expect("a name").text(), "rate");
    assert_eq!(length(reading.ty().expect("a type")), (true, Some(3), None));
    assert_eq!(reading.properties().count(), 1);
    let command = drivers[0].commands().next().expect("a command");
    assert_eq!(command.name().expect("a name").text(), "wake");
    assert_eq!(command.ty().and_then(|ty| ty.scalar()).expect("a type").text(), "bool");
    assert_eq!((command.properties().count(), drivers[0].properties().count()), (1, 1));
}

#[test]
fn what_is_computed() {
    let cases = [
        ("1 + 2 * 3 - 4", "<<1 + <2 * 3>> - 4>"),
        ("(1 + 2) * 3 / 4", "<<(<1 + 2>) * 3> / 4>"),
        ("5 -3", "<5 - 3>"),
        ("5-3", "<5 - 3>"),
        ("5 ms-3us", "<5 Milliseconds - 3 Microseconds>"),
        ("-5 ms", "-5 Milliseconds"),
        ("- 5 * 2", "<-5 * 2>"),
        ("1 - -2", "<1 - -2>"),
        ("-N", "-<name N>"),
        ("+-(N)", "+<-<(name N)>>"),
        ("--1", "-<-1>"),
        ("N - 5", "<name N - 5>"),
        ("N -5", "<name N - 5>"),
        ("3.3 / 4095", "<3.3e0 / 4095>"),
        ("1..5", "1 to 5"),
        ("3 V..5 V", "3 Volts to 5 Volts"),
        ("-5..-3", "-5 to -3"),
        ("A .. B + 1", "name A to <name B + 1>"),
        ("(7)", "(7)"),
        ("[1..2, -N, [3 * 4, 5]]", r#"["1 to 2", "-<name N>", "[\"<3 * 4>\", \"5\"]"]"#),
        ("60\n    + 1", "<60 + 1>"),
    ];
    for (text, expected) in cases {
        let parsed = parse(&format!("const A = {text};"));
        assert_eq!(parsed.errors(), &[], "{text}");
        let value = parsed.ast().constants().next().and_then(|one| one.value()).expect("a value");
        assert_eq!(describe(&value).as_deref(), Some(expected), "{text}");
        assert_eq!(
            value.range(),
            sensedsl_syntax::TextRange::at(10.into(), (text.len() as u32).into())
        );
    }
    // One operand of a broken operation is not mistaken for the other.
    let broken = parse("const A = 1 + ; const B = ..2;").ast();
    let values: Vec<Value> = broken.constants().filter_map(|one| one.value()).collect();
    let (Value::Binary(sum), Value::Range(range)) = (&values[0], &values[1]) else {
        panic!("{values:?}")
    };
    assert!(sum.left().is_some() && sum.right().is_none());
    assert!(range.first().is_none() && range.last().is_some());
}

#[test]
fn rules() {
    let parsed = parse(EXTENDED);
    let board = parsed.ast().boards().next().expect("a board");
    let device = board.devices().next().expect("a device");
    let rules: Vec<String> = board
        .rules()
        .chain(device.rules())
        .map(|rule| {
            let names = |names: Vec<Name>| {
                names.iter().map(|name| name.text().to_owned()).collect::<Vec<_>>().join(" ")
            };
            match rule {
                Rule::Reserve(rule) => format!("reserve {}", names(rule.names().collect())),
                Rule::Release(rule) => format!("release {}", names(rule.names().collect())),
                Rule::Allow(rule) => {
                    let reason = rule.reason().expect("a reason").value();
                    format!("allow {} {reason:?}", rule.code().expect("a code").text())
                }
                Rule::Prefer(rule) => format!("prefer {}", rule.property().expect("it").syntax()),
                Rule::Avoid(rule) => format!("avoid {}", rule.property().expect("it").syntax()),
            }
        })
        .collect();
    assert_eq!(
        rules,
        [
            "reserve PA0 PA1",
            "release PD12",
            "allow W0301 \"known µ\\n\"",
            "prefer side = left;",
            "avoid pin = PA0;",
        ]
    );
}

#[test]
fn values() {
    let parsed = parse(EXTENDED);
    let board = parsed.ast().boards().next().expect("a board");
    let label = board.properties().next().and_then(|property| property.value()).expect("a value");
    assert_eq!(describe(&label).as_deref(), Some(r#""a \"b\" \\""#));
    let device = board.devices().next().expect("a device");
    let values: Vec<String> = device
        .properties()
        .map(|property| property.value().and_then(|value| describe(&value)).expect("a value"))
        .collect();
    assert_eq!(
        values,
        [
            "name srf08",
            "60 Milliseconds",
            r#"["0", "81", "+1", "[\"name a\", \"\\\"b\\\"\"]"]"#,
            "-1.051e-3",
            "10",
            "100 Kilohertz",
            "18446744073709551615",
        ]
    );
    let ty = device.ty().expect("a type");
    assert!(ty.is_array());
    let (length, range) = ty.length().expect("a length");
    assert_eq!((length, &EXTENDED[range]), (4, "4"));
    let actuator = board.devices().nth(1).expect("a device");
    assert_eq!(actuator.direction(), Some(Direction::Actuator));
    assert_eq!(actuator.name().expect("a name").text(), "on");
    assert_eq!(Unit::from_name("kHz"), Some(Unit::Kilohertz));
}

#[test]
fn ranges_leave_out_the_trivia() {
    let text = "// a\nsensor X returns uint8 { // b\n  /* c */ id = 17 ms; // d\n} // e\n";
    let device = parse(text).ast().devices().next().expect("a device");
    assert!(text[device.range()].starts_with("sensor") && text[device.range()].ends_with('}'));
    let property = device.properties().next().expect("a property");
    assert_eq!(&text[property.range()], "id = 17 ms;");
    assert_eq!(&text[property.value().expect("a value").range()], "17 ms");
}

#[test]
fn trees() {
    let texts = [
        ("keywords_as_names", "board on on on { sensor returns returns uint8[2] { driver = x; } }"),
        ("comments", "// a\nuse /* b */ \"c\"; // d\n"),
        ("numbers_and_lists", "driver d for for { a = [+1, -0.5 ms, [x, \"y\"]]; }"),
        (
            "rules",
            "board b { reserve A, B; release A; allow W1 \"r\"; prefer a = 1; avoid a = 2; }",
        ),
        ("chips", "chip c { connection i { a = 1; } sensor s returns uint8[N] {} }"),
        ("drivers", "driver d { connection i for i2c {} reading r returns int8 {} }"),
        ("expressions", "const A = -(1 + N * 2 ms)..5 - -3;"),
        ("broken_head", "sensor 2nd return [ { id = 1; }"),
        ("broken_statements", "board b { id 17; x = ; y = 1 2 { 3 }; @ z = 4 }"),
        ("broken_blocks", "board b { foo bar { baz = 1; } sensor s returns uint8 {"),
    ];
    for (name, text) in texts {
        insta::assert_snapshot!(name, format!("{text}\n\n{:#?}", parse(text).syntax()));
    }
}
