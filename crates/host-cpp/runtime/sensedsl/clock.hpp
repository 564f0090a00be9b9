// A board's clock and its reports by their stamps: when a report was put together, how late it came,
// and how many before it were lost.
//
// In: stamps, and when they came. Out: moments. No clock in here; C++98.
#ifndef SENSEDSL_CLOCK_HPP
#define SENSEDSL_CLOCK_HPP

#include <stdint.h>

#include "sensedsl/wire.hpp"

namespace sensedsl {

/// What a stamp says.
struct Moment {
    /// Microseconds since the board started; does not wrap.
    uint64_t board_us;
    /// How much longer this report took than the quickest one: a sample was taken so long before now.
    int64_t late_us;
    /// Reports that were lost just before this one.
    unsigned lost;
};

/// Follows the stamps of one board.
class BoardClock {
public:
    BoardClock() : last_(), came_us_(0), least_us_(0), moment_(), lost_(0), is_running_(false) {}

    /// The next stamp. `now_us` is of a clock that only goes forward; negative where there is none, as
    /// in a recording.
    const Moment &take(const Stamp &stamp, int64_t now_us) {
        const uint32_t passed = stamp.time_us - last_.time_us;
        const int64_t waited_us = now_us < 0 ? static_cast<int64_t>(passed) : now_us - came_us_;
        // By how much the board's clock went further than ours.
        const int32_t ahead_us = static_cast<int32_t>(passed - static_cast<uint32_t>(waited_us));
        // Back, or on by more than 35 minutes.
        const bool is_back = (passed & 0x80000000U) != 0;
        const bool is_long = now_us >= 0 && waited_us > 0x7FFFFFFF && ahead_us > -tolerance_us;
        if (!is_running_ || ahead_us > tolerance_us || (is_back && !is_long)) {
            // The first one, or the board was started anew.
            moment_.board_us = stamp.time_us;
            moment_.lost = 0;
            least_us_ = now_us - static_cast<int64_t>(moment_.board_us);
            is_running_ = true;
        } else {
            moment_.board_us += static_cast<uint64_t>(waited_us + ahead_us);
            moment_.lost = static_cast<uint8_t>(stamp.counter - last_.counter - 1);
            lost_ += moment_.lost;
            // Crystals differ by up to 100 us a second.
            least_us_ += waited_us / 10000;
        }
        const int64_t offset_us = now_us - static_cast<int64_t>(moment_.board_us);
        least_us_ = offset_us < least_us_ ? offset_us : least_us_;
        moment_.late_us = now_us < 0 ? 0 : offset_us - least_us_;
        last_ = stamp;
        came_us_ = now_us;
        return moment_;
    }

    /// The next stamp is of another session: nothing is known of what was between.
    void restart() { is_running_ = false; }
    /// That of the latest report.
    const Moment &moment() const { return moment_; }
    /// Reports that were lost so far.
    uint64_t lost() const { return lost_; }

private:
    static const int32_t tolerance_us = 2000000;

    Stamp last_;
    int64_t came_us_;
    /// The least that our clock was ahead of the board's.
    int64_t least_us_;
    Moment moment_;
    uint64_t lost_;
    bool is_running_;
};

} // namespace sensedsl

#endif
