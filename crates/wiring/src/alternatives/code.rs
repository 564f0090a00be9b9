//! `code`: no wire, so one way on each board.

use sensedsl_model::kind::code::Code;

use super::{Alternatives, Maker, Served};

impl Served for Code {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        maker.finish(None, &[], Vec::new())
    }
}
