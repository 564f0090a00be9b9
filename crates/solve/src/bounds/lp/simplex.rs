//! The dual simplex method for variables with bounds: goes from one basis to a better one.
//!
//! Minimises `cost x` where `matrix x` lies within the bounds of the rows and `x` within its own.
//! Each row has a slack variable that equals the row. The basis survives changes of bounds, so a
//! node of a search starts where its parent ended.
//!
//! Three things keep the number of steps low: steepest-edge pricing (J. J. Forrest and D. Goldfarb,
//! *Steepest-edge simplex algorithms for linear programming*, 1992), a ratio test that flips bounds
//! on its way (I. Maros, *A generalized dual phase-2 simplex algorithm*, 2003), and slightly
//! perturbed costs (A. Charnes, *Optimality and degeneracy in linear programming*, 1952), which are
//! left to whoever makes the program.

mod basis;
mod kept;

use self::kept::Kept;
use super::factor::{Dense, Factor};
use super::free_rows::FreeRows;
use super::matrix::{Matrix, Variable};
use crate::cancel::Cancel;
use crate::index::{ColumnId, IdVec, Ids, RowId, VarId};

/// How far outside its bounds a value may lie.
const FEASIBLE: f64 = 1e-7;
/// Smaller entries are not used as pivots.
const PIVOT: f64 = 1e-7;
/// Number of exchanges after which the basis is decomposed again.
const UPDATES: usize = 60;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    /// The prices are optimal.
    Optimal,
    /// The value has reached the cutoff.
    Cutoff,
    /// No more steps were allowed, the caller gave up, or the numbers became unreliable.
    Unfinished,
}

/// The basic variables, and everything that is computed from them.
#[derive(Clone, Debug)]
struct Basis {
    /// The variable that is basic in a row.
    basic: IdVec<RowId, VarId>,
    /// The row in which a variable is basic.
    place: IdVec<VarId, Option<RowId>>,
    value: IdVec<VarId, f64>,
    /// Reduced costs; those of columns that are fixed at zero are out of date.
    reduced: IdVec<VarId, f64>,
    /// Steepest edge weights.
    edge: IdVec<VarId, f64>,
    factor: Factor,
    ready: bool,
}

/// A linear program and its basis.
#[derive(Clone, Debug)]
pub(crate) struct Simplex {
    matrix: Matrix,
    free: FreeRows,
    cost: IdVec<ColumnId, f64>,
    lower: IdVec<VarId, f64>,
    upper: IdVec<VarId, f64>,
    now: Basis,
    kept: Option<Box<Kept>>,
    /// Rows of all steps since the work was last taken.
    work: u64,
    // Work space.
    rho: Dense,
    column: Dense,
    tau: Dense,
    alpha: IdVec<VarId, f64>,
    touched: Vec<VarId>,
    listed: IdVec<VarId, bool>,
    /// Ratio, size of the pivot, variable.
    candidates: Vec<(f64, f64, VarId)>,
    nonzeros: Vec<RowId>,
}

impl Simplex {
    /// A program with the slacks as basis. All bounds of columns are finite; each row has at least
    /// one finite bound.
    pub(crate) fn new(
        matrix: Matrix,
        cost: IdVec<ColumnId, f64>,
        lower: IdVec<VarId, f64>,
        upper: IdVec<VarId, f64>,
    ) -> Self {
        let (rows, variables) = (matrix.rows().len(), matrix.variables());
        let of_columns = matrix.column_variables().iter().map(|_| None);
        Self {
            cost,
            lower,
            upper,
            now: Basis {
                basic: matrix.slacks().iter().collect(),
                place: of_columns.chain(matrix.rows().iter().map(Some)).collect(),
                value: IdVec::same(0.0, variables),
                reduced: IdVec::same(0.0, variables),
                edge: IdVec::same(1.0, variables),
                factor: Factor::default(),
                ready: false,
            },
            kept: None,
            work: 0,
            rho: IdVec::same(0.0, rows),
            column: IdVec::same(0.0, rows),
            tau: IdVec::same(0.0, rows),
            alpha: IdVec::same(0.0, variables),
            touched: Vec::new(),
            listed: IdVec::same(false, variables),
            candidates: Vec::new(),
            nonzeros: Vec::new(),
            free: FreeRows::new(&matrix),
            matrix,
        }
    }

    pub(crate) fn columns(&self) -> Ids<ColumnId> {
        self.matrix.columns()
    }

    pub(crate) fn bound(&mut self, column: ColumnId, lower: f64, upper: f64) {
        self.lower[Matrix::of_column(column)] = lower;
        self.upper[Matrix::of_column(column)] = upper;
    }

    pub(crate) fn value(&self, column: ColumnId) -> f64 {
        self.now.value[Matrix::of_column(column)]
    }

    /// The price of a row: what one more unit of its bound would cost (at most 0) or save.
    pub(crate) fn price(&self, row: RowId) -> f64 {
        self.now.reduced[self.matrix.slack(row)]
    }

    /// Runs until the prices are optimal, the value reaches `cutoff`, `steps` steps are done or the
    /// caller gives up.
    pub(crate) fn solve(&mut self, cutoff: f64, steps: usize, cancel: Cancel<'_>) -> Status {
        self.find_free();
        self.place_nonbasic();
        if self.now.ready {
            self.compute_values();
        } else {
            self.rebuild();
        }
        let mut anew = false;
        for step in 0..steps {
            self.work += self.matrix.rows().len() as u64;
            if anew || self.now.factor.updates() >= UPDATES || self.now.factor.worn() {
                self.rebuild();
                anew = false;
            }
            if step % 8 == 0 && self.objective() >= cutoff {
                return Status::Cutoff;
            }
            if step % 8 == 0 && cancel.is_over() {
                return Status::Unfinished;
            }
            let Some((row, over)) = self.leaving() else {
                if self.now.factor.updates() == 0 {
                    return Status::Optimal;
                }
                self.rebuild();
                if self.leaving().is_none() {
                    return Status::Optimal;
                }
                continue;
            };
            self.price_row(row);
            match self.entering(over) {
                Entering::None(slope) => {
                    if self.now.factor.updates() > 0 {
                        anew = true;
                        continue;
                    }
                    // The value grows without bound along this ray.
                    let far = ((cutoff - self.objective()).max(0.0) + 1.0) / slope * 1.01;
                    self.move_prices(row, over, far.min(1e12));
                    self.now.ready = false;
                    return Status::Cutoff;
                }
                Entering::Variable(variable, flips) => {
                    self.flip(flips);
                    if !self.exchange(row, variable) {
                        if self.now.factor.updates() == 0 {
                            return Status::Unfinished;
                        }
                        anew = true;
                    }
                }
            }
        }
        Status::Unfinished
    }

    /// The work since the last call: the number of steps times the rows that each goes through.
    pub(crate) fn take_work(&mut self) -> u64 {
        std::mem::take(&mut self.work)
    }

    /// The value that the present prices prove.
    pub(crate) fn objective(&self) -> f64 {
        let terms = self.now.reduced.iter().zip(&self.now.value).filter(|(d, _)| **d != 0.0);
        terms.map(|(d, x)| d * x).sum()
    }

    /// The row whose variable lies farthest outside its bounds, and by how much (negative if
    /// below).
    fn leaving(&self) -> Option<(RowId, f64)> {
        let mut best = (0.0, None);
        for (row, &variable) in self.now.basic.enumerate() {
            let value = self.now.value[variable];
            let over = if value > self.upper[variable] + FEASIBLE {
                value - self.upper[variable]
            } else if value < self.lower[variable] - FEASIBLE {
                value - self.lower[variable]
            } else {
                continue;
            };
            let score = over * over / self.now.edge[variable];
            if score > best.0 {
                best = (score, Some((row, over)));
            }
        }
        best.1
    }

    /// Computes a row of the inverse and of the tableau.
    fn price_row(&mut self, row: RowId) {
        for variable in self.touched.drain(..) {
            self.alpha[variable] = 0.0;
            self.listed[variable] = false;
        }
        self.rho.fill(0.0);
        self.rho[row] = 1.0;
        self.now.factor.backward(&mut self.rho);
        for (row, &rho) in self.rho.enumerate() {
            if rho.abs() < 1e-13 {
                continue;
            }
            for entry in self.free.row(row) {
                let variable = Matrix::of_column(entry.column);
                if self.now.place[variable].is_none() {
                    if !self.listed[variable] {
                        self.listed[variable] = true;
                        self.touched.push(variable);
                    }
                    self.alpha[variable] += entry.value * rho;
                }
            }
            let slack = self.matrix.slack(row);
            if self.now.place[slack].is_none() {
                self.touched.push(slack);
                self.alpha[slack] = -rho;
            }
        }
    }

    /// The variable that stops the prices from moving, after those that only flip to their other
    /// bound.
    fn entering(&mut self, over: f64) -> Entering {
        let sign = over.signum();
        self.candidates.clear();
        for &variable in &self.touched {
            let alpha = sign * self.alpha[variable];
            if alpha.abs() < PIVOT || self.lower[variable] == self.upper[variable] {
                continue;
            }
            let reduced = self.now.reduced[variable];
            let low = self.now.value[variable] <= self.lower[variable];
            if low && alpha > 0.0 || !low && alpha < 0.0 {
                self.candidates.push(((reduced / alpha).max(0.0), alpha.abs(), variable));
            }
        }
        let mut slope = over.abs();
        let mut end = None;
        let mut number = 0;
        while let Some(candidate) = self.nearest(number) {
            let (_, alpha, variable) = candidate;
            slope -= alpha * (self.upper[variable] - self.lower[variable]);
            if slope <= FEASIBLE {
                end = Some((number, candidate));
                break;
            }
            number += 1;
        }
        let Some((flips, first)) = end else { return Entering::None(slope.max(FEASIBLE)) };
        // Of those that stop it at nearly the same point, take the one with the largest pivot.
        let mut best = first;
        while let Some(candidate) = self.nearest(number).filter(|c| c.0 <= first.0 + 1e-9) {
            if candidate.1 > best.1 {
                best = candidate;
            }
            number += 1;
        }
        Entering::Variable(best.2, flips)
    }

    /// The candidate with `number` others before it. They are sorted a few at a time, as most steps
    /// need only a few.
    fn nearest(&mut self, number: usize) -> Option<(f64, f64, VarId)> {
        const SOME: usize = 16;
        if number.is_multiple_of(SOME) {
            let order = |a: &(f64, f64, VarId), b: &(f64, f64, VarId)| {
                a.0.total_cmp(&b.0).then(a.2.cmp(&b.2))
            };
            let rest = self.candidates.get_mut(number..).unwrap_or_default();
            if rest.len() > SOME {
                rest.select_nth_unstable_by(SOME - 1, order);
            }
            let some = SOME.min(rest.len());
            if let Some(some) = rest.get_mut(..some) {
                some.sort_unstable_by(order);
            }
        }
        self.candidates.get(number).copied()
    }

    /// Moves the first candidates to their other bounds.
    fn flip(&mut self, number: usize) {
        if number == 0 {
            return;
        }
        let mut v = std::mem::take(&mut self.tau);
        v.fill(0.0);
        for &(_, _, variable) in self.candidates.iter().take(number) {
            let (lower, upper) = (self.lower[variable], self.upper[variable]);
            let to = if self.now.value[variable] <= lower { upper } else { lower };
            let by = to - self.now.value[variable];
            self.now.value[variable] = to;
            match self.matrix.variable(variable) {
                Variable::Column(column) => {
                    self.matrix.column(column).iter().for_each(|&(r, a)| v[r] -= a * by);
                }
                Variable::Slack(row) => v[row] += by,
            }
        }
        self.now.factor.forward(&mut v);
        for (row, &by) in v.enumerate() {
            if by != 0.0 {
                self.now.value[self.now.basic[row]] += by;
            }
        }
        self.tau = v;
    }

    fn move_prices(&mut self, row: RowId, over: f64, by: f64) {
        let leaving = self.now.basic[row];
        let step = by * over.signum();
        for &variable in &self.touched {
            self.now.reduced[variable] -= step * self.alpha[variable];
        }
        self.now.reduced[leaving] = -step;
    }

    /// Exchanges the variable of a row; false if the pivot cannot be trusted.
    fn exchange(&mut self, row: RowId, entering: VarId) -> bool {
        let leaving = self.now.basic[row];
        self.column.fill(0.0);
        match self.matrix.variable(entering) {
            Variable::Column(column) => {
                self.matrix.column(column).iter().for_each(|&(r, a)| self.column[r] = a);
            }
            Variable::Slack(slack) => self.column[slack] = -1.0,
        }
        self.now.factor.forward(&mut self.column);
        let pivot = self.column[row];
        if pivot.abs() < PIVOT || (pivot - self.alpha[entering]).abs() > 1e-6 * (1.0 + pivot.abs())
        {
            return false;
        }
        // Flips may have carried the value to its bound: the sign of its price decides which.
        let value = self.now.value[leaving];
        let above = value > self.upper[leaving];
        let below = value < self.lower[leaving];
        let low = below || !above && self.now.reduced[entering] / pivot <= 0.0;
        let target = if low { self.lower[leaving] } else { self.upper[leaving] };
        let step = self.now.reduced[entering] / pivot;
        let by = (value - target) / pivot;
        self.tau.copy_from(&self.rho);
        let weight: f64 = self.rho.iter().map(|r| r * r).sum();
        self.now.factor.forward(&mut self.tau);
        self.nonzeros.clear();
        for r in self.column.ids() {
            let a = self.column[r];
            if a.abs() < 1e-13 {
                continue;
            }
            self.nonzeros.push(r);
            let variable = self.now.basic[r];
            self.now.value[variable] -= by * a;
            if r != row {
                let ratio = a / pivot;
                let edge =
                    self.now.edge[variable] - 2.0 * ratio * self.tau[r] + ratio * ratio * weight;
                self.now.edge[variable] = edge.max(1e-4);
            }
        }
        self.now.value[entering] += by;
        self.now.value[leaving] = target;
        for &variable in &self.touched {
            self.now.reduced[variable] -= step * self.alpha[variable];
        }
        self.now.reduced[entering] = 0.0;
        self.now.reduced[leaving] = -step;
        self.now.edge[entering] = (weight / (pivot * pivot)).max(1e-4);
        self.now.factor.exchange(row, &self.column, &self.nonzeros);
        self.now.basic[row] = entering;
        self.now.place[entering] = Some(row);
        self.now.place[leaving] = None;
        true
    }
}

enum Entering {
    /// Nothing stops the move; the value grows by this much per unit.
    None(f64),
    /// The variable, and how many of the candidates before it flip to their other bound.
    Variable(VarId, usize),
}

#[cfg(feature = "inside")]
#[expect(missing_docs, reason = "the name of a test says what it holds")]
pub(crate) mod tests;
