//! Elements of an array of `bool` that are set one by one, as switches of a home are: an element and its new state in,
//! the whole array out, because a board is told nothing less.
//!
//! The others keep what they were set to. Right after a command that is what was asked for, not what the board has
//! confirmed: the confirmation of one of several commands in a row would take the next ones back.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use sensedsl_wire::Scalar;
use serde_json::Value;

use crate::picture::Picture;
use crate::plan::Place;

/// How long what was asked for counts.
const ASKED_FOR: Duration = Duration::from_secs(1);

/// What was asked for lately, and when.
#[derive(Debug, Default)]
pub(super) struct Elements {
    asked: BTreeMap<(usize, usize), (Instant, Vec<bool>)>,
}

/// Whether a device's elements are set one by one.
pub(super) fn are_set(place: &Place<'_>) -> bool {
    place.is_actuator() && place.is_bool() && place.device.value.length.is_some()
}

impl Elements {
    /// The array with one element set. Elements that were never set are off.
    pub(super) fn with(
        &mut self,
        place: &Place<'_>,
        picture: &Picture,
        element: usize,
        payload: &[u8],
    ) -> Result<Value, String> {
        let is_on = match payload.trim_ascii() {
            b"true" | b"on" | b"ON" | b"1" => true,
            b"false" | b"off" | b"OFF" | b"0" => false,
            _ => return Err("it must be `true` or `false`".to_owned()),
        };
        let key = (place.board, place.index);
        let lately = self.asked.remove(&key).filter(|(at, _)| at.elapsed() < ASKED_FOR);
        let mut all = match lately {
            Some((_, all)) => all,
            None => {
                let known = picture.raw(place.board, place.index).unwrap_or_default();
                let mut all: Vec<bool> =
                    known.iter().map(|one| *one == Scalar::Bool(true)).collect();
                all.resize(place.device.value.count(), false);
                all
            }
        };
        *all.get_mut(element).ok_or("there is no such element")? = is_on;
        let value = all.iter().copied().collect();
        self.asked.insert(key, (Instant::now(), all));
        Ok(value)
    }
}
