//! Linear programs: a matrix with bounds and costs in, prices of its rows out.
//!
//! All of this is in floating point and none of it is trusted: prices only suggest where the exact
//! bound of [`crate::bounds::lagrangian`] looks, and values only suggest which branch is tried
//! first.

mod factor;
pub(crate) mod free_rows;
mod matrix;
pub(crate) mod simplex;

pub(crate) use matrix::Matrix;
pub(crate) use simplex::{Simplex, Status};
