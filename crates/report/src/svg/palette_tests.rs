//! Colours are told apart by people with any of the common colour blindnesses, and text is read.

use super::*;

/// The least difference of two kinds' colours, CIE 1976.
const DIFFERENCE_MIN: f64 = 20.0;
/// The least contrast of text (WCAG 2, level AA).
const TEXT_MIN: f64 = 4.5;
/// The least contrast of a wire and what it is drawn on.
const WIRE_MIN: f64 = 2.0;

/// What is seen, in linear light: by people who distinguish all colours, and with protanopia, deuteranopia and
/// tritanopia (Machado, Oliveira and Fernandes, 2009, severity 1).
const EYES: [[[f64; 3]; 3]; 4] = [
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
    [
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.303900],
    ],
];

fn linear(colour: &str) -> [f64; 3] {
    channels(colour).map(|c| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) })
}

fn times(matrix: &[[f64; 3]; 3], light: [f64; 3]) -> [f64; 3] {
    matrix.map(|row| row.iter().zip(light).map(|(factor, part)| factor * part).sum::<f64>())
}

/// CIELAB under D65.
fn lab(light: [f64; 3]) -> [f64; 3] {
    let to_xyz = [
        [0.4124564, 0.3575761, 0.1804375],
        [0.2126729, 0.7151522, 0.0721750],
        [0.0193339, 0.1191920, 0.9503041],
    ];
    let [x, y, z] = times(&to_xyz, light.map(|part| part.clamp(0.0, 1.0)));
    let root = |t: f64| if t > 0.008856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
    let [x, y, z] = [root(x / 0.95047), root(y), root(z / 1.08883)];
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn difference(one: &str, other: &str) -> f64 {
    let seen = |eye, colour| lab(times(eye, linear(colour)));
    let distance = |eye| {
        let (a, b) = (seen(eye, one), seen(eye, other));
        a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    EYES.iter().map(distance).fold(f64::INFINITY, f64::min)
}

fn exact_contrast(one: &str, other: &str) -> f64 {
    let luminance = |colour| {
        let [red, green, blue] = linear(colour);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    };
    let (one, other): (f64, f64) = (luminance(one), luminance(other));
    (one.max(other) + 0.05) / (one.min(other) + 0.05)
}

#[test]
fn the_colours_of_kinds_are_told_apart() {
    assert!(difference("#000000", "#FFFFFF") > 99.0 && difference("#D00000", "#D00500") < 5.0);
    // Red and green of the same lightness: most people distinguish them, some do not.
    assert!(difference("#C85A50", "#8C8246") < DIFFERENCE_MIN);
    for theme in [LIGHT, DARK] {
        let colours = KindName::ALL.map(|kind| (theme.kind)(kind.spec()));
        for (at, one) in colours.iter().enumerate() {
            for other in &colours[at + 1..] {
                let found = difference(one, other);
                assert!(found > DIFFERENCE_MIN, "{one} and {other}: {found}");
            }
        }
    }
}

#[test]
fn text_and_wires_stand_out() {
    for theme in [LIGHT, DARK] {
        for ground in [theme.page, theme.board] {
            for ink in [theme.ink, theme.soft] {
                let found = exact_contrast(ink, ground);
                assert!(found >= TEXT_MIN, "{ink} on {ground}: {found}");
            }
            for kind in KindName::ALL {
                let found = exact_contrast((theme.kind)(kind.spec()), ground);
                assert!(found >= WIRE_MIN, "{} on {ground}: {found}", kind.name());
            }
        }
        for kind in KindName::ALL {
            let colour = (theme.kind)(kind.spec());
            let found = exact_contrast(ink_on(colour), colour);
            assert!(found >= TEXT_MIN, "the letter of {}: {found}", kind.name());
        }
    }
}
