//! Voltages: whether a pin tolerates what a device puts on it, and which resistors help where it
//! does not.

use sensedsl_board::silicon::{self, Volts};
use sensedsl_board::table::Pin;
use sensedsl_model::design::Board;
use sensedsl_model::kind::Kind;
#[cfg(test)]
use sensedsl_model::volts::shown_ohm;

/// Up to this every pin of an MCU that nothing is known of stands a level, in millivolts.
const UNKNOWN_MAX_MV: u32 = 3_600;
/// The resistor to ground that is proposed, in ohms.
const LOWER_OHM: u32 = 10_000;
/// Steps of the E12 series, in tenths.
const E12: [u32; 12] = [10, 12, 15, 18, 22, 27, 33, 39, 47, 56, 68, 82];

/// Whether a pin tolerates a voltage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stands {
    Yes,
    /// It tolerates only so many millivolts.
    No(u32),
    Unknown,
}

/// Whether a pin tolerates `mv` as an input. An analog input measures only up to the supply.
pub(crate) fn stands(board: &Board, pin: &Pin, kind: &Kind, mv: u32) -> Stands {
    let volts = volts(board);
    let supply = volts.map(|volts| volts.supply_mv);
    let most = if kind.analog().is_some() {
        supply
    } else if supply.is_some_and(|supply| mv <= supply) {
        return Stands::Yes;
    } else {
        stated_mv(pin).or_else(|| volts?.stands_mv(&pin.name))
    };
    match most {
        Some(most) if mv <= most => Stands::Yes,
        Some(most) => Stands::No(most),
        None if mv <= UNKNOWN_MAX_MV => Stands::Yes,
        None => Stands::Unknown,
    }
}

/// The supply of the board's MCU in millivolts, where it is known.
pub(crate) fn supply_mv(board: &Board) -> Option<u32> {
    volts(board).map(|volts| volts.supply_mv)
}

fn volts(board: &Board) -> Option<&'static Volts> {
    silicon::volts(board.mcu.as_deref()?)
}

/// What the table says of the pin: volts, or the letters of ST's data sheets.
fn stated_mv(pin: &Pin) -> Option<u32> {
    let said = pin.voltage.as_deref()?.trim();
    if said.starts_with("FT") {
        return Some(5_500);
    }
    if said.starts_with('T') {
        return Some(UNKNOWN_MAX_MV);
    }
    let volts: f64 = said.trim_end_matches(['V', 'v']).trim().parse().ok()?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in range")]
    (0.0..1_000.0).contains(&volts).then(|| (volts * 1_000.0).round() as u32)
}

/// Resistors of the E12 series, from the device to the pin and from there to ground, in ohms, that
/// leave at most `most_mv` of `mv`.
pub(crate) fn divider(mv: u32, most_mv: u32) -> [u32; 2] {
    let enough = |upper: &u64| {
        let (mv, lower) = (u64::from(mv), u64::from(LOWER_OHM));
        mv * lower <= u64::from(most_mv) * (upper + lower)
    };
    let decades = (2..8).map(|power| 10_u64.pow(power));
    let mut all = decades.flat_map(|decade| E12.map(|step| u64::from(step) * decade / 10));
    let upper = all.find(enough).and_then(|upper| u32::try_from(upper).ok());
    [upper.unwrap_or(u32::MAX), LOWER_OHM]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_divider_leaves_no_more_than_the_supply() {
        let told = |mv, most| divider(mv, most).map(shown_ohm).join(", ");
        assert_eq!(told(5_000, 3_300), "5.6 kOhm, 10 kOhm");
        assert_eq!(told(12_600, 3_300), "33 kOhm, 10 kOhm");
        assert_eq!(told(3_400, 3_300), "330 Ohm, 10 kOhm");
        for mv in (3_301..60_000).step_by(37) {
            let [upper, lower] = divider(mv, 3_300).map(u64::from);
            let left = u64::from(mv) * lower / (upper + lower);
            assert!(left <= 3_300 && left > 2_400, "{mv}: {left}");
        }
    }
}
