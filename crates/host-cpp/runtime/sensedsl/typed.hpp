// What a person types for an actuator, as codes of the wire.
//
// In: words behind an actuator's name. Out: its raw values. A number is the value that is shown, in the
// message's quantity; `raw` makes codes of those behind it; a unit may follow a number, with or without
// a space, and is converted where it fits. C++17.
#ifndef SENSEDSL_TYPED_HPP
#define SENSEDSL_TYPED_HPP

#include <cmath>
#include <cstddef>
#include <istream>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "sensedsl/text.hpp"

namespace sensedsl {

/// A unit that can be typed: what it is of, and its power of ten.
struct TypedUnit {
    const char *name;
    char of;
    int power;
};

/// The unit of that name; null where there is none.
inline const TypedUnit *typed_unit(const std::string &name) {
    static const TypedUnit units[] = {
        {"us", 't', -6}, {"ms", 't', -3}, {"s", 't', 0},    {"Hz", 'f', 0},  {"kHz", 'f', 3},
        {"MHz", 'f', 6}, {"mV", 'v', -3}, {"V", 'v', 0},    {"Ohm", 'o', 0}, {"kOhm", 'o', 3},
        {"mm", 'l', -3}, {"cm", 'l', -2}, {"m", 'l', 0},    {"mA", 'a', -3}, {"A", 'a', 0},
        {"mm/s", 'p', -3}, {"cm/s", 'p', -2}, {"m/s", 'p', 0},
    };
    for (const TypedUnit &unit : units) {
        if (name == unit.name) {
            return &unit;
        }
    }
    return nullptr;
}

/// A number times a power of ten, rounded once.
inline double shifted(double number, int power) {
    return power < 0 ? number / std::pow(10.0, -power) : number * std::pow(10.0, power);
}

/// Converts a number of one unit into another. False where they are of different things.
inline bool convert_unit(const std::string &from, const std::string &to, double &number) {
    if (from == to || (from == "%" && to == "percent")) {
        return true;
    }
    const TypedUnit *const given = typed_unit(from);
    const TypedUnit *const wanted = typed_unit(to);
    if (given == nullptr || wanted == nullptr || given->of != wanted->of) {
        return false;
    }
    number = shifted(number, given->power - wanted->power);
    return true;
}

/// Takes the value that is shown as `shown`. False, and nothing is taken, where no code is shown so.
template <typename Message> bool take_shown(Message &message, std::size_t element, double shown) {
    return take_code(Message::scaling().raw_of(shown), message.data()[element]);
}

/// One typed value: its number, its unit, and whether the number is a code.
struct TypedValue {
    std::string number;
    std::string unit;
    bool is_raw;
};

/// Whether a word begins as a number does.
inline bool begins_number(const std::string &word) {
    const std::size_t at = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
    return word.size() > at && ((word[at] >= '0' && word[at] <= '9') || word[at] == '.');
}

/// Cuts a unit off the number that it touches: `1500us`, `50%`, `9.8m/s^2`. `0x1F` and `1e3` have none.
inline void cut_unit(TypedValue &value) {
    const std::string &word = value.number;
    const std::size_t begin = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
    const bool is_hex = word.compare(begin, 2, "0x") == 0 || word.compare(begin, 2, "0X") == 0;
    if (is_hex || !begins_number(word)) {
        return;
    }
    std::size_t end = word.find_first_not_of("0123456789.", begin);
    if (end != std::string::npos && (word[end] == 'e' || word[end] == 'E')) {
        const std::size_t sign = word.find_first_of("+-", end + 1) == end + 1 ? 1 : 0;
        const std::size_t power = word.find_first_not_of("0123456789", end + 1 + sign);
        end = power == end + 1 + sign ? end : power;
    }
    if (end != std::string::npos) {
        value.unit = word.substr(end);
        value.number.erase(end);
    }
}

/// The words of a line as values. A word that is no number is the unit of the one before, or a truth.
inline std::vector<TypedValue> typed_values(std::istream &words) {
    std::vector<TypedValue> values;
    bool is_raw = false;
    std::string word;
    while (words >> word) {
        const bool is_unit = !values.empty() && !begins_number(word) && values.back().unit.empty() &&
                             begins_number(values.back().number) && word != "true" && word != "false";
        if (word == "raw") {
            is_raw = true;
        } else if (is_unit) {
            values.back().unit = word;
        } else {
            values.push_back({word, std::string(), is_raw});
            cut_unit(values.back());
        }
    }
    return values;
}

/// What is wrong with a typed value for an element of a message; empty when nothing is.
template <typename Message>
std::string read_value(const TypedValue &typed, Message &message, std::size_t element) {
    auto &code = message.data()[element];
    const std::string quantity = Message::quantity;
    const bool has_unit = !typed.unit.empty();
    if (typed.is_raw && has_unit) {
        return typed.number + " is a code, which has no unit: leave out " + typed.unit;
    }
    // Numbers of 64 bits stay exact where nothing is to be computed.
    if (typed.is_raw || (Message::scaling().is_plain() && (!has_unit || typed.unit == quantity))) {
        const std::string problem = read_typed(typed.number, code);
        return problem.empty() ? problem : typed.number + " " + problem;
    }
    double shown = 0.0;
    const std::string problem = read_typed(typed.number, shown);
    if (!problem.empty()) {
        return typed.number + " " + problem;
    }
    if (has_unit && !convert_unit(typed.unit, quantity, shown)) {
        return quantity.empty() ? "the value has no unit: leave out " + typed.unit
                                : typed.unit + " is not a unit of the value, which is in " + quantity;
    }
    const std::string suffix = quantity.empty() ? std::string() : " " + quantity;
    // A bound is told as a bound, also where the type could not hold the value.
    if (!outside(Message::limits, shown, suffix).empty()) {
        return shown_text(shown) + suffix + outside(Message::limits, shown, suffix);
    }
    if (!take_shown(message, element, shown)) {
        return shown_text(shown) + suffix + " is out of reach of the value; `raw` before a number makes it a code";
    }
    return std::string();
}

} // namespace sensedsl

#endif
