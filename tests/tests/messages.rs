//! The tool's appearance to people, as snapshots: its messages and its forms of a wiring.
//!
//! After an intended change: `cargo insta review`, or `INSTA_UPDATE=always`.

use sensedsl_tests::{design, sensedsl};

const FIG2: &str = "examples/fig2.sense";

fn settings() -> insta::Settings {
    let mut settings = insta::Settings::clone_current();
    settings.set_omit_expression(true);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_snapshot_path("../snapshots");
    settings
}

/// The output of `check` for people, about a file of the corpus.
fn reported(file: &str) -> String {
    let folder = sensedsl_tests::root().join("tests/corpus/err");
    let call = sensedsl(["check"]).within(&folder);
    let call = if file.ends_with(".csv") {
        call.arg("--board").arg(file).arg("-").stdin(design("Robot", &["analog"]))
    } else {
        call.arg(file)
    };
    let ran = call.run();
    format!("{}{}", ran.stderr, ran.stdout)
}

#[test]
fn messages_for_people() {
    let files = [
        "E0104_last_semicolon_missing.sense",
        "E0105_bracket.sense",
        "E0201_near.sense",
        "E0203_identifier.sense",
        "E0205_case.sense",
        "E0211_id_negative.sense",
        "E0304_pin_twice.csv",
        "E0306_misspelt_adc.csv",
        "E0314_pin_without_the_signal.sense",
        "E0316_pin_of_an_onboard_part.sense",
        "E0401_ten_analog.sense",
        "E0401_pulses_on_one_timer.sense",
        "W0602_srf08_every_40_ms.sense",
    ];
    settings().bind(|| {
        for file in files {
            insta::assert_snapshot!(file, reported(file));
        }
    });
}

#[test]
fn the_forms_of_a_wiring() {
    settings().bind(|| {
        for form in ["human", "csv", "markdown", "json", "svg"] {
            let ran = sensedsl(["solve", FIG2, "-q", "--format", form]).run().exits(0);
            insta::assert_snapshot!(format!("fig2.{form}"), ran.stdout);
        }
    });
}
