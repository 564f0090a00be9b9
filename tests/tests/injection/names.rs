//! Names that cannot be told apart, cannot be seen, or cannot be a file name are refused.

use sensedsl_diagnostics::is_hidden;
use sensedsl_tests::{one_in, sensedsl};

fn codes(text: String) -> Vec<String> {
    let ran = sensedsl(["check", "--format", "json", "-"]).stdin(text).run();
    assert!(!ran.stdout.contains(|c| is_hidden(c) && c != '\n'), "{}", ran.stdout);
    let output = ran.json();
    let diagnostics = output["diagnostics"].as_array().unwrap();
    diagnostics.iter().map(|one| one["code"].as_str().unwrap().to_owned()).collect()
}

fn board(name: &str) -> String {
    format!(
        "board {name} on STM32F4DiscoveryBoard {{ sensor A returns uint16 {{ id = 1; type = analog; }} }}"
    )
}

fn sensor(name: &str) -> String {
    format!(
        "board B on STM32F4DiscoveryBoard {{ sensor {name} returns uint16 {{ id = 1; type = analog; }} }}"
    )
}

#[test]
fn names_are_letters_digits_and_underscores_of_ascii() {
    // Direction marks, joiners, line ends and other characters that are not letters.
    let marks = "\u{202a}\u{202b}\u{202c}\u{202d}\u{202e}\u{2066}\u{2067}\u{2068}\u{2069}\u{200e}\u{200f}\u{61c}\
                 \u{200b}\u{200c}\u{200d}\u{2060}\u{feff}\u{ad}\u{2028}\u{2029}\u{85}\u{0}\u{1b}\u{7f}\u{9b}$%&'`@!?:/\\*|<>~^";
    for mark in one_in(5, marks.chars()) {
        for name in [format!("A{mark}b"), format!("{mark}Ab")] {
            for text in [sensor(&name), board(&name)] {
                let codes = codes(text);
                // A possible operator is unexpected there; anything else is an unknown character.
                let reported = |code: &String| code == "E0102" || code == "E0101";
                assert!(codes.iter().any(reported), "{name:?}: {codes:?}");
            }
        }
    }
    // Letters of other alphabets, some of which look like ASCII.
    for name in ["А", "Aа", "Größe", "e\u{301}", "\u{ff21}", "試験", "ſensor", "ı"] {
        for text in [sensor(name), board(name)] {
            let codes = codes(text);
            assert!(
                codes.iter().any(|code| code == "E0221" || code == "E0102"),
                "{name:?}: {codes:?}"
            );
        }
    }
    for name in ["_a", &"a".repeat(64), "..", "../x", "a.b", "a-b", "1a"] {
        assert!(!codes(sensor(name)).is_empty(), "{name}");
    }
}

#[test]
fn no_board_is_a_device_of_windows() {
    let ports =
        ["COM", "LPT"].into_iter().flat_map(|port| (0..=9).map(move |n| format!("{port}{n}")));
    let devices = ["CON", "PRN", "AUX", "NUL"].map(str::to_owned);
    for name in ports.chain(devices) {
        for name in
            [name.clone(), name.to_lowercase(), name[..1].to_owned() + &name[1..].to_lowercase()]
        {
            assert_eq!(codes(board(&name)), ["E0221"], "{name}");
        }
    }
    // The other names of the list cannot be names at all.
    for name in ["COM¹", "COM²", "LPT³", "CONIN$", "CONOUT$", "NUL.txt", "CON ."] {
        assert!(!codes(board(name)).is_empty(), "{name}");
    }
    for name in ["COM10", "COM", "LPT", "CONS", "NULL", "AUX1", "COM1_"] {
        assert!(codes(board(name)).is_empty(), "{name}: {:?}", codes(board(name)));
    }
}

#[test]
fn boards_that_would_share_a_folder_or_a_name_are_refused() {
    for (first, second) in [("Robot", "ROBOT"), ("A_b", "Ab"), ("left", "Left"), ("a_1", "a1")] {
        let device =
            |id: u8| format!("sensor S{id} returns uint16 {{ id = {id}; type = analog; }}");
        let text = format!(
            "board {first} on STM32F4DiscoveryBoard {{ {} }}\nboard {second} on STM32F4DiscoveryBoard {{ {} }}",
            device(1),
            device(2)
        );
        assert_eq!(codes(text), ["E0205"], "{first} {second}");
    }
}
