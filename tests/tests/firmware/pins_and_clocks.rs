//! Features of only some families: pins that are remapped in blocks (STM32F1), and a clock with few
//! divisors (STM32L4).

use super::applications::files;
use super::stubs;

fn hardware(text: &str, board: &str) -> String {
    files(text)[&format!("{board}/generated/sense_hw.c")].clone()
}

/// The field of each peripheral gets the number of the block that has its pins, according to the
/// tables of RM0008.
#[test]
fn remaps_of_f1_are_those_of_the_pins() {
    let icu = |pin: &str| format!("sensor A returns uint32 {{ id = 1; type = icu; pin = {pin}; }}");
    let uart = |tx: &str, rx: &str| {
        format!(
            "sensor A returns uint16 {{ id = 1; type = uart; start = [1]; length = 2; checksum = sum8; tx = {tx}; rx = {rx}; }}"
        )
    };
    let i2c = |scl: &str, sda: &str| {
        format!(
            "sensor A returns uint8 {{ id = 1; type = i2c; address = 0x20; scl = {scl}; sda = {sda}; }}"
        )
    };
    let cases = [
        // TIM3: PA6 in block 0, PB4 in block 2 (partial remap), with the debug port's pin; PC6 is in block 3.
        (icu("PA6"), "TIM3", Some(0), false),
        (icu("PB4"), "TIM3", Some(2), true),
        // TIM2: PA0 in blocks 0 and 2, PA15 in 1 and 3; the lowest is taken.
        (icu("PA0"), "TIM2", Some(0), false),
        (icu("PA15"), "TIM2", Some(1), true),
        (icu("PB6"), "TIM4", Some(0), false),
        (uart("PA9", "PA10"), "USART1", Some(0), false),
        (uart("PB6", "PB7"), "USART1", Some(1), false),
        (uart("PB10", "PB11"), "USART3", Some(0), false),
        (i2c("PB6", "PB7"), "I2C1", Some(0), false),
        (i2c("PB8", "PB9"), "I2C1", Some(1), false),
    ];
    for (device, unit, block, frees_debug) in cases {
        let link = "link { transport = usb; }";
        let text = hardware(&format!("board F1 on BLUEPILL_F103C8 {{ {link} {device} }}"), "F1");
        let field = format!("AFIO_MAPR_{unit}_REMAP");
        let wanted = block.map(|block: u8| format!("({block}U << {field}_Pos)"));
        assert!(wanted.is_some_and(|set| text.contains(&set)), "{device}\n{text}");
        let cleared = text.split("& ~(").nth(1).unwrap().split("))").next().unwrap();
        assert!(cleared.contains(&field), "{device}: {cleared}");
        // The value read from the debug port's field is not the value that was written.
        assert!(cleared.starts_with("AFIO_MAPR_SWJ_CFG | "), "{device}: {cleared}");
        assert!(text.contains("AFIO_MAPR_SWJ_CFG_JTAGDISABLE"), "{device}");
        let says = text.contains("the debug port on two wires");
        assert_eq!(says, frees_debug, "{device}");
        assert!(text.contains("void sense_start(void) {\n  choose_pins();\n"), "{device}");
    }
}

/// The demos of STM32L4 run at 79.96 MHz: a rate that does not divide to within a thousandth is
/// refused, and the generated code has the rates that it states.
#[test]
fn the_clock_of_l4_is_what_it_is() {
    const HZ: u32 = 79_960_000;
    let design = |resolution: &str| {
        format!(
            "board L4 on NUCLEO_L476RG {{
                sensor A returns uint32 {{ id = 1; type = icu; mode = frequency; {resolution} }}
                actuator P accepts uint16 {{ id = 2; driver = servo; }}
            }}"
        )
    };
    for (resolution, hz) in [
        ("", 1_000_000),
        ("resolution = 1 MHz;", 1_000_000),
        ("resolution = 999500 Hz;", 999_500),
        ("resolution = 10 kHz;", 10_000),
        ("resolution = 10 us;", 100_000),
        ("resolution = 3 MHz;", 3_000_000),
        ("resolution = 7 MHz;", 7_000_000),
    ] {
        let near = HZ / ((HZ + hz / 2) / hz);
        let is_near = near.abs_diff(hz) <= hz / 1_000;
        let codes = stubs::codes(&design(resolution));
        assert_eq!(codes, if is_near { vec![] } else { vec!["E0620"] }, "{resolution}");
    }
    let text = hardware(&design("resolution = 10 kHz;"), "L4");
    assert!(text.contains("STM32_TIMCLK1 == 79960000U"), "{text}");
    let config = text.split("PWMConfig ").nth(1).unwrap();
    let number = |name: &str| -> u32 {
        let rest = config.split(&format!(".{name} = ")).nth(1).unwrap();
        rest.split('U').next().unwrap().parse().unwrap()
    };
    let (tick_hz, period) = (number("frequency"), number("period"));
    assert_eq!(HZ % tick_hz, 0, "{tick_hz}");
    // 50 Hz, within a per mille.
    assert!(tick_hz.abs_diff(50 * period) <= tick_hz / 1_000, "{tick_hz} / {period}");
}
