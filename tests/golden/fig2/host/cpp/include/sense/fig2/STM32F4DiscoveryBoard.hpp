// Board STM32F4DiscoveryBoard: its messages and the board itself. Written by SenseDSL; do not edit.
// C++17, no library needed.
#ifndef SENSE_fig2_STM32F4DiscoveryBoard_HPP
#define SENSE_fig2_STM32F4DiscoveryBoard_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <utility>

#include "sense/fig2/STM32F4DiscoveryBoard_schema.hpp"
#include "sensedsl/board.hpp"

namespace sense::fig2 {

/// sensor IRFront uint16
struct IRFront {
    static constexpr std::uint8_t id = 17;
    static constexpr const char *name = "IRFront";
    static constexpr const char *summary = "IRFront uint16";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::fig2::scaling::IRFront(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::fig2::IRFront &message) {
    return sensedsl::print_message(out, message);
}

/// sensor IRFrontRight uint16
struct IRFrontRight {
    static constexpr std::uint8_t id = 18;
    static constexpr const char *name = "IRFrontRight";
    static constexpr const char *summary = "IRFrontRight uint16";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::fig2::scaling::IRFrontRight(); }

    uint16_t raw{};

    [[nodiscard]] const uint16_t *data() const { return &raw; }
    [[nodiscard]] uint16_t *data() { return &raw; }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::fig2::IRFrontRight &message) {
    return sensedsl::print_message(out, message);
}

/// sensor USRear uint8
struct USRear {
    static constexpr std::uint8_t id = 19;
    static constexpr const char *name = "USRear";
    static constexpr const char *summary = "USRear uint8, cm";
    static constexpr const char *quantity = "cm";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = true;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::fig2::scaling::USRear(); }

    uint8_t raw{};

    [[nodiscard]] const uint8_t *data() const { return &raw; }
    [[nodiscard]] uint8_t *data() { return &raw; }
    /// In its quantity.
    [[nodiscard]] double value() const { return sensedsl::shown(*this, 0); }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::fig2::USRear &message) {
    return sensedsl::print_message(out, message);
}

/// sensor WheelEncoder uint32
struct WheelEncoder {
    static constexpr std::uint8_t id = 20;
    static constexpr const char *name = "WheelEncoder";
    static constexpr const char *summary = "WheelEncoder uint32";
    static constexpr const char *quantity = "";
    static constexpr std::size_t count = 1;
    static constexpr bool is_scaled = false;
    static constexpr sensedsl::Limits limits{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    static sensedsl::Scaling scaling() { return ::sense::fig2::scaling::WheelEncoder(); }

    uint32_t raw{};

    [[nodiscard]] const uint32_t *data() const { return &raw; }
    [[nodiscard]] uint32_t *data() { return &raw; }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::fig2::WheelEncoder &message) {
    return sensedsl::print_message(out, message);
}

/// The board: `open` it, then `poll` or `run`; see `sensedsl::Board`.
class STM32F4DiscoveryBoard final
    : public sensedsl::Board<
          sensedsl::Messages<::sense::fig2::IRFront, ::sense::fig2::IRFrontRight, ::sense::fig2::USRear, ::sense::fig2::WheelEncoder>,
          sensedsl::Messages<>> {
public:
    using Sensors = sensedsl::Messages<::sense::fig2::IRFront, ::sense::fig2::IRFrontRight, ::sense::fig2::USRear, ::sense::fig2::WheelEncoder>;
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

} // namespace sense::fig2

#endif
