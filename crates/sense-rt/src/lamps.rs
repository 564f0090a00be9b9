//! The bytes that LED strips take for the colours of their LEDs.
//!
//! In: colours, each an unsigned number such as 0xRRGGBB, and how they are sent. Out: the bytes of a frame.
//!
//! [`Code::Pulses`] is for strips with one wire. Each bit of a colour becomes `bits` bits of the bus, of which the first
//! `low` are high for a 0, and the first `word_bytes` for a 1. A byte before them, and a rest of more than 300 us behind
//! them, are low.
//!
//! [`Code::Leds`] is for strips with a clock: four bytes of zeros; for each LED its brightness and its colours; and
//! enough zeros for the last LED. The brightness is that of the colour's highest byte, 1 to 31; 0 stands for 31, so that
//! a number without it is as bright as can be.

use crate::coding::{Code, Coding};
use crate::convert::load_magnitude;
use crate::schema::Item;

/// The rest behind the pulses of a frame: what so many bytes of colours would take.
const REST_BYTES: usize = 40;
const LED_START_BYTES: usize = 4;
const LED_BYTES: usize = 4;
const LED_MARK: u8 = 0xE0;
const BRIGHTNESS_MAX: u8 = 31;

/// The size of what is sent for `count` colours.
pub(crate) const fn wire_bytes(how: &Coding, count: u16) -> usize {
    let count = count as usize;
    if matches!(how.code, Code::Leds) {
        // Each LED delays the clock by half a period.
        return 2 * LED_START_BYTES + count * LED_BYTES + count.div_ceil(16);
    }
    1 + (count * how.words as usize + REST_BYTES) * how.bits as usize
}

/// Writes [`wire_bytes`] bytes.
pub(crate) fn encode(how: &Coding, item: &Item, value: &[u8], bytes: &mut [u8]) {
    bytes.fill(0);
    // The value may be in a larger buffer.
    let elements = value.chunks(item.scalar.bytes().max(1)).take(item.count.into());
    let colours = elements.map(|element| {
        let (magnitude, is_negative) = load_magnitude(item.scalar, element);
        if is_negative { [0; 4] } else { (magnitude as u32).to_le_bytes() }
    });
    if how.code == Code::Leds {
        let leds = bytes.get_mut(LED_START_BYTES..).unwrap_or_default();
        for (colour, led) in colours.zip(leds.chunks_mut(LED_BYTES)) {
            put_led(how, colour, led);
        }
        return;
    }
    let mut at = 8;
    for colour in colours {
        for place in how.elements {
            at = put_pulses(how, byte_of(colour, *place), bytes, at);
        }
    }
}

fn byte_of(colour: [u8; 4], place: u8) -> u8 {
    colour.get(usize::from(place)).copied().unwrap_or(0)
}

fn put_led(how: &Coding, colour: [u8; 4], led: &mut [u8]) {
    let brightness = match byte_of(colour, 3) & BRIGHTNESS_MAX {
        0 => BRIGHTNESS_MAX,
        some => some,
    };
    let colours = how.elements.iter().map(|place| byte_of(colour, *place));
    let all = core::iter::once(LED_MARK | brightness).chain(colours);
    led.iter_mut().zip(all).for_each(|(target, byte)| *target = byte);
}

/// Sets the bits of the pulses of a byte; the others are 0 already. `at` is the first bit; returns the next one.
fn put_pulses(how: &Coding, byte: u8, bytes: &mut [u8], at: usize) -> usize {
    let mut at = at;
    for bit in (0..8).rev() {
        let high = if byte >> bit & 1 != 0 { how.word_bytes } else { how.low };
        for place in at..at.wrapping_add(usize::from(high)) {
            if let Some(target) = bytes.get_mut(place / 8) {
                *target |= 0x80 >> (place % 8);
            }
        }
        at = at.wrapping_add(usize::from(how.bits));
    }
    at
}
