//! What the marks of a picture mean, below it: only those that occur.

use std::collections::BTreeSet;

use sensedsl_board::landmark::LandmarkKind;

use super::area::Point;
use super::board::Picture;
use super::draw::{Use, unused};
use super::landmarks::Symbol;
use super::marks::{self, Unused};
use super::text::{Text, width};

const SIZE: f64 = 11.0;
const LINE: f64 = 22.0;
/// From the middle of a mark to its words, and from these to the next mark.
const GAP: f64 = 12.0;

/// The marks that occur.
#[derive(Clone, Debug, Default)]
pub(super) struct Legend {
    unused: BTreeSet<Unused>,
    has_shared: bool,
    landmarks: BTreeSet<LandmarkKind>,
}

/// A mark with its words.
enum Entry<'k> {
    Kind(&'k str),
    Shared,
    Unused(Unused),
    Landmark(LandmarkKind),
}

impl Legend {
    /// Notes the marks of a board.
    pub(super) fn add(&mut self, picture: &Picture<'_>, use_of: &dyn Fn(&str) -> Option<Use>) {
        self.landmarks.extend(picture.landmarks.iter().map(|one| one.symbol.kind));
        for contact in &picture.shape.contacts {
            match contact.pin().and_then(|pin| use_of(pin.name.as_str())) {
                Some(used) => self.has_shared |= used.is_shared,
                None => {
                    self.unused.insert(unused(contact));
                }
            }
        }
    }

    /// Draws it from a point to the right, in as many lines as it needs, and returns where it ends.
    pub(super) fn draw(
        &self,
        out: &mut String,
        kinds: &[&str],
        (left, top): Point,
        right: f64,
    ) -> f64 {
        let kinds = kinds.iter().copied().map(Entry::Kind);
        let shared = self.has_shared.then_some(Entry::Shared);
        let landmarks = self.landmarks.iter().copied().map(Entry::Landmark);
        let unused = self.unused.iter().copied().map(Entry::Unused);
        let entries = kinds.chain(shared).chain(unused).chain(landmarks);
        let (mut x, mut y) = (left, top);
        for entry in entries {
            let words = entry.words();
            let room = 2.0 * GAP + width(words, SIZE) + GAP;
            if x > left && x + room > right {
                x = left;
                y += LINE;
            }
            let at = (x + 9.0, y + LINE / 2.0);
            match entry {
                Entry::Kind(kind) => marks::of_kind(out, at, kind),
                Entry::Shared => marks::shared(out, at),
                Entry::Unused(what) => marks::unused(out, at, what),
                Entry::Landmark(kind) => Symbol::small(kind, at).draw(out),
            }
            Text::new((at.0 + GAP, at.1), SIZE, "sd-ink", words).write(out);
            x += room;
        }
        y + LINE
    }
}

impl Entry<'_> {
    fn words(&self) -> &str {
        match self {
            Self::Kind(kind) => kind,
            Self::Shared => "shared with a part of the board",
            Self::Unused(what) => what.words(),
            Self::Landmark(kind) => kind.word(),
        }
    }
}
