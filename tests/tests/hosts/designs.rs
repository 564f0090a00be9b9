//! The designs that each host is generated for.

use std::collections::BTreeMap;

use sensedsl_job::host::HostBoard;
use sensedsl_model::design::Presentation;
use sensedsl_wire::{Checksum, Direction, Item, ScalarType, Schema, ValueType};

/// A schema of items such as `17 sensor IRFront uint16`.
pub(crate) fn schema(checksum: Checksum, items: &[&str]) -> Schema {
    Schema { checksum, stamp: false, items: items.iter().map(|line| item(line)).collect() }
}

/// A board from lines such as `17 sensor IRFront uint16`.
pub(crate) fn board(name: &str, checksum: Checksum, items: &str) -> HostBoard {
    let items: Vec<&str> = items.lines().filter(|line| !line.trim().is_empty()).collect();
    HostBoard {
        name: name.into(),
        schema: schema(checksum, &items),
        baud: 115_200,
        silence_ms: None,
        presentations: BTreeMap::new(),
        cycles_ms: BTreeMap::new(),
    }
}

pub(crate) fn item(line: &str) -> Item {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [id, direction, name, value] = words[..] else { panic!("no item: {line}") };
    let (scalar, length) = match value.split_once('[') {
        None => (value, None),
        Some((scalar, length)) => {
            (scalar, Some(length.trim_end_matches(']').parse::<u16>().unwrap()))
        }
    };
    Item {
        id: id.parse().unwrap(),
        name: name.into(),
        direction: if direction == "sensor" { Direction::Sensor } else { Direction::Actuator },
        value: ValueType { scalar: ScalarType::from_name(scalar).unwrap(), length },
    }
}

/// The paper's Fig. 2.
pub(crate) fn fig2() -> Vec<HostBoard> {
    let items = "17 sensor IRFront uint16
        18 sensor IRFrontRight uint16
        19 sensor USRear uint8
        20 sensor WheelEncoder uint32";
    vec![board("STM32F4DiscoveryBoard", Checksum::None, items)]
}

/// Each type as a single value and as an array, in both directions, with every value scaled.
pub(crate) fn all_types() -> Vec<HostBoard> {
    let mut lines = String::new();
    for (index, scalar) in ScalarType::ALL.into_iter().enumerate() {
        lines.push_str(&format!("{} sensor S{index} {scalar}\n", index + 1));
        lines.push_str(&format!("{} sensor A{index} {scalar}[3]\n", index + 31));
        lines.push_str(&format!("{} actuator T{index} {scalar}\n", index + 61));
        lines.push_str(&format!("{} actuator B{index} {scalar}[2]\n", index + 91));
    }
    let mut board = board("Everything", Checksum::Crc16, &lines);
    for (index, item) in board.schema.items.iter().enumerate().skip(3) {
        let sensor = item.direction == Direction::Sensor;
        let shown = Presentation {
            quantity: (index % 3 == 0).then(|| "cm".into()),
            scale: (index % 2 == 0).then_some(0.5),
            offset: (index % 4 == 1).then_some(-3.0),
            min: (index % 5 == 4 && sensor).then_some(-1e9),
            max: (index % 5 == 3 && sensor).then_some(1e9),
            curve: if index % 7 == 6 {
                vec![(-1e18, -4.5), (0.0, 0.0), (1e18, 5e-3)]
            } else {
                Vec::new()
            },
            ..Presentation::default()
        };
        board.presentations.insert(item.id, shown);
        if index % 2 == 0 {
            board.cycles_ms.insert(item.id, 40);
        }
    }
    vec![board]
}

/// Names that have a meaning in C++, in system headers or in the generated files, and texts that
/// try to break out of their literal or comment.
pub(crate) fn hostile() -> Vec<HostBoard> {
    let names = "default int class namespace and ECHO EOF linux NULL assert errno stdin B0 CR1 \
                 sense sensedsl std core odcore cluon main id name raw value schema Decoder \
                 Commands Hello ID ShortName LongName getRaw setRaw setValue refused shown isRaw is_raw accept toString m_raw \
                 _leading __double default_ size_t uint8_t string Handler Message Board Publisher \
                 Item Serial Report decoder handler call publish command send print text entry \
                 message bytes out begin WIRE_ID COUNT scaled scaling curve latest board Größe µ";
    let mut lines = String::new();
    for (index, name) in names.split_whitespace().enumerate() {
        let direction = if index % 2 == 0 { "sensor" } else { "actuator" };
        lines.push_str(&format!("{} {direction} {name} uint16\n", index + 1));
    }
    let mut board = board("class", Checksum::None, &lines);
    let texts =
        ["*/ int x; /*", "ends with \\", "a\nint y;", "\"; }", "%s%n", "??/", "°C", "{{ x }}"];
    for (index, item) in board.schema.items.iter().enumerate() {
        let text = texts[index % texts.len()].to_owned();
        let shown = Presentation {
            label: Some(text.clone()),
            quantity: Some(text),
            scale: Some([0.1, 1e-300, -1e300, 3.0][index % 4]),
            curve: if index % 2 == 0 {
                vec![(-1e300, 1e-300), (1e-300, -1e300)]
            } else {
                Vec::new()
            },
            ..Presentation::default()
        };
        board.presentations.insert(item.id, shown);
    }
    vec![board]
}

/// Three boards: one with checksum, stamps and a silence limit, one that only listens, one with
/// neither sensor nor actuator.
pub(crate) fn several_boards() -> Vec<HostBoard> {
    let mut front =
        board("Front", Checksum::Crc16, "1 sensor Left uint16\n2 actuator Steering int16");
    front.schema.stamp = true;
    front.silence_ms = Some(500);
    vec![
        front,
        board("Rear", Checksum::None, "3 actuator Lamps bool[4]"),
        board("Spare", Checksum::None, ""),
    ]
}

/// Every design, with a name for its folders.
pub(crate) fn all() -> Vec<(&'static str, Vec<HostBoard>)> {
    vec![
        ("fig2", fig2()),
        ("all-types", all_types()),
        ("hostile", hostile()),
        ("several-boards", several_boards()),
    ]
}
