//! `digital`: a GPIO; a sensor with an edge also takes the interrupt line of its number.

use sensedsl_model::kind::digital::Digital;

use super::candidates::Need;
use super::{Alternatives, Maker, Served};

impl Served for Digital {
    fn ways(&self, maker: &mut Maker<'_, '_>) -> Vec<Alternatives> {
        let direction = maker.wanted.direction;
        let is_awaited = self.edge.is_some() && direction == sensedsl_wire::Direction::Sensor;
        let need = if is_awaited { Need::Interrupt } else { Need::Gpio };
        let roles = maker.wanted.kind.roles(direction);
        let roles = roles.into_iter().map(|role| maker.role(role, &need, None)).collect();
        maker.finish(None, &[], roles)
    }
}
