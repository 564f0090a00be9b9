//! DMA streams as a bipartite matching: each request gets a stream of its own.
//!
//! In: the problem, and users of DMA. Out: whether they can all be served, and with which streams.
//! A matching grows by augmenting paths (C. Berge, *Two theorems in graph theory*, 1957). The flat
//! problem asks this before there are domains.

use crate::index::IdVec;
use crate::problem::{DmaUserId, Problem, StreamId};
use std::collections::BTreeSet;

/// A growing matching of requests to streams.
pub(crate) struct Matching<'a> {
    /// The request that holds the stream, as the list of streams that can serve it.
    holder: IdVec<StreamId, Option<&'a [StreamId]>>,
}

impl<'a> Matching<'a> {
    pub(crate) fn new(streams: u32) -> Self {
        Self { holder: IdVec::same(None, streams as usize) }
    }

    /// Serves one more request, moving others if needed; false if that is impossible.
    pub(crate) fn add(&mut self, streams: &'a [StreamId]) -> bool {
        let mut seen = IdVec::same(false, self.holder.len());
        self.serve(streams, &mut seen)
    }

    fn serve(&mut self, request: &'a [StreamId], seen: &mut IdVec<StreamId, bool>) -> bool {
        for &stream in request {
            if std::mem::replace(&mut seen[stream], true) {
                continue;
            }
            if self.holder[stream].is_none_or(|other| self.serve(other, seen)) {
                self.holder[stream] = Some(request);
                return true;
            }
        }
        false
    }
}

/// Whether all users of the problem could be served at once.
pub(crate) fn all_fit(problem: &Problem) -> bool {
    let requests = problem.dma.iter().flat_map(|user| &user.requests);
    fit(problem, requests.map(|r| r.streams.as_slice()))
}

/// Whether these users can be served at once.
pub(crate) fn users_fit(problem: &Problem, users: &BTreeSet<DmaUserId>) -> bool {
    fit(problem, requests(problem, users))
}

/// The requests of these users, each as the list of streams that can serve it.
pub(crate) fn requests<'a>(
    problem: &'a Problem,
    users: &'a BTreeSet<DmaUserId>,
) -> impl Iterator<Item = &'a [StreamId]> + Clone {
    let requests = users.iter().flat_map(|&user| &problem.dma_user(user).requests);
    requests.map(|r| r.streams.as_slice())
}

/// Whether these requests can be served at once.
pub(crate) fn fit<'a>(problem: &Problem, requests: impl Iterator<Item = &'a [StreamId]>) -> bool {
    let mut matching = Matching::new(problem.streams);
    let mut requests = requests;
    requests.all(|r| matching.add(r))
}

/// Assigns streams to these users: to each request in turn, the first that leaves enough for the
/// rest.
pub(crate) fn assign(
    problem: &Problem,
    users: &BTreeSet<DmaUserId>,
) -> Option<Vec<(DmaUserId, Vec<StreamId>)>> {
    let all: Vec<&[StreamId]> = requests(problem, users).collect();
    let mut chosen: Vec<StreamId> = Vec::new();
    for (number, request) in all.iter().enumerate() {
        let works = |stream: &&StreamId| {
            let before = chosen.chunks(1).chain([std::slice::from_ref(*stream)]);
            fit(problem, before.chain(all.iter().skip(number + 1).copied()))
        };
        let stream = *request.iter().find(works)?;
        chosen.push(stream);
    }
    let mut chosen = chosen.into_iter();
    let user = |&user: &DmaUserId| {
        let number = problem.dma_user(user).requests.len();
        (user, chosen.by_ref().take(number).collect())
    };
    Some(users.iter().map(user).collect())
}
