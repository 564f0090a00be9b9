//! What a file says of the user's own code: blocks of controllers in; devices and [`Controller`](crate::design::Controller)s
//! out.

mod bind;
mod read;

pub(crate) use bind::bind;
pub(crate) use read::{HOST, PROPERTIES, Unbound, read};
