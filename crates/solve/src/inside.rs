//! Tests of what no answer shows: the linear program, the bounds and the branches of the search.
//!
//! `tests/it/inside.rs` runs them. They are part of the library, under a feature, since it takes
//! longer to compile than all of them take to run, and is compiled once this way.

pub use crate::bounds::lp::free_rows::tests::rows_have_the_free_columns_whatever_changed_before;
pub use crate::bounds::lp::simplex::tests::{bounds_change_and_come_back, prices_prove_the_values};
pub use crate::search::branching::tests::a_facility_of_unequal_boards_is_refused_where_it_is;
pub use crate::search::worked_example::{
    fixing_leaves_light_and_wheel_the_cheap_pins, the_bounds_are_7_and_9_and_10,
    the_search_takes_two_nodes_and_the_root_again,
};
