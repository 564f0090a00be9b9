//! WebSocket: clients after the RFC, some of which behave badly.

use std::net::{TcpListener, TcpStream};
use std::time::Duration;

use serde_json::{Value, json};

use super::peer::{Message, WebSocket};
use super::{Running, free_port, robot, shown, text};

fn started(file: &std::path::Path, port: u16, more: &[&str]) -> Running {
    let serve = format!("--websocket=127.0.0.1:{port}");
    let arguments = ["simulate", text(file), "--format", "ndjson", &serve];
    let run = Running::monitor(arguments.iter().chain(more));
    run.says(&format!("WebSocket: ws://127.0.0.1:{port}"));
    run
}

#[test]
fn clients_get_what_is_shown_from_when_they_come() {
    let (scratch, _) = robot("sinks-websocket");
    let port = free_port();
    let mut run = started(&scratch.join("robot.sense"), port, &["--seconds", "3"]);
    let mut clients = [0, 1].map(|_| WebSocket::connect(port, "").unwrap());
    for client in &mut clients {
        let mut texts = Vec::new();
        while let Some(Message::Text(text)) = client.next(Duration::from_secs(5)) {
            texts.push(text);
        }
        let hello = &texts[0]["hello"];
        assert_eq!((&hello["protocol"], &hello["commands"]), (&json!(1), &json!(true)));
        let board = &hello["boards"][0];
        assert_eq!(
            (&board["name"], board["devices"].as_array().unwrap().len()),
            (&json!("Rover"), 3)
        );
        let servo = json!({ "name": "Servo", "topic": "Rover/Servo", "direction": "actuator", "type": "uint16",
            "length": null, "kind": "dac", "unit": "deg", "min": 0.0, "max": 180.0, "cycle_ms": null });
        assert_eq!(board["devices"][2], servo);
        assert_eq!(texts.last().unwrap(), &json!({ "bye": "the monitor ended" }));
        let mut found = Vec::new();
        for values in texts.iter().map(|text| &text["values"]).filter(|values| !values.is_null()) {
            assert_eq!(values["board"], "Rover");
            for (topic, value) in values["values"].as_object().unwrap() {
                found.push((topic.strip_prefix("Rover/").unwrap().to_owned(), value.clone()));
            }
        }
        let printed = shown(&run.printed());
        assert!(found.len() > 20, "{}", found.len());
        assert_eq!(found, printed[printed.len() - found.len()..]);
        let is_good = |health: &Value| health["devices"]["Light"]["status"] == "good";
        assert!(is_good(&board["health"]) || texts.iter().any(|text| is_good(&text["health"])));
    }
    assert_eq!(run.ends(), 0, "{}", run.said());
}

#[test]
fn actuators_are_set_and_mistakes_answered() {
    let (scratch, _) = robot("sinks-websocket-set");
    let port = free_port();
    let run = started(&scratch.join("robot.sense"), port, &[]);
    let mut client = WebSocket::connect(port, "").unwrap();
    let _ = client.wait(|text| text["values"].is_object());
    let mut ask = |message: &str| {
        client.text(message);
        client.wait(|text| text["answer"].is_object())["answer"].clone()
    };
    let set = ask(r#"{ "id": 7, "set": { "Rover/Servo": 45.5 } }"#);
    assert_eq!(
        set,
        json!({ "id": 7, "set": "Rover/Servo", "ok": true, "value": 45.5, "raw": 455 })
    );
    for (message, why) in [
        (r#"{ "set": { "Rover/Servo": 181 } }"#, "above the maximum of 180"),
        (r#"{ "set": { "Rover/Light": 1 } }"#, "is a sensor"),
        (r#"{ "set": { "Rover/Sevro": 1 } }"#, "no device has this topic"),
        (r#"{ "set": { "Rover/Servo": {} } }"#, "must be a number"),
        (r#"{ "set": 5 }"#, "must have `set`"),
        ("[1]", "must be an object"),
        ("{", "must be an object"),
    ] {
        let answer = ask(message);
        assert_eq!(answer["ok"], false, "{message}");
        assert!(answer["error"].as_str().unwrap().contains(why), "{message}: {answer}");
    }
    run.says("sent: Servo = 455 (45.5 deg)");
    // Who comes later is told what holds.
    let mut later = WebSocket::connect(port, "").unwrap();
    let hello = later.wait(|text| text["hello"].is_object());
    assert_eq!(hello["hello"]["values"]["Rover/Servo"]["value"], 45.5);
}

#[test]
fn strangers_and_bad_clients_disturb_nobody() {
    let (scratch, _) = robot("sinks-websocket-bad");
    let port = free_port();
    let config = format!(
        "[websocket]\nlisten = \"127.0.0.1:{port}\"\ncommands = false\norigins = [\"https://lab.example\"]\n"
    );
    let config = scratch.write("sinks.toml", config);
    let file = scratch.join("robot.sense");
    let mut run = Running::monitor(["simulate", text(&file), "--config", text(&config)]);
    run.says("WebSocket: ws://");
    for (origin, is_let_in) in [
        ("http://localhost:3000", true),
        ("https://lab.example", true),
        ("https://evil.example", false),
        ("null", false),
    ] {
        let found = WebSocket::connect(port, &format!("Origin: {origin}\r\n")).map(|_| ());
        let status = "HTTP/1.1 403 Forbidden".to_owned();
        assert_eq!(found, if is_let_in { Ok(()) } else { Err(status) }, "{origin}");
    }
    let mut good = WebSocket::connect(port, "").unwrap();
    good.text(r#"{ "set": { "Rover/Servo": 1 } }"#);
    let refused = good.wait(|text| text["answer"].is_object());
    assert!(refused["answer"]["error"].as_str().unwrap().contains("commands are off"));
    // One that says nothing, one that sends too much, one of another protocol, one that breaks off.
    let _silent = TcpStream::connect(("127.0.0.1", port)).unwrap();
    let mut large = WebSocket::connect(port, "").unwrap();
    large.send(1, &vec![b'a'; 1 << 20]);
    let mut end = large.next(Duration::from_secs(5));
    while matches!(end, Some(Message::Text(_))) {
        end = large.next(Duration::from_secs(5));
    }
    assert_eq!(end, Some(Message::Closed));
    let mut binary = WebSocket::connect(port, "").unwrap();
    binary.send(2, &[1, 2, 3]);
    let answer = binary.wait(|text| text["answer"].is_object());
    assert_eq!(answer["answer"]["error"], "a message must be text");
    let _ = std::io::Write::write_all(
        &mut TcpStream::connect(("127.0.0.1", port)).unwrap(),
        b"GET / HTTP/1.1\r\n\r\n",
    );
    drop(binary);
    let _: Value = good.wait(|text| text["values"].is_object());
    run.type_in("Servo 5");
    let _ = good.wait(|text| text["command"]["values"]["Rover/Servo"] == 5.0);
}

#[test]
fn an_address_that_is_taken_is_waited_for() {
    let (scratch, _) = robot("sinks-websocket-taken");
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    let file = scratch.join("robot.sense");
    let serve = format!("--websocket={port}");
    let run = Running::monitor(["simulate", text(&file), &serve, "--format", "ndjson"]);
    run.says(&format!("WebSocket: cannot listen on 127.0.0.1:{port}: "));
    run.says("(E0567); choose another address with `listen`, or end what has it");
    drop(taken);
    run.says("WebSocket: works again");
    let mut client = WebSocket::connect(port, "").unwrap();
    let hello = client.wait(|text| text["hello"].is_object());
    assert_eq!(hello["hello"]["boards"][0]["online"], true);
    assert!(!run.printed().is_empty());
}
