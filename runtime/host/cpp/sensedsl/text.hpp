// Scalars as text and back, the same for each host.
//
// In: scalars of the wire's types. Out: decimal text that reads back to the same value, 8-bit
// integers as numbers and not as characters. C++98.
#ifndef SENSEDSL_TEXT_HPP
#define SENSEDSL_TEXT_HPP

#include <errno.h>
#include <inttypes.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <limits>
#include <ostream>
#include <string>

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

/// Reads an integer of `T`'s range. False when the text is none.
template <typename T> inline bool parse(const std::string &text, T &value) {
    char *end = NULL;
    errno = 0;
    if (std::numeric_limits<T>::is_signed) {
        const intmax_t number = strtoimax(text.c_str(), &end, 0);
        if (number < static_cast<intmax_t>(std::numeric_limits<T>::min()) ||
            number > static_cast<intmax_t>(std::numeric_limits<T>::max())) {
            return false;
        }
        value = static_cast<T>(number);
    } else {
        const uintmax_t number = strtoumax(text.c_str(), &end, 0);
        if (text.find('-') != std::string::npos ||
            number > static_cast<uintmax_t>(std::numeric_limits<T>::max())) {
            return false;
        }
        value = static_cast<T>(number);
    }
    return errno == 0 && !text.empty() && *end == '\0';
}
template <> inline bool parse<bool>(const std::string &text, bool &value) {
    value = text == "true" || text == "1";
    return value || text == "false" || text == "0";
}
template <> inline bool parse<double>(const std::string &text, double &value) {
    char *end = NULL;
    value = strtod(text.c_str(), &end);
    return !text.empty() && *end == '\0';
}
template <> inline bool parse<float>(const std::string &text, float &value) {
    char *end = NULL;
    value = strtof(text.c_str(), &end);
    return !text.empty() && *end == '\0';
}

} // namespace sensedsl

#endif
