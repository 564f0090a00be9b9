//! Strips of LEDs and displays: the right ones show what the host says, and each mistake shows at the part that has it.

use crate::commanded::tried_as;

const RIGHT: &str = "board STM32F407G_DISC1 {
    link { transport = uart; unit = USART3; silence = 400 ms; }
    actuator Ring accepts uint32[5] { id = 1; driver = ws2812b; delay = 20 ms; failsafe = 0; }
    actuator White accepts uint32[3] { id = 2; driver = sk6812_rgbw; delay = 20 ms; }
    actuator Bar accepts uint32[17] { id = 3; driver = apa102; delay = 20 ms; failsafe = 0; }
    chip Display {
        driver = ssd1306;
        delay = 50 ms;
        actuator Title accepts uint8[21] { id = 4; reading = line1; }
        actuator State accepts uint8[21] { id = 5; reading = line3; failsafe = 0; }
    }
}";

fn mismatch(from: &str, to: &str) -> Vec<String> {
    assert!(RIGHT.contains(from), "{from}");
    let all = tried_as(RIGHT, &RIGHT.replacen(from, to, 1), "");
    all.into_iter().filter(|one| one.wrong > 0).map(|one| one.name).collect()
}

#[test]
fn what_is_right_is_shown() {
    let all = tried_as(RIGHT, RIGHT, "");
    for one in &all {
        assert_eq!((one.wrong, one.left, one.is_silence_left), (0, 0, false), "{one:#?}");
        assert!(one.looks >= 5 && one.commands >= 5, "{one:#?}");
    }
    assert_eq!(all.len(), 5);
}

#[test]
fn each_mistake_is_noticed_where_it_is() {
    let seeds = [
        ("driver = ws2812b;", "driver = ws2812b; colours = rgb;", "Ring"),
        ("driver = ws2812b;", "driver = sk6812;", "Ring"),
        ("delay = 20 ms; failsafe = 0", "delay = 20 ms; failsafe = 1", "Ring"),
        ("driver = sk6812_rgbw;", "driver = sk6812_rgbw; colours = rgbw;", "White"),
        ("driver = sk6812_rgbw;", "driver = sk6812;", "White"),
        ("driver = apa102;", "driver = apa102; colours = rgb;", "Bar"),
        ("reading = line1", "reading = line2", "Title"),
        ("reading = line3", "reading = line4", "State"),
        ("driver = ssd1306;", "driver = ssd1306_128x32;", "Title"),
    ];
    for (from, to, name) in seeds {
        let found = mismatch(from, to);
        assert!(found.iter().any(|one| one == name), "{from} -> {to}: {found:?}");
    }
}
