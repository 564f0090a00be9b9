//! The properties of controllers and of tests.

use super::{Meaning, REQUIRED, Takes};
use crate::control::HOST;
use crate::test::words::{LENGTH_MAX_US, LENGTH_MIN_US};

/// The properties of a controller that devices do not have.
pub(super) const CONTROLLER: &[Meaning] = &[
    Meaning::new(
        ("reads", Takes::Devices),
        "none",
        "The devices whose newest values each step gets.",
        "reads = [Line, Gain];",
    ),
    Meaning::new(
        ("sets", Takes::Devices),
        "none",
        "The actuators that the code sets, and the values of `type = code` that it makes.",
        "sets = [Left, Right];",
    ),
    Meaning::new(
        ("takes", Takes::Time(1, 60_000_000)),
        "none: nothing is known of it",
        "How long a step takes at most. A longer one counts as late, and `explain timing` has it among what keeps the \
         board busy.",
        "takes = 200 us;",
    ),
    Meaning::new(
        ("host", Takes::Words(|| super::first(&HOST))),
        "`refused`",
        "Whether the host may set what the code sets: with `override` it wins, until it has been silent for the link's \
         `silence`.",
        "host = override;",
    ),
];

/// The properties of a test.
pub(super) const TEST: &[Meaning] = &[
    Meaning::new(
        ("for", Takes::Time(LENGTH_MIN_US as u64, LENGTH_MAX_US as u64)),
        REQUIRED,
        "How long the run is.",
        "for = 10 s;",
    ),
    Meaning::new(
        ("world", Takes::Text),
        "none: sensors move within their ranges",
        "What sensors measure, as a file beside this one.",
        "world = \"oval.toml\";",
    ),
    Meaning::new(
        ("seed", Takes::Whole(0, i64::MAX)),
        "that of the world, else 1",
        "What chance begins with; `--seed` wins.",
        "seed = 7;",
    ),
];
