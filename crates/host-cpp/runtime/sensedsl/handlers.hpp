// What a C++17 program writes to take messages from a board.
#ifndef SENSEDSL_HANDLERS_HPP
#define SENSEDSL_HANDLERS_HPP

#include <cstdint>
#include <string>

namespace sensedsl {

/// The board told its schema hash.
struct Hello {
    std::uint32_t hash;
    /// True when it is the hash of the design this program was generated from.
    bool is_same_schema;
};

/// Something happened that people want to know: the board is lost, back, silent, or another one.
struct Note {
    /// One or more lines.
    std::string text;
};

/// Many function objects as one with an overload of each.
template <typename... Functions> struct Handlers : Functions... {
    using Functions::operator()...;
};
template <typename... Functions> Handlers(Functions...) -> Handlers<Functions...>;

} // namespace sensedsl

#endif
