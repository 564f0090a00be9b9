// Board STM32F4DiscoveryBoard: its messages and the board itself. Written by SenseDSL; do not edit.
// C++17, no library needed.
#ifndef SENSE_miniature_car_STM32F4DiscoveryBoard_HPP
#define SENSE_miniature_car_STM32F4DiscoveryBoard_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <utility>

#include "sense/miniature_car/STM32F4DiscoveryBoard_schema.hpp"
#include "sensedsl/board.hpp"

namespace sense::miniature_car {

/// sensor IRFrontRight uint16
struct IRFrontRight {
    static constexpr std::uint8_t id = 1;
    static constexpr const char *name = "IRFrontRight";
    static constexpr const char *summary = "IRFrontRight uint16";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::IRFrontRight(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::IRFrontRight &message) {
    return sensedsl::print_message(out, message);
}

/// sensor IRRearRight uint16
struct IRRearRight {
    static constexpr std::uint8_t id = 2;
    static constexpr const char *name = "IRRearRight";
    static constexpr const char *summary = "IRRearRight uint16";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::IRRearRight(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::IRRearRight &message) {
    return sensedsl::print_message(out, message);
}

/// sensor IRRear uint16
struct IRRear {
    static constexpr std::uint8_t id = 3;
    static constexpr const char *name = "IRRear";
    static constexpr const char *summary = "IRRear uint16";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::IRRear(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::IRRear &message) {
    return sensedsl::print_message(out, message);
}

/// sensor USFront uint16
struct USFront {
    static constexpr std::uint8_t id = 4;
    static constexpr const char *name = "USFront";
    static constexpr const char *summary = "USFront uint16, cm";
    static constexpr const char *quantity = "cm";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::USFront(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::USFront &message) {
    return sensedsl::print_message(out, message);
}

/// sensor USFrontRight uint16
struct USFrontRight {
    static constexpr std::uint8_t id = 5;
    static constexpr const char *name = "USFrontRight";
    static constexpr const char *summary = "USFrontRight uint16, cm";
    static constexpr const char *quantity = "cm";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::USFrontRight(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::USFrontRight &message) {
    return sensedsl::print_message(out, message);
}

/// sensor USRear uint16
struct USRear {
    static constexpr std::uint8_t id = 6;
    static constexpr const char *name = "USRear";
    static constexpr const char *summary = "USRear uint16, cm";
    static constexpr const char *quantity = "cm";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::USRear(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::USRear &message) {
    return sensedsl::print_message(out, message);
}

/// sensor WheelLeftA uint32
struct WheelLeftA {
    static constexpr std::uint8_t id = 7;
    static constexpr const char *name = "WheelLeftA";
    static constexpr const char *summary = "WheelLeftA uint32";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::WheelLeftA(); }

    uint32_t raw{};

    [[nodiscard]] const uint32_t *data() const { return &raw; }
    [[nodiscard]] uint32_t *data() { return &raw; }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::WheelLeftA &message) {
    return sensedsl::print_message(out, message);
}

/// sensor WheelLeftB uint32
struct WheelLeftB {
    static constexpr std::uint8_t id = 8;
    static constexpr const char *name = "WheelLeftB";
    static constexpr const char *summary = "WheelLeftB uint32";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::WheelLeftB(); }

    uint32_t raw{};

    [[nodiscard]] const uint32_t *data() const { return &raw; }
    [[nodiscard]] uint32_t *data() { return &raw; }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::WheelLeftB &message) {
    return sensedsl::print_message(out, message);
}

/// sensor WheelRightA uint32
struct WheelRightA {
    static constexpr std::uint8_t id = 9;
    static constexpr const char *name = "WheelRightA";
    static constexpr const char *summary = "WheelRightA uint32";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::WheelRightA(); }

    uint32_t raw{};

    [[nodiscard]] const uint32_t *data() const { return &raw; }
    [[nodiscard]] uint32_t *data() { return &raw; }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::WheelRightA &message) {
    return sensedsl::print_message(out, message);
}

/// sensor WheelRightB uint32
struct WheelRightB {
    static constexpr std::uint8_t id = 10;
    static constexpr const char *name = "WheelRightB";
    static constexpr const char *summary = "WheelRightB uint32";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::WheelRightB(); }

    uint32_t raw{};

    [[nodiscard]] const uint32_t *data() const { return &raw; }
    [[nodiscard]] uint32_t *data() { return &raw; }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::WheelRightB &message) {
    return sensedsl::print_message(out, message);
}

/// sensor RCSteering uint16
struct RCSteering {
    static constexpr std::uint8_t id = 11;
    static constexpr const char *name = "RCSteering";
    static constexpr const char *summary = "RCSteering uint16, 1000 to 2000 us";
    static constexpr const char *quantity = "us";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{1000.0, 2000.0};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::RCSteering(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::RCSteering &message) {
    return sensedsl::print_message(out, message);
}

/// sensor RCThrottle uint16
struct RCThrottle {
    static constexpr std::uint8_t id = 12;
    static constexpr const char *name = "RCThrottle";
    static constexpr const char *summary = "RCThrottle uint16, 1000 to 2000 us";
    static constexpr const char *quantity = "us";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{1000.0, 2000.0};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::RCThrottle(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::RCThrottle &message) {
    return sensedsl::print_message(out, message);
}

/// sensor RCSwitch uint16
struct RCSwitch {
    static constexpr std::uint8_t id = 13;
    static constexpr const char *name = "RCSwitch";
    static constexpr const char *summary = "RCSwitch uint16, 1000 to 2000 us";
    static constexpr const char *quantity = "us";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{1000.0, 2000.0};
    static sensedsl::Scaling scaling() { return ::sense::miniature_car::scaling::RCSwitch(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::miniature_car::RCSwitch &message) {
    return sensedsl::print_message(out, message);
}

/// The board: `open` it, then `poll` or `run`; see `sensedsl::Board`.
class STM32F4DiscoveryBoard final
    : public sensedsl::Board<
          sensedsl::Messages<::sense::miniature_car::IRFrontRight, ::sense::miniature_car::IRRearRight, ::sense::miniature_car::IRRear, ::sense::miniature_car::USFront, ::sense::miniature_car::USFrontRight, ::sense::miniature_car::USRear, ::sense::miniature_car::WheelLeftA, ::sense::miniature_car::WheelLeftB, ::sense::miniature_car::WheelRightA, ::sense::miniature_car::WheelRightB, ::sense::miniature_car::RCSteering, ::sense::miniature_car::RCThrottle, ::sense::miniature_car::RCSwitch>,
          sensedsl::Messages<>> {
public:
    using Sensors = sensedsl::Messages<::sense::miniature_car::IRFrontRight, ::sense::miniature_car::IRRearRight, ::sense::miniature_car::IRRear, ::sense::miniature_car::USFront, ::sense::miniature_car::USFrontRight, ::sense::miniature_car::USRear, ::sense::miniature_car::WheelLeftA, ::sense::miniature_car::WheelLeftB, ::sense::miniature_car::WheelRightA, ::sense::miniature_car::WheelRightB, ::sense::miniature_car::RCSteering, ::sense::miniature_car::RCThrottle, ::sense::miniature_car::RCSwitch>;
    static constexpr unsigned default_baud = 115200;

    template <typename Handler>
    explicit STM32F4DiscoveryBoard(Handler handler) : Board(facts::STM32F4DiscoveryBoard(), std::move(handler)) {}

    void open(const std::string &device, unsigned baud = default_baud) { Board::open(device, baud); }

    /// For a stream that does not come from a device.
    template <typename Handler> [[nodiscard]] static auto decoder(Handler handler) {
        return sensedsl::MessageDecoder<Sensors, Handler>(*facts::STM32F4DiscoveryBoard().schema,
                                                          std::move(handler));
    }
};

} // namespace sense::miniature_car

#endif
