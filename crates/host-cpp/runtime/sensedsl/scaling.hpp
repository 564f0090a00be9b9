// How a design shows raw values.
//
// In: what the design says of one message. Out: the one place where a raw value becomes the shown one, and back.
// C++98.
#ifndef SENSEDSL_SCALING_HPP
#define SENSEDSL_SCALING_HPP

#include <math.h>
#include <stddef.h>

#include <limits>

namespace sensedsl {

/// A point of a curve.
struct Point {
    double x;
    double y;
};

/// `scale * raw + offset`, and through a curve where there is one: linear between its points, its ends
/// held beyond them. The points stay the caller's; their `x` ascends.
struct Scaling {
    Scaling(double factor, double summand)
        : scale(factor), offset(summand), curve(NULL), point_count(0) {}
    template <size_t count>
    Scaling(double factor, double summand, const Point (&points)[count])
        : scale(factor), offset(summand), curve(points), point_count(count) {}

    /// The shown value of a raw one. What is not a number stays so.
    double of(double raw) const {
        const double x = scale * raw + offset;
        if (point_count == 0) {
            return x;
        }
        if (!(x >= curve[0].x)) {
            return x < curve[0].x ? curve[0].y : x;
        }
        size_t last = 0;
        while (last + 1 < point_count && curve[last + 1].x <= x) {
            ++last;
        }
        const Point &from = curve[last];
        if (last + 1 == point_count) {
            return from.y;
        }
        const Point &to = curve[last + 1];
        return from.y + (x - from.x) * (to.y - from.y) / (to.x - from.x);
    }

    /// Whether the shown value is the raw one.
    bool is_plain() const {
        return point_count == 0 && !(scale < 1.0) && !(scale > 1.0) && !(offset < 0.0) && !(offset > 0.0);
    }

    /// The raw value, with a fraction, that is shown so; not a number where no value is.
    double raw_of(double shown) const {
        double x = shown;
        bool is_reached = point_count == 0;
        for (size_t i = 0; i + 1 < point_count && !is_reached; ++i) {
            const Point &from = curve[i];
            const Point &to = curve[i + 1];
            const bool rises = from.y < to.y;
            is_reached = rises ? shown >= from.y && shown <= to.y : shown <= from.y && shown >= to.y;
            if (is_reached) {
                const bool is_level = !(from.y < to.y) && !(from.y > to.y);
                x = is_level ? from.x : from.x + (shown - from.y) * (to.x - from.x) / (to.y - from.y);
            }
        }
        const double raw = (x - offset) / scale;
        return is_reached ? raw : std::numeric_limits<double>::quiet_NaN();
    }

    double scale;
    double offset;
    const Point *curve;
    size_t point_count;
};

/// Takes a raw value with a fraction as a `T`. False where the type does not hold the nearest code.
template <typename T> inline bool take_code(double raw, T &value) {
    typedef std::numeric_limits<T> Bounds;
    const double code = Bounds::is_integer ? round(raw) : raw;
    // 2^63 and 2^64 are no codes, but what the greatest ones of 64 bits are rounded to.
    const double greatest = static_cast<double>(Bounds::max());
    const double least = Bounds::is_integer ? static_cast<double>(Bounds::min()) : -greatest;
    const bool is_wide = Bounds::is_integer && sizeof(T) == 8;
    if (!(code >= least && (is_wide ? code < greatest : code <= greatest))) {
        return false;
    }
    value = static_cast<T>(code);
    return true;
}
template <> inline bool take_code<bool>(double raw, bool &value) {
    const double code = round(raw);
    if (!(code >= 0.0 && code <= 1.0)) {
        return false;
    }
    value = code > 0.5;
    return true;
}

} // namespace sensedsl

#endif
