//! DMA channels, for HALs that have them as peripherals with an interrupt each.

use sensedsl_job::{JobConnection, JobStream};

use crate::context::Context;
use crate::missing::{Missing, Printed};
use crate::section::Section;

/// The channel that serves a request of a connection's unit, `_TX` or `_RX`, with its handler bound in the section.
pub(super) fn channel(
    context: &Context<'_>,
    wire: &JobConnection<'_>,
    request: &str,
    section: &mut Section,
) -> Printed<String> {
    let of = |one: &&JobStream<'_>| one.request.ends_with(request);
    let stream = wire.streams.iter().find(of);
    let stream = stream.ok_or_else(|| Missing::wire(format!("a DMA stream for {request}")))?.stream;
    let channel = context.names.channel(stream);
    let channel = channel.ok_or_else(|| Missing::name(format!("the DMA stream {stream}")))?;
    let interrupt = context.interrupt(&channel, "GLOBAL")?;
    section.bind(interrupt, format!("hal::dma::InterruptHandler<{channel}>"));
    Ok(channel)
}
