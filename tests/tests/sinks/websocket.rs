//! WebSocket: clients after the RFC, some of which behave badly.

use std::io::{Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::process::Command;
use std::time::Duration;

use sensedsl_tests::{TempDir, has};

use serde_json::{Value, json};

use super::peer::{Message, WebSocket};
use super::{Running, free_port, robot, shown, text, until};

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

/// A browser without a screen, which is asked over its debugging port.
struct Browser {
    _run: Running,
    page: WebSocket,
    asked: u32,
}

impl Browser {
    fn open(scratch: &TempDir, url: &str) -> Self {
        let profile = format!("--user-data-dir={}", text(&scratch.join("profile")));
        let arguments = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"];
        let run = Running::start(Command::new("chromium").args(arguments).args([
            &profile,
            "--remote-debugging-port=0",
            url,
        ]));
        run.says("DevTools listening on ws://127.0.0.1:");
        let said = run.said();
        let rest = said.split_once("DevTools listening on ws://127.0.0.1:").unwrap().1;
        let port = rest.split_once('/').unwrap().0.parse().unwrap();
        let pages = get(port, "/json/list");
        let pages: Value = serde_json::from_str(pages.split_once("\r\n\r\n").unwrap().1).unwrap();
        let page = pages.as_array().unwrap().iter().find(|page| page["type"] == "page").unwrap();
        let path = format!("/devtools/page/{}", page["id"].as_str().unwrap());
        Self { _run: run, page: WebSocket::connect_to(port, &path, "").unwrap(), asked: 0 }
    }

    /// What an expression is on the page.
    fn evaluate(&mut self, expression: &str) -> Value {
        self.asked += 1;
        let (id, params) = (self.asked, json!({ "expression": expression, "returnByValue": true }));
        let call = json!({ "id": id, "method": "Runtime.evaluate", "params": params });
        self.page.text(&call.to_string());
        self.page.wait(|text| text["id"] == id)["result"]["result"]["value"].clone()
    }
}

pub(super) fn get(port: u16, path: &str) -> String {
    let mut stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
    let head =
        format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close\r\n\r\n");
    stream.write_all(head.as_bytes()).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(2))).unwrap();
    let mut bytes = Vec::new();
    // A server may keep the connection: what it has said by then is all.
    let _ = stream.read_to_end(&mut bytes);
    String::from_utf8(bytes).unwrap()
}

/// A browser shows the page of the address itself, with the values, and sets an actuator.
#[test]
fn a_browser_shows_the_values() {
    if !has("chromium") {
        return;
    }
    let (scratch, _) = robot("sinks-websocket-page");
    let port = free_port();
    let run = started(&scratch.join("robot.sense"), port, &[]);
    let mut browser = Browser::open(&scratch, &format!("http://127.0.0.1:{port}/"));
    let mut rows = Value::Null;
    until(
        || {
            let all = "[...document.querySelectorAll('tbody tr')].map((row) => [...row.cells].map((cell) => cell.textContent))";
            rows = browser.evaluate(all);
            rows[0][1].as_str().is_some_and(|value| !value.is_empty())
        },
        || "the page has no values".to_owned(),
    );
    assert_eq!(browser.evaluate("document.getElementById('state').textContent"), "Rover is there");
    assert_eq!((&rows[0][0], &rows[0][2]), (&json!("Rover/Light"), &json!("cm")));
    let value: f64 = rows[0][1].as_str().unwrap().parse().unwrap();
    let is_it = |(name, shown): &(String, Value)| name == "Light" && shown.as_f64() == Some(value);
    assert!(shown(&run.printed()).iter().any(is_it), "{rows}");
    let points = browser.evaluate("document.querySelector('polyline').getAttribute('points')");
    assert!(points.as_str().unwrap().contains(','), "{points}");
    let set = "document.querySelector('input').value = '45 deg'; document.querySelector('form').requestSubmit()";
    let _ = browser.evaluate(set);
    run.says("sent: Servo = 450 (45 deg)");
    let said = "document.getElementById('said').textContent";
    until(|| browser.evaluate(said) == "Rover/Servo = 45", || "no answer".to_owned());
    let _ = browser.evaluate(&set.replace("45 deg", "181"));
    let expected = "Rover/Servo: 181 deg is above the maximum of 180";
    until(|| browser.evaluate(said) == expected, || "no refusal".to_owned());
    assert!(get(port, "/other").starts_with("HTTP/1.1 404 "));
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
