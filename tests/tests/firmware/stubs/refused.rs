//! Mistakes in templates and in the runtime that the stubs must refuse: a wrong field, a wrong
//! call, a wrong object, a unit that is switched off. Each is put into files that compile without
//! it.

use sensedsl_tests::{one_in, text};

use super::super::tools::scratch;
use super::compiler::{compile, is_here, macros_of, write};
use super::designs::{Made, make};

const HARDWARE: &str = "generated/sense_hw.c";
const SETTINGS: &str = "cfg/mcuconf.h";

/// A mistake: board, design, file, a text in it, and its replacement.
type Mistake = (&'static str, &'static str, &'static str, &'static str, &'static str);

const F1: &str = "BLUEPILL_F103C8";
const F4: &str = "NUCLEO_F446RE";
const F3: &str = "NUCLEO_F303RE";
const G0: &str = "NUCLEO_G0B1RE";
const G4: &str = "B_G474E_DPOW1";
const H7: &str = "NUCLEO_H743ZI";

/// Mistakes for every driver, in every version that has fields of its own.
const MISTAKES: &[Mistake] = &[
    (F4, "kinds/analog", HARDWARE, ".sqr3 =", ".sqr4 ="),
    (F4, "kinds/analog", HARDWARE, ".driver = &ADCD1", ".driver = &ADCD2"),
    (F4, "kinds/analog", "uproxy/chibios/up_adc.c", "(uint8_t)(mean >> 8)", "mean >> 8"),
    (F1, "kinds/analog", HARDWARE, ".sqr3 =", ".chselr ="),
    (F3, "kinds/analog", HARDWARE, ".smpr =", ".smpr1 ="),
    (G0, "kinds/analog", HARDWARE, ".chselr =", ".sqr ="),
    (H7, "kinds/analog", HARDWARE, ".pcsel =", ".tr1 ="),
    (F4, "kinds/i2c", HARDWARE, ".clock_speed =", ".timingr ="),
    (F4, "kinds/i2c", HARDWARE, "OPMODE_I2C", "OPMODE_SMBUS"),
    (G0, "kinds/i2c", HARDWARE, ".timingr =", ".clock_speed ="),
    (F4, "kinds/i2c", "uproxy/chibios/up_i2c_bus.c", "SR2 & I2C_SR2_BUSY", "SR3 & I2C_SR2_BUSY"),
    (F4, "kinds/spi", HARDWARE, ".ssline =", ".sspad ="),
    (F4, "kinds/spi", HARDWARE, "SPI_CR1_CPHA", "SPI_CR1_PHASE"),
    (F4, "kinds/spi", HARDWARE, ".driver = &SPID", ".driver = &I2CD"),
    (F3, "kinds/spi", HARDWARE, "SPI_CR2_DS_2", "SPI_CR2_DS_4"),
    (H7, "kinds/spi", HARDWARE, "SPI_CFG1_MBR_DIV", "SPI_CR1_BR_"),
    (
        F4,
        "kinds/spi",
        "uproxy/chibios/up_spi_bus.c",
        "spiStopTransfer(port->driver, NULL)",
        "spiStopTransfer(port->driver)",
    ),
    (F4, "kinds/can", HARDWARE, "canSTM32SetFilters(&CAND1, 14U,", "canSTM32SetFilters(&CAND1,"),
    (F4, "kinds/can", "uproxy/chibios/up_can.c", "config->btr =", "config->NBTP ="),
    (G4, "kinds/can", "uproxy/chibios/up_can.c", "config->NBTP =", "config->btr ="),
    (G4, "kinds/can", "uproxy/chibios/up_can.c", "= OPMODE_CAN;", "= OPMODE_CLASSIC;"),
    (G4, "kinds/can", "uproxy/chibios/up_can.c", "frame->std.SID = ", "frame->std.EID = "),
    (F4, "kinds/uart", HARDWARE, ".speed = 115200U", ".baud = 115200U"),
    (
        F4,
        "kinds/uart",
        "uproxy/chibios/up_uart.c",
        "sdReadTimeout(port->driver, bytes, 1U,",
        "sdReadTimeout(port->driver, bytes,",
    ),
    (F4, "kinds/icu", HARDWARE, ".period_cb =", ".cycle_cb ="),
    (F4, "kinds/pwm", HARDWARE, ".period =", ".top ="),
    (F4, "kinds/dac", HARDWARE, ".datamode =", ".mode ="),
    (
        F4,
        "kinds/digital",
        "uproxy/chibios/up_digital.c",
        "palEnableLineEvent(input->line, ",
        "palEnableLineEvent(",
    ),
    (F4, "kinds/encoder", HARDWARE, "rccResetTIM", "rccResetTimer"),
    (
        F4,
        "kinds/analog",
        "uproxy/chibios/up_main.c",
        "task->stack, task->stack_bytes,",
        "task->stack,",
    ),
    (F4, "kinds/analog", "uproxy/chibios/up_life.c", ".rlr =", ".reload ="),
    (F4, "mixed/usb", "uproxy/chibios/up_link_usb.c", "sduStart(&channel,", "sduStart(channel,"),
    (F4, "mixed/uart", HARDWARE, ".link_config = &link_config", ".link_config = link_config"),
    (F4, "kinds/spi", SETTINGS, "STM32_SPI_USE_SPI2 TRUE", "STM32_SPI_USE_SPI2 FALSE"),
    (F4, "kinds/pwm", SETTINGS, "#define STM32_PWM_USE_TIM", "#define STM32_PWM_USES_TIM"),
];

#[test]
fn mistakes_in_templates_are_refused() {
    if !is_here() {
        return;
    }
    let place = scratch("stubs/refused");
    let mut passed = Vec::new();
    for (index, (board, design, path, find, with)) in one_in(5, MISTAKES.iter().enumerate()) {
        let design = text(&format!("tests/firmware/{design}.sense")).replace("BOARD", board);
        let Made::Firmware(mut boards, _) = make(&design) else { panic!("{board}: {design}") };
        let (_, mut files) = boards.remove(0);
        let file = files.get_mut(*path).unwrap();
        assert!(file.contains(find), "{board}: {path} has no `{find}`\n{file}");
        *file = file.replace(find, with);
        let only: Vec<&str> = if path.ends_with(".c") { vec![path] } else { vec![HARDWARE] };
        let folder = place.join(index.to_string());
        write(&folder, &files);
        let reported = compile(&folder, &macros_of(board), "development", &only);
        if !reported.contains("error") {
            passed.push(format!("{board} {path}: `{with}` for `{find}`"));
        }
    }
    assert!(passed.is_empty(), "{passed:#?}");
}
