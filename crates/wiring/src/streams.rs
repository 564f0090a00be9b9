//! DMA streams for all peripherals in use on a board, its converters included.

use std::collections::BTreeSet;

use sensedsl_board::pin::natural;
use sensedsl_model::design::Board;

use crate::assignment::{BoardAssignment, DmaAssignment};

/// One request and the streams that can serve it.
struct Request {
    unit: String,
    name: String,
    streams: Vec<String>,
}

/// A stream of its own for each request, the first of its list wherever that leaves one for all
/// others; none when there are not enough.
pub(crate) fn serve(board: &Board, assignment: &BoardAssignment) -> Option<Vec<DmaAssignment>> {
    let Some(profile) = board.profile() else { return Some(Vec::new()) };
    let units = assignment.devices.iter().filter_map(|wiring| wiring.unit.as_deref());
    let mut units: Vec<&str> = units.collect();
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
    let mut taken = BTreeSet::new();
    let mut chosen = Vec::new();
    place(&requests, &mut taken, &mut chosen).then_some(())?;
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

/// Depth-first over a handful of requests with two streams each.
fn place(requests: &[Request], taken: &mut BTreeSet<String>, chosen: &mut Vec<String>) -> bool {
    let Some(request) = requests.get(chosen.len()) else { return true };
    for stream in &request.streams {
        if taken.insert(stream.clone()) {
            chosen.push(stream.clone());
            if place(requests, taken, chosen) {
                return true;
            }
            chosen.pop();
            taken.remove(stream);
        }
    }
    false
}
