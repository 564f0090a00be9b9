// Scalars as text and back, the same for each host.
//
// In: scalars of the wire's types. Out: decimal text that reads back to the same value, 8-bit
// integers as numbers and not as characters. C++98.
#ifndef SENSEDSL_TEXT_HPP
#define SENSEDSL_TEXT_HPP

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <iomanip>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>

#include "sensedsl/scaling.hpp"

namespace sensedsl {

/// Shortest decimal text, of at least `digits` significant digits, that reads back the same.
inline std::string real_text(double value, int digits, bool is_single) {
    char text[40];
    for (; digits <= 17; ++digits) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        const double back = strtod(text, NULL);
        const bool same = is_single ? !(static_cast<float>(back) < static_cast<float>(value)) &&
                                          !(static_cast<float>(back) > static_cast<float>(value))
                                    : !(back < value) && !(back > value);
        if (same) {
            break;
        }
    }
    return text;
}

/// Integers; `+` makes a number of an 8-bit one.
template <typename T> inline void print(std::ostream &out, T value) { out << +value; }
template <> inline void print<bool>(std::ostream &out, bool value) {
    out << (value ? "true" : "false");
}
template <> inline void print<float>(std::ostream &out, float value) {
    out << real_text(static_cast<double>(value), 6, true);
}
template <> inline void print<double>(std::ostream &out, double value) {
    out << real_text(value, 15, false);
}

/// One value, or `[a, b, c]`.
template <typename T> inline void print_all(std::ostream &out, const T *values, size_t count) {
    if (count == 1) {
        print(out, values[0]);
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        out << (i == 0 ? "[" : ", ");
        print(out, values[i]);
    }
    out << ']';
}

/// A shown value for people: whole numbers in full, others to nine significant digits. The raw value
/// stands beside it.
inline std::string shown_text(double value) {
    const bool is_whole = !(value < floor(value)) && !(value > floor(value));
    char text[40];
    snprintf(text, sizeof text, "%.*g", is_whole ? 15 : 9, value);
    return text;
}

/// ` (28 cm)` behind raw values: what they mean.
template <typename T>
inline void print_scaled(std::ostream &out, const T *raw, size_t count, const Scaling &scaling,
                         const std::string &quantity) {
    out << (count == 1 ? " (" : " ([");
    for (size_t i = 0; i < count; ++i) {
        out << (i == 0 ? "" : ", ") << shown_text(scaling.of(static_cast<double>(raw[i])));
    }
    out << (count == 1 ? "" : "]") << quantity << ')';
}

/// What is wrong with typed text as a `T`; empty when nothing is, and then `value` is it. Integers are
/// decimal, leading zeros included, or hexadecimal behind `0x`; nothing stands before or behind.
template <typename T> inline std::string read_typed(const std::string &text, T &value) {
    const bool has_sign = !text.empty() && (text[0] == '-' || text[0] == '+');
    const std::string number = has_sign ? text.substr(1) : text;
    const bool is_hex = number.compare(0, 2, "0x") == 0 || number.compare(0, 2, "0X") == 0;
    const std::string digits = is_hex ? number.substr(2) : number;
    const char *const allowed = is_hex ? "0123456789abcdefABCDEF" : "0123456789";
    if (digits.empty() || digits.find_first_not_of(allowed) != std::string::npos) {
        return "is not a whole number";
    }
    errno = 0;
    const uint64_t size = strtoumax(digits.c_str(), NULL, is_hex ? 16 : 10);
    const bool is_negative = has_sign && text[0] == '-' && size != 0;
    const uint64_t greatest = static_cast<uint64_t>(std::numeric_limits<T>::max());
    const uint64_t least = std::numeric_limits<T>::is_signed ? greatest + 1 : 0;
    if (errno != 0 || size > (is_negative ? least : greatest)) {
        std::ostringstream reason;
        reason << "is not in the range " << +std::numeric_limits<T>::min() << " to "
               << +std::numeric_limits<T>::max();
        return reason.str();
    }
    value = static_cast<T>(is_negative ? 0 - size : size);
    return std::string();
}
template <> inline std::string read_typed<bool>(const std::string &text, bool &value) {
    value = text == "true" || text == "1";
    return value || text == "false" || text == "0" ? "" : "is not true, false, 1 or 0";
}
template <> inline std::string read_typed<double>(const std::string &text, double &value) {
    if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string::npos) {
        return "is not a finite number such as -2.5 or 1e3";
    }
    char *end = NULL;
    value = strtod(text.c_str(), &end);
    if (*end != '\0') {
        return "is not a finite number such as -2.5 or 1e3";
    }
    const bool is_finite = value - value <= 0.0;
    return is_finite ? "" : "is too large for a float64";
}
template <> inline std::string read_typed<float>(const std::string &text, float &value) {
    double wide = 0.0;
    const std::string reason = read_typed(text, wide);
    const double greatest = static_cast<double>(std::numeric_limits<float>::max());
    if (!reason.empty()) {
        return reason;
    }
    if (wide > greatest || wide < -greatest) {
        return "is too large for a float32";
    }
    // Not by way of double: that would round twice.
    value = strtof(text.c_str(), NULL);
    return std::string();
}

/// Reads one scalar. False when the text is none.
template <typename T> inline bool parse(const std::string &text, T &value) {
    return read_typed(text, value).empty();
}

/// Microseconds as seconds: `12.345678`.
inline std::string seconds_text(uint64_t microseconds) {
    std::ostringstream text;
    text << microseconds / 1000000 << '.' << std::setfill('0') << std::setw(6) << microseconds % 1000000;
    return text.str();
}

/// The limits that the design gives to a value; absent ones are infinite.
struct Limits {
    double min;
    double max;
};

/// ` (below the minimum of -30 deg)` behind a value outside its limits, otherwise nothing.
inline std::string outside(const Limits &limits, double value, const std::string &quantity) {
    if (value >= limits.min && value <= limits.max) {
        return std::string();
    }
    const bool is_below = value < limits.min;
    if (!is_below && !(value > limits.max)) {
        return " (not a number)";
    }
    return (is_below ? " (below the minimum of " : " (above the maximum of ") +
           real_text(is_below ? limits.min : limits.max, 6, false) + quantity + ")";
}

/// The same for the first of `count` raw scalars whose shown value is outside.
template <typename T>
inline std::string outside_of(const Limits &limits, const T *raw, size_t count,
                              const Scaling &scaling, const std::string &quantity) {
    const double infinity = std::numeric_limits<double>::infinity();
    const bool has_limits = limits.min > -infinity || limits.max < infinity;
    std::string text;
    for (size_t i = 0; i < count && text.empty() && has_limits; ++i) {
        text = outside(limits, scaling.of(static_cast<double>(raw[i])), quantity);
    }
    return text;
}

} // namespace sensedsl

#endif
