// Bytes to values: any split of the stream, any garbage between frames.
//
// In: the bytes of the stream, cut anywhere, and the tables of one board. Out: each value of each
// whole frame. It needs C++98 and nothing else, so that every C++ host runs this one decoder.
//
// A frame is a Netstring `LEN ":" payload ","`; the payload is a run of items, each one identifier
// byte and its value in network byte order.
#ifndef SENSEDSL_DECODE_HPP
#define SENSEDSL_DECODE_HPP

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <vector>

#include "sensedsl/health.hpp"
#include "sensedsl/memo.hpp"
#include "sensedsl/wire.hpp"

namespace sensedsl {

/// Takes what a decoder finds, in the order of the stream.
class Sink {
public:
    virtual ~Sink() {}
    /// The board's schema hash.
    virtual void on_hello(uint32_t hash) { (void)hash; }
    /// The host's wish for a hello; only a board's decoder meets it.
    virtual void on_hello_request() {}
    /// The host's wish for health; only a board's decoder meets it.
    virtual void on_health_request() {}
    /// How the board and its devices are.
    virtual void on_health(const Health &health) { (void)health; }
    /// Health of another version, of which nothing else is known.
    virtual void on_other_health(uint8_t version) { (void)version; }
    /// Where the link has stamps, before the values of each report.
    virtual void on_stamp(const Stamp &stamp) { (void)stamp; }
    /// One value; `bytes` are as many as the item says and valid during the call.
    virtual void on_value(uint8_t id, const uint8_t *bytes) = 0;
    /// All values of the frame have been handed over.
    virtual void on_frame_end() {}
};

/// Decoder of one direction of one link. Its sink must not feed it.
///
/// A candidate for a frame that cannot become a valid one loses its first byte only, and the rest is
/// looked at again: so the first valid frame is found wherever it starts. A frame that lies whole in
/// the bytes of one call is read there; only what a call leaves unfinished is copied.
///
/// The time is linear in the bytes, whatever they are and however long a frame may be: a candidate
/// costs at most some dozens of steps. Its comma is looked at first, values are stepped over, and no
/// identifier stands twice in a payload. Where checksums, arrays of bools or identifiers were gone
/// through for a candidate that failed, the others do not go through them again: `Memo` answers for
/// the bytes in constant time, `Leaps` for sixteen identifiers at once.
class Decoder {
public:
    Decoder(const Schema &schema, const Direction &direction, Sink &sink)
        : schema_(&schema), direction_(&direction), sink_(&sink), crc_(schema.checksum), checksum_bytes_(crc_.size_bytes()),
          is_from_board_(direction.hello_bytes > 1), is_stamped_(is_from_board_ && schema.has_stamp),
          health_bytes_(is_from_board_ ? schema.health_bytes() : 0), held_(),
          start_(0), candidate_(), place_(0), spent_(0), memo_(crc_, direction.payload_bytes_max + 22),
          walked_(0), leaps_(direction.payload_bytes_max + 22), frames_(0), dropped_bytes_(0) {
        memset(slots_, 0, sizeof slots_);
        for (size_t i = direction.item_count; i-- > 0;) {
            const Item &item = direction.items[i];
            slots_[item.id].value_bytes = static_cast<uint32_t>(item.size_bytes());
            slots_[item.id].is_bool = item.is_bool;
        }
    }

    /// Takes the next bytes of the stream, however it is cut.
    void feed(const uint8_t *bytes, size_t count) {
        size_t taken = 0;
        while (!held_.empty()) {
            const size_t missing = missing_bytes() < count - taken ? missing_bytes() : count - taken;
            if (missing == 0) {
                return;
            }
            held_.insert(held_.end(), bytes + taken, bytes + taken + missing);
            taken += missing;
            // What starts in the bytes of this call is looked for there.
            const size_t old_bytes = held_.size() > taken ? held_.size() - taken : 0;
            run(&held_[0], held_.size(), start_, old_bytes);
            if (start_ >= old_bytes) {
                taken = start_ - old_bytes;
                held_.clear();
                start_ = 0;
            } else if (start_ > held_.size() / 2) {
                // Only when half of it is gone, so that a byte moves once on average.
                held_.erase(held_.begin(), held_.begin() + static_cast<Bytes::difference_type>(start_));
                start_ = 0;
            }
        }
        if (taken < count) {
            size_t at = taken;
            run(bytes, count, at, count);
            held_.insert(held_.end(), bytes + at, bytes + count);
        }
    }

    /// Frames delivered so far.
    uint64_t frames() const { return frames_; }
    /// Bytes so far that belonged to no delivered frame.
    uint64_t dropped_bytes() const { return dropped_bytes_; }

private:
    /// What the bytes at hand can be.
    enum Verdict { invalid, incomplete, complete };

    /// What travels under one identifier; 0 bytes where nothing does.
    struct Slot {
        uint32_t value_bytes;
        bool is_bool;
    };

    /// One place where a frame may start, and how far it has been looked at. All places are counted
    /// from its first byte.
    struct Candidate {
        Candidate()
            : payload_start(0), values_end(0), frame_bytes(0), at(0), looked_at(0),
              is_checksum_right(false), seen() {}
        /// Another place, of which nothing is known; the rest is set when its length has been read.
        void restart() {
            payload_start = 0;
            frame_bytes = 0;
            at = 0;
            looked_at = 0;
            is_checksum_right = false;
        }
        /// 0 as long as the length has not been read.
        size_t payload_start;
        /// Where the checksum or the comma stands.
        size_t values_end;
        size_t frame_bytes;
        /// Where the next identifier stands; 0 as long as the length has not been read.
        size_t at;
        /// Up to here values and checksum were gone through byte by byte.
        size_t looked_at;
        bool is_checksum_right;
        /// Identifiers of this payload.
        Ids seen;
    };

    /// How many bytes the held candidate lacks; while its length is read, one at a time.
    size_t missing_bytes() const {
        const size_t here = held_.size() - start_;
        return candidate_.frame_bytes > here ? candidate_.frame_bytes - here : 1;
    }

    /// Looks for frames that start at `at` or behind it and before `limit`; leaves `at` where the
    /// candidate starts that lacks bytes, or where to go on.
    void run(const uint8_t *bytes, size_t count, size_t &at, size_t limit) {
        while (at < limit) {
            const Verdict verdict = look(bytes + at, count - at);
            if (verdict == incomplete) {
                return;
            }
            if (verdict == complete) {
                // First on to the next frame: the sink may throw.
                const uint8_t *payload = bytes + at + candidate_.payload_start;
                const size_t values_bytes = candidate_.values_end - candidate_.payload_start;
                at += candidate_.frame_bytes;
                place_ += candidate_.frame_bytes;
                candidate_.restart();
                ++frames_;
                deliver(payload, values_bytes);
                continue;
            }
            if (place_ + candidate_.looked_at > spent_) {
                spent_ = place_ + candidate_.looked_at;
            }
            if (place_ + candidate_.at > walked_) {
                walked_ = place_ + candidate_.at;
            }
            candidate_.restart();
            const size_t from = at++;
            while (at < limit && (bytes[at] < '1' || bytes[at] > '9')) {
                ++at;
            }
            dropped_bytes_ += at - from;
            place_ += at - from;
        }
    }

    /// Looks at the bytes from the candidate's first on, and at none twice.
    Verdict look(const uint8_t *bytes, size_t count) {
        Verdict verdict = candidate_.payload_start == 0 ? read_length(bytes, count) : complete;
        if (verdict != complete) {
            return verdict;
        }
        // The cheapest first: most of what only looks like a frame ends wrong.
        const bool has_comma = count >= candidate_.frame_bytes;
        if (has_comma && bytes[candidate_.frame_bytes - 1] != ',') {
            return invalid;
        }
        if (checksum_bytes_ != 0 && count > candidate_.values_end &&
            bytes[candidate_.values_end] != id_checksum) {
            return invalid;
        }
        // By sums the checksum costs less than a walk.
        if (has_comma && place_ < spent_ && compare_checksum(bytes, count) != complete) {
            return invalid;
        }
        verdict = walk(bytes, count);
        if (verdict == complete) {
            verdict = compare_checksum(bytes, count);
        }
        return verdict == complete && !has_comma ? incomplete : verdict;
    }

    Verdict read_length(const uint8_t *bytes, size_t count) {
        size_t payload_bytes = 0;
        for (size_t i = 0; i < count; ++i) {
            const uint8_t byte = bytes[i];
            if (byte == ':' && payload_bytes > checksum_bytes_) {
                candidate_.payload_start = i + 1;
                candidate_.at = i + 1;
                candidate_.frame_bytes = i + 1 + payload_bytes + 1;
                candidate_.values_end = i + 1 + payload_bytes - checksum_bytes_;
                candidate_.seen.clear();
                const size_t values_bytes = payload_bytes - checksum_bytes_;
                return values_bytes <= direction_->short_bytes_max || values_bytes == health_bytes_ ? complete
                                                                                                     : invalid;
            }
            if (byte < '0' || byte > '9' || (i == 0 && byte == '0')) {
                return invalid;
            }
            payload_bytes = payload_bytes * 10 + static_cast<size_t>(byte - '0');
            if (payload_bytes > direction_->payload_bytes_max) {
                return invalid;
            }
        }
        return incomplete;
    }

    /// From identifier to identifier up to the end of the values.
    Verdict walk(const uint8_t *bytes, size_t count) {
        if (candidate_.at == candidate_.payload_start) {
            const Verdict begun = begin(bytes, count);
            if (begun != complete) {
                return begun;
            }
        }
        if (place_ < walked_) {
            return leap(bytes, count);
        }
        Verdict verdict = complete;
        while (verdict == complete && candidate_.at < candidate_.values_end) {
            verdict = step(bytes, count);
        }
        return verdict;
    }

    /// What a payload is follows from its first byte, its length and the schema: steps over a stamp, and
    /// over the whole of what is no report.
    Verdict begin(const uint8_t *bytes, size_t count) {
        const size_t at = candidate_.at;
        const size_t values_bytes = candidate_.values_end - at;
        if (at >= count) {
            return incomplete;
        }
        if (bytes[at] == id_hello) {
            if (values_bytes == direction_->hello_bytes) {
                candidate_.at = candidate_.values_end;
                return complete;
            }
            if (!is_from_board_ && values_bytes == 2) {
                if (count < at + 2) {
                    return incomplete;
                }
                candidate_.at = candidate_.values_end;
                return bytes[at + 1] == ask_health ? complete : invalid;
            }
            candidate_.at += stamp_bytes;
            return is_stamped_ && values_bytes > stamp_bytes && values_bytes <= direction_->short_bytes_max
                       ? complete
                       : invalid;
        }
        if (bytes[at] == id_health) {
            candidate_.at = candidate_.values_end;
            return values_bytes == health_bytes_ ? complete : invalid;
        }
        return is_stamped_ || values_bytes > direction_->short_bytes_max ? invalid : complete;
    }

    /// The same with the leaps of others, and leaves leaps for others.
    Verdict leap(const uint8_t *bytes, size_t count) {
        Leap steps(place_ + candidate_.at);
        bool is_behind_leap = false;
        while (candidate_.at < candidate_.values_end) {
            const size_t from = candidate_.at;
            const Leap *const leap = leaps_.at(place_ + from);
            const bool fits = leap != NULL && from + leap->bytes <= candidate_.values_end;
            if (leap != NULL && !fits && leap->misses(candidate_.values_end - from)) {
                return invalid;
            }
            if (fits) {
                candidate_.at += leap->bytes;
                if (!candidate_.seen.add_all(leap->ids)) {
                    return invalid;
                }
                // Else every candidate would make these few steps between two leaps.
                if (is_behind_leap && steps.steps > 0) {
                    leaps_.put(steps);
                }
            } else {
                const Verdict verdict = step(bytes, count);
                if (verdict != complete) {
                    return verdict;
                }
                if (!steps.add(bytes[from], candidate_.at - from)) {
                    continue;
                }
                leaps_.put(steps);
            }
            steps = Leap(place_ + candidate_.at);
            is_behind_leap = true;
        }
        return complete;
    }

    /// To the next identifier.
    Verdict step(const uint8_t *bytes, size_t count) {
        const size_t at = candidate_.at;
        const size_t values_end = candidate_.values_end;
        if (at >= count) {
            return incomplete;
        }
        const uint8_t id = bytes[at];
        const Slot slot = slots_[id];
        const size_t end = at + 1 + slot.value_bytes;
        if (slot.value_bytes == 0 || candidate_.seen.has(id) || end > values_end) {
            return invalid;
        }
        if (slot.is_bool) {
            const Verdict verdict = look_at_bools(bytes, count, end);
            if (verdict != complete) {
                return verdict;
            }
        }
        candidate_.seen.add(id);
        candidate_.at = end;
        return complete;
    }

    /// The elements of the value before `end`, as many as are there.
    Verdict look_at_bools(const uint8_t *bytes, size_t count, size_t end) {
        const size_t value = candidate_.at + 1;
        const size_t from = candidate_.looked_at > value ? candidate_.looked_at : value;
        const size_t to = end < count ? end : count;
        if (from < to) {
            candidate_.looked_at = to;
            if (place_ < spent_) {
                if (!memo_.all_bools(place_, bytes, from, to)) {
                    return invalid;
                }
            } else {
                for (size_t i = from; i < to; ++i) {
                    if (bytes[i] > 1) {
                        return invalid;
                    }
                }
            }
        }
        return to == end ? complete : incomplete;
    }

    Verdict compare_checksum(const uint8_t *bytes, size_t count) {
        const size_t start = candidate_.payload_start;
        const size_t end = candidate_.values_end;
        if (checksum_bytes_ == 0 || candidate_.is_checksum_right) {
            return complete;
        }
        if (count < end + checksum_bytes_) {
            return incomplete;
        }
        const uint32_t number =
            place_ < spent_ ? memo_.crc(place_, bytes, start, end) : crc_.of(bytes + start, end - start);
        candidate_.is_checksum_right = crc_.read(bytes + end + 1) == number;
        // Values that have not been walked through may still hold what is not a bool.
        if (!candidate_.is_checksum_right || candidate_.at == end) {
            candidate_.looked_at = end;
        }
        return candidate_.is_checksum_right ? complete : invalid;
    }

    void deliver(const uint8_t *payload, size_t values_bytes) {
        if (payload[0] == id_health) {
            deliver_health(payload);
        } else if (payload[0] != id_hello || (is_from_board_ && values_bytes > direction_->hello_bytes)) {
            size_t at = 0;
            if (payload[0] == id_hello) {
                const Stamp stamp = {load<uint32_t>(payload + 1), payload[5]};
                sink_->on_stamp(stamp);
                at = stamp_bytes;
            }
            while (at < values_bytes) {
                const uint8_t id = payload[at];
                sink_->on_value(id, payload + at + 1);
                at += 1 + slots_[id].value_bytes;
            }
            sink_->on_frame_end();
        } else if (values_bytes == 1) {
            sink_->on_hello_request();
        } else if (values_bytes == 2) {
            sink_->on_health_request();
        } else {
            sink_->on_hello(load<uint32_t>(payload + 1));
        }
    }

    void deliver_health(const uint8_t *payload) {
        if (payload[1] == health_version) {
            sink_->on_health(read_health(*schema_, payload));
        } else {
            sink_->on_other_health(payload[1]);
        }
    }

    const Schema *schema_;
    const Direction *direction_;
    Sink *sink_;
    Crc crc_;
    size_t checksum_bytes_;
    bool is_from_board_;
    bool is_stamped_;
    /// 0 where there is none.
    size_t health_bytes_;
    Slot slots_[256];
    /// The first bytes of a frame whose end has not come; the candidate starts at `start_`.
    Bytes held_;
    size_t start_;
    Candidate candidate_;
    /// Where the candidate stands in the stream.
    uint64_t place_;
    /// Up to here a candidate that failed was gone through byte by byte.
    uint64_t spent_;
    Memo memo_;
    /// Up to here a candidate that failed went from identifier to identifier.
    uint64_t walked_;
    Leaps leaps_;
    uint64_t frames_;
    uint64_t dropped_bytes_;
};

} // namespace sensedsl

#endif
