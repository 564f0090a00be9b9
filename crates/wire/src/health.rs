//! The state of a board and its devices, which a host gets on request.

use alloc::vec::Vec;

use crate::schema::{HEALTH_DEVICE_BYTES, HEALTH_HEAD_BYTES, ID_HEALTH, Schema};

/// The version of health that this crate reads and writes.
pub const HEALTH_VERSION: u8 = 1;
/// The byte after the 0 of a request for health.
pub(crate) const HEALTH_REQUEST: u8 = 1;
/// The age of a device that was never read or set.
pub const NEVER_MS: u32 = u32::MAX;
/// The load of a processor, if it is unknown.
pub const UNKNOWN_LOAD: u8 = u8::MAX;
/// The rest of a stack, if it is unknown.
pub const UNKNOWN_STACK: u16 = u16::MAX;

/// Makes a type of numbers on the wire, each with its meaning; newer firmware may send others.
macro_rules! codes {
    ($(#[$doc:meta])* $name:ident { $($(#[$code_doc:meta])* $code:literal = $meaning:ident,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $name {
            $($(#[$code_doc])* $meaning,)+
            /// A number that is unknown here, from newer firmware.
            Other(u8),
        }

        impl $name {
            /// The meaning of a number.
            #[must_use]
            pub const fn from_code(code: u8) -> Self {
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
    };
}

codes!(
    /// Why the board started.
    ResetCause {
        /// There is no information.
        0 = Unknown,
        /// Power on or brown-out.
        1 = Power,
        /// The reset pin.
        2 = Pin,
        /// A request by the firmware.
        3 = Software,
        /// The watchdog.
        4 = Watchdog,
        /// The window watchdog.
        5 = WindowWatchdog,
        /// Incorrect entry into or exit from a low-power mode.
        6 = LowPower,
        /// A halt of the kernel.
        7 = Halt,
    }
);

codes!(
    /// The state of a device.
    Status {
        /// It was never read.
        0 = NeverRead,
        /// The last reading was good.
        1 = Good,
        /// There was no value for three cycles.
        2 = Stale,
        /// The last reading failed.
        3 = Failed,
        /// The last answer was not a measurement.
        4 = Invalid,
    }
);

/// How often a device did not give a value, by cause; each counter stops at 65535.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Causes {
    /// Its address or a byte was not acknowledged.
    pub not_acknowledged: u16,
    /// A misplaced start or stop condition, or a framing or parity error.
    pub bus_error: u16,
    /// Another controller took the bus.
    pub arbitration_lost: u16,
    /// The answer did not come in time.
    pub timed_out: u16,
    /// The answer's checksum was wrong.
    pub wrong_checksum: u16,
    /// The answer was not a measurement.
    pub invalid: u16,
}

impl Causes {
    /// The counters, in the order of the wire.
    #[must_use]
    pub const fn counts(self) -> [u16; 6] {
        let Self { not_acknowledged, bus_error, arbitration_lost, timed_out, .. } = self;
        let (wrong_checksum, invalid) = (self.wrong_checksum, self.invalid);
        [not_acknowledged, bus_error, arbitration_lost, timed_out, wrong_checksum, invalid]
    }
}

impl From<[u16; 6]> for Causes {
    fn from(counts: [u16; 6]) -> Self {
        let [not_acknowledged, bus_error, arbitration_lost, timed_out, wrong_checksum, invalid] =
            counts;
        Self { not_acknowledged, bus_error, arbitration_lost, timed_out, wrong_checksum, invalid }
    }
}

/// The health of one device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeviceHealth {
    /// Its identifier, which is not on the wire: devices are in the schema's order.
    pub id: u8,
    /// Its status.
    pub status: Status,
    /// Time since it was last read or set; [`NEVER_MS`] for never.
    pub age_ms: u32,
    /// The failures so far.
    pub causes: Causes,
}

/// The health of a board and all its devices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Health {
    /// Time since it started.
    pub uptime_ms: u32,
    /// Why it started.
    pub reset_cause: ResetCause,
    /// After a watchdog reset, the first device of the thread that hung; otherwise 0.
    pub reset_device: u8,
    /// Reports that were sent.
    pub reports_sent: u32,
    /// Reports that the link did not accept.
    pub reports_refused: u32,
    /// The highest processor load so far; [`UNKNOWN_LOAD`] if it is not measured.
    pub load_percent: u8,
    /// Bytes never used in the fullest stack; [`UNKNOWN_STACK`] if it is not measured.
    pub stack_left_bytes: u16,
    /// All devices, in the schema's order.
    pub devices: Vec<DeviceHealth>,
}

impl Health {
    /// The payload, without the checksum.
    pub(crate) fn payload(&self) -> Vec<u8> {
        let bytes = HEALTH_HEAD_BYTES + HEALTH_DEVICE_BYTES * self.devices.len();
        let mut payload = Vec::with_capacity(bytes);
        payload.extend_from_slice(&[ID_HEALTH, HEALTH_VERSION]);
        payload.extend_from_slice(&self.uptime_ms.to_be_bytes());
        payload.extend_from_slice(&[self.reset_cause.code(), self.reset_device]);
        payload.extend_from_slice(&self.reports_sent.to_be_bytes());
        payload.extend_from_slice(&self.reports_refused.to_be_bytes());
        payload.push(self.load_percent);
        payload.extend_from_slice(&self.stack_left_bytes.to_be_bytes());
        for device in &self.devices {
            payload.push(device.status.code());
            payload.extend_from_slice(&device.age_ms.to_be_bytes());
            let counts = device.causes.counts();
            payload.extend(counts.into_iter().flat_map(u16::to_be_bytes));
        }
        payload
    }
}

/// Health, read in place.
#[derive(Clone, Copy, Debug)]
pub struct HealthFrame<'a> {
    pub(crate) schema: &'a Schema,
    /// The bytes after the version; the decoder has checked their number.
    pub(crate) bytes: &'a [u8],
}

impl HealthFrame<'_> {
    /// Reads all of it.
    #[must_use]
    pub fn read(self) -> Health {
        let mut rest = self.bytes;
        let uptime_ms = u32::from_be_bytes(take(&mut rest));
        let [reset_cause, reset_device] = take(&mut rest);
        let reports_sent = u32::from_be_bytes(take(&mut rest));
        let reports_refused = u32::from_be_bytes(take(&mut rest));
        let [load_percent] = take(&mut rest);
        let stack_left_bytes = u16::from_be_bytes(take(&mut rest));
        let devices = self.schema.items.iter().map(|item| {
            let [status] = take(&mut rest);
            DeviceHealth {
                id: item.id,
                status: Status::from_code(status),
                age_ms: u32::from_be_bytes(take(&mut rest)),
                causes: [(); 6].map(|()| u16::from_be_bytes(take(&mut rest))).into(),
            }
        });
        Health {
            uptime_ms,
            reset_cause: ResetCause::from_code(reset_cause),
            reset_device,
            reports_sent,
            reports_refused,
            load_percent,
            stack_left_bytes,
            devices: devices.collect(),
        }
    }
}

/// The next bytes; zeros if there are none.
fn take<const COUNT: usize>(rest: &mut &[u8]) -> [u8; COUNT] {
    let Some((bytes, others)) = rest.split_first_chunk() else { return [0; COUNT] };
    *rest = others;
    *bytes
}
