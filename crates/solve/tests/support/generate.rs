//! Seeded problems: a family and a number in, always the same problem out.

use super::board::{Builder, Kind, Target};

/// A small generator (splitmix64), so that a seed always gives the same problem.
pub struct Rng(pub u64);

impl Rng {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, limit: u64) -> u64 {
        self.next() % limit
    }

    fn pick<'a, T>(&mut self, weighted: &'a [(u64, T)]) -> &'a T {
        let total = weighted.iter().map(|w| w.0).sum();
        let mut at = self.below(total);
        for (weight, item) in weighted {
            if at < *weight {
                return item;
            }
            at -= weight;
        }
        &weighted[0].1
    }
}

/// The mix of devices in a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mix {
    /// A bit of everything.
    General,
    /// Mostly devices that need DMA streams.
    Dma,
    /// Mostly devices that need timers.
    Timers,
}

/// Request streams of an `STM32F40x`, as its reference manual's tables give them (8 and up: DMA2).
pub const DMA_F4: [(&str, &[&[u32]]); 12] = [
    ("I2C1", &[&[0, 5], &[6, 7]]),
    ("I2C2", &[&[2, 3], &[7]]),
    ("I2C3", &[&[2], &[4]]),
    ("SPI1", &[&[8, 10], &[11, 13]]),
    ("SPI2", &[&[3], &[4]]),
    ("SPI3", &[&[0, 2], &[5, 7]]),
    ("USART1", &[&[10, 13], &[15]]),
    ("USART2", &[&[5], &[6]]),
    ("USART3", &[&[1], &[3, 4]]),
    ("UART4", &[&[2], &[4]]),
    ("UART5", &[&[0], &[7]]),
    ("USART6", &[&[9, 10], &[14, 15]]),
];

/// A problem on these boards (table, spare) with this many devices.
pub fn problem(seed: u64, tables: &[(&str, bool)], devices: u64, mix: Mix, dma: bool) -> Builder {
    let mut rng = Rng(seed.wrapping_mul(0x1234_5678_9ABC_DEF1) ^ devices);
    let mut builder = Builder::new(Target::Chibios, tables);
    if dma {
        for (unit, requests) in DMA_F4 {
            builder.dma(16, unit, requests);
        }
    }
    let all: Vec<usize> = (0..tables.len()).collect();
    for _ in 0..devices {
        let kind = kind(&mut rng, mix);
        if rng.below(10) < 7 || tables.len() == 1 {
            builder.device(&kind, &all);
        } else {
            let board = rng.below(tables.len() as u64) as usize;
            builder.device(&kind, &[board]);
        }
    }
    builder
}

fn kind(rng: &mut Rng, mix: Mix) -> Kind {
    let address = rng.below(12) as u32;
    let group = rng.below(3) as u32;
    let edge = rng.below(2) == 0;
    let i2c = Kind::I2c { address, exclusive: rng.below(8) == 0 };
    let weights: [u64; 10] = match mix {
        Mix::General => [25, 14, 14, 5, 14, 7, 5, 2, 2, 16],
        Mix::Dma => [12, 22, 4, 2, 4, 24, 18, 0, 2, 8],
        Mix::Timers => [10, 8, 30, 14, 28, 3, 2, 1, 0, 6],
    };
    let kinds = [
        Kind::Analog,
        i2c,
        Kind::Icu,
        Kind::Encoder,
        Kind::Pwm { group },
        Kind::Uart,
        Kind::Spi,
        Kind::Can,
        Kind::Dac,
        Kind::Digital { edge },
    ];
    let weighted: Vec<(u64, Kind)> = weights.into_iter().zip(kinds).collect();
    rng.pick(&weighted).clone()
}

/// A made-up board table with `pins` pins, 16 for each port letter, laid out like a real one: units
/// have one to three places for each signal, pins carry one to eight usages.
pub fn table(seed: u64, pins: u64) -> String {
    let mut rng = Rng(seed);
    let mut usages: Vec<Vec<String>> = vec![Vec::new(); pins as usize];
    let mut put = |rng: &mut Rng, name: String, places: u64| {
        for _ in 0..places {
            let pin = rng.below(pins) as usize;
            if !usages[pin].contains(&name) {
                usages[pin].push(name.clone());
            }
        }
    };
    for n in 0..pins / 5 {
        put(&mut rng, format!("ADC12_IN{n}"), 1);
    }
    for n in 1..=pins / 26 {
        for wire in ["SCL", "SDA"] {
            let places = 1 + rng.below(2);
            put(&mut rng, format!("I2C{n}_{wire}"), places);
        }
        for wire in ["SCK", "MISO", "MOSI"] {
            let places = 1 + rng.below(2);
            put(&mut rng, format!("SPI{n}_{wire}"), places);
        }
    }
    for n in 1..=pins / 13 {
        for wire in ["TX", "RX"] {
            let places = 1 + rng.below(2);
            put(&mut rng, format!("USART{n}_{wire}"), places);
        }
    }
    for n in 1..=pins / 6 {
        let channels = [4, 4, 2, 1][rng.below(4) as usize];
        for channel in 1..=channels {
            let places = 1 + rng.below(3);
            put(&mut rng, format!("TIM{n}_CH{channel}"), places);
        }
    }
    for n in 1..=2 {
        put(&mut rng, format!("CAN{n}_RX"), 2);
        put(&mut rng, format!("CAN{n}_TX"), 2);
        put(&mut rng, format!("DAC1_OUT{n}"), 1);
    }
    for n in 0..pins {
        let places = rng.below(3);
        put(&mut rng, format!("FSMC_A{n}"), places);
    }
    let port = |n: usize| char::from(b'A' + (n / 16) as u8);
    let row = |(n, u): (usize, &Vec<String>)| format!("P{}{} {}\n", port(n), n % 16, u.join(" "));
    usages.iter().enumerate().map(row).collect()
}
