//! Values of an actuator that are a step away from its last one, as keys ask for them.
//!
//! In: the device and its last value. Out: a text that [`sensedsl_host::Board::command`] reads.

use sensedsl_host::Device;
use sensedsl_wire::{Scalar, ScalarType};

/// What a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Slide {
    Less,
    More,
    MuchLess,
    MuchMore,
    Zero,
}

impl Slide {
    pub(super) fn of(letter: char) -> Option<Self> {
        match letter {
            '[' => Some(Self::Less),
            ']' => Some(Self::More),
            '{' => Some(Self::MuchLess),
            '}' => Some(Self::MuchMore),
            '0' => Some(Self::Zero),
            _ => None,
        }
    }

    fn is_less(self) -> bool {
        matches!(self, Self::Less | Self::MuchLess)
    }

    fn is_far(self) -> bool {
        matches!(self, Self::MuchLess | Self::MuchMore)
    }
}

/// The value that a key asks for, an element each.
pub(super) fn slid(device: &Device, last: Option<&[Scalar]>, slide: Slide) -> String {
    let count = device.value.count();
    let last = (0..count).map(|place| last.and_then(|last| last.get(place)));
    let all = last.map(|raw| match (device.value.scalar, slide) {
        (ScalarType::Bool, Slide::Zero) => "false".to_owned(),
        (ScalarType::Bool, _) => (!slide.is_less()).to_string(),
        (_, Slide::Zero) => "0".to_owned(),
        _ => {
            let rest = device.min.unwrap_or(0.0).max(0.0);
            let from = raw.map_or(rest, |raw| device.shown(*raw));
            let step = step(device, from, slide.is_far());
            written(device, if slide.is_less() { from - step } else { from + step })
        }
    });
    all.collect::<Vec<_>>().join(" ")
}

/// How far one press goes: a hundredth or a tenth of the range, as a round number, and no less than the device can do.
fn step(device: &Device, at: f64, is_far: bool) -> f64 {
    let is_real = matches!(device.value.scalar, ScalarType::Float32 | ScalarType::Float64);
    let code = if is_real { 0.0 } else { device.scale.shown_step(device.scale.raw(at)) };
    let share = if is_far { 10.0 } else { 100.0 };
    let range = device.min.zip(device.max).map(|(least, most)| most - least);
    let wanted = match range {
        Some(range) if range > 0.0 => round(range / share),
        _ if is_real => 10.0 / share,
        _ => 100.0 * code / share,
    };
    wanted.max(code)
}

/// The nearest of 1, 2 and 5, and ten times or a tenth of these.
pub(super) fn round(number: f64) -> f64 {
    let size = 10_f64.powf(number.log10().floor());
    let many = number / size;
    let rounded = if many < 1.5 {
        1.0
    } else if many < 3.5 {
        2.0
    } else if many < 7.5 {
        5.0
    } else {
        10.0
    };
    rounded * size
}

/// The number within the limits, without the dust of its computation.
fn written(device: &Device, number: f64) -> String {
    let dusted: f64 = format!("{number:.8e}").parse().unwrap_or(number);
    let dusted = if dusted.abs() < 1e-12 { 0.0 } else { dusted };
    let least = device.min.unwrap_or(f64::NEG_INFINITY);
    let most = device.max.unwrap_or(f64::INFINITY);
    dusted.max(least).min(most).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sensedsl_host::Scale;
    use sensedsl_wire::{Direction, ValueType};

    fn device(scalar: ScalarType, limits: Option<(f64, f64)>) -> Device {
        Device {
            name: "Servo".into(),
            id: 9,
            direction: Direction::Actuator,
            value: ValueType { scalar, length: None },
            kind: String::new(),
            quantity: Some("deg".into()),
            scale: Scale::new(Some(0.1), None, Vec::new()),
            min: limits.map(|limits| limits.0),
            max: limits.map(|limits| limits.1),
            cycle_ms: None,
            obeys: None,
        }
    }

    #[test]
    fn steps_are_round_and_stay_within_the_limits() {
        let servo = device(ScalarType::Uint16, Some((0.0, 180.0)));
        let from = |code, slide| slid(&servo, Some(&[Scalar::Unsigned(code)]), slide);
        assert_eq!(slid(&servo, None, Slide::More), "2");
        assert_eq!(from(900, Slide::More), "92");
        assert_eq!(from(900, Slide::MuchMore), "110");
        assert_eq!(from(5, Slide::Less), "0");
        assert_eq!(from(1_795, Slide::MuchMore), "180");
        assert_eq!(from(1_795, Slide::Zero), "0");
        let motor = device(ScalarType::Int8, None);
        assert_eq!(slid(&motor, Some(&[Scalar::Signed(3)]), Slide::Less), "0.2");
        assert_eq!(slid(&motor, Some(&[Scalar::Signed(3)]), Slide::MuchMore), "1.3");
        let fine = device(ScalarType::Float64, Some((-1.0, 1.0)));
        assert_eq!(slid(&fine, None, Slide::MuchLess), "-0.2");
        // A step of less than a code would do nothing.
        let coarse = device(ScalarType::Uint8, Some((0.0, 1.0)));
        assert_eq!(slid(&coarse, Some(&[Scalar::Unsigned(0)]), Slide::More), "0.1");
        let lamp = device(ScalarType::Bool, None);
        assert_eq!(slid(&lamp, None, Slide::More), "true");
        assert_eq!(slid(&lamp, Some(&[Scalar::Bool(true)]), Slide::Zero), "false");
        let mut pair = device(ScalarType::Uint16, Some((0.0, 100.0)));
        pair.value.length = Some(2);
        let value = [Scalar::Unsigned(100), Scalar::Unsigned(200)];
        assert_eq!(slid(&pair, Some(&value), Slide::More), "11 21");
        assert_eq!([0.7, 1.8, 18.0, 40.0, 99.0].map(round), [0.5, 2.0, 20.0, 50.0, 100.0]);
    }
}
