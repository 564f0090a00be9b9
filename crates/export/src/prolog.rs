//! The pin problem as a Prolog program, in the manner of the paper: facts for the board and the
//! devices, a handful of clauses that search. An independent way to the same best cost.

use std::fmt::Write as _;

use sensedsl_certify::Labels;
use sensedsl_diagnostics::is_hidden;
use sensedsl_solve::Problem;
use sensedsl_solve::problem::{Alternative, Candidate, Claim, Holder};

/// The search: generate and test with the best cost so far as a bound.
const SEARCH: &str = include_str!("prolog_search.pl");

/// The program.
pub(crate) fn program(problem: &Problem, labels: &Labels) -> String {
    let mut out = String::from(
        "% The best wiring as a constraint problem, for SWI-Prolog:\n\
         %   swipl -q -g main -t halt wiring.pl\n\
         % prints the least opportunity cost and one wiring that has it.\n\n",
    );
    out.push_str("% pin(Pin, Usages, Shared): 1 where something else is on it.\n");
    for (name, pin) in labels.pins.iter().zip(&problem.pins) {
        // Writing to a String cannot fail.
        let (name, shared) = (atom(name), u32::from(pin.shared));
        let _ = writeln!(out, "pin({name}, {}, {shared}).", pin.cost);
    }
    out.push_str("\n% device(Name), in file order.\n");
    for name in &labels.devices {
        let _ = writeln!(out, "device({}).", atom(name));
    }
    out.push_str(
        "\n% alternative(Device, Number, Spares, Rules, Claims, DmaUsers, Roles).\n\
         % A role is a list of wire(Pin, Signal, Holder, Claims, Rules).\n",
    );
    for (name, device) in labels.devices.iter().zip(&problem.devices) {
        let name = atom(name);
        for (number, alternative) in device.alternatives.iter().enumerate() {
            let _ = writeln!(out, "alternative({name}, {number},");
            let _ = writeln!(out, "    {}).", alternative_terms(problem, labels, alternative));
        }
    }
    out.push_str(
        "\n% dma(User, Requests): each request is a list of streams.\n:- discontiguous dma/2.\n",
    );
    for (user, dma) in problem.dma.iter().enumerate() {
        let requests: Vec<String> = dma
            .requests
            .iter()
            .map(|request| list(request.streams.iter().map(|stream| stream.0.to_string())))
            .collect();
        let _ = writeln!(out, "dma({user}, {}).", list(requests.into_iter()));
    }
    if problem.dma.is_empty() {
        out.push_str("dma(none, []).\n");
    }
    out.push('\n');
    out.push_str(SEARCH);
    out
}

fn alternative_terms(problem: &Problem, labels: &Labels, alternative: &Alternative) -> String {
    let board = alternative.board.0 as usize;
    let spare = problem.boards.get(board).is_some_and(|board| board.spare);
    let spares = if spare { format!("[{board}]") } else { "[]".into() };
    let roles = alternative.roles.iter().map(|role| {
        let wires = role.candidates.iter().map(|candidate| wire(labels, candidate));
        format!("\n     {}", list(wires))
    });
    format!(
        "{spares}, {}, {}, {}, {}",
        list(alternative.violates.iter().map(|rule| rule.0.to_string())),
        claims(&alternative.claims),
        list(alternative.dma.iter().map(|user| user.0.to_string())),
        list(roles),
    )
}

fn wire(labels: &Labels, candidate: &Candidate) -> String {
    let pin = labels.pins.get(candidate.pin.0 as usize).map_or("", String::as_str);
    format!(
        "wire({}, {}, {}, {}, {})",
        atom(pin),
        candidate.signal.0,
        holder(candidate.holder),
        claims(&candidate.claims),
        list(candidate.violates.iter().map(|rule| rule.0.to_string())),
    )
}

fn claims(claims: &[Claim]) -> String {
    list(claims.iter().map(|claim| format!("{}-{}", claim.resource.0, holder(claim.holder))))
}

fn holder(holder: Holder) -> String {
    match holder {
        Holder::Own => "own".into(),
        Holder::Group(group) => format!("g{group}"),
    }
}

fn list(terms: impl Iterator<Item = String>) -> String {
    format!("[{}]", terms.collect::<Vec<_>>().join(", "))
}

/// Text as a quoted atom; invisible characters become escapes of Prolog (`\x202e\`).
fn atom(text: &str) -> String {
    let mut atom = String::from("'");
    for character in text.chars() {
        match character {
            '\\' | '\'' => atom.extend(['\\', character]),
            hidden if is_hidden(hidden) => {
                let _ = write!(atom, "\\x{:x}\\", u32::from(hidden));
            }
            plain => atom.push(plain),
        }
    }
    atom.push('\'');
    atom
}
