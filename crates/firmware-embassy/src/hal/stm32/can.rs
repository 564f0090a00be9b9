//! CAN controllers: the older ones filter frames with banks, the newer ones with their memory.

use sensedsl_board::signal::UnitName;
use sensedsl_job::kinds::can::{BANKS, Bus};
use sensedsl_model::kind::Role;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::buses::{Can, Filters};
use crate::missing::{self, Missing, Printed};
use crate::section::{Constructor, Section, Start};

/// Controllers with banks of filters are alone, or two share them; a third one has banks of its own.
const FIRST: &str = "CAN1";
const SECOND: &str = "CAN2";

impl Can for Settings {
    fn controller(
        &self,
        context: &Context<'_>,
        bus: &Bus<'_>,
        section: &mut Section,
    ) -> Printed<Constructor> {
        let hal = context.peripheral(bus.unit);
        let (rx, tx) = (missing::pad(bus.first, Role::Rx)?, missing::pad(bus.first, Role::Tx)?);
        let handlers: &[(&str, &str)] = if self.has_can_banks() {
            &[("TX", "Tx"), ("RX0", "Rx0"), ("RX1", "Rx1"), ("SCE", "Sce")]
        } else {
            &[("IT0", "IT0"), ("IT1", "IT1")]
        };
        for (signal, handler) in handlers {
            let interrupt = context.interrupt(bus.unit, signal)?;
            section.bind(interrupt, format!("hal::can::{handler}InterruptHandler<{hal}>"));
        }
        section.features.insert(if self.has_can_banks() { "can-banks" } else { "can-fd" });
        let maker = if self.has_can_banks() { "Can" } else { "CanConfigurator" };
        // The unit as the pins spell it: `CAN`, where there is only one.
        let moved = self.generics(context, missing::unit(bus.first)?, &["_"]);
        Ok(Constructor {
            type_: format!("hal::can::{maker}<'static>"),
            make: format!(
                "hal::can::{maker}::new{moved}(p.{hal}, p.{}, p.{}, Irqs)",
                rx.pin.name, tx.pin.name
            ),
        })
    }

    fn filters(
        &self,
        context: &Context<'_>,
        bus: &Bus<'_>,
        section: &mut Section,
    ) -> Printed<Filters> {
        if self.has_can_banks() {
            Ok(Filters { place: banks(context, bus, section)?, wanted: bus.wanted() })
        } else {
            Ok(Filters { place: String::new(), wanted: bus.wanted_in_memory() })
        }
    }
}

/// Where the filters of a controller are. The second of two uses those of the first, which needs its clock for that.
fn banks(context: &Context<'_>, bus: &Bus<'_>, section: &mut Section) -> Printed<String> {
    let own = |first: &str, number: usize| {
        format!("&rt::can::Banks {{ registers: hal::pac::{first}, first: {number} }}, ")
    };
    if bus.unit != SECOND {
        return Ok(own(&context.peripheral(bus.unit), 0));
    }
    let first = context.peripheral(FIRST);
    if context.profile.unit(FIRST).is_none() {
        return Err(Missing::name(format!("{FIRST}, which has the filters of {SECOND},")));
    }
    let mut units = context.job.connections.iter().filter_map(|one| one.unit);
    if !units.any(|unit| UnitName::new(unit) == UnitName::new(FIRST)) {
        section.starts.push(Start::Make(format!("hal::rcc::enable_and_reset::<{first}>();")));
    }
    Ok(own(&first, BANKS))
}
