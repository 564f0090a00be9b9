//! DMA streams as a bipartite matching: requests in, a stream for each out; whether what a search
//! has decided leaves one.
#![expect(clippy::indexing_slicing, reason = "streams are below `Problem::streams`, as validated")]

use crate::problem::{DmaUserId, Problem, StreamId};
use crate::search::{Choices, Engine};
use std::collections::BTreeSet;

const FREE: usize = usize::MAX;

/// A growing matching of requests to streams.
pub(crate) struct Matching<'a> {
    requests: Vec<&'a [StreamId]>,
    /// Request that holds the stream.
    holder: Vec<usize>,
}

impl<'a> Matching<'a> {
    pub(crate) fn new(streams: u32) -> Self {
        Self { requests: Vec::new(), holder: vec![FREE; streams as usize] }
    }

    /// Serves one more request, moving others where needed; false when it cannot be.
    pub(crate) fn add(&mut self, streams: &'a [StreamId]) -> bool {
        self.requests.push(streams);
        let mut seen = vec![false; self.holder.len()];
        self.serve(self.requests.len() - 1, &mut seen)
    }

    fn serve(&mut self, request: usize, seen: &mut [bool]) -> bool {
        let streams = self.requests[request];
        for stream in streams {
            let stream = stream.0 as usize;
            if seen[stream] {
                continue;
            }
            seen[stream] = true;
            if self.holder[stream] == FREE || self.serve(self.holder[stream], seen) {
                self.holder[stream] = request;
                return true;
            }
        }
        false
    }
}

/// Whether all users of the problem could be served at once.
pub(crate) fn all_fit(problem: &Problem) -> bool {
    let mut matching = Matching::new(problem.streams);
    problem.dma.iter().flat_map(|u| &u.requests).all(|r| matching.add(&r.streams))
}

fn fits<'a>(problem: &Problem, requests: impl Iterator<Item = &'a [StreamId]>) -> bool {
    let mut matching = Matching::new(problem.streams);
    let mut requests = requests;
    requests.all(|r| matching.add(r))
}

/// The streams of these users, the first that works for each request in turn.
pub(crate) fn assign(
    problem: &Problem,
    users: &BTreeSet<usize>,
) -> Option<Vec<(DmaUserId, Vec<StreamId>)>> {
    let mut lists: Vec<Vec<StreamId>> = users
        .iter()
        .flat_map(|&u| problem.dma[u].requests.iter().map(|r| r.streams.clone()))
        .collect();
    if !fits(problem, lists.iter().map(Vec::as_slice)) {
        return None;
    }
    for i in 0..lists.len() {
        for stream in lists[i].clone() {
            let all = std::mem::replace(&mut lists[i], vec![stream]);
            if fits(problem, lists.iter().map(Vec::as_slice)) {
                break;
            }
            lists[i] = all;
        }
    }
    let mut chosen = lists.into_iter().flatten();
    let user = |&u: &usize| {
        let streams = chosen.by_ref().take(problem.dma[u].requests.len()).collect();
        (DmaUserId(u as u32), streams)
    };
    Some(users.iter().map(user).collect())
}

impl Engine<'_> {
    /// Whether the streams suffice for these choices.
    pub(crate) fn dma_fits(&self, choices: &Choices) -> bool {
        let mut users: Vec<usize> =
            choices.iter().flat_map(|(alt, _)| self.model.alt_dma.at(*alt)).copied().collect();
        users.sort_unstable();
        users.dedup();
        let mut matching = Matching::new(self.problem.streams);
        let mut requests = users.iter().flat_map(|&u| &self.problem.dma[u].requests);
        requests.all(|r| matching.add(&r.streams))
    }

    /// Whether the streams suffice for all that is certain.
    pub(crate) fn dma_possible(&self) -> bool {
        let model = self.model;
        let mut users: Vec<usize> = (0..model.devices)
            .filter_map(|d| self.domains.decided(d))
            .flat_map(|alt| model.alt_dma.at(alt).iter().copied())
            .collect();
        users.sort_unstable();
        users.dedup();
        let mut unions: Vec<Vec<StreamId>> = Vec::new();
        for device in (0..model.devices).filter(|&d| self.domains.decided(d).is_none()) {
            self.undecided_requests(device, &mut unions);
        }
        let mut matching = Matching::new(self.problem.streams);
        let certain = users.iter().flat_map(|&u| &self.problem.dma[u].requests);
        let mut all = certain.map(|r| r.streams.as_slice()).chain(unions.iter().map(Vec::as_slice));
        all.all(|streams| matching.add(streams))
    }

    /// The requests of a device that needs streams of its own whatever it chooses.
    fn undecided_requests(&self, device: usize, unions: &mut Vec<Vec<StreamId>>) {
        let model = self.model;
        let requests = |alt: usize| {
            let users = model.alt_dma.at(alt).iter();
            users.filter(|u| model.user_private[**u]).flat_map(|&u| &self.problem.dma[u].requests)
        };
        let least = self.domains.alts(model, device).map(|a| requests(a).count()).min();
        for position in 0..least.unwrap_or(0) {
            let mut union = Vec::new();
            for alt in self.domains.alts(model, device) {
                union.extend(requests(alt).nth(position).into_iter().flat_map(|r| &r.streams));
            }
            unions.push(union);
        }
    }
}
