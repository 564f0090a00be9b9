//! The tests that the library has of its own inside.

use sensedsl_solve::inside;

macro_rules! tests {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            inside::$name();
        }
    )*};
}

tests! {
    rows_have_the_free_columns_whatever_changed_before
    prices_prove_the_values
    bounds_change_and_come_back
    a_facility_of_unequal_boards_is_refused_where_it_is
    the_bounds_are_7_and_9_and_10
    fixing_leaves_light_and_wheel_the_cheap_pins
    the_search_takes_two_nodes_and_the_root_again
}
