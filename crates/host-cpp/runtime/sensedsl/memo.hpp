// What a decoder remembers of candidates for a frame that failed, so that those that overlap with
// them do not go through the same bytes again.
//
// In: places in the stream and the bytes there. Out: checksums of windows, whether they are bools,
// and steps from identifier to identifier, several at once. It takes memory only when asked.
#ifndef SENSEDSL_MEMO_HPP
#define SENSEDSL_MEMO_HPP

#include <stddef.h>
#include <stdint.h>

#include <vector>

#include "sensedsl/wire.hpp"

namespace sensedsl {

/// What is known of every window of the stream once it has been gone through: its checksum, and
/// whether all of it are bools.
///
/// Candidates for a frame overlap where one stands in the payload of another. Each would go through
/// the same bytes again; with sums over everything since one place, a window costs the same whatever
/// its length. It needs memory for one frame, and only after a candidate has failed.
class Memo {
public:
    Memo(const Crc &crc, size_t frame_bytes_max)
        : crc_(crc), frame_bytes_max_(frame_bytes_max), mask_(0), sums_(), powers_(), frontier_(0) {}

    /// The CRC of the bytes [from, to) of a candidate that stands at `place` in the stream. Asked
    /// with places that never go back, each byte is gone through once.
    uint32_t crc(uint64_t place, const uint8_t *frame, size_t from, size_t to) {
        extend(place, frame, to);
        // A CRC is linear: its start and what stood before the window shift through it.
        const uint32_t before = at(place + from).crc ^ crc_.start;
        return at(place + to).crc ^ crc_.product(before, powers_[to - from]) ^ crc_.end;
    }

    bool all_bools(uint64_t place, const uint8_t *frame, size_t from, size_t to) {
        extend(place, frame, to);
        return at(place + to).bools >= to - from;
    }

private:
    struct Sums {
        Sums() : crc(0), bools(0) {}
        /// The CRC's register of the bytes before this place, from a start of 0.
        uint32_t crc;
        /// How many bytes before this place are 0 or 1 without a gap.
        size_t bools;
    };

    /// A ring, so that nothing moves when the stream goes on; longer than a frame.
    Sums &at(uint64_t place) { return sums_[static_cast<size_t>(place) & mask_]; }

    void reserve() {
        size_t size = 1;
        while (size <= frame_bytes_max_) {
            size *= 2;
        }
        mask_ = size - 1;
        sums_.resize(size);
        uint32_t power = crc_.one;
        for (size_t i = 0; i <= frame_bytes_max_; ++i) {
            powers_.push_back(power);
            power = crc_.step(power, 0);
        }
    }

    void extend(uint64_t place, const uint8_t *frame, size_t to) {
        if (sums_.empty()) {
            reserve();
        }
        if (frontier_ < place) {
            frontier_ = place;
            at(place) = Sums();
        }
        Sums sums = at(frontier_);
        for (size_t i = static_cast<size_t>(frontier_ - place); i < to; ++i) {
            sums.crc = crc_.step(sums.crc, frame[i]);
            sums.bools = frame[i] <= 1 ? sums.bools + 1 : 0;
            at(++frontier_) = sums;
        }
    }

    Crc crc_;
    size_t frame_bytes_max_;
    size_t mask_;
    std::vector<Sums> sums_;
    /// By a number of bytes: what that many zero bytes multiply a register by.
    std::vector<uint32_t> powers_;
    /// Place behind the last byte that is in the sums.
    uint64_t frontier_;
};

/// A set of identifiers.
struct Ids {
    Ids() { clear(); }
    void clear() { words[0] = words[1] = words[2] = words[3] = 0; }
    bool has(uint8_t id) const { return ((words[id / 64] >> (id % 64)) & 1U) != 0; }
    void add(uint8_t id) { words[id / 64] |= uint64_t(1) << (id % 64); }
    /// False when one of them is there already.
    bool add_all(const Ids &more) {
        uint64_t twice = 0;
        for (int i = 0; i < 4; ++i) {
            twice |= words[i] & more.words[i];
            words[i] |= more.words[i];
        }
        return twice == 0;
    }
    uint64_t words[4];
};

/// Several steps from identifier to identifier taken as one.
struct Leap {
    explicit Leap(uint64_t from = 0) : ids(), place(from), stands(0), bytes(0), steps(0) {}
    /// One step more. True when that is as far as a leap goes.
    bool add(uint8_t id, size_t step_bytes) {
        ids.add(id);
        stands |= bytes < 64 ? uint64_t(1) << bytes : 0;
        bytes += static_cast<uint32_t>(step_bytes);
        // A candidate makes fewer steps than these before it meets a leap, and fewer behind the
        // last one; in between it leaps, in 254 steps as often as this is contained in them.
        return ++steps == 16;
    }
    /// Whether it is known that an item reaches past `count` bytes, fewer than it has.
    bool misses(size_t count) const { return count < 64 && ((stands >> count) & 1U) == 0; }
    Ids ids;
    /// Of the identifier it starts at.
    uint64_t place;
    /// Bit k: an identifier of it stands k bytes behind its place.
    uint64_t stands;
    uint32_t bytes;
    uint32_t steps;
};

/// Leaps by the place in the stream they start at.
///
/// From where two candidates come upon the same identifier they go the same way: which bytes are
/// identifiers, whether they are known and whether values are bools depends on nothing but the
/// place. Only what a candidate has seen before differs, so a leap keeps the identifiers that it
/// passes over.
class Leaps {
public:
    explicit Leaps(size_t frame_bytes_max)
        : frame_bytes_max_(frame_bytes_max), index_(), leaps_(), put_(0) {}

    /// NULL for none.
    const Leap *at(uint64_t place) const {
        if (index_.empty()) {
            return NULL;
        }
        const Leap &leap = leaps_[index_[static_cast<size_t>(place) & (index_.size() - 1)]];
        return leap.place == place && leap.steps > 0 ? &leap : NULL;
    }

    void put(const Leap &leap) {
        if (index_.empty()) {
            size_t size = 8;
            while (size <= frame_bytes_max_) {
                size *= 2;
            }
            index_.resize(size);
            leaps_.resize(size / 8);
        }
        // Where the end of a candidate has cut this one short there is a longer one.
        if (at(leap.place) == NULL) {
            put_ = (put_ + 1) & (leaps_.size() - 1);
            leaps_[put_] = leap;
            index_[static_cast<size_t>(leap.place) & (index_.size() - 1)] = static_cast<uint16_t>(put_);
        }
    }

private:
    size_t frame_bytes_max_;
    /// By place, a ring longer than a frame: where in the next list its leap is, if it is.
    std::vector<uint16_t> index_;
    /// The latest ones, a ring as well: side by side, as candidates go through them.
    std::vector<Leap> leaps_;
    size_t put_;
};

} // namespace sensedsl

#endif
