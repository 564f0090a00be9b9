//! Mistakes in templates and in the runtime that the stubs must refuse: a wrong field, a wrong
//! call, a wrong object, a unit that is switched off. Each is put into files that compile without
//! it.

use sensedsl_tests::{one_in, text};

use super::super::tools::scratch;
use super::compiler::{compile, is_here, macros_of, write};
use super::designs::{Made, make};

const HARDWARE: &str = "generated/sense_hw.c";
const SETTINGS: &str = "cfg/mcuconf.h";

/// A mistake: board, design (of one kind, or by its path), file (of the runtime, or by its path), a text in it, and its
/// replacement.
type Mistake = (&'static str, &'static str, &'static str, &'static str, &'static str);

const F1: &str = "BLUEPILL_F103C8";
const F4: &str = "NUCLEO_F446RE";
const F3: &str = "NUCLEO_F303RE";
const G0: &str = "NUCLEO_G0B1RE";
const G4: &str = "B_G474E_DPOW1";
const H7: &str = "NUCLEO_H743ZI";

/// Mistakes for every driver, in every version that has fields of its own.
const MISTAKES: &[Mistake] = &[
    (F4, "analog", HARDWARE, ".sqr3 =", ".sqr4 ="),
    (F4, "analog", HARDWARE, ".driver = &ADCD1", ".driver = &ADCD2"),
    (F4, "analog", "up_adc.c", "(uint8_t)(mean >> 8)", "mean >> 8"),
    (F1, "analog", HARDWARE, ".sqr3 =", ".chselr ="),
    (F3, "analog", HARDWARE, ".smpr =", ".smpr1 ="),
    (G0, "analog", HARDWARE, ".chselr =", ".sqr ="),
    (H7, "analog", HARDWARE, ".pcsel =", ".tr1 ="),
    (F4, "i2c", HARDWARE, ".clock_speed =", ".timingr ="),
    (F4, "i2c", HARDWARE, "OPMODE_I2C", "OPMODE_SMBUS"),
    (G0, "i2c", HARDWARE, ".timingr =", ".clock_speed ="),
    (F4, "i2c", "up_i2c_bus.c", "SR2 & I2C_SR2_BUSY", "SR3 & I2C_SR2_BUSY"),
    (F4, "spi", HARDWARE, ".ssline =", ".sspad ="),
    (F4, "spi", HARDWARE, "SPI_CR1_CPHA", "SPI_CR1_PHASE"),
    (F4, "spi", HARDWARE, ".driver = &SPID", ".driver = &I2CD"),
    (F3, "spi", HARDWARE, "SPI_CR2_DS_2", "SPI_CR2_DS_4"),
    (H7, "spi", HARDWARE, "SPI_CFG1_MBR_DIV", "SPI_CR1_BR_"),
    (
        F4,
        "spi",
        "up_spi_bus.c",
        "spiStopTransfer(port->driver, NULL)",
        "spiStopTransfer(port->driver)",
    ),
    (F4, "can", HARDWARE, "canSTM32SetFilters(&CAND1, 14U,", "canSTM32SetFilters(&CAND1,"),
    (F4, "can", "up_can.c", "config->btr =", "config->NBTP ="),
    (G4, "can", "up_can.c", "config->NBTP =", "config->btr ="),
    (G4, "can", "up_can.c", "= OPMODE_CAN;", "= OPMODE_CLASSIC;"),
    (G4, "can", "up_can.c", "frame->std.SID = ", "frame->std.EID = "),
    (F4, "uart", HARDWARE, ".speed = 115200U", ".baud = 115200U"),
    (
        F4,
        "uart",
        "up_uart.c",
        "sdReadTimeout(port->driver, bytes, 1U,",
        "sdReadTimeout(port->driver, bytes,",
    ),
    (F4, "icu", HARDWARE, ".period_cb =", ".cycle_cb ="),
    (F4, "pwm", HARDWARE, ".period =", ".top ="),
    (F4, "dac", HARDWARE, ".datamode =", ".mode ="),
    (F4, "digital", "up_digital.c", "palEnableLineEvent(input->line, ", "palEnableLineEvent("),
    (F4, "encoder", HARDWARE, "rccResetTIM", "rccResetTimer"),
    (F4, "analog", "up_main.c", "task->stack, task->stack_bytes,", "task->stack,"),
    (F4, "analog", "up_life.c", ".rlr =", ".reload ="),
    (F4, "mixed/usb", "up_link_usb.c", "sduStart(&channel,", "sduStart(channel,"),
    (F4, "mixed/uart", HARDWARE, ".link_config = &link_config", ".link_config = link_config"),
    (F4, "spi", SETTINGS, "STM32_SPI_USE_SPI2 TRUE", "STM32_SPI_USE_SPI2 FALSE"),
    (F4, "pwm", SETTINGS, "#define STM32_PWM_USE_TIM", "#define STM32_PWM_USES_TIM"),
];

#[test]
fn mistakes_in_templates_are_refused() {
    if !is_here() {
        return;
    }
    let place = scratch("stubs/refused");
    let mut passed = Vec::new();
    for (index, (board, design, path, find, with)) in one_in(12, MISTAKES.iter().enumerate()) {
        let folder = if design.contains('/') { "" } else { "kinds/" };
        let design = text(&format!("tests/firmware/{folder}{design}.sense"));
        let design = design.replace("BOARD", board);
        let Made::Firmware(mut boards, _) = make(&design) else { panic!("{board}: {design}") };
        let (_, mut files) = boards.remove(0);
        let folder = if path.contains('/') { "" } else { "uproxy/chibios/" };
        let path = &*format!("{folder}{path}");
        let file = files.get_mut(path).unwrap();
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
