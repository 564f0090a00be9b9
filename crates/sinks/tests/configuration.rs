//! Configurations: texts in, settings or mistakes with their places out.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::time::Duration;

use sensedsl_diagnostics::{Diagnostic, SourceMap};
use sensedsl_host::Board;
use sensedsl_sinks::config::{Setting, Spec, find, read, sample};
use sensedsl_sinks::{Config, Plan, command};
use sensedsl_wire::Scalar;

const BOARDS: &str = r#"{ "version": 2, "boards": [
    { "name": "Rover", "hash": "0x7b5ad45a", "checksum": "none", "items": [
        { "id": 17, "name": "Light", "direction": "sensor", "type": "uint16", "scale": 0.1, "quantity": "cm" },
        { "id": 18, "name": "Lamps", "direction": "sensor", "type": "bool", "length": 3 },
        { "id": 19, "name": "Servo", "direction": "actuator", "type": "uint16", "scale": 0.1, "quantity": "deg",
          "min": 0, "max": 180 } ] },
    { "name": "Mast", "hash": "0x00b4763a", "checksum": "none", "items": [
        { "id": 17, "name": "Light", "direction": "sensor", "type": "uint16", "scale": 0.1 } ] } ] }"#;

fn boards() -> Vec<Board> {
    Board::all_of_json(BOARDS).unwrap()
}

fn taken(text: &str) -> (Config, Vec<Diagnostic>) {
    let mut sources = SourceMap::default();
    let file = sources.add("sinks.toml", text);
    read(file, text, &boards())
}

#[test]
fn mistakes_are_told_with_a_way_out() {
    for (text, code, message, help) in [
        ("[mqtt]\nbroker = 5", "E0560", "`broker` must be an address", "localhost:1883"),
        ("[mqtt]\nbrocker = \"x:1\"", "E0560", "`[mqtt]` has no `brocker`", "`broker`?"),
        ("[mqqt]", "E0560", "a configuration has no `mqqt`", "`mqtt`?"),
        ("[mqtt", "E0560", "the configuration is not TOML", "--init-config"),
        ("mqtt = 1", "E0560", "must be a table", "[mqtt]"),
        ("[mqtt]\nrate_hz = 0", "E0560", "`rate_hz` must be a number above 0", "10"),
        ("[mqtt]\npayload = \"xml\"", "E0560", "`payload` must be \"plain\" or \"json\"", "plain"),
        ("[mqtt]\ncommands = \"no\"", "E0560", "`commands` must be `true` or `false`", "false"),
        ("[websocket]\norigins = [1]", "E0560", "`origins` must be a list", "[\"text\"]"),
        ("[websocket]\nlisten = \"localhost:80\"", "E0562", "must be the number", "127.0.0.1"),
        ("[plotjuggler]\nto = \"here\"", "E0562", "it has no port", "127.0.0.1:9870"),
        ("[boards.Rower]", "E0561", "no board called `Rower`", "`Rover`?"),
        ("[devices.\"Rover/Ligth\"]", "E0561", "`Rover/Ligth`", "`Rover/Light`?"),
        ("[devices.Light]", "E0561", "no device called `Light`", "Rover/Light"),
        ("[devices.Servo]\nunit = \"V\"", "E0560", "`V` does not fit", "scale"),
        ("[devices.Servo]\ntopic = \"a b\"", "E0564", "`a b` is not a topic", "letters"),
        ("[devices.Servo]\ntopic = \"Rover/Light\"", "E0564", "have the topic", "another `topic`"),
        ("[boards.Mast]\ntopic = \"Rover\"", "E0564", "have the topic `Rover`", "another `topic`"),
    ] {
        let (_, reported) = taken(text);
        let first = reported.first().unwrap_or_else(|| panic!("{text}: taken"));
        assert_eq!(first.code.name(), code, "{text}: {first:?}");
        assert!(first.message.contains(message), "{text}: {}", first.message);
        let helps = format!("{first:?}");
        assert!(helps.contains(&help.replace('"', "\\\"")), "{text}: {helps}");
    }
}

#[test]
fn the_printed_file_is_taken_as_it_is_and_with_all_its_keys() {
    let mut wanted = Config::default();
    wanted.add(find("websocket").unwrap(), "listen", Some(Setting::Text("0.0.0.0:81".into())));
    let text = sample(&boards(), &wanted);
    let (config, reported) = taken(&text);
    assert!(reported.is_empty(), "{reported:?}\n{text}");
    assert_eq!(config, wanted);
    // A key is a word and a sign of equality, a table begins with a bracket; all else is for people.
    let is_live = |line: &&str| {
        let rest = line.strip_prefix("# ").unwrap_or(line);
        rest.starts_with('[') || rest.split_once(" = ").is_some_and(|(key, _)| !key.contains(' '))
    };
    let all: Vec<&str> =
        text.lines().filter(is_live).map(|line| line.strip_prefix("# ").unwrap_or(line)).collect();
    let (config, reported) = taken(&all.join("\n"));
    // What this build does not have is told, and nothing else.
    let (built, not_built) =
        sensedsl_sinks::config::SINKS.iter().partition::<Vec<&Spec>, _>(|spec| spec.is_built);
    let codes: Vec<&str> = reported.iter().map(|one| one.code.name()).collect();
    assert_eq!(codes, vec!["E0563"; not_built.len()], "{reported:?}\n{}", all.join("\n"));
    assert_eq!(
        (config.sinks.len(), config.boards.len(), config.devices.len()),
        (built.len(), 2, 4)
    );
}

#[test]
fn names_rates_and_units_of_devices() {
    let (config, reported) = taken(
        "[mqtt]\n[boards.Rover]\ntopic = \"car\"\nrate_hz = 10\n[devices.Servo]\nunit = \"mdeg\"\n\
         [devices.\"Rover/Light\"]\nunit = \"m\"\ntopic = \"front/wall\"\nrate_hz = 50\n\
         [devices.Lamps]\nleave_out = true\n[devices.\"Mast/Light\"]\nscale = 2\nunit = \"lx\"",
    );
    assert!(reported.is_empty(), "{reported:?}");
    let plan = Plan::new(&boards(), &config, Some(20.0));
    let found: Vec<_> = plan
        .places()
        .map(|place| (place.route.topic.as_str(), place.route.period, place.route.unit.as_deref()))
        .collect();
    let ms = |ms| Some(Duration::from_millis(ms));
    assert_eq!(
        found,
        [
            ("front/wall", ms(100), Some("m")),
            ("car/Servo", ms(100), Some("mdeg")),
            ("Mast/Light", ms(50), Some("lx")),
        ]
    );
    let shown = |board, index| plan.place(board, index).unwrap().json(&[Scalar::Unsigned(8_410)]);
    assert_eq!((shown(0, 0), shown(1, 0)), (8.41.into(), 1_682.0.into()));
    // What comes back is in that unit, too, and is judged by the actuator's limits.
    let servo = plan.place(0, 2).unwrap();
    let set = |text: &str| command::of_bytes(&servo, text.as_bytes()).map(|one| one.text);
    assert_eq!(set("45500"), Ok("45.5".to_owned()));
    assert_eq!(set(" 45.5 deg "), Ok("45.5 deg".to_owned()));
    for (text, why) in [
        ("180001", "above the maximum of 180"),
        ("-1", "below the minimum"),
        ("{}", "must be a number"),
        ("null", "must be a number"),
        ("[1, 2]", "2 values for 1"),
        ("[[1]]", "a list must hold"),
        ("\"a\\u0000\"", "control characters"),
        ("fast", "`fast` is not a valid value"),
        ("\"1e999\"", "is not a valid value"),
    ] {
        let found = set(text);
        assert!(found.as_ref().is_err_and(|found| found.contains(why)), "{text}: {found:?}");
    }
    let light = plan.place(0, 0).unwrap();
    assert!(command::of_bytes(&light, b"1").is_err_and(|why| why.contains("is a sensor")));
    assert!(command::of_bytes(&servo, &[0xff]).is_err_and(|why| why.contains("UTF-8")));
    assert!(
        command::of_bytes(&servo, &vec![b' '; 1 << 20]).is_err_and(|why| why.contains("bytes"))
    );
}
