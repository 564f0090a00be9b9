//! How a board and its devices are, read in place.

use core::fmt;
use core::marker::PhantomData;

use super::wire::Schema;

macro_rules! codes {
    ($(#[$doc:meta])* $name:ident { $($code:literal = $meaning:ident, $words:literal;)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name {
            $(
                #[doc = $words]
                $meaning,
            )+
            /// A number of newer firmware.
            Other(u8),
        }

        impl $name {
            fn of(code: u8) -> Self {
                match code {
                    $($code => Self::$meaning,)+
                    other => Self::Other(other),
                }
            }

            /// Its number on the wire.
            #[must_use]
            pub const fn code(self) -> u8 {
                match self {
                    $(Self::$meaning => $code,)+
                    Self::Other(code) => code,
                }
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self {
                    $(Self::$meaning => f.write_str($words),)+
                    Self::Other(code) => write!(f, "number {code}"),
                }
            }
        }
    };
}

codes! {
    /// Why a board started.
    ResetCause {
        0 = Unknown, "unknown";
        1 = Power, "power";
        2 = Pin, "reset pin";
        3 = Software, "software";
        4 = Watchdog, "watchdog";
        5 = WindowWatchdog, "window watchdog";
        6 = LowPower, "low power";
        7 = Halt, "the kernel stopped itself";
    }
}

codes! {
    /// How a device is.
    Status {
        0 = NeverRead, "never read";
        1 = Good, "good";
        2 = Stale, "stale";
        3 = Failed, "failed";
        4 = Invalid, "invalid";
    }
}

/// How a board is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Health {
    /// Milliseconds since it started.
    pub uptime_ms: u32,
    /// Why it started.
    pub reset_cause: ResetCause,
    /// After a watchdog's reset the identifier of the first device of the thread that hung; otherwise 0.
    pub reset_device: u8,
    /// Reports that were sent.
    pub reports_sent: u32,
    /// Reports that the link did not take.
    pub reports_refused: u32,
    /// The highest load of the processor so far; none if it is unknown.
    pub load_percent: Option<u8>,
    /// Bytes never used of the fullest stack; none if they are unknown.
    pub stack_left_bytes: Option<u16>,
}

/// How a device is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeviceHealth {
    /// The identifier.
    pub id: u8,
    /// The name in the design.
    pub name: &'static str,
    /// How it is.
    pub status: Status,
    /// Milliseconds since its latest value; none for never.
    pub age_ms: Option<u32>,
    /// How often it was not acknowledged, met a bus error, lost the arbitration, timed out, had a wrong checksum, was
    /// invalid.
    pub failures: [u16; 6],
}

/// Health as it came.
#[derive(Clone, Copy, Debug)]
pub struct HealthFrame<'a, S: Schema> {
    /// The bytes behind the version; the decoder has counted them.
    bytes: &'a [u8],
    schema: PhantomData<S>,
}

/// The next bytes; zeros if there are none.
fn take<const COUNT: usize>(rest: &mut &[u8]) -> [u8; COUNT] {
    let Some((bytes, others)) = rest.split_first_chunk() else { return [0; COUNT] };
    *rest = others;
    *bytes
}

const HEAD_BYTES: usize = 17;

impl<'a, S: Schema> HealthFrame<'a, S> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, schema: PhantomData }
    }

    /// How the board is.
    #[must_use]
    pub fn board(self) -> Health {
        let mut rest = self.bytes;
        let uptime_ms = u32::from_be_bytes(take(&mut rest));
        let [cause, reset_device] = take(&mut rest);
        let reports_sent = u32::from_be_bytes(take(&mut rest));
        let reports_refused = u32::from_be_bytes(take(&mut rest));
        let [load] = take(&mut rest);
        let stack = u16::from_be_bytes(take(&mut rest));
        Health {
            uptime_ms,
            reset_cause: ResetCause::of(cause),
            reset_device,
            reports_sent,
            reports_refused,
            load_percent: (load != u8::MAX).then_some(load),
            stack_left_bytes: (stack != u16::MAX).then_some(stack),
        }
    }

    /// How its devices are, in the design's order.
    pub fn devices(self) -> impl Iterator<Item = DeviceHealth> + use<'a, S> {
        let mut rest = self.bytes.get(HEAD_BYTES..).unwrap_or_default();
        S::ITEMS.iter().map(move |item| {
            let [status] = take(&mut rest);
            let age = u32::from_be_bytes(take(&mut rest));
            DeviceHealth {
                id: item.id,
                name: item.name,
                status: Status::of(status),
                age_ms: (age != u32::MAX).then_some(age),
                failures: [(); 6].map(|()| u16::from_be_bytes(take(&mut rest))),
            }
        })
    }
}
