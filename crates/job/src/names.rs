//! Names derived from the names of a design.

/// A name of the language in snake case: `ir_front` of `IRFront`, `us_rear` of `USRear`. Names that differ in more than
/// case and underscores stay different.
#[must_use]
pub fn snake(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    let mut text = String::with_capacity(name.len() + 4);
    for (at, letter) in letters.iter().enumerate() {
        let before = at.checked_sub(1).and_then(|at| letters.get(at));
        let starts = letter.is_ascii_uppercase()
            && before.is_some_and(|before| {
                let is_word = letters.get(at + 1).is_some_and(char::is_ascii_lowercase);
                before.is_ascii_lowercase() || (*before != '_' && is_word)
            });
        if starts {
            text.push('_');
        }
        text.push(letter.to_ascii_lowercase());
    }
    text
}

#[cfg(test)]
mod tests {
    use super::snake;

    #[test]
    fn names_in_snake_case() {
        let names = [
            ("IRFront", "ir_front"),
            ("WheelEncoder", "wheel_encoder"),
            ("USRear", "us_rear"),
            ("ADC1", "adc1"),
            ("I2C1", "i2c1"),
            ("Left_In1", "left_in1"),
            ("speed", "speed"),
            ("A", "a"),
            ("Imu2Rate", "imu2_rate"),
        ];
        for (name, wanted) in names {
            assert_eq!(snake(name), wanted);
        }
    }
}
