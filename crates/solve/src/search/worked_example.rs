//! The worked example of `docs/solver.md`: every number there that no command prints is checked
//! here.

use super::Engine;
use crate::bounds::dualized::Dualized;
use crate::cancel::Cancel;
use crate::index::{AltId, CandId};
use crate::model::Model;
use crate::problem::{
    Alternative, Board, BoardId, Candidate, Device, Pin, PinId, Problem, Role, SignalId,
};
use crate::{Options, Outcome, count, solve};

/// The number of usages of each pin of the example, in order.
const PINS: [u32; 6] = [2, 3, 1, 4, 4, 1];
const PA0: u32 = 0;
const PA1: u32 = 1;
const PB6: u32 = 2;
const PB7: u32 = 3;
const PB10: u32 = 4;
const PB11: u32 = 5;

fn alternative(roles: &[&[u32]]) -> Alternative {
    let candidate =
        |(signal, &pin): (usize, &u32)| Candidate::new(PinId(pin), SignalId(signal as u32));
    let role =
        |pins: &&[u32]| Role { candidates: pins.iter().enumerate().map(candidate).collect() };
    Alternative {
        board: BoardId(0),
        claims: Vec::new(),
        violates: Vec::new(),
        dma: Vec::new(),
        roles: roles.iter().map(role).collect(),
    }
}

fn example() -> Problem {
    let device = |alternatives: Vec<Alternative>| Device { alternatives };
    let compass = vec![alternative(&[&[PB6], &[PB7]]), alternative(&[&[PB10], &[PB11]])];
    let light = vec![alternative(&[&[PA0, PA1, PB7, PB10]])];
    let wheel = vec![alternative(&[&[PA0, PA1, PA1, PB7, PB7, PB10, PB10]])];
    let pin = |cost| Pin { board: BoardId(0), cost, shared: false };
    Problem {
        pins: PINS.map(pin).to_vec(),
        boards: vec![Board { spare: false }],
        devices: vec![device(compass), device(light), device(wheel)],
        ..Problem::default()
    }
}

pub fn the_bounds_are_7_and_9_and_10() {
    let problem = example();
    let model = Model::new(&problem).unwrap();
    let mut engine = Engine::new(&problem, &model, Cancel::NEVER).ok().unwrap();
    engine.settle().ok().unwrap();
    assert_eq!(engine.bound(), 7);
    engine.goal.limit = 11;
    engine.bound_by_prices(100).ok().unwrap();
    let pricing = engine.pricing.as_mut().unwrap();
    assert_eq!(pricing.bound, 10);
    let of_pa0 = Dualized::pin(PinId(PA0));
    let mut price_pa0 = |price: i64| {
        let unit = 1 << pricing.dualized.shift;
        let prices = pricing.dualized.prices.iter();
        let price = prices.map(|p| if p == of_pa0 { price * unit } else { 0 });
        pricing.lagrangian.set(price);
        pricing.lagrangian.assess(&pricing.dualized, &model, &engine.domains)
    };
    assert_eq!([price_pa0(0), price_pa0(1), price_pa0(2)], [9, 10, 9]);
}

pub fn fixing_leaves_light_and_wheel_the_cheap_pins() {
    let problem = example();
    let model = Model::new(&problem).unwrap();
    let mut engine = Engine::new(&problem, &model, Cancel::NEVER).ok().unwrap();
    engine.goal.limit = 11;
    engine.settle().ok().unwrap();
    engine.price().ok().unwrap();
    let cands = |alt| {
        let cands = model.alt_cands(AltId(alt)).iter();
        let living = cands.filter(|&id: &CandId| engine.domains.has_cand(&model, id));
        living.map(|id| model.cand[id].pin.0).collect::<Vec<u32>>()
    };
    assert_eq!([cands(2), cands(3)], [vec![PA0, PA1], vec![PA0, PA1, PA1]]);
    assert_eq!([cands(0), cands(1)], [vec![PB6, PB7], vec![PB10, PB11]]);
}

pub fn the_search_takes_two_nodes_and_the_root_again() {
    let problem = example();
    let model = Model::new(&problem).unwrap();
    let mut engine = Engine::new(&problem, &model, Cancel::NEVER).ok().unwrap();
    let (weight, _) = engine.search(u64::MAX, false).unwrap();
    assert_eq!((weight, engine.progress.nodes), (10, 3));
    assert_eq!(count(&problem, Cancel::NEVER).unwrap(), 20u32.into());
    let Ok(Outcome::Solved(answer)) = solve(&problem, &Options::default()) else { panic!() };
    let first: Vec<Vec<usize>> = answer.choices.into_iter().map(|c| c.candidates).collect();
    assert_eq!(first, [vec![0, 0], vec![0], vec![1]]);
}
