//! Analog sensors and outputs of generated applications: what is converted together, and where the
//! samples are stored.

use std::process::Command;

use super::applications::files;
use super::tools::{has, root, scratch};

fn hardware(text: &str, board: &str) -> String {
    files(text)[&format!("{board}/generated/sense_hw.c")].clone()
}

/// The PF pins belong only to the third converter, PA4 and PA5 only to the others.
const SPREAD: &str = "board Spread on NUCLEO_F446ZE {
    sensor Line returns uint16[4] { id = 1; type = analog; delay = 20 ms; pin = [PF3, PA6, PF4, PA7]; }
    sensor Near returns float32 { id = 2; type = analog; delay = 20 ms; samples = 5; pin = PB0; }
    sensor Warm returns int32 { id = 3; driver = ntc; delay = 1 s; }
    actuator Out accepts uint16 { id = 4; type = dac; failsafe = 2048; pin = PA4; }
}
";

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

#[test]
fn a_formula_is_computed_on_the_board() {
    let text = hardware(SPREAD, "Spread");
    assert!(text.contains(".formula = &up_formula_ntc,"), "{text}");
    assert!(text.contains(".column = 0U, .formula = &warm_formula},"), "{text}");
}

/// The start value is the failsafe value: an output has it before the host sends anything.
#[test]
fn an_output_starts_where_it_falls_back_to() {
    let text = hardware(SPREAD, "Spread");
    assert!(
        text.contains("/* Out at PA4 (DAC1_OUT1) */\nstatic const DACConfig out_config"),
        "{text}"
    );
    assert!(text.contains("    .init = 2048U,\n"), "{text}");
    assert!(text.contains("  (void)dacStart(&DACD1, &out_config);\n"), "{text}");
    assert!(text.contains("      up_dac_set(&DACD1, field, value, 0U);\n"), "{text}");
    assert!(text.contains("  (void)dacPutChannelX(&DACD1, 0U, 2048U);\n"), "{text}");
    let settings = &files(SPREAD)["Spread/cfg/mcuconf.h"];
    assert!(settings.contains("#define STM32_DAC_USE_DAC1_CH1 TRUE"), "{settings}");
}

/// The basic DMA controller of the third converter reaches only one memory, and neither memory is
/// cached.
#[test]
fn samples_lie_where_the_controller_reaches_them() {
    let text = "board Fast on NUCLEO_H743ZI {
        sensor Line returns uint16[2] { id = 1; type = analog; pin = [PF3, PF11]; }
    }";
    let all = files(text);
    let hardware = &all["Fast/generated/sense_hw.c"];
    assert!(hardware.contains("static UP_DMA_BUFFER adcsample_t adc1_"), "{hardware}");
    assert!(hardware.contains("static UP_BDMA_BUFFER adcsample_t adc3_"), "{hardware}");
    assert!(hardware.contains(".full = 65535U,"), "{hardware}");
    let sizes = &all["Fast/cfg/up_conf.h"];
    assert!(sizes.contains("#define UP_DMA_SECTION \".nocache\""), "{sizes}");
    assert!(sizes.contains("#define UP_BDMA_SECTION \".ram4\""), "{sizes}");
    let settings = &all["Fast/cfg/mcuconf.h"];
    for expected in ["STM32_NOCACHE_ENABLE TRUE", "STM32_ADC_ADC3_USE_BDMA TRUE"] {
        assert!(settings.contains(expected), "{settings}");
    }
    // Stream 0 of one controller is not stream 0 of the other.
    assert!(!hardware.contains("two drivers have one DMA stream"), "{hardware}");
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
    let core = ["convert", "schema", "value", "checksum", "formula_ntc", "text"];
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
    compiler
        .arg(root.join("crates/firmware-chibios/runtime/up_dac.c"))
        .args(core)
        .arg("-o")
        .arg(&program);
    let built = compiler.output().unwrap();
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let ran = Command::new(&program).output().unwrap();
    Some((ran.status.success(), String::from_utf8_lossy(&ran.stdout).into_owned()))
}

#[test]
fn conversions_end_fail_and_hang() {
    let Some((is_well, said)) = runtime_says("analog-runtime", None) else { return };
    assert!(is_well && said.contains(" checks, 0 failures"), "{said}");
}

#[test]
fn a_broken_thread_is_noticed() {
    let changes = [
        ("    adcStopConversion(one->driver);\n", ""),
        ("  adcReleaseBus(one->driver);\n", ""),
        ("  one->driver->up_errors = 0U;\n", ""),
        ("(uint64_t)sum * RAW_FULL", "sum"),
        ("(uint64_t)count * group->full", "count"),
        ("adc->inputs[i + 1U].field != input->field", "true"),
        ("(result == UP_FRESH) ? own : result", "own"),
        ("if (one->driver->state == ADC_ACTIVE) {", "{"),
    ];
    for (at, change) in changes.into_iter().enumerate() {
        let Some((is_well, said)) = runtime_says(&format!("analog-broken-{at}"), Some(change))
        else {
            return;
        };
        assert!(!is_well, "{change:?} is not noticed: {said}");
    }
}
