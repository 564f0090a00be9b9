//! Pin names and natural order: a spelling in, a comparable name out.

use std::cmp::Ordering;
use std::fmt;

/// The name of a pin on chips and boards: `PA2`, `PC2_C`, `GP0`, `D3`, `P0.13`.
///
/// Names are in upper case. `PA02` becomes `PA2`, and what ST's tables append to a name
/// (`PC14-OSC32_IN`, `PA9 [PA11]`) is dropped. The order is natural: `PA2` < `PA10` < `PB0`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct PinName(String);

impl PinName {
    /// Reads a spelling; `None` if it cannot be a pin. A name starts with a letter, has a digit,
    /// and contains only letters, digits, `_` and `.`.
    #[must_use]
    pub fn parse(spelled: &str) -> Option<Self> {
        let upper = spelled.trim().to_ascii_uppercase();
        if let Some(name) = port_and_number(&upper) {
            return Some(Self(name));
        }
        let shaped = upper.starts_with(|c: char| c.is_ascii_alphabetic())
            && upper.contains(|c: char| c.is_ascii_digit())
            && upper.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '.'))
            && upper.len() <= 32;
        shaped.then_some(Self(upper))
    }

    /// The canonical spelling.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The port letter of a name like `PA2`.
    #[must_use]
    pub fn port(&self) -> Option<char> {
        self.number()?;
        self.0.chars().nth(1)
    }

    /// The number within the port of a name like `PA2` or `PC2_C`.
    #[must_use]
    pub fn number(&self) -> Option<u8> {
        let rest = self.0.strip_prefix('P')?;
        let digits = rest.strip_prefix(|c: char| c.is_ascii_uppercase())?;
        digits.strip_suffix("_C").unwrap_or(digits).parse().ok()
    }
}

/// `PA02-WKUP` to `PA2`: the port form of STM32, AVR and SAM, with its suffixes.
fn port_and_number(upper: &str) -> Option<String> {
    let rest = upper.strip_prefix('P')?;
    let port = rest.chars().next().filter(char::is_ascii_uppercase)?;
    let rest = rest.get(1..)?;
    let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let (digits, suffix) = rest.split_at_checked(end)?;
    let number: u8 = digits.parse().ok()?;
    let analog = suffix.strip_prefix("_C");
    let suffix = analog.unwrap_or(suffix);
    // Some of ST's files have `PC14OSC32_IN` and `PF11BOOT0` as one word.
    let glued = suffix.starts_with("OSC") || suffix.starts_with("BOOT");
    let known = suffix.is_empty() || glued || suffix.starts_with(['-', ' ', '/', '(', '[']);
    known.then(|| format!("P{port}{number}{}", if analog.is_some() { "_C" } else { "" }))
}

/// Shows a type as its name, and puts its values in natural order.
macro_rules! named {
    ($($type:ty: $name:ident),+) => { $(
        impl fmt::Display for $type {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.$name())
            }
        }

        impl Ord for $type {
            fn cmp(&self, other: &Self) -> Ordering {
                natural(self.$name(), other.$name())
            }
        }

        impl PartialOrd for $type {
            fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
                Some(self.cmp(other))
            }
        }
    )+ };
}

pub(crate) use named;

named!(PinName: as_str);

/// Natural order: runs of digits compare as numbers, everything else byte by byte. Texts that
/// differ never compare as equal.
#[must_use]
pub fn natural(left: &str, right: &str) -> Ordering {
    let (mut a, mut b) = (left, right);
    while !a.is_empty() && !b.is_empty() {
        let (run_a, rest_a) = first_run(a);
        let (run_b, rest_b) = first_run(b);
        let order = match (is_number(run_a), is_number(run_b)) {
            (true, true) => {
                let (x, y) = (run_a.trim_start_matches('0'), run_b.trim_start_matches('0'));
                x.len().cmp(&y.len()).then_with(|| x.cmp(y))
            }
            _ => run_a.cmp(run_b),
        };
        if order != Ordering::Equal {
            return order;
        }
        (a, b) = (rest_a, rest_b);
    }
    a.len().cmp(&b.len()).then_with(|| left.cmp(right))
}

fn is_number(run: &str) -> bool {
    run.as_bytes().first().is_some_and(u8::is_ascii_digit)
}

/// The leading run of digits, or of anything else, and what follows. Digits are single bytes, so a
/// run ends between characters.
fn first_run(text: &str) -> (&str, &str) {
    let digits = is_number(text);
    let end = text.bytes().position(|byte| byte.is_ascii_digit() != digits);
    text.split_at_checked(end.unwrap_or(text.len())).unwrap_or((text, ""))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn name(spelled: &str) -> String {
        PinName::parse(spelled).map_or_else(|| "?".to_owned(), |pin| pin.to_string())
    }

    #[test]
    fn spellings_become_one_name() {
        for (spelled, expected) in [
            ("PA2", "PA2"),
            (" pa02 ", "PA2"),
            ("PC14-OSC32_IN", "PC14"),
            ("PC14-OSC32_IN (PC14)", "PC14"),
            ("PA9 [PA11]", "PA9"),
            ("PF2 - NRST", "PF2"),
            ("PC14OSC32_IN", "PC14"),
            ("PF11BOOT0", "PF11"),
            ("pc2_c", "PC2_C"),
            ("GP0", "GP0"),
            ("D3", "D3"),
            ("P0.13", "P0.13"),
            ("PIO0_1", "PIO0_1"),
            ("GPIO_AD_B0_03", "GPIO_AD_B0_03"),
            ("", "?"),
            ("7", "?"),
            ("VDD", "?"),
            ("PA", "?"),
            ("PA2,PA3", "?"),
            ("PÄ2", "?"),
        ] {
            assert_eq!(name(spelled), expected, "{spelled}");
        }
    }

    #[test]
    fn port_and_number_are_told_apart() {
        let pin = |text| PinName::parse(text).unwrap();
        assert_eq!((pin("PE11").port(), pin("PE11").number()), (Some('E'), Some(11)));
        assert_eq!((pin("PC2_C").port(), pin("PC2_C").number()), (Some('C'), Some(2)));
        assert_eq!((pin("GP15").port(), pin("GP15").number()), (None, None));
        assert_eq!((pin("P0.13").port(), pin("P0.13").number()), (None, None));
    }

    #[test]
    fn the_order_is_natural() {
        let mut pins: Vec<PinName> = ["PB0", "PA10", "PA2", "PC2_C", "PC2", "PA2"]
            .iter()
            .filter_map(|spelled| PinName::parse(spelled))
            .collect();
        pins.sort();
        let pins: Vec<&str> = pins.iter().map(PinName::as_str).collect();
        assert_eq!(pins, ["PA2", "PA2", "PA10", "PB0", "PC2", "PC2_C"]);
    }

    proptest::proptest! {
        #[test]
        fn natural_order_is_a_total_order(a in "[AB0-2_]{0,5}", b in "[AB0-2_]{0,5}", c in "[AB0-2_]{0,5}") {
            use proptest::prop_assert;
            prop_assert!((natural(&a, &b) == Ordering::Equal) == (a == b));
            prop_assert!(natural(&a, &b) == natural(&b, &a).reverse());
            if natural(&a, &b).is_lt() && natural(&b, &c).is_lt() {
                prop_assert!(natural(&a, &c).is_lt());
            }
        }
    }
}
