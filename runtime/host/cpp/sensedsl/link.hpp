// The link between a board and its host: bytes to values, values to bytes.
//
// In: the bytes of the stream, cut anywhere, and the tables of one board. Out: each value of each
// whole frame, and frames to send. It needs C++98 and nothing else, so that every C++ host runs
// this one decoder.
//
// A frame is a Netstring `LEN ":" payload ","`; the payload is a run of items, each one identifier
// byte and its value in network byte order. Bytes that cannot become a valid frame lose their first
// byte only, and the rest is looked at again: a torn frame costs itself, never the whole frame
// behind it.
#ifndef SENSEDSL_LINK_HPP
#define SENSEDSL_LINK_HPP

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <vector>

namespace sensedsl {

/// Bytes of a frame or a stream.
typedef std::vector<uint8_t> Bytes;

/// Identifier of the link's hello; a device never has it.
const uint8_t id_hello = 0;
/// Identifier of the optional trailing checksum; a device never has it.
const uint8_t id_checksum = 255;

/// What travels under one identifier.
struct Item {
    uint8_t id;
    uint8_t scalar_bytes;
    bool is_bool;
    uint16_t count;

    size_t size_bytes() const { return static_cast<size_t>(scalar_bytes) * count; }
};

/// All items that travel in one direction, in the order of the file.
struct Direction {
    const Item *items;
    size_t item_count;
    size_t payload_bytes_max;
    /// Bytes of this direction's hello: 5 with the schema hash, 1 as the host's request.
    size_t hello_bytes;
};

/// One board's link.
struct Schema {
    uint32_t hash;
    bool has_checksum;
    Direction sensors;
    Direction actuators;
};

/// CRC-16/CCITT-FALSE: polynomial 0x1021, start 0xFFFF, not reflected, no final inversion.
inline uint16_t crc16_ccitt_false(const uint8_t *bytes, size_t count) {
    unsigned crc = 0xFFFFU;
    for (size_t i = 0; i < count; ++i) {
        crc ^= static_cast<unsigned>(bytes[i]) << 8;
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc & 0x8000U) != 0 ? ((crc << 1) ^ 0x1021U) & 0xFFFFU : (crc << 1);
        }
    }
    return static_cast<uint16_t>(crc);
}

/// The unsigned integer of as many bytes as the scalar it stands for.
template <size_t size> struct Bits;
template <> struct Bits<1> { typedef uint8_t type; };
template <> struct Bits<2> { typedef uint16_t type; };
template <> struct Bits<4> { typedef uint32_t type; };
template <> struct Bits<8> { typedef uint64_t type; };

/// Reads one scalar in network byte order.
template <typename T> inline T load(const uint8_t *bytes) {
    typedef typename Bits<sizeof(T)>::type Unsigned;
    uint64_t bits = 0;
    for (size_t i = 0; i < sizeof(T); ++i) {
        bits = (bits << 8) | bytes[i];
    }
    const Unsigned narrow = static_cast<Unsigned>(bits);
    T value;
    memcpy(&value, &narrow, sizeof value);
    return value;
}
template <> inline bool load<bool>(const uint8_t *bytes) { return bytes[0] != 0; }

/// Reads `count` scalars, one behind the other.
template <typename T> inline void load_all(const uint8_t *bytes, T *scalars, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        scalars[i] = load<T>(bytes + i * sizeof(T));
    }
}

/// Appends one scalar in network byte order.
template <typename T> inline void store(Bytes &bytes, T value) {
    typename Bits<sizeof(T)>::type narrow;
    memcpy(&narrow, &value, sizeof value);
    const uint64_t bits = narrow;
    for (size_t i = sizeof(T); i-- > 0;) {
        bytes.push_back(static_cast<uint8_t>((bits >> (8 * i)) & 0xFFU));
    }
}
template <> inline void store<bool>(Bytes &bytes, bool value) {
    bytes.push_back(value ? uint8_t(1) : uint8_t(0));
}

/// Takes what a decoder finds, in the order of the stream.
class Sink {
public:
    virtual ~Sink() {}
    /// The board's schema hash.
    virtual void on_hello(uint32_t hash) { (void)hash; }
    /// The host's wish for a hello; only a board's decoder meets it.
    virtual void on_hello_request() {}
    /// One value; `bytes` are as many as the item says and valid during the call.
    virtual void on_value(uint8_t id, const uint8_t *bytes) = 0;
    /// All values of the frame have been handed over.
    virtual void on_frame_end() {}
};

/// Decoder of one direction of one link. Its sink must not feed it.
class Decoder {
public:
    Decoder(const Schema &schema, const Direction &direction, Sink &sink)
        : direction_(&direction), sink_(&sink), checksum_bytes_(schema.has_checksum ? 3 : 0),
          buffer_(), scan_(), frames_(0), dropped_bytes_(0) {}

    /// Takes the next bytes of the stream, however it is cut.
    void feed(const uint8_t *bytes, size_t count) {
        for (size_t i = 0; i < count; ++i) {
            buffer_.push_back(bytes[i]);
            Prefix prefix = look_at(bytes[i]);
            while (prefix != incomplete) {
                if (prefix == complete) {
                    deliver();
                } else {
                    buffer_.erase(buffer_.begin());
                    ++dropped_bytes_;
                }
                prefix = look_again();
            }
        }
    }

    /// Frames delivered so far.
    uint64_t frames() const { return frames_; }
    /// Bytes so far that belonged to no delivered frame.
    uint64_t dropped_bytes() const { return dropped_bytes_; }

private:
    /// What the bytes looked at can be.
    enum Prefix { invalid, incomplete, complete };

    /// How far the frame at the front of the buffer has been looked at.
    struct Scan {
        Scan() : bytes(0), payload_start(0), payload_bytes(0), value_end(0), is_bool(false) {
            memset(seen, 0, sizeof seen);
        }
        size_t bytes;
        /// 0 as long as the length is being read.
        size_t payload_start;
        size_t payload_bytes;
        /// Offset in the payload at which the next identifier stands.
        size_t value_end;
        bool is_bool;
        bool seen[256];
    };

    /// From the front of the buffer; stops at the end of a whole frame.
    Prefix look_again() {
        scan_ = Scan();
        Prefix prefix = incomplete;
        for (size_t i = 0; i < buffer_.size() && prefix == incomplete; ++i) {
            prefix = look_at(buffer_[i]);
        }
        return prefix;
    }

    Prefix look_at(uint8_t byte) {
        const size_t at = scan_.bytes++;
        if (scan_.payload_start == 0) {
            return look_at_length(at, byte);
        }
        const size_t offset = at - scan_.payload_start;
        const size_t values_bytes = scan_.payload_bytes - checksum_bytes_;
        if (offset == scan_.payload_bytes) {
            return byte == ',' ? complete : invalid;
        }
        if (offset < values_bytes) {
            return look_at_value(offset, values_bytes, byte);
        }
        if (offset == values_bytes) {
            return byte == id_checksum ? incomplete : invalid;
        }
        if (offset + 1 == scan_.payload_bytes) {
            const uint8_t *payload = &buffer_[scan_.payload_start];
            const uint16_t crc = crc16_ccitt_false(payload, values_bytes);
            return load<uint16_t>(payload + values_bytes + 1) == crc ? incomplete : invalid;
        }
        return incomplete;
    }

    Prefix look_at_length(size_t at, uint8_t byte) {
        if (byte == ':') {
            scan_.payload_start = at + 1;
            return scan_.payload_bytes > checksum_bytes_ ? incomplete : invalid;
        }
        if (byte < '0' || byte > '9' || (at == 0 && byte == '0')) {
            return invalid;
        }
        scan_.payload_bytes = scan_.payload_bytes * 10 + static_cast<size_t>(byte - '0');
        return scan_.payload_bytes <= direction_->payload_bytes_max ? incomplete : invalid;
    }

    Prefix look_at_value(size_t offset, size_t values_bytes, uint8_t byte) {
        if (offset != scan_.value_end) {
            return scan_.is_bool && byte > 1 ? invalid : incomplete;
        }
        if (offset == 0 && byte == id_hello) {
            scan_.value_end = values_bytes;
            return values_bytes == direction_->hello_bytes ? incomplete : invalid;
        }
        const Item *item = find(byte);
        if (item == NULL || scan_.seen[byte] || offset + 1 + item->size_bytes() > values_bytes) {
            return invalid;
        }
        scan_.seen[byte] = true;
        scan_.is_bool = item->is_bool;
        scan_.value_end = offset + 1 + item->size_bytes();
        return incomplete;
    }

    void deliver() {
        const Bytes frame(buffer_.begin(), position(scan_.bytes));
        buffer_.erase(buffer_.begin(), position(scan_.bytes));
        ++frames_;
        const uint8_t *payload = &frame[scan_.payload_start];
        const size_t values_bytes = scan_.payload_bytes - checksum_bytes_;
        if (payload[0] != id_hello) {
            for (size_t at = 0; at < values_bytes;) {
                const Item *item = find(payload[at]);
                sink_->on_value(item->id, payload + at + 1);
                at += 1 + item->size_bytes();
            }
            sink_->on_frame_end();
        } else if (values_bytes == 1) {
            sink_->on_hello_request();
        } else {
            sink_->on_hello(load<uint32_t>(payload + 1));
        }
    }

    Bytes::iterator position(size_t at) {
        return buffer_.begin() + static_cast<Bytes::difference_type>(at);
    }

    const Item *find(uint8_t id) const {
        for (size_t i = 0; i < direction_->item_count; ++i) {
            if (direction_->items[i].id == id) {
                return &direction_->items[i];
            }
        }
        return NULL;
    }

    const Direction *direction_;
    Sink *sink_;
    size_t checksum_bytes_;
    /// From the first possible frame start on; never more than one frame.
    Bytes buffer_;
    Scan scan_;
    uint64_t frames_;
    uint64_t dropped_bytes_;
};

/// Netstring of a payload, with the checksum behind it where the link has one.
inline Bytes frame_of(const Schema &schema, Bytes payload) {
    if (schema.has_checksum) {
        const uint16_t crc = crc16_ccitt_false(&payload[0], payload.size());
        payload.push_back(id_checksum);
        store<uint16_t>(payload, crc);
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
    Bytes frame() const {
        Bytes payload;
        for (size_t i = 0; i < values_.size(); ++i) {
            if (!values_[i].empty()) {
                payload.push_back(direction_->items[i].id);
                payload.insert(payload.end(), values_[i].begin(), values_[i].end());
            }
        }
        return payload.empty() ? payload : frame_of(*schema_, payload);
    }

private:
    const Schema *schema_;
    const Direction *direction_;
    std::vector<Bytes> values_;
};

} // namespace sensedsl

#endif
