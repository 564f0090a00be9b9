//! Messages of several devices: tables of a configuration in, messages with their conversions or mistakes out.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use sensedsl_diagnostics::{Diagnostic, SourceMap};
use sensedsl_host::Board;
use sensedsl_sinks::config::{read, sample};
use sensedsl_sinks::{Config, Plan};

const BOARDS: &str = r#"{ "version": 2, "boards": [ { "name": "Rover", "hash": "0xad540e3c", "checksum": "none", "items": [
    { "id": 17, "name": "Lat", "direction": "sensor", "type": "int32", "scale": 0.001, "quantity": "deg" },
    { "id": 18, "name": "Lon", "direction": "sensor", "type": "int32", "scale": 0.001, "quantity": "mrad" },
    { "id": 19, "name": "Fire", "direction": "sensor", "type": "bool" },
    { "id": 20, "name": "Shake", "direction": "sensor", "type": "int16", "length": 3, "quantity": "g" },
    { "id": 21, "name": "Volts", "direction": "sensor", "type": "uint16", "quantity": "mV" },
    { "id": 22, "name": "Bare", "direction": "sensor", "type": "uint16" },
    { "id": 23, "name": "Hot", "direction": "sensor", "type": "uint16", "quantity": "degF" } ] } ] }"#;

fn boards() -> Vec<Board> {
    Board::all_of_json(BOARDS).unwrap()
}

fn taken(text: &str) -> (Config, Vec<Diagnostic>) {
    let mut sources = SourceMap::default();
    let file = sources.add("sinks.toml", text);
    read(file, text, &boards())
}

const FIX: &str =
    "[messages.fix]\ntype = \"NavSatFix\"\nlatitude = \"Lat\"\nlongitude = \"Rover/Lon\"\n";

/// What is wrong, its code, its line, words of the message, and of the whole. `FIX` is a table that is right so far.
const MISTAKES: &[(&str, &str, usize, &str, &str)] = &[
    ("messages = 1", "E0560", 1, "`messages` must be tables", "[messages.pad]"),
    ("[mesages.fix]", "E0560", 1, "has no `mesages`", "`messages`?"),
    ("messages.fix = 1", "E0560", 1, "must be a table", "[messages.fix]"),
    ("[messages.fix]\nlatitude = \"Lat\"", "E0560", 1, "has no `type`", "NavSatFix"),
    ("[messages.fix]\ntype = \"NavSatFx\"", "E0560", 2, "as `NavSatFx`", "`NavSatFix`?"),
    ("[messages.fix]\ntype = \"Image\"", "E0560", 2, "as `Image`", "BatteryState, Joy"),
    ("[messages.fix]\ntype = 5", "E0560", 2, "no message", "JointState"),
    (
        "[messages.\"a b\"]\ntype = \"Joy\"\naxes = [\"Bare\"]",
        "E0564",
        1,
        "`a b` is not",
        "letters",
    ),
    ("FIXaltitud = \"Bare\"", "E0560", 5, "`NavSatFix` of", "`altitude`?"),
    ("FIXnames = [\"a\"]", "E0560", 5, "has no `names`", "it has latitude"),
    ("FIXframe = 5", "E0560", 5, "`frame` must be a short text", "name"),
    ("FIXaltitude = \"Volts\"", "E0560", 5, "`Volts` is in mV, and `altitude` needs m", "scale"),
    ("FIXaltitude = \"Bare\"", "E0560", 5, "`Bare` is a bare number", "[devices."),
    ("FIXaltitude = \"Fire\"", "E0560", 5, "takes numbers", "another device"),
    ("FIXaltitude = \"Rover/Latt\"", "E0561", 5, "`Rover/Latt`", "`Rover/Lat`?"),
    ("FIXaltitude = [\"Lat\"]", "E0560", 5, "must be the name of a device", "Light"),
    ("FIXaltitude = \"Shake\"", "E0560", 5, "an array of 3", "`Shake[0]` to `Shake[2]`"),
    ("FIXaltitude = \"Shake[3]\"", "E0560", 5, "an array of 3", "`Shake[2]`"),
    ("FIXaltitude = \"Shake[-1]\"", "E0560", 5, "an array of 3", "`Shake[2]`"),
    ("FIXaltitude = \"Bare[0]\"", "E0560", 5, "`Bare` is no array", "write `Bare`"),
    (
        "[messages.fix]\ntype = \"NavSatFix\"\nlatitude = \"Lat\"",
        "E0560",
        1,
        "has no `longitude`",
        "devices",
    ),
    ("[messages.pad]\ntype = \"Joy\"", "E0560", 1, "has no `axes` or `buttons`", "devices"),
    (
        "[messages.pad]\ntype = \"Joy\"\naxes = \"Bare\"",
        "E0560",
        3,
        "must be a list",
        "[\\\"Rover/Left",
    ),
    ("[messages.pad]\ntype = \"Joy\"\naxes = [5]", "E0560", 3, "made of names", "Rover/Lat"),
    (
        "[messages.pad]\ntype = \"Joy\"\nbuttons = [\"Bare\"]",
        "E0560",
        3,
        "what is a `bool`",
        "another",
    ),
    (
        "[messages.pad]\ntype = \"Joy\"\naxes = [\"Fire\"]",
        "E0560",
        3,
        "`axes` takes numbers",
        "another",
    ),
    (
        "[messages.imu]\ntype = \"Imu\"\nlinear_acceleration = \"Bare\"",
        "E0560",
        3,
        "no array",
        "three",
    ),
    (
        "[messages.imu]\ntype = \"Imu\"\nlinear_acceleration = [\"Bare\"]",
        "E0560",
        3,
        "three numbers",
        "Shake",
    ),
    (
        "[messages.imu]\ntype = \"Imu\"\nangular_velocity = \"Shake\"",
        "E0560",
        3,
        "needs rad/s",
        "unit",
    ),
    (
        "[messages.b]\ntype = \"BatteryState\"\nvoltage = \"Volts\"\npercentage = \"Volts\"",
        "E0560",
        4,
        "in %",
        "unit",
    ),
    (
        "[messages.legs]\ntype = \"JointState\"\nposition = [\"Lat\", \"Lon\"]\nnames = [\"a\"]",
        "E0560",
        1,
        "`names` has 1 entries, and `position` has 2",
        "leave it out",
    ),
    (
        "[devices.Bare]\ntopic = \"pad\"\n[messages.pad]\ntype = \"Joy\"\naxes = [\"Bare\"]",
        "E0564",
        3,
        "have the topic `pad`",
        "topic",
    ),
];

/// Each is told with what is wrong, where it stands, and what helps.
#[test]
fn mistakes_are_told_with_their_place() {
    for &(text, code, line, message, help) in MISTAKES {
        let text = text.replace("FIX", FIX);
        let (_, reported) = taken(&text);
        let first = reported.first().unwrap_or_else(|| panic!("{text}: taken"));
        assert_eq!(first.code.name(), code, "{text}: {first:?}");
        assert!(first.message.contains(message), "{text}: {}", first.message);
        let helps = format!("{first:?}");
        assert!(helps.contains(help), "{text}: {helps}");
        let at = first.primary.span.range().start;
        assert_eq!(text[..at].matches('\n').count() + 1, line, "{text}: {first:?}");
    }
}

#[test]
fn units_become_those_of_the_definitions() {
    let (config, reported) = taken(
        "[messages.fix]\ntype = \"NavSatFix\"\nlongitude = \"Lon\"\nlatitude = \"Lat\"\naltitude = \"Bare\"
[messages.battery]\ntype = \"BatteryState\"\nvoltage = \"Volts\"\ntemperature = \"Hot\"
[messages.imu]\ntype = \"Imu\"\nlinear_acceleration = [\"Shake[2]\", \"Shake[0]\", \"Shake[1]\"]
[devices.Bare]\nunit = \"km\"\nscale = 2\nleave_out = true",
    );
    assert!(reported.is_empty(), "{reported:?}");
    let of = |topic: &str| {
        let message = config.messages.iter().find(|message| message.topic == topic).unwrap();
        let parts = message.parts.iter();
        let parts = parts.map(|part| (part.field, part.device.as_str(), part.element));
        (parts.collect::<Vec<_>>(), message.parts.iter().map(|part| (part.factor, part.offset)))
    };
    // The file's order decides which one is the first.
    let (fields, ways) = of("fix");
    assert_eq!(fields, [("longitude", "Lon", 0), ("latitude", "Lat", 0), ("altitude", "Bare", 0)]);
    let ways: Vec<f64> = ways.map(|(factor, _)| factor).collect();
    for (found, wanted) in ways.iter().zip([0.001_f64.to_degrees(), 1.0, 1_000.0]) {
        assert!((found - wanted).abs() < 1e-9, "{ways:?}");
    }
    let (_, mut ways) = of("battery");
    assert!((ways.next().unwrap().0 - 0.001).abs() < 1e-12);
    let (factor, offset) = ways.next().unwrap();
    assert!(
        (212.0 * factor + offset - 100.0).abs() < 1e-9 && (32.0 * factor + offset).abs() < 1e-9
    );
    let (fields, _) = of("imu");
    assert_eq!(fields.iter().map(|one| one.2).collect::<Vec<_>>(), [2, 0, 1]);
    // What is left out still comes to the messages of a sink that has such, and to no other one.
    let plan = Plan::new(&boards(), &config, None);
    let needed = |plan: &Plan| plan.any_place(0, 5).unwrap().route.is_in_message;
    assert!(plan.place(0, 5).is_none() && !needed(&plan) && plan.messages.is_empty());
    let plan = plan.with_messages(&config);
    assert!(plan.place(0, 5).is_none() && needed(&plan) && plan.messages.len() == 3);
}

/// Examples for a design with such devices, and a general one without.
#[test]
fn the_printed_file_has_examples() {
    let text = sample(&boards(), &Config::default());
    let at = text.find("# For ROS 2, in one message: a battery").unwrap();
    let live: Vec<&str> = text[at..].lines().filter_map(|line| line.strip_prefix("# ")).collect();
    let live: Vec<&str> =
        live.into_iter().filter(|line| !line.contains("in one message")).collect();
    for expected in [
        "[messages.battery]",
        "voltage = \"Rover/Volts\"",
        "[messages.fix]",
        "latitude = \"Rover/Lat\"",
    ] {
        assert!(live.contains(&expected), "{expected}: {text}");
    }
    let (config, reported) = taken(&live.join("\n"));
    assert!(reported.is_empty() && config.messages.len() == 2, "{reported:?} {live:?}");
    assert!(sample(&[], &Config::default()).contains("#     [messages.battery]"));
}
