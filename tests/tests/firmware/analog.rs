//! Analog sensors and outputs of generated applications: what is converted together, and where the
//! samples are stored.

use std::process::Command;

use sensedsl_tests::{few, has, root, run};

use super::applications::files;
use super::tools::scratch;

fn hardware(text: &str, board: &str) -> String {
    files(text)[&format!("{board}/generated/sense_hw.c")].clone()
}

/// The PF pins belong only to the third converter, PA4 and PA5 only to the others.
const SPREAD: &str = include_str!("../../firmware/designs/spread.sense");

/// All elements are converted together, and the value is stored once all are there.
#[test]
fn an_array_over_two_converters_is_one_thread() {
    let text = hardware(SPREAD, "Spread");
    assert!(text.contains(".name = \"ADC1+ADC3 20 ms\""), "{text}");
    assert_eq!(text.matches("THD_WORKING_AREA(adc").count(), 2, "{text}");
    let elements = [
        "/* Line[0] at PF3 (ADC3_IN9) */\n    {.field = SENSE_FIELD_Line, .element = 0U, .samples = 32U, .group = 1U, .column = 0U},",
        "/* Line[1] at PA6 (ADC12_IN6) */\n    {.field = SENSE_FIELD_Line, .element = 1U, .samples = 32U, .group = 0U, .column = 0U},",
        "/* Line[2] at PF4 (ADC3_IN14) */\n    {.field = SENSE_FIELD_Line, .element = 2U, .samples = 32U, .group = 1U, .column = 1U},",
        "/* Line[3] at PA7 (ADC12_IN7) */\n    {.field = SENSE_FIELD_Line, .element = 3U, .samples = 32U, .group = 0U, .column = 1U},",
        "/* Near at PB0 (ADC12_IN8) */\n    {.field = SENSE_FIELD_Near, .element = 0U, .samples = 5U, .group = 0U, .column = 2U},",
    ];
    let mut rest = text.as_str();
    for one in elements {
        let at =
            rest.find(one).unwrap_or_else(|| panic!("{one} is missing or misplaced in\n{text}"));
        rest = &rest[at..];
    }
}

/// Runs the thread and the outputs on drivers that do what the test requests: conversions that end,
/// fail and hang.
fn runtime_says(scratch_name: &str, change: Option<(&str, &str)>) -> Option<(bool, String)> {
    if !has("gcc") {
        return None;
    }
    let folder = scratch(scratch_name);
    let (root, program) = (root(), folder.join("analog"));
    let adc =
        std::fs::read_to_string(root.join("crates/firmware-chibios/runtime/up_adc.c")).unwrap();
    let changed = change.map_or(adc.clone(), |(original, changed)| {
        assert_eq!(adc.matches(original).count(), 1, "{original}");
        adc.replace(original, changed)
    });
    std::fs::write(folder.join("up_adc.c"), changed).unwrap();
    let core =
        ["convert", "schema", "value", "lamps", "letters", "checksum", "formula_ntc", "text"];
    let core = core.map(|name| root.join(format!("crates/firmware-c/runtime/up_{name}.c")));
    let warnings =
        ["-Wall", "-Wextra", "-Wundef", "-Wstrict-prototypes", "-Wconversion", "-Wshadow"];
    let mut compiler = Command::new("gcc");
    compiler.args(["-std=c11", "-Werror", "-fsanitize=address,undefined"]).args(warnings);
    for include in
        ["tests/firmware/analog", "crates/firmware-c/runtime", "crates/firmware-chibios/runtime"]
    {
        compiler.arg("-I").arg(root.join(include));
    }
    compiler.arg(root.join("tests/firmware/analog/main.c")).arg(folder.join("up_adc.c"));
    compiler.arg(root.join("crates/firmware-chibios/runtime/up_dac.c")).args(core);
    run(compiler.arg("-o").arg(&program));
    let ran = Command::new(&program).output().unwrap();
    Some((ran.status.success(), String::from_utf8_lossy(&ran.stdout).into_owned()))
}

#[test]
fn conversions_end_fail_and_hang() {
    let Some((is_well, reported)) = runtime_says("analog-runtime", None) else { return };
    assert!(is_well && reported.contains(" checks, 0 failures"), "{reported}");
}

#[test]
fn a_broken_thread_is_noticed() {
    let changes = [
        ("    adcStopConversion(one->driver);\n", ""),
        ("  adcReleaseBus(one->driver);\n", ""),
        ("  one->driver->up_errors = 0U;\n", ""),
        ("sum, RAW_FULL, count", "sum, 1U, count"),
        ("RAW_FULL, count * group->full", "RAW_FULL, count"),
        ("adc->inputs[i + 1U].field != input->field", "true"),
        ("(result == UP_FRESH) ? own : result", "own"),
        ("if (one->driver->state == ADC_ACTIVE) {", "{"),
    ];
    for (at, change) in few(&changes, 2).iter().copied().enumerate() {
        let Some((is_well, reported)) = runtime_says(&format!("analog-broken-{at}"), Some(change))
        else {
            return;
        };
        assert!(!is_well, "{change:?} is not noticed: {reported}");
    }
}
