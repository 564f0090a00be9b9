//! Warnings of `check` about what `generate` would refuse, and the target that is assumed if none
//! is named.

use sensedsl_tests::{Scratch, sensedsl};

/// Two motor bridges on an RP2040, which has no firmware for them, with rules in their chip.
fn bridges(rules: &str) -> String {
    format!(
        "board Robot on RASPBERRYPI_PICO {{\n    chip Motors {{\n        driver = drv8833;\n        {rules}\n        \
         actuator SpeedA accepts int16 {{}}\n        actuator SpeedB accepts int16 {{}}\n    }}\n}}\n"
    )
}

#[test]
fn check_warns_of_what_generate_refuses() {
    let scratch = Scratch::new("foreseen");
    let file = scratch.write("robot.sense", bridges("")).display().to_string();
    let out = scratch.join("build").display().to_string();
    let refused = sensedsl(["generate", &file, "-o", &out]).run().exits(1).stderr;
    assert!(refused.contains("error[E0501]"), "{refused}");
    let said = sensedsl(["check", &file, "--format", "json"]).run().exits(0).json();
    let all = said["diagnostics"].as_array().unwrap();
    let gap = all.iter().find(|one| one["code"] == "W0615").unwrap_or_else(|| panic!("{said:#}"));
    let message = gap["message"].as_str().unwrap();
    assert!(message.starts_with("target embassy: no firmware can be generated for "), "{message}");
    assert!(message.ends_with("(E0501)"), "{message}");
    // The warning has the same sentence as the error, at the same place.
    let sentence = message.trim_start_matches("target embassy: ").trim_end_matches(" (E0501)");
    assert!(refused.contains(sentence), "{refused}");
    assert!(gap.to_string().contains("robot.sense"), "{gap}");
}

#[test]
fn whoever_writes_the_firmware_allows_the_gap() {
    let own = bridges("allow W0615 \"own firmware\";");
    let said = sensedsl(["check", "-"]).stdin(own.as_str()).run().exits(0).stderr;
    assert!(!said.contains("W0615") && !said.contains("W0604"), "{said}");
    // Without the library's firmware nothing is missing, and the rule is not reported as unused.
    let said = sensedsl(["solve", "-"]).stdin(own.as_str()).run().exits(0).stderr;
    assert!(!said.contains("W0604"), "{said}");
    let pure = sensedsl(["check", "-", "--target", "none"]).stdin(bridges("")).run().exits(0);
    assert!(!pure.stderr.contains("W0615"), "{}", pure.stderr);
}

#[test]
fn embassy_is_meant_where_chibios_has_nothing() {
    let scratch = Scratch::new("usual-target");
    for board in ["RASPBERRYPI_PICO", "NUCLEO_H563ZI", "NUCLEO_C031C6", "NUCLEO_L152RE"] {
        let text = format!(
            "board Robot on {board} {{\n    sensor Light returns uint16 {{ type = analog; }}\n}}\n"
        );
        let file = scratch.write(&format!("{board}.sense"), &text).display().to_string();
        let said = sensedsl(["check", &file]).run().exits(0).stderr;
        assert!(!said.contains("H0702") && !said.contains("W0615"), "{board}: {said}");
        let out = scratch.join(board).display().to_string();
        let _ = sensedsl(["generate", &file, "-o", &out]).run().exits(0);
        let firmware = scratch.join(board).join("firmware/Robot/Cargo.toml");
        assert!(firmware.is_file(), "{board}: no {}", firmware.display());
    }
}

#[test]
fn a_rule_that_allowed_something_is_not_called_unused() {
    let text = "board R on NUCLEO_F446RE {\n    allow W0605 \"the LED may blink\";\n    \
        actuator L accepts bool { type = digital; pin = PA5; }\n}\n";
    let said = sensedsl(["simulate", "-", "--seconds", "0.01"]).stdin(text).run().stderr;
    assert!(!said.contains("W0604"), "{said}");
}

#[test]
fn rules_about_nothing_are_told() {
    let text = "board R on NUCLEO_F446RE {\n    avoid pin = PZ9;\n    \
        sensor A returns uint16 { type = analog; avoid unit = TIM99; prefer side = middle; avoid unit = ADC1; }\n}\n";
    let said = sensedsl(["check", "-"]).stdin(text).run().exits(0).stderr;
    for rule in ["avoid pin = PZ9", "avoid unit = TIM99", "prefer side = middle"] {
        assert!(said.contains(&format!("`{rule}` has no effect")), "{rule}: {said}");
    }
    assert!(said.contains("did you mean `TIM9`?"), "{said}");
    assert_eq!(said.matches("W0604").count(), 3, "{said}");
}

#[test]
fn a_repair_names_its_board_among_several() {
    let pins = "Pin,ADC\nPA0,ADC1_IN0\n";
    let scratch = Scratch::new("unreserve");
    scratch.write("a.csv", pins);
    let text = "board One on \"a.csv\" { reserve PA0; }\nboard Two on \"a.csv\" { reserve PA0; \
        sensor A returns uint16 { type = analog; } }\n";
    let file = scratch.write("two.sense", text).display().to_string();
    let said = sensedsl(["check", &file]).run().exits(1).stderr;
    assert!(said.contains("do not reserve PA0 of Two"), "{said}");
}
