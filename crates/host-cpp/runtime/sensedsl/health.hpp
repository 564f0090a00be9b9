// How a board and its devices are: what a board answers a host that asks, and words for it.
//
// In: the payload of a health frame, or numbers to make one of. Out: numbers, and text for people.
// C++98.
#ifndef SENSEDSL_HEALTH_HPP
#define SENSEDSL_HEALTH_HPP

#include <stddef.h>
#include <stdint.h>

#include <sstream>
#include <string>
#include <vector>

#include "sensedsl/wire.hpp"

namespace sensedsl {

/// The version of health that is read and written here.
const uint8_t health_version = 1;
/// The age of a device that was never read or set.
const uint32_t never_ms = 0xFFFFFFFFU;
const uint8_t unknown_load = 255;
const uint16_t unknown_stack = 65535;

/// How a device is, and why a board started; the numbers are those of the wire.
enum Status { status_never, status_good, status_stale, status_failed, status_invalid };
enum ResetCause {
    reset_unknown,
    reset_power,
    reset_pin,
    reset_software,
    reset_watchdog,
    reset_window_watchdog,
    reset_low_power,
    reset_halt
};

/// What counts of failed readings are of.
const size_t cause_count = 6;

/// The health of one device.
struct DeviceHealth {
    uint8_t id;
    /// A `Status`, or a greater number of firmware that knows more.
    uint8_t status;
    /// Since it was read or set last, or `never_ms`.
    uint32_t age_ms;
    /// Not acknowledged, bus error, arbitration lost, timed out, wrong checksum, invalid; each stops
    /// at 65535.
    uint16_t counts[cause_count];
};

/// The health of a board.
struct Health {
    uint32_t uptime_ms;
    /// A `ResetCause`, or a greater number of firmware that knows more.
    uint8_t reset_cause;
    /// After a watchdog's reset the first device of the thread that hung; otherwise 0.
    uint8_t reset_device;
    uint32_t reports_sent;
    /// Those that the link did not take.
    uint32_t reports_refused;
    /// The highest so far, or `unknown_load`.
    uint8_t load_percent;
    /// Of the fullest stack, never used so far; or `unknown_stack`.
    uint16_t stack_left_bytes;
    /// All devices in the file's order.
    std::vector<DeviceHealth> devices;

    bool is_watchdog() const {
        return reset_cause == reset_watchdog || reset_cause == reset_window_watchdog;
    }
};

/// Of a payload whose length and version are right.
inline Health read_health(const Schema &schema, const uint8_t *payload) {
    Health health;
    health.uptime_ms = load<uint32_t>(payload + 2);
    health.reset_cause = payload[6];
    health.reset_device = payload[7];
    health.reports_sent = load<uint32_t>(payload + 8);
    health.reports_refused = load<uint32_t>(payload + 12);
    health.load_percent = payload[16];
    health.stack_left_bytes = load<uint16_t>(payload + 17);
    const uint8_t *at = payload + health_head_bytes;
    for (size_t i = 0; i < schema.device_count; ++i, at += health_device_bytes) {
        DeviceHealth device;
        device.id = schema.device_ids[i];
        device.status = at[0];
        device.age_ms = load<uint32_t>(at + 1);
        load_all(at + 5, device.counts, cause_count);
        health.devices.push_back(device);
    }
    return health;
}

/// The payload, without a checksum.
inline Bytes health_payload(const Health &health) {
    Bytes payload(1, id_health);
    payload.push_back(health_version);
    store<uint32_t>(payload, health.uptime_ms);
    payload.push_back(health.reset_cause);
    payload.push_back(health.reset_device);
    store<uint32_t>(payload, health.reports_sent);
    store<uint32_t>(payload, health.reports_refused);
    payload.push_back(health.load_percent);
    store<uint16_t>(payload, health.stack_left_bytes);
    for (size_t i = 0; i < health.devices.size(); ++i) {
        const DeviceHealth &device = health.devices[i];
        payload.push_back(device.status);
        store<uint32_t>(payload, device.age_ms);
        for (size_t cause = 0; cause < cause_count; ++cause) {
            store<uint16_t>(payload, device.counts[cause]);
        }
    }
    return payload;
}

/// A device as health and people call it.
struct DeviceFacts {
    const char *name;
    bool is_actuator;
};

/// `12 ms`, `1.2 s`, `3 min 20 s`, `2 h 1 min`, `3 d 4 h`.
inline std::string span_text(uint32_t milliseconds) {
    std::ostringstream text;
    const uint32_t seconds = milliseconds / 1000;
    if (milliseconds < 1000) {
        text << milliseconds << " ms";
    } else if (seconds < 60) {
        text << seconds << '.' << milliseconds / 100 % 10 << " s";
    } else if (seconds < 3600) {
        text << seconds / 60 << " min " << seconds % 60 << " s";
    } else if (seconds < 86400) {
        text << seconds / 3600 << " h " << seconds / 60 % 60 << " min";
    } else {
        text << seconds / 86400 << " d " << seconds / 3600 % 24 << " h";
    }
    return text.str();
}

/// `19 not acknowledged, 3 timed out`; empty when nothing failed.
inline std::string causes_text(const DeviceHealth &device) {
    static const char *const words[cause_count] = {"not acknowledged", "bus error", "arbitration lost",
                                                   "timed out",        "wrong checksum", "invalid"};
    std::ostringstream text;
    for (size_t cause = 0; cause < cause_count; ++cause) {
        if (device.counts[cause] > 0) {
            text << (text.str().empty() ? "" : ", ") << device.counts[cause]
                 << (device.counts[cause] == 65535 ? " or more " : " ") << words[cause];
        }
    }
    return text.str();
}

inline std::string status_text(uint8_t status, bool is_actuator) {
    static const char *const words[] = {"never read", "good", "stale", "failed", "invalid"};
    if (status == status_never && is_actuator) {
        return "never set";
    }
    if (status <= status_invalid) {
        return words[status];
    }
    std::ostringstream text;
    text << "status " << +status;
    return text.str();
}

/// `the watchdog: the thread of IRFront hung`
inline std::string reset_text(const Schema &schema, const DeviceFacts *facts, const Health &health) {
    static const char *const words[] = {"an unknown cause",    "power",     "its reset pin", "software", "its watchdog",
                                        "its window watchdog", "low power", "a stop of its kernel"};
    std::ostringstream text;
    if (health.reset_cause <= reset_halt) {
        text << words[health.reset_cause];
    } else {
        text << "cause " << +health.reset_cause;
    }
    for (size_t i = 0; i < schema.device_count && health.is_watchdog(); ++i) {
        if (schema.device_ids[i] == health.reset_device) {
            text << ": the thread of " << facts[i].name << " hung";
        }
    }
    return text.str();
}

/// A line for each device behind one or two of the board, without the last line feed.
inline std::string health_text(const Schema &schema, const char *board, const DeviceFacts *facts,
                               const Health &health) {
    std::ostringstream text;
    text << "health of " << board << ": up " << span_text(health.uptime_ms) << ", started by "
         << reset_text(schema, facts, health) << "\n  " << health.reports_sent << " reports sent, "
         << health.reports_refused << " refused";
    if (health.load_percent != unknown_load) {
        text << "; load up to " << +health.load_percent << " %";
    }
    if (health.stack_left_bytes != unknown_stack) {
        text << "; " << health.stack_left_bytes << " bytes of stack left";
    }
    size_t width = 0;
    for (size_t i = 0; i < health.devices.size(); ++i) {
        const size_t size = std::string(facts[i].name).size();
        width = size > width && size <= 24 ? size : width;
    }
    for (size_t i = 0; i < health.devices.size(); ++i) {
        const DeviceHealth &device = health.devices[i];
        std::string name = facts[i].name;
        name.resize(name.size() > width ? name.size() : width, ' ');
        text << "\n  " << name << "  " << status_text(device.status, facts[i].is_actuator);
        if (device.age_ms != never_ms) {
            text << ", " << span_text(device.age_ms) << " ago";
        }
        const std::string causes = causes_text(device);
        text << (causes.empty() ? "" : ": ") << causes;
    }
    return text.str();
}

} // namespace sensedsl

#endif
