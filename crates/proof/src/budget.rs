//! How much of a certificate is read and looked at, so that a hostile one is refused soon.
//!
//! Every case of a proof goes through all choices that are left in it, so the text alone does not
//! bound the time: a text of half cases and half choices would take hours.

use crate::format::{Candidate, Problem};
use crate::tree::{Open, OpenAlternative};
use crate::{Refuted, Unusable, ensure};

/// Bytes of a certificate; one of a hundred devices on eight boards has two MiB.
pub const BYTES_MAX: usize = 8 << 20;
/// Lists and objects in a certificate that are not empty; they take memory before all else.
pub const LISTS_MAX: usize = 120_000;
/// Steps of the verifier, about a choice each, which take a second. The search for proofs has an
/// effort of 1,000,000,000 and spends about 800 of them on what is a step here.
pub const STEPS_MAX: usize = 1_250_000;
/// Choices that are remembered of the cases that wait, about a few hundred bytes each.
pub const WAITING_MAX: usize = 500_000;

/// Choices that the records of searches look at, which takes a second or two.
pub const WORK_MAX: usize = 150_000_000;

/// What is said of a proof beyond [`STEPS_MAX`] or [`WAITING_MAX`].
pub const TOO_LONG: &str = "the proofs are longer than the verifier looks at";

/// Bytes of names that are compared in one step.
const NAME_BYTES: usize = 64;

/// Checks that a text is not too large to be read.
///
/// # Errors
/// What it has too much of.
pub fn fits(text: &str) -> Result<(), Unusable> {
    if text.len() > BYTES_MAX {
        return Err(Unusable(format!("it has more than {} MiB", BYTES_MAX >> 20)));
    }
    let pairs = text.as_bytes().windows(2);
    let lists = pairs.filter(|pair| match pair {
        [b'[', next] => *next != b']',
        [b'{', next] => *next != b'}',
        _ => false,
    });
    if lists.count() > LISTS_MAX {
        return Err(Unusable(format!("it has more than {LISTS_MAX} lists and objects")));
    }
    Ok(())
}

/// What is left for the proofs of a certificate.
pub(crate) struct Budget {
    steps: usize,
    waiting: usize,
    work: usize,
}

impl Budget {
    pub(crate) const fn new() -> Self {
        Self { steps: STEPS_MAX, waiting: WAITING_MAX, work: WORK_MAX }
    }

    pub(crate) fn step(&mut self, steps: usize) -> Result<(), Refuted> {
        spend(&mut self.steps, steps)
    }

    /// A search looks at so many choices.
    pub(crate) fn work(&mut self, choices: usize) -> Result<(), Refuted> {
        spend(&mut self.work, choices)
    }

    /// Cases wait for as many choices.
    pub(crate) fn wait(&mut self, choices: usize) -> Result<(), Refuted> {
        spend(&mut self.waiting, choices)
    }

    /// They wait no more.
    pub(crate) const fn resume(&mut self, choices: usize) {
        self.waiting += choices;
    }
}

fn spend(left: &mut usize, spent: usize) -> Result<(), Refuted> {
    ensure(*left >= spent, || TOO_LONG.into())?;
    *left -= spent;
    Ok(())
}

/// The steps it takes to go through names of so many bytes.
fn names(count: usize, bytes: usize) -> usize {
    count + bytes / NAME_BYTES
}

fn texts<'t>(texts: impl IntoIterator<Item = &'t String>) -> usize {
    texts.into_iter().map(|text| names(1, text.len())).sum()
}

/// The steps it takes to go through the streams of all peripherals.
pub(crate) fn of_dma(problem: &Problem) -> usize {
    let of_requests = |requests: &Vec<_>| requests.iter().map(texts).sum::<usize>();
    problem.dma.iter().map(|(name, all)| names(1, name.len()) + of_requests(all)).sum()
}

/// The steps it takes to go through what is left in a case.
pub(crate) fn of_case(open: &Open<'_>) -> usize {
    let of_device = |(name, left): (&&str, &std::collections::BTreeMap<&str, _>)| {
        let left = left.iter().map(|(name, one)| names(1, name.len()) + of_alternative(one));
        names(1, name.len()) + left.sum::<usize>()
    };
    let violated = open.violated.iter().map(|rule| names(1, rule.len())).sum::<usize>();
    violated + open.devices.iter().map(of_device).sum::<usize>()
}

fn of_alternative(alternative: &OpenAlternative<'_>) -> usize {
    let of_role = |(name, left): (&&str, &std::collections::BTreeMap<&str, &Candidate>)| {
        let left = left.iter().map(|(name, one)| names(1, name.len()) + of_candidate(one));
        names(1, name.len()) + left.sum::<usize>()
    };
    let of = alternative.of;
    let claims = of.claims.iter().flat_map(|(name, holder)| [name, holder]);
    let own = texts(claims.chain(&of.violates).chain(&of.dma).chain([&of.board]));
    own + alternative.roles.iter().map(of_role).sum::<usize>()
}

fn of_candidate(candidate: &Candidate) -> usize {
    let Candidate { pin, holder, signal, claims, violates, moved: _ } = candidate;
    let bytes = pin.len() + holder.len() + signal.len();
    let claims = claims.iter().flat_map(|(name, holder)| [name, holder]);
    bytes / NAME_BYTES + texts(claims.chain(violates))
}
