//! The rules that every wiring keeps, as facts.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use sensedsl_diagnostics::visible;
use sensedsl_solve::problem::Holder;

use super::{Choice, Choices, atom, set, sigs};
use sensedsl_certify::{Labels, holders};

/// A choice that takes a pin or a resource.
struct Taker {
    choice: Choice,
    holder: Holder,
    /// The signal on which the holders of a pin must agree.
    signal: u32,
}

impl Taker {
    /// Whether both hold it together, as one group.
    fn shares(&self, other: &Self) -> bool {
        self.holder != Holder::Own && (self.holder, self.signal) == (other.holder, other.signal)
    }
}

pub(super) fn write(out: &mut String, choices: &Choices<'_>, labels: &Labels) {
    out.push_str(
        "\n// Each device is connected in one way, and each of its wires goes to one pin.\n",
    );
    for (ways, name) in choices.devices.iter().zip(&labels.devices) {
        let atoms: Vec<String> = ways.iter().map(|way| atom(way.choice)).collect();
        let _ = writeln!(out, "fact {{ one On & {} }} // {}", set(&atoms), visible(name));
        for way in ways {
            for role in &way.roles {
                let wires: Vec<String> = role.iter().map(|(choice, _)| atom(*choice)).collect();
                let (way, wires) = (atom(way.choice), set(&wires));
                let _ = writeln!(out, "fact {{ {way} in On implies one On & {wires}");
                let _ = writeln!(out, "  else no On & {wires} }}");
            }
        }
    }
    out.push_str(
        "\n// A pin is held by one wire, or by the wires of one group that agree on the signal.\n",
    );
    let mut pins: BTreeMap<usize, Vec<Taker>> = BTreeMap::new();
    for (choice, wire) in choices.wires() {
        let taker = Taker { choice, holder: wire.holder, signal: wire.signal.0 };
        pins.entry(wire.pin.0 as usize).or_default().push(taker);
    }
    for (pin, takers) in &pins {
        held(out, labels.pins.get(*pin), takers, true);
    }
    out.push_str("\n// So is a resource, by one device or by the devices of one group.\n");
    let mut resources: BTreeMap<usize, Vec<Taker>> = BTreeMap::new();
    let ways = choices.ways().map(|way| (way.choice, &way.of.claims));
    for (choice, claims) in ways.chain(choices.wires().map(|(choice, wire)| (choice, &wire.claims)))
    {
        for (resource, holder) in holders(claims) {
            let taker = Taker { choice, holder, signal: 0 };
            resources.entry(resource as usize).or_default().push(taker);
        }
    }
    for (resource, takers) in &resources {
        held(out, labels.resources.get(*resource), takers, false);
    }
    streams(out, choices, labels);
}

/// States that something is held once, or by one group.
fn held(out: &mut String, name: Option<&String>, takers: &[Taker], is_pin: bool) {
    let alone = |taker: &Taker| taker.holder == Holder::Own;
    // Pairs of one device that do not exclude each other anyway.
    let pairs = || {
        takers
            .iter()
            .enumerate()
            .flat_map(|(at, a)| takers.iter().skip(at + 1).map(move |b| (a, b)))
    };
    let together = |(a, b): &(&Taker, &Taker)| {
        a.choice.device == b.choice.device && !a.choice.excludes(&b.choice)
    };
    let plain = !pairs().any(|pair| together(&pair) && !(is_pin && alone(pair.0) && alone(pair.1)));
    let clash = |(a, b): &(&Taker, &Taker)| {
        if a.choice.device == b.choice.device {
            is_pin && !a.choice.excludes(&b.choice)
        } else {
            !a.shares(b)
        }
    };
    if !pairs().any(|pair| clash(&pair)) {
        return;
    }
    let _ = writeln!(out, "// {}", visible(name.map_or("", String::as_str)));
    if !plain {
        for (at, a) in takers.iter().enumerate() {
            let others = takers.iter().skip(at + 1).filter(|b| clash(&(a, b)));
            let others: Vec<String> = others.map(|b| atom(b.choice)).collect();
            if !others.is_empty() {
                let a = atom(a.choice);
                let _ = writeln!(out, "fact {{ {a} in On implies no On & {} }}", set(&others));
            }
        }
        return;
    }
    let own: Vec<String> =
        takers.iter().filter(|one| alone(one)).map(|one| atom(one.choice)).collect();
    if own.len() > 1 {
        let _ = writeln!(out, "fact {{ lone On & {} }}", set(&own));
    }
    let mut groups: Vec<&Taker> = Vec::new();
    for taker in takers.iter().filter(|one| !alone(one)) {
        if groups.iter().any(|group| group.shares(taker)) {
            continue;
        }
        groups.push(taker);
        let (members, others): (Vec<&Taker>, Vec<&Taker>) =
            takers.iter().partition(|one| taker.shares(one));
        if !others.is_empty() {
            let atoms =
                |all: Vec<&Taker>| all.iter().map(|one| atom(one.choice)).collect::<Vec<_>>();
            let (members, others) = (set(&atoms(members)), set(&atoms(others)));
            let _ = writeln!(out, "fact {{ some On & {members} implies\n  no On & {others} }}");
        }
    }
}

/// States that each DMA request of a peripheral in use is served by a stream of its own.
fn streams(out: &mut String, choices: &Choices<'_>, labels: &Labels) {
    let users = choices.problem.dma.iter().zip(&labels.dma).enumerate();
    let mut by_stream: BTreeMap<u32, Vec<String>> = BTreeMap::new();
    let used: BTreeSet<u32> =
        choices.ways().flat_map(|way| &way.of.dma).map(|user| user.0).collect();
    let mut reported = false;
    for (number, (user, name)) in users.filter(|(at, _)| used.contains(&(*at as u32))) {
        if !reported {
            out.push_str("\n// Each DMA request of a peripheral in use has a stream of its own.\n");
            reported = true;
        }
        let ways =
            choices.ways().filter(|way| way.of.dma.iter().any(|one| one.0 as usize == number));
        let ways: Vec<String> = ways.map(|way| atom(way.choice)).collect();
        for (at, request) in user.requests.iter().enumerate() {
            let mut atoms = Vec::new();
            for stream in &request.streams {
                let atom = format!("D{number}_{at}_{}", stream.0);
                let streams = by_stream.entry(stream.0).or_default();
                if !streams.contains(&atom) {
                    streams.push(atom.clone());
                    let stream = labels.streams.get(stream.0 as usize).map_or("", String::as_str);
                    atoms.push((atom, format!("{name} by {stream}")));
                }
            }
            sigs(out, "Choice", &atoms);
            let atoms: Vec<String> = atoms.into_iter().map(|(atom, _)| atom).collect();
            let (ways, atoms) = (set(&ways), set(&atoms));
            let _ = writeln!(out, "fact {{ some On & {ways} implies one On & {atoms}");
            let _ = writeln!(out, "  else no On & {atoms} }}");
        }
    }
    for atoms in by_stream.values().filter(|atoms| atoms.len() > 1) {
        let _ = writeln!(out, "fact {{ lone On & {} }}", set(atoms));
    }
}
