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

/// sensor IRFront uint16
struct IRFront {
    static constexpr std::uint8_t id = 17;
    static constexpr const char *name = "IRFront";
    uint16_t raw{};
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::IRFront &message) {
    out << ::sense::IRFront::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    return out;
}

/// sensor IRFrontRight uint16
struct IRFrontRight {
    static constexpr std::uint8_t id = 18;
    static constexpr const char *name = "IRFrontRight";
    uint16_t raw{};
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::IRFrontRight &message) {
    out << ::sense::IRFrontRight::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    return out;
}

/// sensor USRear uint8
struct USRear {
    static constexpr std::uint8_t id = 19;
    static constexpr const char *name = "USRear";
    static constexpr const char *quantity = "cm";
    uint8_t raw{};

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

/// sensor WheelEncoder uint32
struct WheelEncoder {
    static constexpr std::uint8_t id = 20;
    static constexpr const char *name = "WheelEncoder";
    uint32_t raw{};
};

inline std::ostream &operator<<(std::ostream &out, const ::sense::WheelEncoder &message) {
    out << ::sense::WheelEncoder::name << " = ";
    sensedsl::print_all(out, &message.raw, 1);
    return out;
}

namespace STM32F4DiscoveryBoard {

/// Calls `handler` with each message of the stream: give it an overload for each message type that
/// you want (`sensedsl::Handlers` makes one of lambdas), and one for `sensedsl::Hello` to see
/// whether the board speaks of the same devices.
template <typename Handler> class Decoder final : private sensedsl::Sink {
    static_assert(std::is_invocable_v<Handler &, const sensedsl::Hello &> ||
                      std::is_invocable_v<Handler &, const ::sense::IRFront &> ||
                      std::is_invocable_v<Handler &, const ::sense::IRFrontRight &> ||
                      std::is_invocable_v<Handler &, const ::sense::USRear &> ||
                      std::is_invocable_v<Handler &, const ::sense::WheelEncoder &>,
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
        case ::sense::IRFront::id: {
            ::sense::IRFront message;
            sensedsl::load_all(bytes, &message.raw, 1);
            call(message);
            break;
        }
        case ::sense::IRFrontRight::id: {
            ::sense::IRFrontRight message;
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
        case ::sense::WheelEncoder::id: {
            ::sense::WheelEncoder message;
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
