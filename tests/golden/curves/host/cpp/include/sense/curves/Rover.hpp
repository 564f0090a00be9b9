// Board Rover: its messages and the board itself. Written by SenseDSL; do not edit.
// C++17, no library needed.
#ifndef SENSE_curves_Rover_HPP
#define SENSE_curves_Rover_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <utility>

#include "sense/curves/Rover_schema.hpp"
#include "sensedsl/board.hpp"

namespace sense::curves {

/// sensor Ranger uint16: a GP2Y0A21 behind the bumper
struct Ranger {
    static constexpr std::uint8_t id = 1;
    static constexpr const char *name = "Ranger";
    static constexpr const char *summary = "Ranger uint16, 8 to 70 cm: a GP2Y0A21 behind the bumper";
    static constexpr const char *quantity = "cm";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{8.0, 70.0};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Ranger(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Ranger &message) {
    return sensedsl::print_message(out, message);
}

/// sensor Line uint16[8]
struct Line {
    static constexpr std::uint8_t id = 10;
    static constexpr const char *name = "Line";
    static constexpr const char *summary = "Line uint16[8], at least 1 percent";
    static constexpr const char *quantity = "percent";
    static constexpr std::size_t count = 8;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{1.0, std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Line(); }

    std::array<uint16_t, 8> raw{};

    [[nodiscard]] const uint16_t *data() const { return raw.data(); }
    [[nodiscard]] uint16_t *data() { return raw.data(); }
    /// An element in its quantity.
    [[nodiscard]] double value(std::size_t element) const { return sensedsl::shown(*this, element); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Line &message) {
    return sensedsl::print_message(out, message);
}

/// sensor Bumper bool[3]
struct Bumper {
    static constexpr std::uint8_t id = 12;
    static constexpr const char *name = "Bumper";
    static constexpr const char *summary = "Bumper bool[3]";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 3;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Bumper(); }

    std::array<bool, 3> raw{};

    [[nodiscard]] const bool *data() const { return raw.data(); }
    [[nodiscard]] bool *data() { return raw.data(); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Bumper &message) {
    return sensedsl::print_message(out, message);
}

/// sensor Wheels int32[2]
struct Wheels {
    static constexpr std::uint8_t id = 13;
    static constexpr const char *name = "Wheels";
    static constexpr const char *summary = "Wheels int32[2]";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 2;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Wheels(); }

    std::array<int32_t, 2> raw{};

    [[nodiscard]] const int32_t *data() const { return raw.data(); }
    [[nodiscard]] int32_t *data() { return raw.data(); }
    /// An element in its quantity.
    [[nodiscard]] double value(std::size_t element) const { return sensedsl::shown(*this, element); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Wheels &message) {
    return sensedsl::print_message(out, message);
}

/// sensor Bent uint16
struct Bent {
    static constexpr std::uint8_t id = 14;
    static constexpr const char *name = "Bent";
    static constexpr const char *summary = "Bent uint16";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Bent(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Bent &message) {
    return sensedsl::print_message(out, message);
}

/// sensor Acceleration int16[3]
struct Acceleration {
    static constexpr std::uint8_t id = 30;
    static constexpr const char *name = "Acceleration";
    static constexpr const char *summary = "Acceleration int16[3], g";
    static constexpr const char *quantity = "g";
    static constexpr std::size_t count = 3;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Acceleration(); }

    std::array<int16_t, 3> raw{};

    [[nodiscard]] const int16_t *data() const { return raw.data(); }
    [[nodiscard]] int16_t *data() { return raw.data(); }
    /// An element in its quantity.
    [[nodiscard]] double value(std::size_t element) const { return sensedsl::shown(*this, element); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Acceleration &message) {
    return sensedsl::print_message(out, message);
}

/// sensor Rate int16[3]
struct Rate {
    static constexpr std::uint8_t id = 31;
    static constexpr const char *name = "Rate";
    static constexpr const char *summary = "Rate int16[3], deg/s";
    static constexpr const char *quantity = "deg/s";
    static constexpr std::size_t count = 3;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Rate(); }

    std::array<int16_t, 3> raw{};

    [[nodiscard]] const int16_t *data() const { return raw.data(); }
    [[nodiscard]] int16_t *data() { return raw.data(); }
    /// An element in its quantity.
    [[nodiscard]] double value(std::size_t element) const { return sensedsl::shown(*this, element); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Rate &message) {
    return sensedsl::print_message(out, message);
}

/// sensor Position int32
struct Position {
    static constexpr std::uint8_t id = 41;
    static constexpr const char *name = "Position";
    static constexpr const char *summary = "Position int32, deg";
    static constexpr const char *quantity = "deg";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Position(); }

    int32_t raw{};

    [[nodiscard]] const int32_t *data() const { return &raw; }
    [[nodiscard]] int32_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Position &message) {
    return sensedsl::print_message(out, message);
}

/// actuator Escs uint16[4]
struct Escs {
    static constexpr std::uint8_t id = 20;
    static constexpr const char *name = "Escs";
    static constexpr const char *summary = "Escs uint16[4], percent";
    static constexpr const char *quantity = "percent";
    static constexpr std::size_t count = 4;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Escs(); }

    std::array<uint16_t, 4> raw{};

    [[nodiscard]] const uint16_t *data() const { return raw.data(); }
    [[nodiscard]] uint16_t *data() { return raw.data(); }
    /// An element in its quantity.
    [[nodiscard]] double value(std::size_t element) const { return sensedsl::shown(*this, element); }
    /// Takes an element in its quantity; false, and nothing is taken, where no code is shown so.
    [[nodiscard]] bool value(std::size_t element, double shown) { return sensedsl::take_shown(*this, element, shown); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Escs &message) {
    return sensedsl::print_message(out, message);
}

/// actuator Lamps bool[3]
struct Lamps {
    static constexpr std::uint8_t id = 21;
    static constexpr const char *name = "Lamps";
    static constexpr const char *summary = "Lamps bool[3]";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 3;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Lamps(); }

    std::array<bool, 3> raw{};

    [[nodiscard]] const bool *data() const { return raw.data(); }
    [[nodiscard]] bool *data() { return raw.data(); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Lamps &message) {
    return sensedsl::print_message(out, message);
}

/// actuator Winch uint16
struct Winch {
    static constexpr std::uint8_t id = 22;
    static constexpr const char *name = "Winch";
    static constexpr const char *summary = "Winch uint16, -25 to 100 N";
    static constexpr const char *quantity = "N";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-25.0, 100.0};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Winch(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
    /// Takes what is shown; false, and nothing is taken, where no code is shown so.
    [[nodiscard]] bool value(double shown) { return sensedsl::take_shown(*this, 0, shown); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Winch &message) {
    return sensedsl::print_message(out, message);
}

/// actuator Speed int16
struct Speed {
    static constexpr std::uint8_t id = 40;
    static constexpr const char *name = "Speed";
    static constexpr const char *summary = "Speed int16, -100 to 100 %";
    static constexpr const char *quantity = "%";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-100.0, 100.0};
    static sensedsl::Scaling scaling() { return ::sense::curves::scaling::Speed(); }

    int16_t raw{};

    [[nodiscard]] const int16_t *data() const { return &raw; }
    [[nodiscard]] int16_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
    /// Takes what is shown; false, and nothing is taken, where no code is shown so.
    [[nodiscard]] bool value(double shown) { return sensedsl::take_shown(*this, 0, shown); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::curves::Speed &message) {
    return sensedsl::print_message(out, message);
}

/// The board: `open` it, then `poll` or `run`; see `sensedsl::Board`.
class Rover final
    : public sensedsl::Board<
          sensedsl::Messages<::sense::curves::Ranger, ::sense::curves::Line, ::sense::curves::Bumper, ::sense::curves::Wheels, ::sense::curves::Bent, ::sense::curves::Acceleration, ::sense::curves::Rate, ::sense::curves::Position>,
          sensedsl::Messages<::sense::curves::Escs, ::sense::curves::Lamps, ::sense::curves::Winch, ::sense::curves::Speed>> {
public:
    using Sensors = sensedsl::Messages<::sense::curves::Ranger, ::sense::curves::Line, ::sense::curves::Bumper, ::sense::curves::Wheels, ::sense::curves::Bent, ::sense::curves::Acceleration, ::sense::curves::Rate, ::sense::curves::Position>;
    static constexpr unsigned default_baud = 115200;

    template <typename Handler>
    explicit Rover(Handler handler) : Board(facts::Rover(), std::move(handler)) {}

    void open(const std::string &device, unsigned baud = default_baud) { Board::open(device, baud); }

    /// For a stream that does not come from a device.
    template <typename Handler> [[nodiscard]] static auto decoder(Handler handler) {
        return sensedsl::MessageDecoder<Sensors, Handler>(*facts::Rover().schema,
                                                          std::move(handler));
    }
};

} // namespace sense::curves

#endif
