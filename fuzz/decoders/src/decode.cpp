// The decoder of the C++ hosts (`crates/codegen/src/host/cpp/runtime`), as the fuzzer calls it.
#include "decode.h"

#include <stdlib.h>

#include "sensedsl/link.hpp"

namespace {

const size_t scalar_bytes[] = {1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

void put(sense_decoded_t &decoded, const void *bytes, size_t size) {
    if (size > decoded.log_bytes_max - decoded.log_size) {
        abort();
    }
    memcpy(decoded.log + decoded.log_size, bytes, size);
    decoded.log_size += size;
}

sensedsl::Checksum checksum_of(const sense_stream_t &stream) {
    return stream.checksum == 0   ? sensedsl::checksum_none
           : stream.checksum == 2 ? sensedsl::checksum_crc16
                                  : sensedsl::checksum_crc32;
}

class Log : public sensedsl::Sink {
public:
    Log(const sense_stream_t &stream, sense_decoded_t &decoded)
        : stream_(&stream), decoded_(&decoded), is_open_(false) {}

    virtual void on_hello(uint32_t hash) {
        const uint8_t bytes[] = {'H', static_cast<uint8_t>(hash >> 24), static_cast<uint8_t>(hash >> 16),
                                 static_cast<uint8_t>(hash >> 8), static_cast<uint8_t>(hash)};
        put(*decoded_, bytes, sizeof bytes);
    }

    virtual void on_hello_request() { put(*decoded_, "Q", 1); }
    virtual void on_health_request() { put(*decoded_, "A", 1); }

    virtual void on_health(const sensedsl::Health &health) {
        const sensedsl::Bytes payload = sensedsl::health_payload(health);
        put(*decoded_, "D", 1);
        put(*decoded_, &payload[0], payload.size());
    }

    virtual void on_other_health(uint8_t version) {
        put(*decoded_, "V", 1);
        put(*decoded_, &version, 1);
    }

    virtual void on_stamp(const sensedsl::Stamp &stamp) {
        sensedsl::Bytes bytes(1, static_cast<uint8_t>('S'));
        sensedsl::store<uint32_t>(bytes, stamp.time_us);
        bytes.push_back(stamp.counter);
        put(*decoded_, &bytes[0], bytes.size());
    }

    virtual void on_value(uint8_t id, const uint8_t *bytes) {
        if (!is_open_) {
            put(*decoded_, "R", 1);
            is_open_ = true;
        }
        put(*decoded_, &id, 1);
        for (size_t i = 0; i < stream_->items_count; ++i) {
            const sense_item_t &item = stream_->items[i];
            if (item.id == id) {
                put(*decoded_, bytes, scalar_bytes[item.type] * item.count);
            }
        }
    }

    virtual void on_frame_end() {
        put(*decoded_, ".", 1);
        is_open_ = false;
    }

private:
    const sense_stream_t *stream_;
    sense_decoded_t *decoded_;
    bool is_open_;
};

/// The items of one direction.
struct Side {
    Side(const sense_stream_t &stream, bool to_board) : items() {
        size_t bytes = 0;
        for (size_t i = 0; i < stream.items_count; ++i) {
            const sense_item_t &given = stream.items[i];
            if ((given.to_board != 0) == to_board) {
                sensedsl::Item item;
                item.id = given.id;
                item.scalar_bytes = static_cast<uint8_t>(scalar_bytes[given.type]);
                item.is_bool = given.type == 0;
                item.count = given.count;
                items.push_back(item);
                bytes += 1 + item.size_bytes();
            }
        }
        const size_t asked_bytes = to_board ? 2 : 5;
        const size_t health_bytes = to_board ? 0 : 19 + 17 * stream.items_count;
        bytes += stream.stamp != 0 && !to_board && bytes > 0 ? sensedsl::stamp_bytes : 0;
        direction.items = items.empty() ? NULL : &items[0];
        direction.item_count = items.size();
        direction.hello_bytes = to_board ? 1 : 5;
        direction.short_bytes_max = bytes > asked_bytes ? bytes : asked_bytes;
        direction.payload_bytes_max =
            (direction.short_bytes_max > health_bytes ? direction.short_bytes_max : health_bytes) +
            sensedsl::Crc(checksum_of(stream)).size_bytes();
    }

    std::vector<sensedsl::Item> items;
    sensedsl::Direction direction;
};

} // namespace

extern "C" void sense_decode_cpp(const sense_stream_t *stream, sense_decoded_t *decoded) {
    const Side sensors(*stream, false);
    const Side actuators(*stream, true);
    sensedsl::Bytes ids;
    for (size_t i = 0; i < stream->items_count; ++i) {
        ids.push_back(stream->items[i].id);
    }
    const sensedsl::Schema schema = {0,
                                     checksum_of(*stream),
                                     stream->stamp != 0,
                                     sensors.direction,
                                     actuators.direction,
                                     ids.empty() ? NULL : &ids[0],
                                     ids.size()};
    Log log(*stream, *decoded);
    sensedsl::Decoder decoder(schema, stream->to_board != 0 ? schema.actuators : schema.sensors, log);
    size_t from = 0;
    for (size_t i = 0; i <= stream->cuts_count; ++i) {
        const size_t to = i < stream->cuts_count ? stream->cuts[i] : stream->size;
        decoder.feed(stream->bytes + from, to - from);
        from = to;
    }
    decoded->frames = decoder.frames();
    decoded->dropped_bytes = decoder.dropped_bytes();
}
