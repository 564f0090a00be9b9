//! The designs that firmware is generated for, and their way from text to files.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::FileSet;
use sensedsl_generate::target;
use sensedsl_model::{Files, Request, Unread, Wanted, resolve};
use sensedsl_wiring::{Search, Solved, Wiring};

/// The paper's Fig. 2.
pub(crate) const FIG2: &str = include_str!("../../../examples/fig2.sense");

/// The car whose firmware was written by hand in 2014, as far as ChibiOS can capture it.
pub(crate) const CAR: &str = include_str!("../../../examples/miniature_car.sense");

/// C keywords as names, every property that changes the code, a serial link with a checksum.
pub(crate) const ODD: &str = "
board Odd on \"odd.csv\" {
    link { transport = uart; unit = USART3; baud = 460800; checksum = crc16; rate = 50 Hz; }
    sensor default returns float32 { id = 1; type = analog; samples = 7; sampling = 100; delay = 5; }
    sensor int returns int64 { id = 2; type = analog; samples = 1; delay = 1 s; prio = -3; }
    sensor volatile returns uint8 { id = 3; type = analog; delay = 1 s; prio = -3; }
    sensor register returns int16[3] { id = 4; type = i2c; address = 0x68; register = 0x3B; length = 6; speed = 400 kHz; }
    sensor NULL returns bool { id = 5; type = i2c; address = 0x20; length = 1; order = little; }
    sensor value returns float64 { id = 6; type = i2c; address = 0x21; register = 0; length = 8; delay = 20; }
    actuator struct accepts int16[2] { id = 7; type = i2c; address = 0x22; register = 0x10; length = 4; delay = 20; }
    sensor TRUE returns uint32 { id = 8; type = icu; mode = frequency; }
    sensor pads returns uint16 { id = 9; type = icu; mode = duty; edge = falling; }
    sensor errno returns uint64 { id = 10; type = icu; edge = both; }
    sensor main returns float32 { id = 11; type = icu; mode = period; resolution = 10 us; }
    sensor NDEBUG returns int8 { id = 13; type = icu; unit = TIM5; }
    sensor range returns uint16 { id = 12; type = icu; driver = hcsr04; delay = 100; }
}
";

/// A board of the user's with usages that Table 1 lacks.
const ODD_TABLE: &str = "\
# mcu = STM32F407VGT6
Pin,ADC,I2C,ICU,UART
PA0,-,-,-,-
PB0,ADC12_IN8,-,-,-
PC1,ADC123_IN11,-,-,-
PC4,ADC12_IN14,-,-,-
PB6,-,I2C1_SCL@4,-,-
PB7,-,I2C1_SDA,-,-
PA8,-,-,TIM1_CH1,-
PA1,-,-,TIM2_CH2 TIM5_CH2,-
PA15,-,-,TIM2_CH1,-
PB4,-,-,TIM3_CH1,-
PD12,-,-,TIM4_CH1@2,-
PE5,-,-,TIM9_CH1,-
PD8,-,-,-,USART3_TX
PD9,-,-,-,USART3_RX
";

/// Two boards in one file, each with its own devices.
pub(crate) const TWO: &str = "
board Front on STM32F4DiscoveryBoard {
    sensor Left returns uint16 { id = 1; type = analog; delay = 20; }
    sensor Right returns uint16 { id = 2; type = analog; delay = 20; }
}
board Rear on STM32F4DiscoveryBoard {
    sensor Wheel returns uint32 { id = 3; type = icu; }
}
";

/// All uses of timers and pins: arrays, chips, edges, bridges, a receiver, rangers.
pub(crate) const PINS: &str = "
board Pins on NUCLEO_F446RE {
    link { transport = uart; }
    sensor WheelEncoder returns uint32 { id = 1; type = icu; edge = both; }
    sensor Wheel returns int16 { id = 2; type = encoder; }
    actuator Esc accepts uint16[4] { id = 3; driver = esc; together = unit; }
    chip Left {
        driver = gearmotor_tb6612;
        actuator Speed accepts int16 { id = 4; }
        sensor Position returns int32 { id = 5; }
    }
    sensor Bumper returns bool { id = 6; driver = push_button; delay = 20; }
    sensor Line returns uint8[4] { id = 7; type = digital; pull = up; delay = 20; }
    sensor Stop returns bool { id = 8; driver = emergency_stop; }
    sensor Clicks returns uint16 { id = 9; type = digital; edge = falling; pull = up; }
    actuator Relay accepts bool { id = 10; driver = relay_active_low; }
    actuator Leds accepts bool[3] { id = 11; type = digital; initial = true; }
    sensor Rc returns uint16[8] { id = 12; driver = ppm; }
    sensor Ranges returns uint16[2] { id = 13; driver = hcsr04; delay = 200; }
}
";

/// The files that a design may name.
struct Tables;

impl Files for Tables {
    fn read(&self, wanted: &Wanted<'_>) -> Result<String, Unread> {
        match wanted.path {
            "odd.csv" => Ok(ODD_TABLE.to_owned()),
            path if path.starts_with("pin ") => {
                let pin = path.trim_start_matches("pin ");
                Ok(format!("# mcu = STM32F407VGT6\nPin,ADC\n{pin},ADC12_IN8\n"))
            }
            "emulated.csv" => Ok(super::emulated::TABLE.to_owned()),
            _ => Err(Unread::Missing),
        }
    }
}

/// The files for a text, or its diagnostics.
pub(crate) fn generate(text: &str) -> Result<FileSet, Vec<Diagnostic>> {
    generate_for(None, text)
}

fn generate_for(target: Option<&str>, text: &str) -> Result<FileSet, Vec<Diagnostic>> {
    let request = Request { path: "test.sense", text, target, ..Request::default() };
    let resolved = resolve(&request, &Tables);
    let Some(design) = resolved.design else { panic!("{:#?}", resolved.diagnostics) };
    match Wiring::new(&design, None).solve(&Search::default()) {
        Solved::Wired(assignment) => target::firmware(&design, &assignment),
        other @ (Solved::Infeasible(_) | Solved::Failed(_)) => panic!("{other:#?}"),
    }
}

/// The files of a design for which generation must succeed, by path.
pub(crate) fn files(text: &str) -> BTreeMap<String, String> {
    let files = generate(text).unwrap_or_else(|diagnostics| panic!("{diagnostics:#?}"));
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    files.iter().map(|(path, entry)| (path.to_owned(), text(&entry.bytes))).collect()
}

fn codes(target: Option<&str>, text: &str) -> Vec<&'static str> {
    let diagnostics = generate_for(target, text).unwrap_err();
    diagnostics.iter().map(|one| one.code.info().code).collect()
}

#[test]
fn generating_twice_gives_the_same_bytes() {
    for text in [FIG2, CAR, ODD, TWO, PINS] {
        assert_eq!(generate(text).unwrap(), generate(text).unwrap());
    }
}

#[test]
fn fig2_has_a_group_a_bus_and_a_counter() {
    let files = files(FIG2);
    let board = "STM32F4DiscoveryBoard";
    let hardware = &files[&format!("{board}/generated/sense_hw.c")];
    for expected in [
        "PAL_LINE(GPIOB, 0U), PAL_MODE_INPUT_ANALOG",
        "PAL_LINE(GPIOB, 4U), PAL_MODE_ALTERNATE(2)",
        "PAL_LINE(GPIOC, 9U), PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN",
        "/* ADC1 60 ms:\n * IRFrontRight at PB1 (ADC12-IN9) */",
        "/* ADC1 1000 ms:\n * IRFront at PB0 (ADC12-IN8) */",
        "/* I2C3 40 ms +2: USRear */",
        ".address = 0x73U",
        ".wait_ms = 65U",
        ".driver = &ICUD3",
        ".channel = ICU_CHANNEL_1",
    ] {
        assert!(hardware.contains(expected), "{expected} is missing in\n{hardware}");
    }
    assert!(files[&format!("{board}/generated/sense_model.h")].contains("REPORT_FRAME_BYTES 91U"));
    assert!(files[&format!("{board}/cfg/mcuconf.h")].contains("STM32_ST_USE_TIMER 2"));
    assert!(generate(FIG2).unwrap().get(&format!("{board}/user/user.c")).unwrap().once);
}

#[test]
fn one_thread_serves_what_is_alike() {
    let files = files(CAR);
    let hardware = &files["STM32F4DiscoveryBoard/generated/sense_hw.c"];
    assert!(hardware.contains("/* ADC1 60 ms +12:\n * "), "{hardware}");
    assert_eq!(hardware.matches("THD_WORKING_AREA(").count(), 2);
    assert_eq!(hardware.matches("up_adc_t adc1_").count(), 1);
    assert_eq!(hardware.matches("static const I2CConfig").count(), 1);
    // Seven captures take every timer, except for one of the two that share PA1.
    let settings = &files["STM32F4DiscoveryBoard/cfg/mcuconf.h"];
    assert!(settings.contains("#define STM32_ST_USE_TIMER 5\n"), "{settings}");
    assert_eq!(settings.matches("STM32_ICU_USE_TIM").count(), 14);
}

#[test]
fn the_kernel_takes_the_tick_when_devices_have_its_timers() {
    let text = "board STM32F4DiscoveryBoard {
        sensor A returns uint32 { id = 1; type = icu; unit = TIM2; }
    }";
    let two = &files(text)["STM32F4DiscoveryBoard/cfg/mcuconf.h"];
    assert!(two.contains("STM32_ST_USE_TIMER 5"), "{two}");
    let odd = files(ODD);
    assert!(!odd["Odd/cfg/mcuconf.h"].contains("STM32_ST_USE_TIMER"));
    assert!(odd["Odd/cfg/chconf.h"].contains("#define CH_CFG_ST_TIMEDELTA 0\n"));
}

/// The failsafe value of an actuator is handled like a value from the host, whatever it is
/// connected to.
#[test]
fn a_failsafe_is_a_value_of_the_type() {
    let text = "board NUCLEO_F446RE {
        link { transport = uart; }
        actuator Relays accepts bool[2] { driver = relay_active_low; initial = true; failsafe = false; }
        actuator Level accepts uint16 { type = i2c; address = 0x20; register = 1; failsafe = 300; }
        actuator Torque accepts int16 { type = can; frame = 0x121; failsafe = -5; }
        chip Left { driver = gearmotor_tb6612; actuator Speed accepts int16 { failsafe = raw 7; } }
        actuator Voltage accepts float32 { type = spi; failsafe = 0.5; }
        actuator Free accepts bool { type = digital; }
    }";
    let files = files(text);
    let hardware = &files["NUCLEO_F446RE/generated/sense_hw.c"];
    let (_, body) = hardware.split_once("void sense_failsafe(void) {\n").unwrap();
    let (body, _) = body.split_once("\n}").unwrap();
    let expected = [
        "static const bool value_0[] = {false, false};",
        "static const uint16_t value_1[] = {UINT64_C(300)};",
        "static const int16_t value_2[] = {INT64_C(-5)};",
        "static const int16_t value_3[] = {INT64_C(7)};",
        "static const float value_4[] = {0.5F};",
        "up_fall_back(SENSE_FIELD_Relays, value_0);",
        "up_fall_back(SENSE_FIELD_Level, value_1);",
        "up_fall_back(SENSE_FIELD_Torque, value_2);",
        "up_fall_back(SENSE_FIELD_Speed, value_3);",
        "up_fall_back(SENSE_FIELD_Voltage, value_4);",
    ];
    for line in expected {
        assert!(body.contains(line), "{line} is missing in\n{body}");
    }
    assert!(!body.contains("Free"), "{body}");
    assert!(files["NUCLEO_F446RE/cfg/up_conf.h"].contains("#define UP_SILENCE_MS 500U"));
}

/// The name of an array's element can also be the name of a device.
#[test]
fn names_of_elements_and_devices_differ() {
    let text = "board STM32F407G_DISC1 {
        sensor Wheels returns uint32[2] { type = icu; }
        sensor Wheels_0 returns uint32 { type = icu; }
    }";
    let hardware = &files(text)["STM32F407G_DISC1/generated/sense_hw.c"];
    for name in ["wheels_0", "wheels_0_", "wheels_1"] {
        let config = format!("static const ICUConfig {name}_icu_config = ");
        assert_eq!(hardware.matches(&config).count(), 1, "{name} in\n{hardware}");
    }
}

#[test]
fn files_end_with_a_line_end_and_have_no_empty_runs() {
    for text in [FIG2, CAR, ODD, TWO, PINS] {
        for (path, text) in files(text) {
            assert!(text.ends_with('\n') && !text.ends_with("\n\n"), "{path}");
            assert!(!text.contains("\n\n\n"), "{path}");
            assert!(text.lines().all(|line| line == line.trim_end()), "{path}");
        }
    }
}

#[test]
fn boards_stand_beside_each_other() {
    let files = files(TWO);
    assert!(files["Front/generated/sense_hw.c"].contains("IN8"));
    assert!(!files["Front/generated/sense_hw.c"].contains("Wheel"));
    assert!(files["Rear/generated/sense_hw.c"].contains("Wheel"));
    assert!(files["Rear/cfg/halconf.h"].contains("HAL_USE_ADC FALSE"));
}

/// The driver halts the board if its clock does not divide evenly, and spins while a bus is busy.
#[test]
fn a_bus_gets_a_clock_that_the_driver_accepts() {
    let text = "board STM32F4DiscoveryBoard {
        sensor A returns uint16 { id = 1; type = i2c; address = 0x20; speed = 300 kHz; }
    }";
    let files = files(text);
    let hardware = &files["STM32F4DiscoveryBoard/generated/sense_hw.c"];
    assert!(
        hardware.contains("/* 280000 Hz: the fastest that the unit makes, up to 300000 Hz. */"),
        "{hardware}"
    );
    assert!(hardware.contains(".clock_speed = 280000U,"), "{hardware}");
    assert!(hardware.contains("STM32_PCLK1 % (3U * 280000U) == 0U"), "{hardware}");
    let settings = &files["STM32F4DiscoveryBoard/cfg/mcuconf.h"];
    assert!(settings.contains("#define STM32_I2C_BUSY_TIMEOUT 1\n"), "{settings}");
}

#[test]
fn timers_and_pins_read_as_written_by_hand() {
    let files = files(PINS);
    let hardware = &files["Pins/generated/sense_hw.c"];
    for expected in [
        // Both edges of the wheel, and a train that is ended when the timer wraps.
        "up_capture_on_width(&wheel_encoder_raw, (uint32_t)icuGetWidthX(driver), true);",
        "up_ppm_on_interval(&rc_train_config, &rc_raw, UINT32_MAX);",
        "up_icu_start(&ICUD2, &wheel_encoder_icu_config);",
        // The timer of an encoder is set through its registers; a counter of 16 bits is read in
        // time.
        "  rccEnableTIM4(true);\n  rccResetTIM4();\n  up_encoder_start(&position_counters[0]);",
        ".state = &position_states[0], .filter = 5U, .is_wide = false}",
        // Four speed controllers on one timer: 1 to 2 ms in the finest tick.
        "/* TIM3: 50 Hz, 60000 ticks of 3000000 Hz */",
        ".width = {3000U, 6000U}}",
        "      up_pwm_set(&esc_pwm, value);",
        // A bridge in the order of its wires, stopped at the start and when the host is silent.
        "    {.pwm = &speed_outputs[0]},\n    {.line = PAL_LINE(GPIOA, 10U)},",
        "      up_bridge_set(&speed_bridge, value);",
        // Levels are set before modes.
        "/* PA12 */ {PAL_LINE(GPIOA, 12U), PAL_MODE_OUTPUT_PUSHPULL, PAL_HIGH}",
        "/* PC4 */ {PAL_LINE(GPIOC, 4U), PAL_MODE_OUTPUT_PUSHPULL, PAL_HIGH}",
        "    .lasting = UP_LASTING_US(5000U),\n    .edge = UP_EDGE_BOTH,",
        "/* digital 20 ms: Bumper, Line */",
        "  up_digital_start(&clicks_digital);",
        // The second of two rangers waits until the first has received its echo.
        "    {.line = PAL_LINE(GPIOC, 12U), .apart_ms = 39U},\n",
        "    {.line = PAL_LINE(GPIOD, 2U)},\n",
        "STM32_TIMCLK1 % 90000000U == 0U",
    ] {
        assert!(hardware.contains(expected), "{expected} is missing in\n{hardware}");
    }
    assert_eq!(hardware.matches("up_bridge_set_level(&speed_bridge, 0);").count(), 2, "{hardware}");
    let settings = &files["Pins/cfg/mcuconf.h"];
    for expected in
        ["STM32_TIM4_IS_USED TRUE", "STM32_PWM_USE_TIM3 TRUE", "STM32_ICU_USE_TIM12 TRUE"]
    {
        assert!(settings.contains(expected), "{expected} is missing in\n{settings}");
    }
    assert!(!settings.contains("STM32_ICU_USE_TIM3 "), "{settings}");
    assert!(files["Pins/cfg/halconf.h"].contains("PAL_USE_CALLBACKS TRUE"));
}

/// An unknown port once became pad 0 of port A silently.
#[test]
fn a_pin_of_an_unknown_port_is_refused() {
    for (pin, known) in [("PB0", true), ("AIN8", false), ("PZ0", false), ("PB16", false)] {
        let text = format!(
            "board Odd on \"pin {pin}\" {{ sensor A returns uint16 {{ id = 1; type = analog; }} }}"
        );
        match generate(&text) {
            Ok(_) => assert!(known, "{pin}"),
            Err(why) => {
                let found: Vec<&str> = why.iter().map(|one| one.code.info().code).collect();
                assert_eq!((found, known), (vec!["E0511"], false), "{pin}: {why:#?}");
            }
        }
    }
}

#[test]
fn what_cannot_be_generated_is_said() {
    let analog = |properties: &str| {
        format!(
            "board STM32F4DiscoveryBoard {{
                sensor A returns uint16 {{ id = 1; type = {properties} }}
            }}"
        )
    };
    assert_eq!(codes(None, &analog("analog; sampling = 481;")), ["E0620"]);
    assert_eq!(codes(None, &analog("icu; resolution = 13 kHz;")), ["E0620"]);
    assert_eq!(codes(None, &analog("i2c; address = 0x20; speed = 5 kHz;")), ["E0620"]);
    assert_eq!(codes(Some("none"), FIG2), ["E0504"]);
}
