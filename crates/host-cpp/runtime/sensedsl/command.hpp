// What a message asks of an actuator, as codes of the wire.
//
// In: the fields of a message: the values that are shown, or codes where it says so. Out: codes, or what is wrong
// with them, for people. C++98.
#ifndef SENSEDSL_COMMAND_HPP
#define SENSEDSL_COMMAND_HPP

#include <stddef.h>

#include <string>

#include "sensedsl/scaling.hpp"
#include "sensedsl/text.hpp"

namespace sensedsl {

/// Makes codes of the `count` values that are to be shown as `shown`, unless `raw` has the codes already (`is_raw`).
/// Gives what is wrong with them; empty when nothing is. Codes without `is_raw` are refused: a message cannot tell a
/// value of 0 from one that nobody has set.
template <typename T>
inline std::string take_command(const Scaling &scaling, const Limits &limits, const std::string &quantity,
                                bool is_raw, const double *shown, T *raw, size_t count) {
    if (is_raw) {
        return outside_of(limits, raw, count, scaling, quantity);
    }
    for (size_t i = 0; i < count; ++i) {
        const double code = static_cast<double>(raw[i]);
        if (code < 0.0 || code > 0.0) {
            return " `raw` is set and `is_raw` is not: set both, or `value` alone";
        }
    }
    for (size_t i = 0; i < count; ++i) {
        const std::string refused = outside(limits, shown[i], quantity);
        if (!refused.empty()) {
            return " " + shown_text(shown[i]) + quantity + refused;
        }
        if (!take_code(scaling.raw_of(shown[i]), raw[i])) {
            return " " + shown_text(shown[i]) + quantity + " is out of reach of the value";
        }
    }
    return std::string();
}

} // namespace sensedsl

#endif
