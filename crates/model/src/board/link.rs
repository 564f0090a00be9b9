//! A board's link to the host: its block and its target in, medium, rate and pins of the link out.

use sensedsl_board::catalog;
use sensedsl_board::profile::{self, Target, TargetProfile};
use sensedsl_board::table::Table;
use sensedsl_diagnostics::codes::{
    e0201_unknown_property, e0202_property_twice, w0601_unused_property,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wire::{Checksum, Direction};

use crate::design::{BoardIndex, Design, Device, Link, Transport};
use crate::fields::Fields;
use crate::spanned::{Spanned, span};
use crate::value::constants::Constants;

/// The properties of a link.
const LINK_PROPERTIES: &[&str] =
    &["transport", "unit", "baud", "checksum", "stamp", "silence", "rate", "vbus"];
/// The words after `transport`.
pub(crate) const TRANSPORTS: [(&str, Transport); 3] =
    [("usb", Transport::Usb), ("uart", Transport::Uart), ("none", Transport::None)];
/// Bits per second of a serial link if the file gives none.
const LINK_BAUD_DEFAULT: u32 = 115_200;
/// Silence, in milliseconds, after which a host is taken to be gone, if the file gives none.
const SILENCE_DEFAULT_MS: u32 = 500;

/// Reads a board's link. If the file does not state one, it is the first that a built-in board has
/// `wired` and the target has a driver for. If none is wired, it is USB if the target has a driver
/// for that, otherwise a UART. A UART that is wired on the board keeps its unit and its pins.
/// Without a target there is no firmware for a link to belong to, apart from what is stated.
pub(crate) fn read(
    file: FileId,
    node: &ast::Board,
    target: Option<&Target>,
    wired: &[catalog::Link],
    reported: (&Constants, &mut Vec<Diagnostic>),
) -> Link {
    let default = match target {
        Some(Target::Profile(profile)) => default_transport(profile, wired),
        Some(Target::None) | None => Transport::Usb,
    };
    let mut link = stated_link(file, node, default, reported);
    let stated = link.unit.as_ref().map(|unit| unit.value.as_str());
    let driven = |wired: &catalog::Link| match target {
        Some(Target::Profile(profile)) => is_driven(profile, wired),
        Some(Target::None) | None => true,
    };
    let uart = wired.iter().find(|wired| {
        wired.transport == profile::Transport::Uart
            && stated.is_none_or(|stated| stated == wired.unit)
            && driven(wired)
    });
    if link.transport == Transport::Uart
        && let Some(uart) = uart
    {
        let at = span(file, node.name().map_or_else(|| node.range(), |name| name.range()));
        link.unit.get_or_insert_with(|| Spanned { value: uart.unit.clone(), span: at });
        link.pins.clone_from(&uart.pins);
    }
    link
}

/// Whether a built-in board's table shows that something is on the USB device's VBUS pin. A pin
/// that is not in the table is assumed to be wired.
pub(crate) fn vbus_is_wired(table: &Table, target: &Target) -> bool {
    let Target::Profile(profile) = target else { return true };
    let vbus = profile.usb(None).and_then(|usb| usb.vbus.as_ref());
    vbus.and_then(|vbus| table.pin(vbus)).is_none_or(|pin| pin.onboard.is_some())
}

fn default_transport(profile: &TargetProfile, wired: &[catalog::Link]) -> Transport {
    let first = wired.iter().find(|wired| is_driven(profile, wired)).map(|link| link.transport);
    match first {
        Some(profile::Transport::Usb) => Transport::Usb,
        None if wired.is_empty() && profile.usb(None).is_some() => Transport::Usb,
        Some(profile::Transport::Uart) | None => Transport::Uart,
    }
}

/// Whether the target has a driver for a link.
fn is_driven(profile: &TargetProfile, wired: &catalog::Link) -> bool {
    match wired.transport {
        profile::Transport::Uart => profile.serials.iter().any(|unit| unit.name == wired.unit),
        profile::Transport::Usb => profile.usb(None).is_some(),
    }
}

/// The places of properties that not every medium has.
struct PropertyPlaces {
    transport: Transport,
    baud: Option<Span>,
    unit: Option<Span>,
    vbus: Option<Span>,
    stamp: Option<Span>,
    silence: Option<Span>,
}

impl PropertyPlaces {
    fn contradictions(&self, fields: &mut Fields<'_>) {
        let Self { transport, baud, unit, vbus, stamp, silence } = *self;
        let (spans, why) = match transport {
            Transport::Usb => (vec![baud], "a USB link has no baud rate"),
            Transport::Uart => (vec![vbus], "a serial link has no VBUS"),
            Transport::None => (vec![baud, unit, vbus, stamp, silence], "there is no link"),
        };
        for span in spans.into_iter().flatten() {
            fields.contradiction(span, "transport", why);
        }
    }
}

/// The link as the file states it.
fn stated_link(
    file: FileId,
    node: &ast::Board,
    default: Transport,
    (constants, diagnostics): (&Constants, &mut Vec<Diagnostic>),
) -> Link {
    let mut links = node.links();
    let Some(link) = links.next() else {
        let (baud, checksum) = (LINK_BAUD_DEFAULT, default_checksum(default));
        return Link { transport: default, baud, checksum, vbus: true, ..Link::default() };
    };
    let place = |link: &ast::Link| {
        span(file, link.keyword().map_or_else(|| link.range(), |keyword| keyword.text_range()))
    };
    for again in links {
        let first = place(&link);
        diagnostics.push(e0202_property_twice::property_twice(place(&again), "link", first));
    }
    let at = place(&link);
    let mut fields = Fields::new(link.properties(), file, "a link", at, (constants, diagnostics));
    let transport = fields.word("transport", &TRANSPORTS);
    let unit = fields.name("unit", "a peripheral such as USART2");
    let baud = fields.integer("baud", 1_200..=10_000_000);
    let checksums = Checksum::ALL.map(|checksum| (checksum.name(), checksum));
    let checksum = fields.word("checksum", &checksums);
    let stamp_span = fields.own_span("stamp");
    let stamp = fields.boolean("stamp").is_some_and(|stamp| stamp.value);
    let silence = fields.time_ms("silence", 10..=3_600_000);
    let rate = fields.frequency_hz("rate", 1..=10_000);
    let vbus_span = fields.own_span("vbus");
    let vbus = fields.boolean("vbus").map(|vbus| vbus.value);
    for field in fields.rest() {
        let meant = nearest(&field.name, LINK_PROPERTIES.iter().copied());
        fields.say(e0201_unknown_property::unknown_property(
            field.name_span,
            &field.name,
            "a link",
            meant,
        ));
    }
    let stated = transport.is_some();
    let transport = transport.map_or(default, |word| word.value);
    let given = PropertyPlaces {
        transport,
        baud: baud.as_ref().map(|baud| baud.span),
        unit: unit.as_ref().map(|unit| unit.span),
        vbus: vbus_span,
        stamp: stamp_span.filter(|_| stamp),
        silence: silence.as_ref().map(|silence| silence.span),
    };
    given.contradictions(&mut fields);
    Link {
        transport,
        pins: Vec::new(),
        unit: unit.map(|unit| Spanned { value: unit.value.to_uppercase(), span: unit.span }),
        baud_span: baud.map(|baud| baud.span),
        baud: baud.and_then(|n| u32::try_from(n.value).ok()).unwrap_or(LINK_BAUD_DEFAULT),
        checksum: checksum.map_or_else(|| default_checksum(transport), |word| word.value),
        stamp,
        silence_ms: silence.as_ref().map(|silence| silence.value),
        silence_span: silence.map(|silence| silence.span),
        rate_hz: rate.map(|rate| rate.value),
        vbus: vbus.unwrap_or(true),
        stated,
    }
}

/// USB checks its own data; a UART checks nothing.
fn default_checksum(transport: Transport) -> Checksum {
    match transport {
        Transport::Usb | Transport::None => Checksum::None,
        Transport::Uart => Checksum::Crc16,
    }
}

/// Sets how long each board's host may be silent: as the file states, or a default if an actuator
/// has a failsafe value.
pub(crate) fn settle_silence(design: &mut Design, diagnostics: &mut Vec<Diagnostic>) {
    let board_of = |device: &Device| design.part(device.part).and_then(|part| part.board);
    // Repeated frames stop when the host does, and so do motors.
    let has_to_stop = |device: &Device| {
        let is_motor = device.kind.stepper().is_some() && device.direction == Direction::Actuator;
        device.coding.failsafe.is_some() || device.kind.resend_ms() > 0 || is_motor
    };
    let falling: Vec<Option<BoardIndex>> = design
        .connections
        .iter()
        .filter(|connection| connection.kind.failsafe().is_some())
        .map(|connection| connection.board)
        .chain(design.devices.iter().filter(|one| has_to_stop(one)).map(board_of))
        .collect();
    for (index, board) in design.boards.iter_mut().enumerate() {
        let link = &mut board.link;
        let is_here = |on: &Option<BoardIndex>| on.is_none_or(|on| on.0 == index);
        if falling.iter().any(is_here) {
            let default = (link.transport != Transport::None).then_some(SILENCE_DEFAULT_MS);
            link.silence_ms = link.silence_ms.or(default);
        } else if let Some(at) = link.silence_span {
            let (kind, why) = ("this board", "no actuator on it has a `failsafe`");
            diagnostics.push(w0601_unused_property::unused_property(at, "silence", kind, why));
        }
    }
}
