//! Did-you-mean.

/// The name nearest to `typed`, when one is near enough to be meant: at most a third of the
/// letters differ, case apart. Ties go to the earlier name.
pub fn nearest<'a>(typed: &str, names: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let typed = typed.to_lowercase();
    let length = typed.chars().count();
    if length > TYPED_MAX {
        return None;
    }
    let near = names.into_iter().filter_map(|name| {
        // The difference in length is a lower bound that costs little.
        let other = name.chars().count();
        if length.abs_diff(other) > (other.max(length) / 3).max(1) {
            return None;
        }
        let distance = strsim::osa_distance(&typed, &name.to_lowercase());
        let most = (other.max(length) / 3).max(1);
        (distance <= most).then_some((distance, name))
    });
    near.min_by_key(|(distance, _)| *distance).map(|(_, name)| name)
}

/// Longer words are no slips of the pen.
const TYPED_MAX: usize = 64;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_names_are_found_and_far_ones_not() {
        let names = ["analog", "i2c", "icu", "encoder"];
        assert_eq!(nearest("anlaog", names), Some("analog"));
        assert_eq!(nearest("I2C", names), Some("i2c"));
        assert_eq!(nearest("encdr", names), Some("encoder"));
        assert_eq!(nearest("bluetooth", names), None);
        assert_eq!(nearest("", names), None);
    }
}
