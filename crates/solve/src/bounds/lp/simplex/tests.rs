//! Values and prices prove each other, whatever the bounds were before.

use super::*;
use crate::index::Id;

/// A small pseudo-random generator (splitmix64) for numbers below `limit`.
fn below(state: &mut u64, limit: u64) -> u64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    ((z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB) >> 20) % limit
}

/// Choices that share things that exist only once: the shape of the solver's programs.
fn program(seed: u64) -> Simplex {
    let mut state = seed;
    let (groups, things) = (2 + below(&mut state, 8) as usize, 3 + below(&mut state, 9) as usize);
    let mut matrix = Matrix::default();
    let mut cost = Vec::new();
    for group in 0..groups {
        for _ in 0..1 + below(&mut state, 6) {
            let mut entries = vec![(RowId::new(things + group), 1.0)];
            for _ in 0..1 + below(&mut state, 3) {
                entries.push((RowId::new(below(&mut state, things as u64) as usize), 1.0));
            }
            matrix.add(&entries);
            cost.push(below(&mut state, 9) as f64);
        }
    }
    matrix.finish(things + groups);
    let columns = cost.len();
    let mut lower = vec![0.0; columns];
    let mut upper = vec![1.0; columns];
    lower.extend((0..things).map(|_| f64::NEG_INFINITY).chain((0..groups).map(|_| 1.0)));
    upper.extend((0..things + groups).map(|_| 1.0));
    Simplex::new(matrix, cost.into(), lower.into(), upper.into())
}

/// Asserts that the values are within bounds and cost what the prices prove: neither can be
/// improved.
fn assert_optimal(simplex: &Simplex) {
    for (variable, &value) in simplex.now.value.enumerate() {
        assert!(value > simplex.lower[variable] - 1e-5, "{value}");
        assert!(value < simplex.upper[variable] + 1e-5, "{value}");
    }
    for row in simplex.matrix.rows() {
        let entries = simplex.matrix.row(row).iter();
        let sum: f64 = entries.map(|&(c, a)| a * simplex.value(c)).sum();
        assert!((sum - simplex.now.value[simplex.matrix.slack(row)]).abs() < 1e-5);
    }
    let cost: f64 = simplex.cost.iter().zip(&simplex.now.value).map(|(c, x)| c * x).sum();
    assert!((cost - simplex.objective()).abs() < 1e-4, "{cost} {}", simplex.objective());
}

pub fn prices_prove_the_values() {
    let mut solved = 0;
    for seed in 0..2_000 {
        let mut simplex = program(seed);
        if simplex.solve(1e6, 10_000, Cancel::NEVER) == Status::Optimal {
            assert_optimal(&simplex);
            solved += 1;
        }
    }
    assert!(solved > 500, "{solved}");
}

pub fn bounds_change_and_come_back() {
    for seed in 0..500 {
        let mut simplex = program(seed);
        if simplex.solve(1e6, 10_000, Cancel::NEVER) != Status::Optimal {
            continue;
        }
        let before = simplex.objective();
        let column = ColumnId::new((seed as usize * 7) % simplex.cost.len());
        simplex.bound(column, 0.0, 0.0);
        if simplex.solve(1e6, 10_000, Cancel::NEVER) == Status::Optimal {
            assert_optimal(&simplex);
            assert!(simplex.objective() > before - 1e-4);
        }
        simplex.bound(column, 0.0, 1.0);
        assert_eq!(simplex.solve(1e6, 10_000, Cancel::NEVER), Status::Optimal);
        assert!((simplex.objective() - before).abs() < 1e-4);
    }
}
