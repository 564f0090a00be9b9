//! DMA streams for all peripherals in use on a board, its converters included.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::natural;
use sensedsl_model::design::Board;

use crate::assignment::DmaAssignment;

/// One request and the streams that can serve it.
struct Request {
    unit: String,
    name: String,
    streams: Vec<String>,
}

/// A stream of its own for each request of the units in use: the first of its list that leaves one
/// for all others. `None` if there are not enough.
pub(crate) fn serve(board: &Board, mut units: Vec<&str>) -> Option<Vec<DmaAssignment>> {
    let Some(profile) = board.profile() else { return Some(Vec::new()) };
    units.sort_by(|a, b| natural(a, b));
    units.dedup();
    let requests: Vec<Request> = units
        .iter()
        .flat_map(|unit| profile.dma(unit).iter().map(move |request| (unit, request)))
        .map(|(unit, request)| Request {
            unit: (*unit).to_owned(),
            name: request.name.clone(),
            streams: request.streams.iter().map(ToString::to_string).collect(),
        })
        .collect();
    let chosen = place(&requests)?;
    let served = requests.into_iter().zip(chosen);
    Some(
        served
            .map(|(request, stream)| DmaAssignment {
                unit: request.unit,
                request: request.name,
                stream,
            })
            .collect(),
    )
}

/// For each request, the first stream of its list that leaves one for all later ones.
fn place(requests: &[Request]) -> Option<Vec<String>> {
    let mut chosen: Vec<String> = Vec::new();
    for (at, request) in requests.iter().enumerate() {
        let later = requests.get(at + 1..).unwrap_or_default();
        let fits = |stream: &&String| {
            let taken: BTreeSet<&str> =
                chosen.iter().chain([*stream]).map(String::as_str).collect();
            !chosen.contains(*stream) && all_served(later, &taken)
        };
        let stream = request.streams.iter().find(fits)?.clone();
        chosen.push(stream);
    }
    Some(chosen)
}

/// Whether each request can have a stream of its own that is not taken.
fn all_served(requests: &[Request], taken: &BTreeSet<&str>) -> bool {
    let mut owners: BTreeMap<&str, usize> = BTreeMap::new();
    (0..requests.len())
        .all(|request| serve_one(requests, request, taken, &mut owners, &mut BTreeSet::new()))
}

/// Finds a stream for a request; a stream with an owner can be taken if the owner finds another.
fn serve_one<'r>(
    requests: &'r [Request],
    request: usize,
    taken: &BTreeSet<&str>,
    owners: &mut BTreeMap<&'r str, usize>,
    seen: &mut BTreeSet<&'r str>,
) -> bool {
    let streams = requests.get(request).map(|one| one.streams.as_slice()).unwrap_or_default();
    for stream in streams.iter().map(String::as_str) {
        if taken.contains(stream) || !seen.insert(stream) {
            continue;
        }
        let free = match owners.get(stream) {
            Some(owner) => serve_one(requests, *owner, taken, owners, seen),
            None => true,
        };
        if free {
            owners.insert(stream, request);
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placed(requests: &[&[&str]]) -> Option<Vec<String>> {
        let request = |streams: &&[&str]| Request {
            unit: String::new(),
            name: String::new(),
            streams: streams.iter().map(|stream| (*stream).to_owned()).collect(),
        };
        place(&requests.iter().map(request).collect::<Vec<_>>())
    }

    #[test]
    fn the_first_that_leaves_one_for_the_others() {
        assert_eq!(placed(&[]), Some(vec![]));
        assert_eq!(placed(&[&["a", "b"], &["a", "b"]]).unwrap(), ["a", "b"]);
        assert_eq!(placed(&[&["a", "b"], &["a"]]).unwrap(), ["b", "a"]);
        assert_eq!(placed(&[&["a", "b"], &["b", "c"], &["a"]]).unwrap(), ["b", "c", "a"]);
        assert_eq!(placed(&[&["a"], &["a"]]), None);
    }

    /// As many requests as a multiplexer has streams, and one more, take no time.
    #[test]
    fn a_multiplexer_is_dealt_out_at_once() {
        let streams: Vec<String> = (0..16).map(|stream| format!("1,{stream}")).collect();
        let streams: Vec<&str> = streams.iter().map(String::as_str).collect();
        assert_eq!(placed(&vec![streams.as_slice(); 16]).unwrap(), streams);
        assert_eq!(placed(&vec![streams.as_slice(); 17]), None);
    }
}
