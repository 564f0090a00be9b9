//! A certificate small enough to be read, and changes to it that are refused.
#![allow(missing_docs, reason = "tests need none")]
#![allow(clippy::indexing_slicing, clippy::expect_used, clippy::panic, reason = "only tests")]

use sensedsl_proof::format::Objective;
use sensedsl_proof::subject::{compare, sha256};
use sensedsl_proof::{Verified, read, verify};

/// Two sensors of one kind on three pins that cost 1, 2 and 5: the cheapest wiring costs 3. A
/// sensor on PA1 pays 1 more than it costs, so that each sensor pays at least 2, and that 1 is
/// given back.
const TWO_OF_THREE: &str = r#"{
"format": "SenseDSL certificate 4",
"subject": {"tool": "a tool", "options": {}, "files": {}, "built_in": {}},
"problem": {
  "boards": {"B": false},
  "pins": {"PA1": 1, "PA2": 2, "PA3": 5},
  "shared": [],
  "dma": {},
  "devices": {
    "Left": {"any": {"board": "B", "claims": {}, "violates": [], "dma": [], "roles": {"in": {
      "PA1": {"pin": "PA1", "holder": "own", "signal": "A1", "claims": {}, "violates": [], "moved": false},
      "PA2": {"pin": "PA2", "holder": "own", "signal": "A2", "claims": {}, "violates": [], "moved": false},
      "PA3": {"pin": "PA3", "holder": "own", "signal": "A3", "claims": {}, "violates": [], "moved": false}}}}},
    "Right": {"any": {"board": "B", "claims": {}, "violates": [], "dma": [], "roles": {"in": {
      "PA1": {"pin": "PA1", "holder": "own", "signal": "A1", "claims": {}, "violates": [], "moved": false},
      "PA2": {"pin": "PA2", "holder": "own", "signal": "A2", "claims": {}, "violates": [], "moved": false},
      "PA3": {"pin": "PA3", "holder": "own", "signal": "A3", "claims": {}, "violates": [], "moved": false}}}}}
  }
},
"answer": {
  "objective": {"moved": 0, "violated": 0, "shared": 0, "cost": 3, "spares": 0},
  "wiring": {
    "Left": {"takes": "any", "wires": {"in": "PA1"}},
    "Right": {"takes": "any", "wires": {"in": "PA2"}}
  },
  "streams": {}
},
"search": {"weights": [1000, 200, 40, 1, 1], "facilities": [], "covers": [], "swaps": [{"devices": [0, 1]}], "steps": [
  {"closed": {"scale": 1, "pins": [0, 1]}}
]}
}"#;

/// Two cases, one of which is not needed for the bound: Left is on PA1, or neither of the two is.
const SPLIT: &str = r#"{"split": {"on": {"wire": [0, 0, 0, 0]}, "swaps": [0]}},
  {"closed": {"scale": 1, "pins": [0, 1]}},
  {"closed": {"scale": 1}}"#;
const CLOSED: &str = r#"{"closed": {"scale": 1, "pins": [0, 1]}}"#;

/// What the comparison says about files, each with its content, or why it refuses them.
fn compared(subject: &str, given: &[(&str, &str)]) -> Result<String, String> {
    let empty = r#"{"tool": "a tool", "options": {}, "files": {}, "built_in": {}}"#;
    let certificate = read(&changed(TWO_OF_THREE, empty, subject)).expect("a certificate");
    let given: Vec<(String, String)> = given
        .iter()
        .map(|(path, content)| ((*path).to_owned(), sha256(content.as_bytes())))
        .collect();
    let compared = compare(&certificate.subject, &given).map_err(|refuted| refuted.0)?;
    Ok(compared.to_string())
}

fn verified(text: &str) -> Result<Verified, String> {
    verify(&read(text).expect("a certificate")).map_err(|refuted| refuted.0)
}

#[track_caller]
fn changed(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    text.replace(from, to)
}

#[test]
fn a_proof_is_verified() {
    let objective = Objective { moved: 0, violated: 0, shared: 0, cost: 3, spares: 0 };
    assert_eq!(verified(TWO_OF_THREE), Ok(Verified::Best(objective)));
    assert_eq!(verified(&changed(TWO_OF_THREE, CLOSED, SPLIT)), Ok(Verified::Best(objective)));
}

#[test]
fn hashes_are_those_of_the_standard() {
    // FIPS 180-2, appendix B.
    let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
    assert_eq!(sha256(b"abc"), abc);
}

#[test]
fn files_are_told_from_others() {
    let (one, two, pins) = (sha256(b"one"), sha256(b"two"), sha256(b"pins"));
    let subject = format!(
        r#"{{"tool": "a tool", "options": {{"--target": "none"}},
        "files": {{"robot.sense": "{one}", "../common/robot.sense": "{two}"}},
        "built_in": {{"boards B": "{pins}"}}}}"#
    );
    let compared = |given: &[(&str, &str)]| compared(&subject, given);
    let all = [("a/robot.sense", "one"), ("/home/common/robot.sense", "two"), ("x.csv", "pins")];
    let messages = compared(&all).expect("all are the same");
    assert!(
        !messages.contains("not compared") && messages.contains("with --target none"),
        "{messages}"
    );
    let messages = compared(&all[..2]).expect("the table may be left out");
    assert!(messages.contains("`sensedsl boards B`: not compared"), "{messages}");
    let renamed = [("other.sense", "one"), ("common\\robot.sense", "two")];
    assert!(
        compared(&renamed).is_ok(),
        "a path that the design does not name is compared by content"
    );
    for (given, why) in [
        (&[("robot.sense", "one")][..], "also of \"../common/robot.sense\""),
        (&[("x.csv", "pins")], "which is not given"),
        (&[("robot.sense", "one "), all[1]], "is not the \"robot.sense\" that was solved"),
        (&[("robot.sense", "two"), ("common/robot.sense", "one")], "is not the"),
        (&[all[0], all[1], ("y.csv", "pines")], "not of \"y.csv\""),
        (&[all[0], all[1], ("c.sense", "")], "not of \"c.sense\""),
    ] {
        let messages = compared(given).expect_err(why);
        assert!(messages.contains(why), "{given:?}: {messages}");
    }
}

#[test]
fn shared_pins_come_before_the_cost() {
    let shared = changed(TWO_OF_THREE, "\"shared\": []", "\"shared\": [\"PA1\"]");
    // One shared pin is not needed: there are PA2 and PA3.
    let reported = changed(&shared, "\"shared\": 0, \"cost\": 3", "\"shared\": 1, \"cost\": 3");
    let why = verified(&shared).expect_err("PA1 is shared");
    assert!(why.starts_with("the wiring has moved 0, violated 0, shared 1, cost 3"), "{why}");
    assert_eq!(verified(&reported), Err("step 0 does not show what it has to".into()));
    let nowhere = changed(TWO_OF_THREE, "\"shared\": []", "\"shared\": [\"PA4\"]");
    assert_eq!(verified(&nowhere), Err("there is no pin \"PA4\"".into()));
}

#[test]
fn a_claim_is_stated() {
    let (before, after) = TWO_OF_THREE.split_once("\"answer\"").expect("two parts");
    let (_, after) = after.split_once("\"search\"").expect("two parts");
    let error = read(&format!("{before}\"search\"{after}")).expect_err("nothing is claimed");
    assert!(error.0.contains("missing field `answer`"), "{}", error.0);
}

#[test]
fn no_wiring_is_verified() {
    let (problem, _) = TWO_OF_THREE.split_once("\"answer\"").expect("two parts");
    let one_pin = problem.lines().filter(|line| !line.contains("\"PA1\": {\"pin\""));
    let one_pin: String = one_pin.collect();
    let one_pin = one_pin.replace("\"PA3\": {\"pin\": \"PA3\"", "\"PA3\": {\"pin\": \"PA2\"");
    // A price of 20 on PA2: two devices pay it, and it is given back once.
    let rest = r#""answer": null, "search": {"weights": [1000, 200, 40, 1, 1],
        "facilities": [], "covers": [], "swaps": [], "steps": [{"closed": {"scale": 1, "pins": [1, 20]}}]}}"#;
    assert_eq!(verified(&format!("{one_pin}{rest}")), Ok(Verified::NoWiring));
    assert!(verified(&format!("{problem}{rest}")).is_err(), "there are wirings");
}

#[test]
fn what_is_not_proved_is_refused() {
    let split = changed(TWO_OF_THREE, CLOSED, SPLIT);
    for (text, from, to, why) in [
        (TWO_OF_THREE, "\"cost\": 3,", "\"cost\": 2,", "the wiring has"),
        (TWO_OF_THREE, "{\"in\": \"PA2\"}", "{\"in\": \"PA1\"}", "held twice"),
        (TWO_OF_THREE, "{\"in\": \"PA2\"}", "{\"in\": \"PA3\"}", "the wiring has"),
        (TWO_OF_THREE, "{\"in\": \"PA2\"}", "{\"in\": \"PA4\"}", "not wired"),
        (TWO_OF_THREE, "{\"in\": \"PA2\"}", "{}", "not wired"),
        (TWO_OF_THREE, "\"streams\": {}", "\"streams\": {\"I2C1\": []}", "streams"),
        (TWO_OF_THREE, "\"pins\": [0, 1]", "\"pins\": []", "does not show"),
        (TWO_OF_THREE, "\"pins\": [0, 1]", "\"pins\": [7, 1]", "no pin 7"),
        (TWO_OF_THREE, "\"pins\": [0, 1]", "\"pins\": [0]", "odd end"),
        (TWO_OF_THREE, "\"scale\": 1", "\"scale\": 0", "scale"),
        (TWO_OF_THREE, "200, 40, 1, 1", "200, 1, 1, 1", "is not larger"),
        (TWO_OF_THREE, "\"board\": \"B\"", "\"board\": \"C\"", "no board"),
        (TWO_OF_THREE, "\"PA3\": 5", "\"PA4\": 5", "no pin"),
        (TWO_OF_THREE, CLOSED, "", "leaves out"),
        (TWO_OF_THREE, "[0, 1]}],", "[0, 2]}],", "no device 2"),
        (&split, "[0, 0, 0, 0]", "[0, 0, 0, 1]", "does not show"),
        (&split, ",\n  {\"closed\": {\"scale\": 1}}", "", "leaves out"),
        (&split, "\"swaps\": [0]}", "\"swaps\": [1]}", "no swap 1"),
        (&split, "[0, 0, 0, 0]", "[2, 0, 0, 0]", "no device 2"),
        (&split, "[0, 0, 0, 0]", "[0, 0, 0, 3]", "no candidate 3"),
    ] {
        let messages = verified(&changed(text, from, to)).expect_err(from);
        assert!(messages.contains(why), "{from} to {to}: {messages}");
    }
}

#[test]
fn what_is_no_certificate_is_told_from_a_wrong_one() {
    for (from, to) in [
        ("certificate 4", "certificate 3"),
        ("\"subject\"", "\"subjects\""),
        ("\"built_in\": {}", "\"built_in\": {\"boards B\": 1}"),
        ("\"boards\"", "\"board\""),
        ("\"PA3\": 5", "\"PA3\": -5"),
        ("\"PA3\": 5", "\"PA3\": 5.0"),
        ("\"PA3\": 5", "\"PA3\": 4294967296"),
        ("\"PA3\": 5", "\"PA3\": 5, \"PA1\": 1"),
        ("\"moved\": false", "\"moved\": 0"),
        ("\"scale\": 1", "\"scale\": 1, \"hint\": 1"),
        ("{\"closed\"", "{\"shut\""),
    ] {
        assert!(read(&changed(TWO_OF_THREE, from, to)).is_err(), "{from} to {to}");
    }
    for end in (0..TWO_OF_THREE.len()).step_by(7) {
        assert!(read(&TWO_OF_THREE[..end]).is_err());
    }
    assert!(read(&"[".repeat(1 << 16)).is_err());
}
