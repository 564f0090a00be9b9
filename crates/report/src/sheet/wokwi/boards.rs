//! What boards Wokwi has: their contacts, and which of them is which built-in board.
//!
//! Names, contacts and sizes are facts from `@wokwi/elements` 1.9.2 and `wokwi-boards`.

use super::table::Rail;

/// A board of Wokwi's.
#[derive(Debug)]
pub(super) struct WokwiBoard {
    /// The built-in board that it is.
    pub(super) name: &'static str,
    /// Wokwi's type.
    pub(super) kind: &'static str,
    /// Width and height in pixels.
    pub(super) size: (i32, i32),
    /// How its contacts are called.
    pub(super) names: Names,
    /// The contacts of ground, 3.3 V and 5 V, and which of the two the MCU runs at.
    pub(super) ground: &'static [&'static str],
    pub(super) three: &'static [&'static str],
    pub(super) five: &'static [&'static str],
    pub(super) logic: Rail,
    /// Its contacts with their places: `GP4@4,62`.
    pub(super) contacts: &'static str,
    /// Contacts of pins that are called otherwise.
    pub(super) others: &'static [(&'static str, &'static str)],
}

/// How a board's contacts are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Names {
    /// As printed, without a D before a number: `13`, `A0`.
    Numbers,
    /// As printed: `D13`, `A0`.
    Printed,
    /// As the pins: `GP4`, `PB12`; `.1` behind it where there are several.
    Pins,
    /// As the pins, without the P: `B12`.
    Short,
}

const PICO: &str = "GP0@6,13 GP1@6,22 GND.1@6,32 GP2@6,42 GP3@6,51 GP4@6,61 GP5@6,70 GND.2@6,80 GP6@6,90 GP7@6,99 \
                    GP8@6,109 GP9@6,118 GND.3@6,128 GP10@6,138 GP11@6,147 GP12@6,157 GP13@6,166 GND.4@6,176 \
                    GP14@6,186 GP15@6,195 GP16@73,195 GP17@73,186 GND.5@73,176 GP18@73,166 GP19@73,157 GP20@73,147 \
                    GP21@73,138 GND.6@73,128 GP22@73,118 GP26@73,99 GP27@73,90 GND.7@73,80 GP28@73,70 3V3@73,51 \
                    GND.8@73,32 VBUS@73,13";
const PICO_GROUND: &[&str] =
    &["GND.1", "GND.2", "GND.3", "GND.4", "GND.5", "GND.6", "GND.7", "GND.8"];
const NUCLEO_32: &str = "D1@6,37 D0@6,47 GND.1@6,66 D2@6,76 D3@6,85 D4@6,95 D5@6,104 D6@6,114 D7@6,124 D8@6,133 \
                         D9@6,143 D10@6,152 D11@6,162 D12@6,172 GND.2@64,47 5V@64,66 A7@64,76 A6@64,85 A5@64,95 \
                         A4@64,104 A3@64,114 A2@64,124 A1@64,133 A0@64,143 3V3@64,162 D13@64,172";
const XIAO: &str = "D0@5,19 D1@5,28 D2@5,38 D3@5,47 D4@5,57 D5@5,67 D6@5,76 D7@62,76 D8@62,67 D9@62,57 D10@62,47 \
                    3V3@62,38 GND@62,28 5V@62,19";

/// All boards.
pub(super) const BOARDS: &[WokwiBoard] = &[
    WokwiBoard {
        name: "ARDUINO-UNO-R3",
        kind: "wokwi-arduino-uno",
        size: (275, 202),
        names: Names::Numbers,
        ground: &["GND.2", "GND.3", "GND.1"],
        three: &["3.3V"],
        five: &["5V"],
        logic: Rail::Five,
        contacts: "GND.1@116,9 13@125,9 12@135,9 11@144,9 10@154,9 9@163,9 8@173,9 7@189,9 6@199,9 5@208,9 4@218,9 \
                   3@227,9 2@237,9 1@246,9 0@256,9 3.3V@150,192 5V@160,192 GND.2@170,192 GND.3@179,192 A0@208,192 \
                   A1@218,192 A2@227,192 A3@237,192 A4@246,192 A5@256,192",
        others: &[],
    },
    WokwiBoard {
        name: "ARDUINO-NANO",
        kind: "wokwi-arduino-nano",
        size: (170, 68),
        names: Names::Numbers,
        ground: &["GND.1", "GND.2"],
        three: &["3.3V"],
        five: &["5V"],
        logic: Rail::Five,
        contacts: "12@20,5 11@29,5 10@39,5 9@49,5 8@58,5 7@68,5 6@77,5 5@87,5 4@97,5 3@106,5 2@116,5 GND.2@125,5 \
                   0@145,5 1@154,5 13@20,62 3.3V@29,62 A0@49,62 A1@58,62 A2@68,62 A3@77,62 A4@87,62 A5@97,62 \
                   A6@106,62 A7@116,62 5V@125,62 GND.1@145,62",
        others: &[],
    },
    WokwiBoard {
        name: "ARDUINO-MEGA-2560",
        kind: "wokwi-arduino-mega",
        size: (388, 192),
        names: Names::Numbers,
        ground: &["GND.2", "GND.3", "GND.4", "GND.5", "GND.1"],
        three: &["3.3V"],
        five: &["5V", "5V.1", "5V.2"],
        logic: Rail::Five,
        contacts: "GND.1@119,9 13@129,9 12@138,9 11@148,9 10@158,9 9@168,9 8@177,9 7@190,9 6@200,9 5@210,9 4@219,9 \
                   3@229,9 2@238,9 1@248,9 0@258,9 14@271,9 15@280,9 16@290,9 17@299,9 18@309,9 19@319,9 20@328,9 \
                   21@338,9 5V.1@361,8 5V.2@371,8 22@361,18 23@371,18 24@361,27 25@371,27 26@361,37 27@371,37 \
                   28@361,46 29@371,46 30@361,56 31@371,56 32@361,66 33@371,66 34@361,75 35@371,75 36@361,85 \
                   37@371,85 38@361,94 39@371,94 40@361,104 41@371,104 42@361,114 43@371,114 44@361,123 45@371,123 \
                   46@361,133 47@371,133 48@361,142 49@371,142 50@361,152 51@371,152 52@361,162 53@371,162 \
                   GND.4@361,171 GND.5@371,171 3.3V@155,185 5V@165,185 GND.2@174,185 GND.3@184,185 A0@209,185 \
                   A1@218,185 A2@228,185 A3@237,185 A4@247,185 A5@256,185 A6@266,185 A7@276,185 A8@290,185 \
                   A9@300,185 A10@310,185 A11@319,185 A12@329,185 A13@339,185 A14@348,185 A15@358,185",
        others: &[],
    },
    WokwiBoard {
        name: "RASPBERRYPI-PICO",
        kind: "wokwi-pi-pico",
        size: (79, 200),
        names: Names::Pins,
        ground: PICO_GROUND,
        three: &["3V3"],
        five: &["VBUS"],
        logic: Rail::Three,
        contacts: PICO,
        others: &[],
    },
    WokwiBoard {
        name: "RASPBERRYPI-PICO-W",
        kind: "board-pi-pico-w",
        size: (79, 200),
        names: Names::Pins,
        ground: PICO_GROUND,
        three: &["3V3"],
        five: &["VBUS"],
        logic: Rail::Three,
        contacts: PICO,
        others: &[],
    },
    WokwiBoard {
        name: "RASPBERRYPI-PICO-2",
        kind: "board-pi-pico-2",
        size: (79, 200),
        names: Names::Pins,
        ground: PICO_GROUND,
        three: &["3V3"],
        five: &["VBUS"],
        logic: Rail::Three,
        contacts: PICO,
        others: &[],
    },
    WokwiBoard {
        name: "NUCLEO-C031C6",
        kind: "board-st-nucleo-c031c6",
        size: (265, 317),
        names: Names::Pins,
        ground: &["GND.3", "GND.4", "GND.5", "GND.6", "GND.7", "GND.8", "GND.9", "GND.1", "GND.2"],
        three: &["3V3.1", "3V3.2"],
        five: &["5V.1", "5V.2", "5V.3"],
        logic: Rail::Three,
        contacts: "PD0@11,124 PD2@11,134 PA14@11,153 PA13@11,182 PC6@11,201 GND.1@11,210 PC13@11,230 PC14@11,239 \
                   PF0@11,258 PF1@11,268 PB11@11,287 PA2@11,297 PD1@20,124 GND.2@20,153 3V3.1@20,191 5V.1@20,201 \
                   GND.3@20,210 GND.4@20,220 PA0@20,249 PA1@20,258 PA4@20,268 PB1@20,278 PA11@20,287 PA12@20,297 \
                   3V3.2@39,191 5V.2@39,201 GND.5@39,210 GND.6@39,220 5V.3@253,153 PA3@253,162 PC15@253,172 \
                   PB12.1@253,182 PB2@253,201 GND.7@253,210 PF3@253,220 PA8@253,230 PB15@253,239 PB14@253,249 \
                   PB13@253,258 PB0.1@253,278 PB8@244,134 PB9@244,143 GND.8@244,162 PA5@244,172 PA6@244,182 \
                   PA7@244,191 PC7@244,210 PA9@244,220 PA15@244,230 PB5@244,239 PB4@244,249 PB10@244,258 \
                   PB3@244,268 PA10@244,278 PB6@244,287 PB7@244,297 GND.9@224,153",
        others: &[],
    },
    WokwiBoard {
        name: "NUCLEO-L031K6",
        kind: "board-st-nucleo-l031k6",
        size: (71, 198),
        names: Names::Printed,
        ground: &["GND.1", "GND.2"],
        three: &["3V3"],
        five: &["5V"],
        logic: Rail::Three,
        contacts: NUCLEO_32,
        others: &[("PA15", "VCP_RX")],
    },
    WokwiBoard {
        name: "NUCLEO-L432KC",
        kind: "board-st-nucleo-l432kc",
        size: (71, 198),
        names: Names::Printed,
        ground: &["GND.1", "GND.2"],
        three: &["3V3"],
        five: &["5V"],
        logic: Rail::Three,
        contacts: NUCLEO_32,
        others: &[("PA15", "VCP_RX")],
    },
    WokwiBoard {
        name: "BLUEPILL-F103C8",
        kind: "board-stm32-bluepill",
        size: (87, 205),
        names: Names::Short,
        ground: &["GND.1", "GND.2", "GND.3"],
        three: &["3V3.1", "3V3.2"],
        five: &["5V.1"],
        logic: Rail::Three,
        contacts: "B12@13,11 B13@13,21 B14@13,30 B15@13,40 A8@13,49 A9@13,59 A10@13,69 A11@13,78 A12@13,88 \
                   A15@13,97 B3@13,107 B4@13,117 B5@13,126 B6@13,136 B7@13,145 B8@13,155 B9@13,165 5V.1@13,174 \
                   GND.1@13,184 3V3.1@13,193 GND.2@73,11 GND.3@73,21 3V3.2@73,30 B11@73,49 B10@73,59 B1@73,69 \
                   B0@73,78 A7@73,88 A6@73,97 A5@73,107 A4@73,117 A3@73,126 A2@73,136 A1@73,145 A0@73,155 \
                   C15@73,165 C14@73,174 C13@73,184",
        others: &[],
    },
    WokwiBoard {
        name: "BLACKPILL-F411CE",
        kind: "board-stm32-blackpill",
        size: (79, 201),
        names: Names::Short,
        ground: &["GND.1", "GND.3"],
        three: &["3V3.1", "3V3.2"],
        five: &["5V.1", "5V.2"],
        logic: Rail::Three,
        contacts: "C13@10,22 C14@10,31 C15@10,41 A0@10,60 A1@10,70 A2@10,79 A3@10,89 A4@10,98 A5@10,108 A6@10,118 \
                   A7@10,127 B0@10,137 B1@10,146 B2@10,156 B10@10,166 3V3.1@10,175 GND.1@10,185 5V.1@10,194 \
                   3V3.2@67,11 GND.3@67,21 5V.2@67,30 B9@67,40 B8@67,49 B7@67,59 B6@67,69 B5@67,78 B4@67,88 \
                   B3@67,97 A15@67,107 A12@67,117 A11@67,126 A10@67,136 A9@67,145 A8@67,155 B15@67,165 B14@67,174 \
                   B13@67,184 B12@67,193",
        others: &[],
    },
    WokwiBoard {
        name: "ESP32-DEVKITC-V4",
        kind: "board-esp32-devkit-c-v4",
        size: (106, 215),
        names: Names::Printed,
        ground: &["GND.1", "GND.2", "GND.3"],
        three: &["3V3"],
        five: &["5V"],
        logic: Rail::Three,
        contacts: "0@101,154 2@101,163 4@101,144 5@101,115 12@5,144 13@5,163 14@5,134 15@101,173 16@101,134 \
                   17@101,125 18@101,106 19@101,96 21@101,77 22@101,48 23@101,38 25@5,106 26@5,115 27@5,125 32@5,86 \
                   33@5,96 34@5,67 35@5,77 3V3@5,29 VP@5,48 VN@5,58 GND.1@5,154 D2@5,173 D3@5,182 CMD@5,192 \
                   5V@5,202 GND.2@101,29 TX@101,58 RX@101,67 GND.3@101,86 D1@101,182 D0@101,192 CLK@101,202",
        others: &[],
    },
    WokwiBoard {
        name: "ESP32-C3-DEVKITM-1",
        kind: "board-esp32-c3-devkitm-1",
        size: (96, 163),
        names: Names::Printed,
        ground: &[
            "GND.1", "GND.2", "GND.3", "GND.4", "GND.5", "GND.6", "GND.7", "GND.8", "GND.9",
            "GND.10",
        ],
        three: &["3V3.1", "3V3.2"],
        five: &["5V.1", "5V.2"],
        logic: Rail::Three,
        contacts: "0@4,96 1@4,106 2@4,48 3@4,58 4@91,116 5@91,106 6@91,96 7@91,87 8@91,68 9@91,58 10@4,116 \
                   18@91,135 19@91,144 GND.1@4,20 3V3.1@4,29 3V3.2@4,39 GND.2@4,68 GND.3@4,87 GND.4@4,125 \
                   5V.1@4,135 5V.2@4,144 GND.5@4,154 GND.6@91,154 GND.7@91,125 GND.8@91,77 GND.9@91,48 RX@91,39 \
                   TX@91,29 GND.10@91,20",
        others: &[],
    },
    WokwiBoard {
        name: "ESP32-C6-DEVKITC-1",
        kind: "board-esp32-c6-devkitc-1",
        size: (100, 219),
        names: Names::Printed,
        ground: &["GND.1", "GND.2", "GND.3", "GND.4"],
        three: &["3V3"],
        five: &["5V"],
        logic: Rail::Three,
        contacts: "0@5,91 1@5,100 2@5,139 3@5,148 4@5,52 5@5,62 6@5,72 7@5,81 8@5,110 9@93,129 10@5,120 11@5,129 \
                   12@93,158 13@93,148 15@93,62 18@93,120 19@93,110 20@93,100 21@93,91 22@93,81 23@93,72 3V3@5,33 \
                   5V@5,158 GND.1@5,168 GND.2@93,168 GND.3@93,139 RX@93,52 TX@93,43 GND.4@93,33",
        others: &[],
    },
    WokwiBoard {
        name: "ESP32-S3-DEVKITC-1",
        kind: "board-esp32-s3-devkitc-1",
        size: (97, 265),
        names: Names::Printed,
        ground: &["GND.1", "GND.2", "GND.3", "GND.4"],
        three: &["3V3.1", "3V3.2"],
        five: &["5V"],
        logic: Rail::Three,
        contacts: "0@91,154 1@91,58 2@91,67 3@5,144 4@5,58 5@5,67 6@5,77 7@5,87 8@5,135 9@5,163 10@5,173 11@5,183 \
                   12@5,192 13@5,202 14@5,211 15@5,96 16@5,106 17@5,115 18@5,125 19@91,211 20@91,202 21@91,192 \
                   35@91,144 36@91,135 37@91,125 38@91,115 39@91,106 40@91,96 41@91,87 42@91,77 45@91,163 46@5,154 \
                   47@91,183 48@91,173 3V3.1@5,29 3V3.2@5,39 5V@5,221 GND.1@5,231 GND.2@91,29 TX@91,39 RX@91,48 \
                   GND.3@91,221 GND.4@91,231",
        others: &[],
    },
    WokwiBoard {
        name: "ARDUINO-NANO-ESP32",
        kind: "board-arduino-nano-esp32",
        size: (164, 69),
        names: Names::Printed,
        ground: &["GND.1", "GND.2"],
        three: &["3V3"],
        five: &["VBUS"],
        logic: Rail::Three,
        contacts: "D12@18,6 D11@28,6 D10@37,6 D9@47,6 D8@57,6 D7@66,6 D6@76,6 D5@85,6 D4@95,6 D3@105,6 D2@114,6 \
                   GND.1@124,6 RX0@143,6 TX1@153,6 D13@18,63 3V3@28,63 B0@37,63 A0@47,63 A1@57,63 A2@66,63 A3@76,63 \
                   A4@85,63 A5@95,63 A6@105,63 A7@114,63 VBUS@124,63 B1@133,63 GND.2@143,63",
        others: &[],
    },
    WokwiBoard {
        name: "XIAO-ESP32C3",
        kind: "board-xiao-esp32-c3",
        size: (69, 89),
        names: Names::Printed,
        ground: &["GND"],
        three: &["3V3"],
        five: &["5V"],
        logic: Rail::Three,
        contacts: XIAO,
        others: &[],
    },
    WokwiBoard {
        name: "XIAO-ESP32C6",
        kind: "board-xiao-esp32-c6",
        size: (69, 89),
        names: Names::Printed,
        ground: &["GND"],
        three: &["3V3"],
        five: &["5V"],
        logic: Rail::Three,
        contacts: XIAO,
        others: &[],
    },
    WokwiBoard {
        name: "XIAO-ESP32S3",
        kind: "board-xiao-esp32-s3",
        size: (69, 89),
        names: Names::Printed,
        ground: &["GND"],
        three: &["3V3"],
        five: &["5V"],
        logic: Rail::Three,
        contacts: XIAO,
        others: &[],
    },
];

/// A board by the name of the built-in one.
pub(super) fn board(name: &str) -> Option<&'static WokwiBoard> {
    BOARDS.iter().find(|board| board.name == name)
}
