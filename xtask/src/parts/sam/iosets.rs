//! The pads of SAM D5x and E5x that go together (IOSET), from the data sheet's tables by way of `atsamd-hal` 0.23.4.

/// The SERCOM, the set's number, the pins of its pads 0 to 3. Sets 7 and 8 are not in the data sheet: Adafruit's boards
/// have their SPI lines on them (Feather M4 and `ItsyBitsy` M4).
const SETS: [(u8, u8, [&str; 4]); 38] = [
    (0, 1, ["PA8", "PA9", "PA10", "PA11"]),
    (0, 2, ["PB24", "PB25", "PC24", "PC25"]),
    (0, 3, ["PA4", "PA5", "PA6", "PA7"]),
    (0, 4, ["PC17", "PC16", "PC18", "PC19"]),
    (1, 1, ["PA16", "PA17", "PA18", "PA19"]),
    (1, 2, ["PC22", "PC23", "PD20", "PD21"]),
    (1, 3, ["PC27", "PC28", "PB22", "PB23"]),
    (1, 4, ["PA0", "PA1", "PA30", "PA31"]),
    (1, 7, ["PA16", "PA17", "PB22", "PB23"]),
    (1, 8, ["PA0", "PA1", "PB22", "PB23"]),
    (2, 1, ["PA12", "PA13", "PA14", "PA15"]),
    (2, 2, ["PB26", "PB27", "PB28", "PB29"]),
    (2, 3, ["PA9", "PA8", "PA10", "PA11"]),
    (2, 4, ["PB25", "PB24", "PC24", "PC25"]),
    (3, 1, ["PA22", "PA23", "PA24", "PA25"]),
    (3, 2, ["PB20", "PB21", "PA20", "PA21"]),
    (3, 3, ["PA17", "PA16", "PA18", "PA19"]),
    (3, 4, ["PC23", "PC22", "PD20", "PD21"]),
    (4, 1, ["PB12", "PB13", "PB14", "PB15"]),
    (4, 2, ["PB8", "PB9", "PB10", "PB11"]),
    (4, 3, ["PA13", "PA12", "PA14", "PA15"]),
    (4, 4, ["PB27", "PB26", "PB28", "PB29"]),
    (5, 1, ["PB16", "PB17", "PB18", "PB19"]),
    (5, 2, ["PA23", "PA22", "PA20", "PA21"]),
    (5, 3, ["PA23", "PA22", "PA24", "PA25"]),
    (5, 4, ["PA23", "PA22", "PB22", "PB23"]),
    (5, 5, ["PB31", "PB30", "PB0", "PB1"]),
    (5, 6, ["PB2", "PB3", "PB0", "PB1"]),
    (6, 1, ["PC16", "PC17", "PC18", "PC19"]),
    (6, 2, ["PC4", "PC5", "PC6", "PC7"]),
    (6, 3, ["PD9", "PD8", "PD10", "PD11"]),
    (6, 4, ["PC13", "PC12", "PC14", "PC15"]),
    (6, 5, ["PC13", "PC12", "PC10", "PC11"]),
    (7, 1, ["PC12", "PC13", "PC14", "PC15"]),
    (7, 2, ["PD8", "PD9", "PD10", "PD11"]),
    (7, 3, ["PC12", "PC13", "PC10", "PC11"]),
    (7, 4, ["PB21", "PB20", "PB18", "PB19"]),
    (7, 5, ["PB30", "PB31", "PA30", "PA31"]),
];

/// The numbers of the sets in which a SERCOM has a pad on a pin.
pub(super) fn sets_of<'a>(
    sercom: &'a str,
    pad: &'a str,
    pin: &'a str,
) -> impl Iterator<Item = u8> + 'a {
    let is_there = move |(of, _, pins): &&(u8, u8, [&str; 4])| {
        let at = pad.parse::<usize>().ok().and_then(|pad| pins.get(pad));
        sercom.parse() == Ok(*of) && at == Some(&pin)
    };
    SETS.iter().filter(is_there).map(|(_, set, _)| *set)
}
