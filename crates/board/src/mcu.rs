//! MCU names: whether a name looks like one, and which part it means.

/// Prefixes by which a name is taken for a part number. This is only a spelling check: boards and
/// target profiles determine which parts are known in detail.
const STARTS: [&str; 18] = [
    "STM32", "STM8", "RP20", "RP23", "ATMEGA", "ATTINY", "ATXMEGA", "AVR", "ATSAM", "SAM", "NRF5",
    "ESP", "LPC", "MIMXRT", "MSP430", "GD32", "PIC", "R7FA",
];

/// The canonical spelling: upper case, without white space.
#[must_use]
pub fn normalise(spelled: &str) -> String {
    spelled.trim().to_ascii_uppercase()
}

/// Whether this may be the name of an MCU.
#[must_use]
pub fn is_plausible(spelled: &str) -> bool {
    let name = normalise(spelled);
    let shaped = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_');
    let model = STARTS.iter().find_map(|start| name.strip_prefix(start));
    shaped && model.is_some_and(|model| model.contains(|c: char| c.is_ascii_digit()))
}

/// The family: `STM32F4` for `STM32F407VGT6`, `ATMEGA` for `ATMEGA2560-16AU`, `RP2040` for itself.
#[must_use]
pub fn family(name: &str) -> &str {
    let start =
        STARTS.iter().find(|start| name.starts_with(**start)).map_or(0, |start| start.len());
    let end = match name.get(..start) {
        Some("STM32") => start + 2,
        Some("RP20" | "RP23" | "ESP") => start + 2,
        Some("R7FA") => start + 3,
        Some("NRF5") => start + 1,
        _ => start,
    };
    name.get(..end).filter(|family| !family.is_empty()).unwrap_or(name)
}

/// Whether one name is the other with more of the ordering code, where `X` stands for any letter:
/// `STM32F407VG` and `STM32F407VGTx` both mean `STM32F407VGT6`.
#[must_use]
pub fn same_part(left: &str, right: &str) -> bool {
    let (left, right) = (normalise(left), normalise(right));
    // Die, pin count and flash size, as in STM32F407VG, are the least that distinguishes two parts.
    let shortest = left.len().min(right.len());
    let alike = |(a, b): (u8, u8)| a == b || a == b'X' || b == b'X';
    shortest >= 6
        && left.len().abs_diff(right.len()) <= 3
        && left.bytes().zip(right.bytes()).all(alike)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plausible_names() {
        for name in
            ["STM32F407VGT6", "stm32g031j6", "RP2040", "ATmega328P", "nRF52840", "ESP32", "AT90CAN"]
        {
            assert_eq!(is_plausible(name), name != "AT90CAN", "{name}");
        }
        for name in ["", "STM32", "F407", "SMT32F407VG", "STM32 F407", "Discovery"] {
            assert!(!is_plausible(name), "{name}");
        }
    }

    #[test]
    fn families() {
        assert_eq!(family("STM32F407VGT6"), "STM32F4");
        assert_eq!(family("STM32WB55RGV6"), "STM32WB");
        assert_eq!(family("ATMEGA328P-PU"), "ATMEGA");
        assert_eq!(family("RP2350A"), "RP2350");
        assert_eq!(family("ESP32-S3"), "ESP32");
        assert_eq!(family("NRF52840-QIAA"), "NRF52");
        assert_eq!(family("Z80"), "Z80");
        assert_eq!(family("STM32"), "STM32");
    }

    #[test]
    fn parts_match_by_what_is_given() {
        assert!(same_part("STM32F407VG", "STM32F407VGT6"));
        assert!(same_part("stm32f407vgtx", "STM32F407VGT6"));
        assert!(!same_part("STM32F407ZG", "STM32F407VGT6"));
        assert!(!same_part("STM32F407", "STM32F407VGT6"));
    }
}
