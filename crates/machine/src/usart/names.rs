//! The names of serial ports, and their places among each other.
//!
//! In: a name such as `LPUART1`, or a place. Out: the other. Who reads the files of MCUs needs no more of a port.

/// The place of the first low-power port, behind all others.
pub(super) const LOW_POWER: usize = 10;

/// The place of a unit among the serial ports: 0 is USART1.
pub(crate) fn place(name: &str) -> Option<usize> {
    let number = name.trim_start_matches(|letter: char| letter.is_ascii_uppercase());
    let at = number.parse::<usize>().ok()?.checked_sub(1)?;
    Some(if name.starts_with("LP") { LOW_POWER + at } else { at })
}

pub(super) fn name(place: usize) -> String {
    match place {
        LOW_POWER.. => format!("LPUART{}", place - LOW_POWER + 1),
        3 | 4 | 6 | 7 => format!("UART{}", place + 1),
        _ => format!("USART{}", place + 1),
    }
}
