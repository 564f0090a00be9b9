// Board STM32F4DiscoveryBoard: its messages, their decoder and encoder. Written by SenseDSL; do not edit.
// C++17, no library needed.
#ifndef SENSE_STM32F4DiscoveryBoard_HPP
#define SENSE_STM32F4DiscoveryBoard_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <type_traits>
#include <utility>

#include "sense/STM32F4DiscoveryBoard_schema.hpp"
#include "sensedsl/handlers.hpp"
#include "sensedsl/link.hpp"
#include "sensedsl/text.hpp"

namespace sense {

/// sensor IRFrontRight uint16
struct IRFrontRight {
    static constexpr std::uint8_t id = 1;
    static constexpr const char *name = "IRFrontRight";
    uint16_t raw{};
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::IRFrontRight &message) {
    out << ::sense::IRFrontRight::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    return out;
}

/// sensor IRRearRight uint16
struct IRRearRight {
    static constexpr std::uint8_t id = 2;
    static constexpr const char *name = "IRRearRight";
    uint16_t raw{};
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::IRRearRight &message) {
    out << ::sense::IRRearRight::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    return out;
}

/// sensor IRRear uint16
struct IRRear {
    static constexpr std::uint8_t id = 3;
    static constexpr const char *name = "IRRear";
    uint16_t raw{};
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::IRRear &message) {
    out << ::sense::IRRear::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    return out;
}

/// sensor USFront uint16
struct USFront {
    static constexpr std::uint8_t id = 4;
    static constexpr const char *name = "USFront";
    static constexpr const char *quantity = "cm";
    uint16_t raw{};

    /// In its quantity.
    [[nodiscard]] double value() const {
        return 1.0 * static_cast<double>(raw) + 0.0;
    }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::USFront &message) {
    out << ::sense::USFront::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    out << " (";
    sensedsl::print(out, message.value());
    out << " cm" << ')';
    return out;
}

/// sensor USFrontRight uint16
struct USFrontRight {
    static constexpr std::uint8_t id = 5;
    static constexpr const char *name = "USFrontRight";
    static constexpr const char *quantity = "cm";
    uint16_t raw{};

    /// In its quantity.
    [[nodiscard]] double value() const {
        return 1.0 * static_cast<double>(raw) + 0.0;
    }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::USFrontRight &message) {
    out << ::sense::USFrontRight::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    out << " (";
    sensedsl::print(out, message.value());
    out << " cm" << ')';
    return out;
}

/// sensor USRear uint16
struct USRear {
    static constexpr std::uint8_t id = 6;
    static constexpr const char *name = "USRear";
    static constexpr const char *quantity = "cm";
    uint16_t raw{};

    /// In its quantity.
    [[nodiscard]] double value() const {
        return 1.0 * static_cast<double>(raw) + 0.0;
    }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::USRear &message) {
    out << ::sense::USRear::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    out << " (";
    sensedsl::print(out, message.value());
    out << " cm" << ')';
    return out;
}

/// sensor WheelLeftA uint32
struct WheelLeftA {
    static constexpr std::uint8_t id = 7;
    static constexpr const char *name = "WheelLeftA";
    uint32_t raw{};
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::WheelLeftA &message) {
    out << ::sense::WheelLeftA::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    return out;
}

/// sensor WheelLeftB uint32
struct WheelLeftB {
    static constexpr std::uint8_t id = 8;
    static constexpr const char *name = "WheelLeftB";
    uint32_t raw{};
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::WheelLeftB &message) {
    out << ::sense::WheelLeftB::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    return out;
}

/// sensor WheelRightA uint32
struct WheelRightA {
    static constexpr std::uint8_t id = 9;
    static constexpr const char *name = "WheelRightA";
    uint32_t raw{};
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::WheelRightA &message) {
    out << ::sense::WheelRightA::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    return out;
}

/// sensor WheelRightB uint32
struct WheelRightB {
    static constexpr std::uint8_t id = 10;
    static constexpr const char *name = "WheelRightB";
    uint32_t raw{};
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::WheelRightB &message) {
    out << ::sense::WheelRightB::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    return out;
}

/// sensor RCSteering uint16
struct RCSteering {
    static constexpr std::uint8_t id = 11;
    static constexpr const char *name = "RCSteering";
    static constexpr const char *quantity = "us";
    uint16_t raw{};

    /// In its quantity.
    [[nodiscard]] double value() const {
        return 1.0 * static_cast<double>(raw) + 0.0;
    }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::RCSteering &message) {
    out << ::sense::RCSteering::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    out << " (";
    sensedsl::print(out, message.value());
    out << " us" << ')';
    return out;
}

/// sensor RCThrottle uint16
struct RCThrottle {
    static constexpr std::uint8_t id = 12;
    static constexpr const char *name = "RCThrottle";
    static constexpr const char *quantity = "us";
    uint16_t raw{};

    /// In its quantity.
    [[nodiscard]] double value() const {
        return 1.0 * static_cast<double>(raw) + 0.0;
    }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::RCThrottle &message) {
    out << ::sense::RCThrottle::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    out << " (";
    sensedsl::print(out, message.value());
    out << " us" << ')';
    return out;
}

/// sensor RCSwitch uint16
struct RCSwitch {
    static constexpr std::uint8_t id = 13;
    static constexpr const char *name = "RCSwitch";
    static constexpr const char *quantity = "us";
    uint16_t raw{};

    /// In its quantity.
    [[nodiscard]] double value() const {
        return 1.0 * static_cast<double>(raw) + 0.0;
    }
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::RCSwitch &message) {
    out << ::sense::RCSwitch::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    out << " (";
    sensedsl::print(out, message.value());
    out << " us" << ')';
    return out;
}

namespace STM32F4DiscoveryBoard {

/// Calls `handler` with each message of the stream: give it an overload for each message type that
/// you want (`sensedsl::Handlers` makes one of lambdas), and one for `sensedsl::Hello` to see
/// whether the board speaks of the same devices.
template <typename Handler> class Decoder final : private sensedsl::Sink {
    static_assert(std::is_invocable_v<Handler &, const sensedsl::Hello &> ||
                      std::is_invocable_v<Handler &, const ::sense::IRFrontRight &> ||
                      std::is_invocable_v<Handler &, const ::sense::IRRearRight &> ||
                      std::is_invocable_v<Handler &, const ::sense::IRRear &> ||
                      std::is_invocable_v<Handler &, const ::sense::USFront &> ||
                      std::is_invocable_v<Handler &, const ::sense::USFrontRight &> ||
                      std::is_invocable_v<Handler &, const ::sense::USRear &> ||
                      std::is_invocable_v<Handler &, const ::sense::WheelLeftA &> ||
                      std::is_invocable_v<Handler &, const ::sense::WheelLeftB &> ||
                      std::is_invocable_v<Handler &, const ::sense::WheelRightA &> ||
                      std::is_invocable_v<Handler &, const ::sense::WheelRightB &> ||
                      std::is_invocable_v<Handler &, const ::sense::RCSteering &> ||
                      std::is_invocable_v<Handler &, const ::sense::RCThrottle &> ||
                      std::is_invocable_v<Handler &, const ::sense::RCSwitch &>,
                  "the handler takes none of this board's messages");

public:
    explicit Decoder(Handler handler)
        : handler_(std::move(handler)), decoder_(schema(), schema().sensors, *this) {}
    Decoder(const Decoder &) = delete;
    Decoder &operator=(const Decoder &) = delete;

    /// Takes the next bytes of the stream, however it is cut.
    void feed(const std::uint8_t *bytes, std::size_t count) { decoder_.feed(bytes, count); }
    void feed(const sensedsl::Bytes &bytes) { decoder_.feed(bytes.data(), bytes.size()); }

    /// Frames delivered so far.
    [[nodiscard]] std::uint64_t frames() const { return decoder_.frames(); }
    /// Bytes so far that belonged to no delivered frame.
    [[nodiscard]] std::uint64_t dropped_bytes() const { return decoder_.dropped_bytes(); }

private:
    template <typename Message> void call(const Message &message) {
        if constexpr (std::is_invocable_v<Handler &, const Message &>) {
            handler_(message);
        }
    }

    void on_hello(std::uint32_t hash) override {
        call(sensedsl::Hello{hash, hash == schema().hash});
    }

    void on_value(std::uint8_t id, const std::uint8_t *bytes) override {
        switch (id) {
        case ::sense::IRFrontRight::id: {
            ::sense::IRFrontRight message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::IRRearRight::id: {
            ::sense::IRRearRight message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::IRRear::id: {
            ::sense::IRRear message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::USFront::id: {
            ::sense::USFront message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::USFrontRight::id: {
            ::sense::USFrontRight message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::USRear::id: {
            ::sense::USRear message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::WheelLeftA::id: {
            ::sense::WheelLeftA message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::WheelLeftB::id: {
            ::sense::WheelLeftB message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::WheelRightA::id: {
            ::sense::WheelRightA message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::WheelRightB::id: {
            ::sense::WheelRightB message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::RCSteering::id: {
            ::sense::RCSteering message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::RCThrottle::id: {
            ::sense::RCThrottle message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::RCSwitch::id: {
            ::sense::RCSwitch message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        default:
            break;
        }
    }

    Handler handler_;
    sensedsl::Decoder decoder_;
};

/// The frame by which the host asks the board for its hello.
inline sensedsl::Bytes hello_request() { return sensedsl::hello_request(schema()); }

} // namespace STM32F4DiscoveryBoard
} // namespace sense

#endif
