// The decoder of the C++ hosts.
#include "decoders.h"

#include "sensedsl/link.hpp"

namespace {

const uint8_t type_bytes[] = {1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

class Log : public sensedsl::Sink {
public:
    Log(decoders_out_t out, void *context) : out_(out), context_(context), report_(5), sizes_(256) {}

    void knows(const sensedsl::Item &item) { sizes_[item.id] = item.size_bytes(); }

    void say(char word, uint32_t number, bool has_number) {
        sensedsl::Bytes said(1, static_cast<uint8_t>(word));
        if (has_number) {
            sensedsl::store<uint32_t>(said, number);
        }
        put(said);
    }

    void put(const sensedsl::Bytes &said) {
        if (out_ != NULL) {
            out_(context_, &said[0], said.size());
        }
    }

private:
    Log(const Log &);
    Log &operator=(const Log &);

    virtual void on_hello(uint32_t hash) { say('H', hash, true); }
    virtual void on_hello_request() { say('Q', 0, false); }
    virtual void on_health_request() { say('A', 0, false); }
    virtual void on_health(const sensedsl::Health &health) { whole('D', sensedsl::health_payload(health)); }
    virtual void on_other_health(uint8_t version) {
        sensedsl::Bytes said(1, static_cast<uint8_t>('V'));
        said.push_back(version);
        put(said);
    }
    virtual void on_stamp(const sensedsl::Stamp &stamp) {
        if (out_ != NULL) {
            report_.push_back(0);
            sensedsl::store<uint32_t>(report_, stamp.time_us);
            report_.push_back(stamp.counter);
        }
    }
    virtual void on_value(uint8_t id, const uint8_t *bytes) {
        if (out_ == NULL) {
            report_[0] = static_cast<uint8_t>(report_[0] ^ bytes[0]);
            return;
        }
        report_.push_back(id);
        report_.insert(report_.end(), bytes, bytes + sizes_[id]);
    }
    virtual void on_frame_end() {
        if (out_ == NULL) {
            return;
        }
        whole('R', sensedsl::Bytes(report_.begin() + 5, report_.end()));
        report_.resize(5);
    }
    void whole(char word, const sensedsl::Bytes &payload) {
        sensedsl::Bytes said(1, static_cast<uint8_t>(word));
        sensedsl::store<uint32_t>(said, static_cast<uint32_t>(payload.size()));
        said.insert(said.end(), payload.begin(), payload.end());
        put(said);
    }

    decoders_out_t out_;
    void *context_;
    sensedsl::Bytes report_;
    std::vector<size_t> sizes_;
};

} // namespace

extern "C" void decoders_cpp(const decoders_input_t *input, decoders_out_t out, void *context) {
    const bool to_board = (input->schema[0] & 2U) != 0;
    std::vector<sensedsl::Item> items;
    sensedsl::Bytes ids;
    Log log(out, context);
    size_t values_bytes = 0;
    for (size_t at = 1; at + 5 <= input->schema_bytes; at += 5) {
        const uint8_t *bytes = input->schema + at;
        const sensedsl::Item item = {bytes[0], type_bytes[bytes[1]], bytes[1] == 0,
                                     sensedsl::load<uint16_t>(bytes + 3)};
        ids.push_back(item.id);
        if ((bytes[2] != 0) == to_board) {
            items.push_back(item);
            log.knows(item);
            values_bytes += 1 + item.size_bytes();
        }
    }
    const sensedsl::Checksum checksum = (input->schema[0] & 1U) != 0   ? sensedsl::checksum_crc16
                                        : (input->schema[0] & 8U) != 0 ? sensedsl::checksum_crc32
                                                                       : sensedsl::checksum_none;
    const bool has_stamp = (input->schema[0] & 4U) != 0;
    values_bytes += has_stamp && !to_board && values_bytes > 0 ? sensedsl::stamp_bytes : 0;
    const size_t asked_bytes = to_board ? 2 : 5;
    const size_t short_bytes = values_bytes > asked_bytes ? values_bytes : asked_bytes;
    const size_t health_bytes = to_board ? 0 : 19 + 17 * ids.size();
    const sensedsl::Direction direction = {
        items.empty() ? NULL : &items[0], items.size(),
        (short_bytes > health_bytes ? short_bytes : health_bytes) + sensedsl::Crc(checksum).size_bytes(), short_bytes,
        static_cast<size_t>(to_board ? 1 : 5)};
    const sensedsl::Schema schema = {0,         checksum, has_stamp, direction, direction, ids.empty() ? NULL : &ids[0],
                                     ids.size()};
    sensedsl::Decoder decoder(schema, direction, log);
    size_t piece = 0;
    for (size_t at = 0; at < input->stream_bytes; ++piece) {
        size_t size = input->pieces_count == 0 ? 0 : input->pieces[piece % input->pieces_count];
        if (size == 0 || size > input->stream_bytes - at) {
            size = input->stream_bytes - at;
        }
        decoder.feed(input->stream + at, size);
        at += size;
    }
    sensedsl::Bytes end(1, static_cast<uint8_t>('E'));
    sensedsl::store<uint32_t>(end, static_cast<uint32_t>(decoder.frames()));
    sensedsl::store<uint32_t>(end, static_cast<uint32_t>(decoder.dropped_bytes()));
    log.put(end);
}
