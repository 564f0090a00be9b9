//! Voltages: whether a pin tolerates what a device puts on it.

use sensedsl_board::silicon::{self, Volts};
use sensedsl_board::table::Pin;
use sensedsl_model::design::Board;
use sensedsl_model::kind::Kind;

/// The level, in millivolts, that every pin of an unknown MCU tolerates.
const UNKNOWN_MAX_MV: u32 = 3_600;

/// Whether a pin tolerates a voltage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tolerates {
    Yes,
    /// It tolerates only this many millivolts.
    No(u32),
    Unknown,
}

/// Whether a pin tolerates `mv` as an input. An analog input measures only up to the supply.
pub(crate) fn stands(board: &Board, pin: &Pin, kind: &Kind, mv: u32) -> Tolerates {
    let volts = volts(board);
    let supply = volts.map(|volts| volts.supply_mv);
    let most = if kind.is_sampled() {
        supply
    } else if supply.is_some_and(|supply| mv <= supply) {
        return Tolerates::Yes;
    } else {
        stated_mv(pin).or_else(|| volts?.stands_mv(&pin.name))
    };
    match most {
        Some(most) if mv <= most => Tolerates::Yes,
        Some(most) => Tolerates::No(most),
        None if mv <= UNKNOWN_MAX_MV => Tolerates::Yes,
        None => Tolerates::Unknown,
    }
}

/// The supply of the board's MCU in millivolts, if it is known.
pub(crate) fn supply_mv(board: &Board) -> Option<u32> {
    volts(board).map(|volts| volts.supply_mv)
}

fn volts(board: &Board) -> Option<&'static Volts> {
    silicon::volts(board.mcu.as_deref()?)
}

/// The level that the table gives for the pin: volts, or the letters of ST's data sheets.
fn stated_mv(pin: &Pin) -> Option<u32> {
    let reported = pin.voltage.as_deref()?.trim();
    if reported.starts_with("FT") {
        return Some(5_500);
    }
    if reported.starts_with('T') {
        return Some(UNKNOWN_MAX_MV);
    }
    let volts: f64 = reported.trim_end_matches(['V', 'v']).trim().parse().ok()?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "in range")]
    (0.0..1_000.0).contains(&volts).then(|| (volts * 1_000.0).round() as u32)
}
