//! The formulas of the BME280, in integers that are wide enough for any value and in floating
//! point.

use sensedsl_tests::{Random, hex};

use super::{ask, program, rounds};

/// The trimming values of one part.
struct Trimming {
    t: [i128; 3],
    p: [i128; 9],
    h: [i128; 6],
}

impl Trimming {
    /// Values near those of real parts, which differ by a few percent.
    fn random(random: &mut Random) -> Self {
        let mut near = |centre: i128, spread: usize| {
            centre - spread as i128 / 2 + random.below(spread + 1) as i128
        };
        Self {
            t: [near(27_800, 1_500), near(26_300, 800), near(0, 2_000)],
            p: [
                near(37_000, 2_500),
                near(-10_600, 500),
                near(3_024, 0),
                near(5_500, 7_000),
                near(0, 400),
                near(-7, 0),
                near(11_000, 9_000),
                near(-12_000, 5_000),
                near(5_000, 2_000),
            ],
            h: [near(75, 0), near(365, 30), near(0, 0), near(315, 60), near(50, 0), near(30, 0)],
        }
    }

    fn bytes(&self) -> Vec<u8> {
        let word = |number: &i128| (*number as u16).to_le_bytes();
        let mut bytes: Vec<u8> = self.t.iter().chain(&self.p).flat_map(word).collect();
        let [h1, h2, h3, h4, h5, h6] = self.h;
        bytes.push(h1 as u8);
        bytes.extend(word(&h2));
        bytes.extend([
            h3 as u8,
            (h4 >> 4) as u8,
            ((h4 & 15) | (h5 & 15) << 4) as u8,
            (h5 >> 4) as u8,
            h6 as u8,
        ]);
        bytes
    }

    /// The formulas as in the data sheet, with integers that never overflow.
    fn integers(&self, adc: [i128; 3]) -> [i128; 3] {
        let ([t1, t2, t3], [p1, p2, p3, p4, p5, p6, p7, p8, p9]) = (self.t, self.p);
        let [h1, h2, h3, h4, h5, h6] = self.h;
        let near = (adc[1] >> 4) - t1;
        let fine =
            ((((adc[1] >> 3) - (t1 << 1)) * t2) >> 11) + ((((near * near) >> 12) * t3) >> 14);
        let from = fine - 128_000;
        let offset = from * from * p6 + ((from * p5) << 17) + (p4 << 35);
        let slope = ((from * from * p3) >> 8) + ((from * p2) << 12);
        let divisor = (((1 << 47) + slope) * p1) >> 33;
        let gross = (((1_048_576 - adc[0]) << 31) - offset) * 3_125 / divisor;
        let high = gross >> 13;
        let pascal = ((gross + ((p9 * high * high) >> 25) + ((p8 * gross) >> 19)) >> 8) + (p7 << 4);
        let from = fine - 76_800;
        let level = ((adc[2] << 14) - (h4 << 20) - h5 * from + 16_384) >> 15;
        let bend = ((((from * h6) >> 10) * (((from * h3) >> 11) + 32_768)) >> 10) + 2_097_152;
        let water = level * ((bend * h2 + 8_192) >> 14);
        let water = water - (((((water >> 15) * (water >> 15)) >> 7) * h1) >> 4);
        [(fine * 5 + 128) >> 8, pascal, water.clamp(0, 419_430_400) >> 12]
    }

    /// The other formulas of the data sheet: degC, Pa and %.
    fn reals(&self, adc: [i128; 3]) -> [f64; 3] {
        let [t1, t2, t3] = self.t.map(|number| number as f64);
        let [p1, p2, p3, p4, p5, p6, p7, p8, p9] = self.p.map(|number| number as f64);
        let [h1, h2, h3, h4, h5, h6] = self.h.map(|number| number as f64);
        let [up, ut, uh] = adc.map(|number| number as f64);
        let near = ut / 131_072.0 - t1 / 8_192.0;
        let fine = (ut / 16_384.0 - t1 / 1_024.0) * t2 + near * near * t3;
        let from = fine / 2.0 - 64_000.0;
        let offset = (from * from * p6 / 32_768.0 + from * p5 * 2.0) / 4.0 + p4 * 65_536.0;
        let slope = (p3 * from * from / 524_288.0 + p2 * from) / 524_288.0;
        let gross =
            (1_048_576.0 - up - offset / 4_096.0) * 6_250.0 / ((1.0 + slope / 32_768.0) * p1);
        let bend = p9 * gross * gross / 2_147_483_648.0 + gross * p8 / 32_768.0 + p7;
        let from = fine - 76_800.0;
        let scale = 1.0 + h6 / 67_108_864.0 * from * (1.0 + h3 / 67_108_864.0 * from);
        let water = (uh - (h4 * 64.0 + h5 / 16_384.0 * from)) * (h2 / 65_536.0 * scale);
        let water = water * (1.0 - h1 * water / 524_288.0);
        [fine / 5_120.0, gross + bend / 16.0, water.clamp(0.0, 100.0)]
    }
}

#[test]
fn bosch_formulas_are_those_of_the_data_sheet() {
    let Some(program) = program() else { return };
    let mut random = Random::new(61);
    let mut parts = Vec::new();
    let mut requests = Vec::new();
    for _ in 0..rounds(4_000) {
        let part = Trimming::random(&mut random);
        let adc = [
            200_000 + random.below(500_000) as i128,
            400_000 + random.below(200_000) as i128,
            random.below(65_536) as i128,
        ];
        let three = |number: i128| [(number >> 12) as u8, (number >> 4) as u8, (number << 4) as u8];
        let raw = [&three(adc[0])[..], &three(adc[1]), &(adc[2] as u16).to_be_bytes()].concat();
        requests.push(format!("formula bme280 {} {}", hex(&part.bytes()), hex(&raw)));
        parts.push((part, adc));
    }
    let mut sound = 0;
    for ((part, adc), answer) in parts.iter().zip(ask(program, &requests)) {
        let [celsius, pascal, percent] = part.reals(*adc);
        let is_sound = (-40.0..85.0).contains(&celsius) && (30_000.0..110_000.0).contains(&pascal);
        let integers = part.integers(*adc);
        if !is_sound || adc[2] == 0x8000 {
            continue;
        }
        sound += 1;
        let wanted = integers.map(|number| format!(" {number}")).concat();
        assert_eq!(answer, format!("1{wanted}"), "{celsius} degC, {pascal} Pa, {percent} %");
        assert!((integers[0] as f64 / 100.0 - celsius).abs() < 0.01, "{celsius} {answer}");
        assert!((integers[1] as f64 / 256.0 - pascal).abs() < 0.5, "{pascal} {answer}");
        assert!((integers[2] as f64 / 1_024.0 - percent).abs() < 0.1, "{percent} {answer}");
    }
    assert!(sound > requests.len() / 4, "only {sound} of {}", requests.len());
}
