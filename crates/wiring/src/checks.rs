//! Checks before and after solving: fixed pins that cannot serve, instances that do not exist,
//! on-board parts that are touched.

mod arrays;
mod nowhere;
mod silicon;

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_board::pin::natural;
use sensedsl_board::signal::UnitName;
use sensedsl_board::silicon::PinRole;
use sensedsl_board::table::{Occupation, Onboard, release_name};
use sensedsl_diagnostics::codes::{
    e0311_unknown_unit, e0314_pin_cannot_serve, e0316_pin_not_available, e0320_silicon_cannot,
    e0321_too_much_voltage, w0604_unused_rule, w0605_onboard_part, w0609_one_address_on_two_buses,
    w0610_level_not_known,
};
use sensedsl_diagnostics::{Diagnostic, Span, visible};
use sensedsl_model::design::{
    Board, BoardIndex, Connection, Design, Level, PinRef, PreferenceSubject, Spanned,
};
use sensedsl_model::kind::{Role, Sharing};
use sensedsl_model::written::{divider, shown_mv, shown_ohm};

use crate::alternatives::alternatives;
use crate::assignment::{Assignment, BoardAssignment};
use crate::builder::{Builder, Converters, Meaning};
use crate::formulate::{Formulation, wanted};
use crate::levels::{Tolerates, stands, supply_mv};
use crate::offer::{Offer, Withheld, roles};
use crate::requested::{RequestedWires, free};

/// What tables call the part at a pin that only the MCU reads, at reset.
const STRAPPING: &str = "strapping";

/// Reports what is wrong with the placement of devices that have no way to be connected at all.
pub(crate) fn hopeless(design: &Design, formulation: &Formulation<'_>) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    // All elements of an array have the same reason.
    let mut reported = BTreeSet::new();
    for (wires, meanings) in design.connections.iter().zip(&formulation.meanings) {
        if meanings.is_empty() && reported.insert((wires.part, wires.name.as_deref())) {
            diagnostics.extend(Placed::new(design, formulation, wires).why_hopeless());
        }
    }
    if diagnostics.is_empty() {
        diagnostics.extend(arrays::too_long(design, formulation));
    }
    diagnostics
}

/// A fixed pin of a device.
type Fixed = (Role, Spanned<PinRef>);

/// A connection, with the boards that it may be on.
struct Placed<'d> {
    design: &'d Design,
    offers: Vec<&'d Offer<'d>>,
    wires: &'d Connection,
}

impl<'d> Placed<'d> {
    fn new(design: &'d Design, formulation: &'d Formulation<'_>, wires: &'d Connection) -> Self {
        let bound = |offer: &&Offer<'_>| wires.board.is_none_or(|board| board == offer.index);
        Self { design, offers: formulation.offers.iter().filter(bound).collect(), wires }
    }

    fn why_hopeless(&self) -> Option<Diagnostic> {
        let wires = self.wires;
        if let Some(level) = wires.level
            && self.is_possible(|wanted| wanted.level_mv = None)
        {
            return Some(self.too_much_voltage(level));
        }
        for fixed in &wires.placement.pins {
            if let Some(withheld) = self.withheld(&fixed.1) {
                return Some(withheld);
            }
            if !self.is_possible(|wanted| {
                wanted.unit = None;
                wanted.side = None;
                wanted.header = None;
                wanted.pins.retain(|(role, _)| *role == fixed.0);
            }) {
                let report = self.swapped(fixed).or_else(|| self.bus_only(fixed));
                let report = report.or_else(|| self.by_silicon(fixed));
                let report = report.or_else(|| self.no_gpio(fixed));
                return Some(report.unwrap_or_else(|| self.cannot_serve(fixed)));
            }
        }
        if let Some(report) = self.without_silicon() {
            return Some(report);
        }
        let unit = wires.placement.unit.as_ref()?;
        let reachable = self.is_possible(|wanted| {
            wanted.pins.clear();
            wanted.side = None;
            wanted.header = None;
        });
        if reachable {
            return None;
        }
        let units = self.units();
        let kind = wires.kind.name().with_article();
        if let Some(because) = self.unit_lacks(&unit.value) {
            let name = &unit.value;
            return Some(e0320_silicon_cannot::unit_cannot(
                unit.span,
                name,
                &kind,
                because,
                &units.join(", "),
            ));
        }
        Some(e0311_unknown_unit::unknown_unit(unit.span, &unit.value, &kind, &units))
    }

    /// The report for a fixed pin that is withheld on every board that has it.
    fn withheld(&self, pin: &Spanned<PinRef>) -> Option<Diagnostic> {
        let at = |offer: &&Offer<'_>| {
            let name = pin.value.on(offer.index)?;
            let index = offer.board.table.pins.iter().position(|one| one.name == *name)?;
            Some(offer.why_withheld(index).cloned())
        };
        let all: Option<Vec<Withheld>> = self.offers.iter().filter_map(at).collect();
        let first = all?.into_iter().next()?;
        let name = pin.value.name();
        let (by, place, help) = match &first {
            Withheld::Reserved(rule) => (
                "a `reserve` rule".to_owned(),
                Some(*rule),
                "take another pin, or change the rule".to_owned(),
            ),
            Withheld::Onboard(part) if part.eq_ignore_ascii_case(STRAPPING) => (
                "the MCU, which reads it at reset to know how to start (a strapping pin)"
                    .to_owned(),
                None,
                format!(
                    "take another pin, or write `release {name};` if nothing drives or pulls it at reset"
                ),
            ),
            Withheld::Onboard(part) => (
                format!("{part} on the board"),
                None,
                format!("take another pin, or write `release {name};` if {part} is not needed"),
            ),
            Withheld::NoConnector => (
                "the board, which leads it to no connector".to_owned(),
                None,
                format!("take another pin, or write `release {name};`"),
            ),
            Withheld::Link => {
                let vbus = self.offers.iter().any(|offer| {
                    let usb = offer.board.profile().and_then(|profile| profile.usb(None));
                    usb.and_then(|usb| usb.vbus.as_ref()).is_some_and(|vbus| vbus.as_str() == name)
                });
                let help = if vbus {
                    "take another pin, or write `link { vbus = false; }` where the MCU need not notice the host"
                } else {
                    "take another pin, or another link"
                };
                ("the USB link".to_owned(), None, help.to_owned())
            }
            Withheld::Needed(role) => {
                let price = match role {
                    PinRole::Debug => "give up debugging",
                    PinRole::Reset => "make it a GPIO in the option bytes",
                    PinRole::Boot => "leave it alone at reset",
                    PinRole::Oscillator => "fit no crystal",
                    PinRole::Memory => "have a module that leaves it free",
                };
                let help = format!("take another pin, or write `release {name};` and {price}");
                (role.describe().to_owned(), None, help)
            }
        };
        let is_releasable = !matches!(first, Withheld::Reserved(_) | Withheld::Link);
        let release = self.board_of(pin).filter(|_| is_releasable).map(|board| (board, name));
        let shown = pin.value.shown();
        let report = e0316_pin_not_available::pin_not_available;
        Some(report((pin.span, &shown), &by, place, &help, release))
    }

    /// The name of the first board that has the pin.
    fn board_of(&self, pin: &Spanned<PinRef>) -> Option<Span> {
        let mut has = self.offers.iter().filter(|offer| pin.value.on(offer.index).is_some());
        has.next().map(|offer| offer.board.name.span)
    }

    /// The report for a device whose level none of its possible pins tolerates.
    fn too_much_voltage(&self, level: Level) -> Diagnostic {
        let most = |offer: &&Offer<'_>| {
            let pins = offer.pins().map(|(_, pin)| pin).filter(|pin| {
                self.wires
                    .placement
                    .pins
                    .iter()
                    .all(|(_, fixed)| fixed.value.on(offer.index) == Some(&pin.name))
            });
            let of_pin = |pin| match stands(offer.board, pin, &self.wires.kind, level.at_pin_mv()) {
                Tolerates::No(most) => Some(most),
                Tolerates::Yes | Tolerates::Unknown => None,
            };
            pins.filter_map(of_pin).max()
        };
        let supply =
            self.offers.iter().filter_map(|offer| supply_mv(offer.board)).max().unwrap_or(3_300);
        let most = self.offers.iter().filter_map(most).max().unwrap_or(supply);
        let help = if self.wires.kind.name().spec().sharing == Sharing::Own {
            let [upper, lower] = divider(level.mv, supply).map(shown_ohm);
            format!("put two resistors in between, and write `divider = [{upper}, {lower}];`")
        } else {
            format!("put a level shifter in between, and write `level = {};`", shown_mv(supply))
        };
        let at_pin = level.at_pin_mv();
        let (name, shown) = (self.design.part_name(self.wires.part), shown_mv(at_pin));
        let at = self.design.part(self.wires.part).map_or(level.span, |part| part.name.span);
        let most = if most < at_pin { most } else { supply };
        let (device, stated) = ((at, name), (level.span, shown.as_str()));
        e0321_too_much_voltage::too_much_voltage(device, stated, &shown_mv(most), &help)
    }

    /// The report for two fixed pins that would be right if exchanged.
    fn swapped(&self, (role, pin): &Fixed) -> Option<Diagnostic> {
        let pins = &self.wires.placement.pins;
        let (other, its_pin) = pins.iter().find(|(other, its_pin)| {
            other != role && its_pin.value.name() != pin.value.name() && {
                let the_other_way = [(*role, its_pin.value.clone()), (*other, pin.value.clone())];
                self.is_possible(|wanted| wanted.pins = the_other_way.to_vec())
            }
        })?;
        let needs = format!("`{role}` of {}", self.wires.kind.name().with_article());
        let line = |role: Role, pin: &PinRef| format!("{} = {};", role.property(), pin.spelled);
        let lines = format!("{} {}", line(*role, &its_pin.value), line(*other, &pin.value));
        let (one, two) = ((pin.span, &*pin.value.spelled), (its_pin.span, &*its_pin.value.spelled));
        let report = e0314_pin_cannot_serve::pins_swapped;
        Some(report(one, two, (&pin.value.shown(), &needs), &lines))
    }

    fn cannot_serve(&self, (role, pin): &Fixed) -> Diagnostic {
        let row = self.offers.iter().find_map(|offer| {
            let row = offer.board.table.pin(pin.value.on(offer.index)?)?;
            Some(offer.board.table_span(row.range.clone()))
        });
        let (needs, pins) = self.needs_and_pins(*role);
        e0314_pin_cannot_serve::pin_cannot_serve(pin.span, &pin.value.shown(), &needs, row, &pins)
    }

    /// What a device needs from a pin, and the pins that have it, in the words of reports.
    fn needs_and_pins(&self, role: Role) -> (String, String) {
        let needs = format!("`{role}` of {}", self.wires.kind.name().with_article());
        (needs, self.pins_of(role).join(", "))
    }

    /// The report for a fixed pin that an on-board part has left to the devices of its bus, if the
    /// device could have the pin without the part.
    fn bus_only(&self, (role, pin): &Fixed) -> Option<Diagnostic> {
        let row = |offer: &&Offer<'_>| {
            let table = &offer.board.table;
            let name = pin.value.on(offer.index)?;
            Some((name.clone(), table.pin(name)?.onboard.as_ref()?.part.clone()))
        };
        let (name, part) = self.offers.iter().find_map(row)?;
        let released: Vec<Offer<'_>> =
            self.offers.iter().map(|offer| offer.with_released(&name)).collect();
        let meanings = self.relaxed_on(&released, |wanted| {
            wanted.unit = None;
            wanted.side = None;
            wanted.header = None;
            wanted.pins.retain(|(fixed, _)| fixed == role);
        });
        let free = !meanings.is_empty();
        let help = format!("take another pin, or write `release {name};` if {part} is not needed");
        let by = format!("{part} on the board");
        free.then(|| {
            let release = self.board_of(pin).map(|board| (board, name.as_str()));
            let shown = pin.value.shown();
            let report = e0316_pin_not_available::pin_not_available;
            report((pin.span, &shown), &by, None, &help, release)
        })
    }

    /// Whether the device could be connected to one of the boards with its placement relaxed.
    fn is_possible(&self, relax: impl Fn(&mut RequestedWires<'_>)) -> bool {
        !self.relaxed(relax).is_empty()
    }

    fn relaxed(&self, relax: impl Fn(&mut RequestedWires<'_>)) -> Vec<Meaning> {
        let fresh: Vec<Offer<'_>> = self
            .offers
            .iter()
            .map(|offer| Offer::new(self.design, offer.index, offer.board))
            .collect();
        self.relaxed_on(&fresh, relax)
    }

    fn relaxed_on(
        &self,
        offers: &[Offer<'_>],
        relax: impl Fn(&mut RequestedWires<'_>),
    ) -> Vec<Meaning> {
        let mut wanted = wanted(self.design, self.wires);
        relax(&mut wanted);
        let mut builder =
            Builder::new(self.design, Converters::Later, sensedsl_solve::Cancel::NEVER);
        wanted.boards.retain(|board| offers.iter().any(|offer| offer.index == *board));
        alternatives(&mut builder, offers, &wanted).1
    }

    fn units(&self) -> Vec<String> {
        let meanings = self.relaxed(free);
        let mut units: Vec<String> = meanings.into_iter().filter_map(|one| one.unit).collect();
        if units.is_empty() {
            for meaning in self.relaxed(free) {
                let Some(board) = self.design.board(meaning.board) else { continue };
                for chosen in meaning.roles.iter().flatten() {
                    let pin = board.table.pins.get(chosen.pin);
                    let usage = pin.zip(chosen.usage).and_then(|(pin, at)| pin.usages.get(at));
                    let of = usage.map(|usage| usage.signal.function().units()).unwrap_or_default();
                    units.extend(of.iter().map(ToString::to_string));
                }
            }
        }
        units.sort_by(|a, b| natural(a, b));
        units.dedup();
        units
    }

    fn pins_of(&self, role: Role) -> Vec<String> {
        let at = self.wires.kind.roles(self.wires.direction).iter().position(|one| *one == role);
        let mut pins: Vec<String> = Vec::new();
        for meaning in self.relaxed(free) {
            let Some(board) = self.design.board(meaning.board) else { continue };
            let Some(candidates) = at.and_then(|at| meaning.roles.get(at)) else { continue };
            let names = candidates.iter().filter_map(|chosen| board.table.pins.get(chosen.pin));
            // With what is printed on the board, as this is what people look for.
            pins.extend(names.map(|pin| {
                let labels = pin.labels().into_iter().filter(|label| *label != pin.name.as_str());
                match labels.collect::<Vec<_>>().as_slice() {
                    [] => pin.name.to_string(),
                    labels => format!("{} ({})", pin.name, visible(&labels.join(", "))),
                }
            }));
        }
        pins.sort_by(|a, b| natural(a, b));
        pins.dedup();
        pins
    }
}

/// Warnings about a wiring.
pub(crate) fn of_wiring(design: &Design, assignment: &Assignment) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    for (on, board) in assignment.used(design) {
        for wiring in &on.connections {
            let Some(wires) = design.connection(wiring.connection) else { continue };
            let Some(part) = design.part(wires.part) else { continue };
            let (span, name) = (part.name.span, &part.name.value);
            for wire in &wiring.wires {
                let Some(pin) = wire.pin(board) else { continue };
                if let Some(level) = wires.level
                    && wire.role.is_driven_by_device()
                    && stands(board, pin, &wires.kind, level.at_pin_mv()) == Tolerates::Unknown
                {
                    let level = shown_mv(level.at_pin_mv());
                    let report = w0610_level_not_known::level_not_known;
                    diagnostics.push(report(span, name, &level, pin.name.as_str()));
                }
                let on_bus = |part: &Onboard| part.how == Occupation::Bus;
                let Some(with) = on.shared_with(wire) else { continue };
                // A device that names the part wants it, and one that joins its bus does not disturb it.
                let mut fixed = wires.placement.pins.iter().filter(|(role, _)| *role == wire.role);
                let is_fixed = fixed.clone().next().is_some();
                let is_named = fixed.any(|(_, pin)| names_part(&pin.value.spelled, with));
                if !is_named && !pin.onboard.as_ref().is_some_and(on_bus) {
                    let (pin, at) = (pin.name.as_str(), board.name.span);
                    let report = w0605_onboard_part::onboard_part;
                    diagnostics.push(report((span, name), pin, with, at, is_fixed));
                }
            }
        }
        diagnostics.extend(same_addresses(design, on));
    }
    diagnostics
}

/// Whether a pin is named by the part on it: `LED` or `LD2` for `LED LD2`.
fn names_part(name: &str, part: &str) -> bool {
    let is = |word: &str| word.eq_ignore_ascii_case(name);
    is(part) || part.split_whitespace().any(is)
}

/// Devices of one address that are on two buses although the file does not ask for a bus.
fn same_addresses(design: &Design, on: &BoardAssignment) -> Vec<Diagnostic> {
    let mut first: BTreeMap<u8, (&Connection, &str)> = BTreeMap::new();
    let mut diagnostics = Vec::new();
    for wiring in &on.connections {
        let Some(wires) = design.connection(wiring.connection) else { continue };
        let (Some(i2c), Some(unit)) = (wires.kind.i2c(), wiring.unit.as_deref()) else { continue };
        let Some((other, on)) = first.get(&i2c.address) else {
            first.insert(i2c.address, (wires, unit));
            continue;
        };
        let meant =
            |one: &Connection| one.placement.unit.is_some() || !one.placement.pins.is_empty();
        if meant(other) && meant(wires) {
            continue;
        }
        if let (Some(part), Some(before)) = (design.part(wires.part), design.part(other.part)) {
            diagnostics.push(w0609_one_address_on_two_buses::one_address_on_two_buses(
                (part.name.span, &part.name.value, unit),
                (before.name.span, &before.name.value, on),
                i2c.address,
            ));
        }
    }
    diagnostics
}

/// Rules that cannot have any effect.
pub(crate) fn rules(design: &Design) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    for (index, board) in design.boards.iter().enumerate() {
        let pins = || board.table.pins.iter();
        let mut known: BTreeSet<&str> = pins().map(|pin| pin.name.as_str()).collect();
        let units: Vec<_> = pins()
            .flat_map(|pin| &pin.usages)
            .flat_map(|usage| usage.signal.function().units())
            .collect();
        known.extend(units.iter().map(UnitName::as_str));
        let is_known = |name: &str| {
            known.contains(name) || units.iter().any(|unit| board.same_unit(name, unit.as_str()))
        };
        for rule in board.reserved.iter().filter(|rule| !is_known(&rule.value)) {
            let text = format!("reserve {}", rule.value);
            let why = "the board has no such pin or peripheral";
            diagnostics.push(w0604_unused_rule::unused_rule(rule.span, &text, why));
        }
        diagnostics.extend(releases(design, BoardIndex(index), board));
    }
    let mut reported = BTreeSet::new();
    for wires in &design.connections {
        // The connections of a part share their rules.
        if !reported.insert(wires.part) {
            continue;
        }
        let several = wires.kind.roles(wires.direction).len() > 1
            || wires.element.is_some()
            || design.connections_of(wires.part).nth(1).is_some();
        for wish in &wires.wishes {
            if several && wish.prefer && matches!(wish.what, PreferenceSubject::Pin(None, _)) {
                let roles: Vec<&str> =
                    wires.kind.roles(wires.direction).iter().map(|role| role.name()).collect();
                let why = format!("the device has several wires: name one of {}", roles.join(", "));
                diagnostics.push(w0604_unused_rule::unused_rule(wish.span, "prefer pin", &why));
            }
            let of_array =
                matches!(wish.what, PreferenceSubject::Together(_) | PreferenceSubject::Sequence);
            if of_array && wires.element.is_none() {
                let text = crate::labels::describe(wish);
                let why = "it is for arrays, whose elements have a wire each";
                diagnostics.push(w0604_unused_rule::unused_rule(wish.span, &text, why));
            }
        }
        diagnostics.extend(arrays::without_unit(wires));
    }
    diagnostics.extend(nowhere::nowhere(design));
    diagnostics
}

/// Releases that free nothing: nothing has the pin, or the link keeps it.
fn releases(design: &Design, index: BoardIndex, board: &Board) -> Vec<Diagnostic> {
    let offer = Offer::new(design, index, board);
    let roles = roles(board);
    // By the name of a pin that is taken, or of the part on it: whether the link keeps such a pin.
    let (mut names, mut parts) = (BTreeMap::<&str, bool>::new(), BTreeMap::<String, bool>::new());
    for (at, pin) in board.table.pins.iter().enumerate() {
        let linked = offer.why_withheld(at) == Some(&Withheld::Link);
        let is_off = board.table.is_off_connectors(pin);
        if pin.onboard.is_some() || roles.contains_key(&pin.name) || is_off {
            *names.entry(pin.name.as_str()).or_default() |= linked;
        }
        if let Some(part) = &pin.onboard {
            *parts.entry(release_name(&part.part).to_uppercase()).or_default() |= linked;
        }
    }
    let why_useless = |rule: &str| {
        let (name, part) = (names.get(rule), parts.get(&rule.to_uppercase()));
        match name.into_iter().chain(part).copied().reduce(|one, other| one || other) {
            None => Some("no on-board part is there"),
            Some(true) => Some("the USB link keeps it"),
            Some(false) => None,
        }
    };
    let useless = board.released.iter().filter_map(|rule| {
        let text = format!("release {}", rule.value);
        Some(w0604_unused_rule::unused_rule(rule.span, &text, why_useless(&rule.value)?))
    });
    useless.collect()
}
