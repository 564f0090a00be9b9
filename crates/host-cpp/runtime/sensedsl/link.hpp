// The link between a board and its host: bytes to values (`decode.hpp`), values to bytes (here).
//
// In: the values to send and the tables of one board. Out: frames.
#ifndef SENSEDSL_LINK_HPP
#define SENSEDSL_LINK_HPP

#include <stddef.h>
#include <stdint.h>

#include <vector>

#include "sensedsl/decode.hpp"
#include "sensedsl/wire.hpp"

namespace sensedsl {

/// Netstring of a payload, with the checksum behind it where the link has one.
inline Bytes frame_of(const Schema &schema, Bytes payload) {
    const Crc crc(schema.checksum);
    if (crc.bytes != 0) {
        const uint32_t number = crc.of(&payload[0], payload.size());
        payload.push_back(id_checksum);
        for (size_t i = crc.bytes; i-- > 0;) {
            payload.push_back(static_cast<uint8_t>((number >> (8 * i)) & 0xFFU));
        }
    }
    Bytes frame;
    for (size_t rest = payload.size(); rest != 0; rest /= 10) {
        frame.insert(frame.begin(), static_cast<uint8_t>('0' + rest % 10));
    }
    frame.push_back(':');
    frame.insert(frame.end(), payload.begin(), payload.end());
    frame.push_back(',');
    return frame;
}

/// The frame by which a host asks the board for its hello.
inline Bytes hello_request(const Schema &schema) { return frame_of(schema, Bytes(1, id_hello)); }

/// The frame by which a host asks the board for its health.
inline Bytes health_request(const Schema &schema) {
    Bytes payload(1, id_hello);
    payload.push_back(ask_health);
    return frame_of(schema, payload);
}

/// The frame by which a board tells its health.
inline Bytes health_frame(const Schema &schema, const Health &health) {
    return frame_of(schema, health_payload(health));
}

/// The frame by which a board tells its schema hash.
inline Bytes hello(const Schema &schema) {
    Bytes payload(1, id_hello);
    store<uint32_t>(payload, schema.hash);
    return frame_of(schema, payload);
}

/// Values on their way into one frame: each item at most once, sent in the order of the file.
class Report {
public:
    Report(const Schema &schema, const Direction &direction)
        : schema_(&schema), direction_(&direction), values_(direction.item_count) {}

    /// Sets an item from `count` scalars; a later value replaces an earlier one. False, and
    /// nothing set, when there is no such item of that size.
    template <typename T> bool set(uint8_t id, const T *scalars, size_t count) {
        for (size_t i = 0; i < direction_->item_count; ++i) {
            const Item &item = direction_->items[i];
            if (item.id == id && item.count == count && item.scalar_bytes == sizeof(T)) {
                values_[i].clear();
                for (size_t element = 0; element < count; ++element) {
                    store<T>(values_[i], scalars[element]);
                }
                return true;
            }
        }
        return false;
    }

    bool empty() const {
        for (size_t i = 0; i < values_.size(); ++i) {
            if (!values_[i].empty()) {
                return false;
            }
        }
        return true;
    }

    /// The frame of all values set; empty when none is.
    Bytes frame() const { return frame_behind(Bytes()); }

    /// The same from a board whose reports have stamps.
    Bytes frame(const Stamp &stamp) const {
        Bytes payload(1, id_hello);
        store<uint32_t>(payload, stamp.time_us);
        payload.push_back(stamp.counter);
        return frame_behind(payload);
    }

private:
    Bytes frame_behind(Bytes payload) const {
        const size_t head_bytes = payload.size();
        for (size_t i = 0; i < values_.size(); ++i) {
            if (!values_[i].empty()) {
                payload.push_back(direction_->items[i].id);
                payload.insert(payload.end(), values_[i].begin(), values_[i].end());
            }
        }
        return payload.size() == head_bytes ? Bytes() : frame_of(*schema_, payload);
    }

    const Schema *schema_;
    const Direction *direction_;
    std::vector<Bytes> values_;
};

} // namespace sensedsl

#endif
