//! Projects of other tools: their devices, links and rules, and the tables with all pins of their
//! MCUs.
#![cfg(test)]
#![allow(missing_docs, reason = "tests")]

use sensedsl_board::table::{Occupation, Table, load};
use sensedsl_import::{Imported, ReadError, Source, import};

/// What comes of a file with others beside it.
fn with(name: &str, text: &str, files: &[(&str, &str)]) -> Imported {
    let beside = |path: &str| {
        let file = files.iter().find(|(name, _)| *name == path);
        file.map(|(_, text)| text.as_bytes().to_vec()).ok_or(ReadError::Missing)
    };
    import(&Source {
        name,
        bytes: text.as_bytes(),
        format: None,
        sheet: None,
        table: "pins.csv",
        beside: &beside,
    })
}

fn table(made: &Imported) -> Table {
    load(made.table.as_deref().unwrap()).board
}

/// The row of a pin: its usages, or what is on it.
fn row(made: &Imported, pin: &str) -> String {
    let table = table(made);
    let pin = table.pins.iter().find(|one| one.name.as_str() == pin).unwrap();
    let how = |how: &Occupation| Occupation::WORDS.iter().find(|(_, one)| one == how).unwrap().0;
    let onboard = pin.onboard.as_ref().map(|one| format!("{}:{} ", one.part, how(&one.how)));
    let usages: Vec<&str> = pin.usages.iter().map(|usage| usage.spelled.as_str()).collect();
    format!("{}{}", onboard.unwrap_or_default(), usages.join(" "))
}

fn program(made: &Imported) -> &str {
    made.program.as_deref().unwrap()
}

fn holds(made: &Imported, lines: &[&str]) {
    let program = program(made);
    for line in lines {
        assert!(program.contains(line), "{line}\n{program}");
    }
    assert_eq!(sensedsl_syntax::format(program).as_deref(), Ok(program));
}

fn says(made: &Imported, words: &str) -> bool {
    made.diagnostics.iter().any(|one| one.message.contains(words))
}

const IOC: &str = "\
Mcu.Name=STM32F407V(E-G)Tx\nMcu.UserName=STM32F407VGTx\nPA11.Mode=Device_Only\n\
PA11.Signal=USB_OTG_FS_DM\nPA12.Mode=Device_Only\nPA12.Signal=USB_OTG_FS_DP\n\
PB8.Signal=I2C1_SCL\nPB9.Signal=I2C1_SDA\nPA13.Signal=GPIO_Output\nPA13.GPIO_Label=LED [red]\n\
PB5.Signal=SPI1_MOSI\nPB3.Signal=SPI1_SCK\nPC6.Signal=USART6_TX\n\
PD12.Signal=S_TIM4_CH1\nSH.S_TIM4_CH1.0=TIM4_CH1,PWM Generation1 CH1\n\
PD13.Signal=S_TIM4_CH2\nSH.S_TIM4_CH2.0=TIM4_CH2,Input_Capture2_from_TI2\n\
PC8.Signal=S_TIM3_CH3\nSH.S_TIM3_CH3.0=TIM3_CH3,PWM Generation3 CH3\n\
PH0-OSC_IN.Signal=RCC_OSC_IN\n";

#[test]
fn a_project_has_all_pins_its_link_and_its_rules() {
    let made = with("rover.ioc", IOC, &[]);
    holds(
        &made,
        &[
            "    link {\n        transport = usb;\n        vbus = false;\n    }\n",
            "    release PA13; // otherwise for the debugger\n",
            "    reserve SPI1, USART6; // in use for what is not a device\n",
            "unit = TIM3;\n        pin = PC8;",
        ],
    );
    assert_eq!(table(&made).pins.len(), 82);
    assert_eq!(row(&made, "PB8"), "I2C1:bus I2C1_SCL");
    // The bus is on no other pins.
    assert!(!row(&made, "PB6").contains("I2C1"), "{}", row(&made, "PB6"));
    assert!(row(&made, "PD13").starts_with("TIM4_CH2:taken "));
    assert!(says(&made, "TIM4_CH2 of PD13 is left out: its timer puts out pulses"));
    assert!(row(&made, "PH0").starts_with("RCC_OSC_IN:taken"));
    assert!(row(&made, "PA0").contains("ADC123_IN0"));
}

/// A device that is added later can join the bus, as the debugger has given its pins up.
#[test]
fn a_bus_without_devices_keeps_the_pins_of_the_debugger() {
    let ioc = "Mcu.Name=STM32G474CBTx\nPA13.Signal=I2C1_SCL\nPA14.Signal=I2C1_SDA\n";
    let made = with("a.ioc", ioc, &[]);
    holds(&made, &["    release PA13, PA14; // otherwise for the debugger\n"]);
    assert_eq!(row(&made, "PA13"), "I2C1:bus I2C1_SCL");
}

#[test]
fn a_project_without_console_takes_what_is_free() {
    let ioc = "Mcu.Name=STM32F411CEUx\nPA11.Signal=GPIO_Output\nPA9.Signal=USART1_TX\n\
               PA10.Signal=USART1_RX\n";
    let made = with("a.ioc", ioc, &[]);
    holds(&made, &["    link {\n        transport = uart;\n    }\n"]);
    assert!(says(&made, "does not say how the board talks to a host"));
    let labelled = format!("{ioc}PA9.GPIO_Label=DEBUG_TX\n");
    let made = with("a.ioc", &labelled, &[]);
    holds(&made, &["transport = uart;\n        unit = USART1;"]);
    assert!(!program(&made).contains("Usart1Device") && !row(&made, "PB6").contains("USART1"));
    // On the USB pins as a host, the MCU has no device for the link.
    let host = "Mcu.Name=STM32F411CEUx\nPA11.Signal=USB_OTG_FS_DM\nPA12.Signal=USB_OTG_FS_DP\n\
                USB_OTG_FS.VirtualMode=Host_Only\n";
    holds(&with("a.ioc", host, &[]), &["transport = uart;"]);
    // Nothing else is on the board, so a crystal might be.
    let bare = with("a.ioc", "Mcu.Name=STM32F411CEUx\nPC14.Signal=GPIO_Output\n", &[]);
    holds(&bare, &["    release PC14; // otherwise for the oscillator\n"]);
    let unknown = with("a.ioc", "Mcu.Name=STM32MP999\nPA1.Signal=GPIO_Input\n", &[]);
    assert!(says(&unknown, "STM32MP999 is not among the known parts"));
    assert_eq!(table(&unknown).pins.len(), 1);
}

#[test]
fn the_smallest_part_of_a_line_is_told() {
    let hwdef = "MCU STM32H7xx STM32H743xx\nFLASH_SIZE_KB 2048\nSTDOUT_SERIAL SD7\n\
                 PE7 UART7_RX UART7\nPE8 UART7_TX UART7\nPC2 LED OUTPUT\n";
    let made = with("b/hwdef.dat", hwdef, &[]);
    assert!(says(&made, "the pins of STM32H743VI, the smallest part with all pins in use"));
    // In this package the pin has the name of its converter's side.
    holds(&made, &["unit = UART7;", "pin = PC2_C; // LED"]);
}

const DUMP: &str = "\
# Betaflight / STM32F405 (S405) 4.3.0\nboard_name FC\nresource BEEPER 1 C13\nresource MOTOR 1 B00\n\
resource MOTOR 2 A15\nresource SERIAL_TX 3 B10\nresource SERIAL_RX 3 B11\nresource SPI_SCK 1 A05\n\
resource SPI_MISO 1 A06\nresource SPI_MOSI 1 A07\nresource GYRO_CS 1 C02\nresource GYRO_EXTI 1 C03\n\
resource ADC_BATT 1 C00\nresource LED_STRIP 1 A08\nresource MOTOR 9 NONE\nresource LED 1 x9\n\
resource I2C_SCL 1 B06\nresource I2C_SDA 1 B07\ntimer B00 AF2\nset gyro_1_spibus = 1\n\
set baro_i2c_device = 1\nset baro_i2c_address = 118\n";

#[test]
fn a_dump_of_betaflight_becomes_devices() {
    let made = with("fc.config", DUMP, &[]);
    holds(
        &made,
        &[
            "board FC on",
            "transport = usb;",
            "actuator BEEPER accepts bool {",
            "type = pwm;\n        unit = TIM3;\n        pin = PB0; // MOTOR1",
            "type = pwm;\n        pin = PA15; // MOTOR2",
            "unit = USART3;",
            "sensor GYRO_CS returns uint8 {",
            "edge = rising;",
            "sensor ADC_BATT returns uint16 {",
            "sensor baro returns uint8 {",
            "address = 0x76;",
        ],
    );
    assert!(row(&made, "PA8").starts_with("LED_STRIP:taken"));
    assert!(says(&made, "`x9` is not a pin"));
}

#[test]
fn a_header_of_betaflight_becomes_the_same() {
    let header = "#pragma once\n#define FC_TARGET_MCU STM32F405\n#define BOARD_NAME FC\n\
                  #define MOTOR1_PIN PB0 // TIM3\n#define UART3_TX_PIN PB10\n#define UART3_RX_PIN PB11\n\
                  #define SPI1_SCK_PIN PA5\n#define SPI1_SDI_PIN PA6\n#define SPI1_SDO_PIN PA7\n\
                  #define GYRO_1_CS_PIN PC2\n#define GYRO_1_SPI_INSTANCE SPI1\n\
                  #define TIMER_PIN_MAPPING TIMER_PIN_MAP( 0, PB0 , 2,  0)\n\
                  #define I2C1_SCL_PIN PB6\n#define I2C1_SDA_PIN PB7\n\
                  #define BARO_I2C_INSTANCE (I2CDEV_1)\n#define DEFAULT_BARO_I2C_ADDRESS 0x76\n";
    holds(
        &with("config.h", header, &[]),
        &[
            "unit = TIM3;\n        pin = PB0; // MOTOR1",
            "sensor GYRO_CS ",
            "unit = USART3;",
            "sensor baro ",
        ],
    );
}

#[test]
fn a_board_of_micropython_has_labels_leds_and_its_prompt() {
    let pins = "# left\nX1,PA0\n-X2,PA1\nX3,-PA2\nY,PA3\nLED_RED,PA13\nSW,PB3\nodd,P\n";
    let header = "#define MICROPY_HW_BOARD_NAME \"PYB\"\n#define MICROPY_HW_MCU_NAME \"STM32F405RG\"\n\
                  #define MICROPY_HW_LED1 (pin_A13) // red\n#define MICROPY_HW_USRSW_PIN (pin_B3)\n\
                  #define MICROPY_HW_USRSW_PULL (GPIO_PULLUP)\n\
                  #define MICROPY_HW_UART_REPL PYB_UART_2\n\
                  #define MICROPY_HW_UART2_TX (pin_A2)\n#define MICROPY_HW_UART2_RX (pin_A3)\n";
    let made = with("pyb/pins.csv", pins, &[("mpconfigboard.h", header)]);
    holds(
        &made,
        &["board PYB on", "unit = USART2;", "release PA13;", "actuator LED_RED ", "pull = up;"],
    );
    assert!(says(&made, "`odd,P` is not a label"));
    let table = table(&made);
    assert_eq!(table.pins.first().and_then(|pin| pin.label.as_deref()), Some("X1"));
    let alone = with("pyb/pins.csv", "LED,GPIO25\nGP0,GPIO0\n", &[]);
    assert!(says(&alone, "`mpconfigboard.h` is not beside the file"));
    assert!(alone.table.as_deref().unwrap().starts_with("# mcu = RP2040\n"));
    holds(&alone, &["actuator LED accepts bool {", "pin = GP25;"]);
}

const BOARD: &str = "\
/dts-v1/;\n#include <st/f4/stm32f446Xe.dtsi>\n#include <st/f4/stm32f446r(c-e)tx-pinctrl.dtsi>\n\
#include \"more.dtsi\"\n#include \"none.dtsi\"\n\
/ {\n\tchosen { zephyr,console = &usart2; };\n\tleds {\n\t\tcompatible = \"gpio-leds\";\n\
\t\tgreen: led_0 { gpios = <&gpioa 5 GPIO_ACTIVE_HIGH>; };\n\t};\n\tkeys {\n\
\t\tcompatible = \"gpio-keys\";\n\t\tbutton { gpios = <&gpioc 13 (GPIO_ACTIVE_LOW | GPIO_PULL_UP)>; };\n\t};\n};\n\
&usart2 { pinctrl-0 = <&usart2_tx_pa2 &usart2_rx_pa3>; current-speed = <9600>; status = \"okay\"; };\n\
&usart6 { pinctrl-0 = <&usart6_tx_pc6>; status = \"disabled\"; };\n\
&spi1 {\n\tpinctrl-0 = <&spi1_sck_pb3\n\t\t&spi1_miso_pb4 &spi1_mosi_pb5>;\n\
\tcs-gpios = <&gpiob 6 GPIO_ACTIVE_LOW>, <&gpiod 2 0>;\n\tflash: flash@1 { reg = <1>; };\n};\n\
&timers4 { pwm4: pwm { pinctrl-0 = <&tim4_ch3_pb8>; }; };\n";

#[test]
fn a_board_of_zephyr_becomes_devices() {
    let more =
        "&i2c2 { pinctrl-0 = <&i2c2_scl_pb10 &i2c2_sda_pc12>;\n bme280@77 { reg = <0x77>; }; };\n";
    let made = with("boards/demo.dts", BOARD, &[("more.dtsi", more)]);
    holds(
        &made,
        &[
            "board demo on",
            "unit = USART2;\n        baud = 9600;",
            "actuator green accepts bool {",
            "sensor button returns bool {",
            "pull = up;",
            "sensor bme280 returns uint8 {",
            "address = 0x77;",
            "cs = PD2; // flash",
            "cs = PB6;",
            "unit = TIM4;\n        pin = PB8;",
        ],
    );
    assert!(!program(&made).contains("USART6"));
    assert!(says(&made, "`none.dtsi` is not beside the file"));
    assert!(made.table.as_deref().unwrap().starts_with("# mcu = STM32F446RETX\n"));
}

#[test]
fn an_overlay_takes_the_mcu_of_its_board() {
    let overlay = "&i2c1 { pinctrl-0 = <&i2c1_scl_pb8 &i2c1_sda_pb9>; };\n";
    let made = with("boards/nucleo_f446re.overlay", overlay, &[]);
    assert!(made.table.as_deref().unwrap().starts_with("# mcu = STM32F446RET6\n"));
    assert_eq!(row(&made, "PB8"), "I2C1:bus I2C1_SCL");
    let pico = "#include <raspberrypi/rpi_pico/rp2040.dtsi>\n&pinctrl { uart0_default: uart0 {\n\
                g1 { pinmux = <UART0_TX_P0>; };\n g2 { pinmux = <UART0_RX_P1>; }; }; };\n\
                &uart0 { pinctrl-0 = <&uart0_default>; };\n";
    let made = with("pico.dts", pico, &[]);
    holds(&made, &["unit = UART0;", "tx = GP0;", "rx = GP1;"]);
}

#[test]
fn a_variant_of_an_arduino_core_becomes_a_board() {
    let header = "#pragma once\n#define PA10 2\n#define PA0 PIN_A0\n#define PA5 PIN_A8 // LED\n\
                  #define NUM_DIGITAL_PINS 52\n#define LED_GREEN PA5\n#ifndef LED_BUILTIN\n\
                  #define LED_BUILTIN LED_GREEN\n#endif\n#define USER_BTN PC13\n\
                  #define SERIAL_UART_INSTANCE 2\n#define PIN_SERIAL_RX PA3\n#define PIN_SERIAL_TX PA2\n";
    let maps = "* Automatically generated from STM32F446R(C-E)Tx.xml\n\
                const PinMap PinMap_TIM[] = {\n  {PA_0_ALT1, TIM5, STM_PIN_DATA_EXT(A, B, GPIO_AF2_TIM5, 1, 0)}, // TIM5_CH1\n\
                const PinMap PinMap_UART_TX[] = {\n  {PA_2, USART2, STM_PIN_DATA(A, B, GPIO_AF7_USART2)},\n\
                  {PA_9_R, USART1, STM_PIN_DATA(A, B, GPIO_AF7_USART1)},\n  {NC, NP, 0}\n};\n";
    let made = with("variant_MINE.h", header, &[("PeripheralPins.c", maps)]);
    holds(&made, &["board MINE on", "unit = USART2;", "actuator LED_BUILTIN ", "sensor USER_BTN "]);
    let table = table(&made);
    assert_eq!(table.mcu.as_deref(), Some("STM32F446RETx"));
    let labelled = table.pins.iter().find(|pin| pin.name.as_str() == "PA10").unwrap();
    assert_eq!(labelled.label.as_deref(), Some("D2"));
    let made = with("PeripheralPins.c", maps, &[]);
    assert_eq!(
        made.table.as_deref(),
        Some("# mcu = STM32F446RETx\nPin,TIM,UART\nPA0,TIM5_CH1@2,-\nPA2,-,USART2_TX@7\n")
    );
    assert!(made.program.is_none() && says(&made, "`PA_9_R` is not a pin"));
    let rp = "#define PINS_COUNT (30u)\n#define PIN_LED (25u)\n#define PIN_WIRE0_SDA (4u)\n";
    holds(&with("pico/pins_arduino.h", rp, &[]), &["board pico on", "pin = GP25;"]);
}

#[test]
fn sources_without_pins_are_refused_with_a_reason() {
    for (name, text, words) in [
        ("a.dts", "/dts-v1/;\n/ { a { }; };\n", "no node of the tree"),
        ("config.h", "#define FC_TARGET_MCU STM32F405\n", "no line says what a pin is for"),
        ("fc.config", "resource MOTOR 1 NONE\n", "no line says what a pin is for"),
        ("v.h", "#define LED_BUILTIN 13\n", "no `#define` names a pin"),
        ("P.c", "PinMap_X STM_PIN_DATA\n", "no list has a row"),
    ] {
        let made = with(name, text, &[]);
        assert!(made.failed() && says(&made, words), "{name}: {:?}", made.diagnostics);
    }
}

#[test]
fn tables_of_rp_chips_have_the_names_of_their_pins() {
    let made = with("af.csv", "Pin,AF0,AF1,AF2,AF3\nGPIO0,,SPI0_RX,UART0_TX,SIO\n", &[]);
    assert_eq!(made.table.as_deref(), Some("Pin,UART,SPI\nGP0,UART0_TX@2,SPI0_RX@1\n"));
}
