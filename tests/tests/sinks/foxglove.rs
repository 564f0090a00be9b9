//! Foxglove: a client that was written from the published protocol (foxglove/ws-protocol) and knows nothing else.

use std::time::Duration;

use serde_json::{Value, json};

use super::peer::{Message, WebSocket};
use super::{Running, free_port, robot, shown, text};

const PROTOCOL: &str = "Sec-WebSocket-Protocol: foxglove.sdk.v1.1, foxglove.sdk.v1\r\n";

/// The subscription, the time in nanoseconds and the message of a value.
fn data(bytes: &[u8]) -> (u32, u64, Value) {
    assert_eq!(bytes[0], 1, "message data");
    let subscription = u32::from_le_bytes(bytes[1..5].try_into().unwrap());
    let time_ns = u64::from_le_bytes(bytes[5..13].try_into().unwrap());
    (subscription, time_ns, serde_json::from_slice(&bytes[13..]).unwrap())
}

#[test]
fn channels_have_what_is_shown_and_actuators_are_set() {
    let (scratch, _) = robot("sinks-foxglove");
    let port = free_port();
    let config =
        scratch.write("sinks.toml", format!("[foxglove]\nlisten = \"127.0.0.1:{port}\"\n"));
    let file = scratch.join("robot.sense");
    let call = ["simulate", text(&file), "--seconds", "4", "--format", "ndjson", "--config"];
    let mut run = Running::monitor(call.into_iter().chain([text(&config)]));
    run.says(&format!("Foxglove: ws://127.0.0.1:{port}"));
    let mut client = WebSocket::connect(port, PROTOCOL).unwrap();
    let info = client.wait(|text| text["op"] == "serverInfo");
    assert_eq!(info["capabilities"], json!(["clientPublish"]));
    let channels = client.wait(|text| text["op"] == "advertise")["channels"].clone();
    let channel = |topic: &str| -> Value {
        let all = channels.as_array().unwrap();
        all.iter().find(|one| one["topic"] == topic).unwrap_or_else(|| panic!("{channels}")).clone()
    };
    let light = channel("/Rover/Light");
    assert_eq!(
        (&light["encoding"], &light["schemaEncoding"]),
        (&"json".into(), &"jsonschema".into())
    );
    let schema: Value = serde_json::from_str(light["schema"].as_str().unwrap()).unwrap();
    assert_eq!(schema["properties"]["value"]["type"], "number");
    let subscribe = json!({ "op": "subscribe", "subscriptions": [
        { "id": 70, "channelId": light["id"] }, { "id": 71, "channelId": channel("/Rover/Servo")["id"] },
    ] });
    client.text(&subscribe.to_string());
    let advertise = json!({ "op": "advertise", "channels": [
        { "id": 5, "topic": "/Rover/Servo/set", "encoding": "json", "schemaName": "" },
    ] });
    client.text(&advertise.to_string());
    let publish = |payload: &str| [&[1, 5, 0, 0, 0], payload.as_bytes()].concat();
    client.send(2, &publish(r#"{"value":45.5}"#));
    client.send(2, &publish("181"));
    client.text("{");
    let (mut lights, mut servo, mut said) = (Vec::new(), Vec::new(), Vec::new());
    loop {
        match client.next(Duration::from_secs(5)) {
            Some(Message::Binary(bytes)) => {
                let (subscription, time_ns, value) = data(&bytes);
                assert!(time_ns > 1_700_000_000_000_000_000, "{time_ns}");
                let all = if subscription == 70 { &mut lights } else { &mut servo };
                all.push(value["value"].clone());
            }
            Some(Message::Text(text)) => said.push(text),
            Some(Message::Closed) => break,
            None => panic!("nothing comes: {}", run.said()),
        }
    }
    assert_eq!(run.ends(), 0, "{}", run.said());
    run.says("sent: Servo = 455 (45.5 deg)");
    assert_eq!(servo, [45.5]);
    let all: Vec<Value> =
        shown(&run.printed()).into_iter().filter(|one| one.0 == "Light").map(|one| one.1).collect();
    assert!(lights.len() > 20, "{}", lights.len());
    // What the monitor prints last may not be out before it ends.
    let last = all.iter().rposition(|one| Some(one) == lights.last()).unwrap();
    assert!(all.len() - last < 20, "{} of {}", last, all.len());
    assert_eq!(lights, all[last + 1 - lights.len()..=last]);
    let refused = "/Rover/Servo/set: 181 deg is above the maximum of 180";
    for expected in [refused, "the message is not of the protocol"] {
        let status = json!({ "op": "status", "level": 2, "message": expected });
        assert!(said.contains(&status), "{expected}: {said:?}");
    }
}

#[test]
fn others_are_not_let_in() {
    let (scratch, _) = robot("sinks-foxglove-others");
    let port = free_port();
    let config = format!("[foxglove]\nlisten = \"127.0.0.1:{port}\"\ncommands = false\n");
    let config = scratch.write("sinks.toml", config);
    let file = scratch.join("robot.sense");
    let run = Running::monitor(["simulate", text(&file), "--config", text(&config)]);
    run.says("Foxglove: ws://");
    let connect = |more: &str| WebSocket::connect(port, more).map(|_| ());
    assert_eq!(connect(""), Err("HTTP/1.1 400 Bad Request".to_owned()));
    for (origin, is_let_in) in [("https://app.foxglove.dev", true), ("https://evil.example", false)]
    {
        let found = connect(&format!("{PROTOCOL}Origin: {origin}\r\n"));
        let forbidden = Err("HTTP/1.1 403 Forbidden".to_owned());
        assert_eq!(found, if is_let_in { Ok(()) } else { forbidden }, "{origin}");
    }
    let mut client = WebSocket::connect(port, PROTOCOL).unwrap();
    let info = client.wait(|text| text["op"] == "serverInfo");
    assert_eq!(info["capabilities"], json!([]));
    client.send(2, b"\x01\x05\0\0\0 1");
    let refused = client.wait(|text| text["op"] == "status" && text["level"] == 2);
    assert!(refused["message"].as_str().unwrap().contains("commands are off"), "{refused}");
}
