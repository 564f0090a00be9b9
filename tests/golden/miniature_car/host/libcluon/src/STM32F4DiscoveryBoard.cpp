// OD4 microservice of board STM32F4DiscoveryBoard: what the board says becomes messages. Written by SenseDSL; do not edit. C++14, libcluon.
#include "cluon-complete.hpp"
#include "sense.hpp"

#include <chrono>
#include <cstdint>
#include <exception>
#include <iostream>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "sense/STM32F4DiscoveryBoard_schema.hpp"
#include "sensedsl/link.hpp"
#include "sensedsl/serial.hpp"
#include "sensedsl/text.hpp"

namespace {

namespace board = ::sense::STM32F4DiscoveryBoard;

struct Options {
    std::uint16_t cid{0};
    std::string device{};
    unsigned baud{115200};
    /// Each message's own wire identifier when not given.
    bool has_sender_stamp{false};
    std::uint32_t sender_stamp{0};
    bool is_verbose{false};
    /// 0: each value is sent when it comes.
    float frequency_hz{0.0F};
};

class Publisher final : public sensedsl::Sink {
public:
    Publisher(cluon::OD4Session &od4, const Options &options) : od4_(od4), options_(options) {}

    bool is_other_schema() const { return is_other_schema_; }

    /// Sends the latest value of each sensor that spoke since the last time.
    void publish_latest() {
        for (const auto &entry : latest_) {
            publish(entry.first, entry.second.bytes.data(), entry.second.sampled);
        }
        latest_.clear();
    }

private:
    struct Latest {
        sensedsl::Bytes bytes;
        cluon::data::TimeStamp sampled;
    };

    void on_hello(std::uint32_t hash) override {
        is_other_schema_ = hash != board::schema().hash;
    }

    void on_value(std::uint8_t id, const std::uint8_t *bytes) override {
        if (is_other_schema_) {
            return;
        }
        const cluon::data::TimeStamp sampled{cluon::time::now()};
        if (!(options_.frequency_hz > 0.0F)) {
            publish(id, bytes, sampled);
            return;
        }
        for (std::size_t i{0}; i < board::schema().sensors.item_count; ++i) {
            const sensedsl::Item &item = board::schema().sensors.items[i];
            if (item.id == id) {
                latest_[id] = Latest{sensedsl::Bytes(bytes, bytes + item.size_bytes()), sampled};
            }
        }
    }

    void publish(std::uint8_t id, const std::uint8_t *bytes,
                 const cluon::data::TimeStamp &sampled) {
        const std::uint32_t stamp{options_.has_sender_stamp ? options_.sender_stamp : id};
        switch (id) {
        case 1: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::IRFrontRight message;
            message.raw(raw[0]);
            tell("IRFrontRight", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 2: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::IRRearRight message;
            message.raw(raw[0]);
            tell("IRRearRight", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 3: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::IRRear message;
            message.raw(raw[0]);
            tell("IRRear", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 4: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::USFront message;
            message.raw(raw[0]);
            message.value(1.0 * static_cast<double>(raw[0]) + 0.0);
            tell("USFront", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 5: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::USFrontRight message;
            message.raw(raw[0]);
            message.value(1.0 * static_cast<double>(raw[0]) + 0.0);
            tell("USFrontRight", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 6: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::USRear message;
            message.raw(raw[0]);
            message.value(1.0 * static_cast<double>(raw[0]) + 0.0);
            tell("USRear", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 7: {
            uint32_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::WheelLeftA message;
            message.raw(raw[0]);
            tell("WheelLeftA", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 8: {
            uint32_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::WheelLeftB message;
            message.raw(raw[0]);
            tell("WheelLeftB", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 9: {
            uint32_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::WheelRightA message;
            message.raw(raw[0]);
            tell("WheelRightA", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 10: {
            uint32_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::WheelRightB message;
            message.raw(raw[0]);
            tell("WheelRightB", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 11: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::RCSteering message;
            message.raw(raw[0]);
            message.value(1.0 * static_cast<double>(raw[0]) + 0.0);
            tell("RCSteering", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 12: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::RCThrottle message;
            message.raw(raw[0]);
            message.value(1.0 * static_cast<double>(raw[0]) + 0.0);
            tell("RCThrottle", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        case 13: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::RCSwitch message;
            message.raw(raw[0]);
            message.value(1.0 * static_cast<double>(raw[0]) + 0.0);
            tell("RCSwitch", raw, 1);
            od4_.send(message, sampled, stamp);
            break;
        }
        default:
            break;
        }
    }

    template <typename T> void tell(const char *name, const T *raw, std::size_t count) const {
        if (options_.is_verbose) {
            std::cout << name << " = ";
            sensedsl::print_all(std::cout, raw, count);
            std::cout << std::endl;
        }
    }

    cluon::OD4Session &od4_;
    const Options &options_;
    std::map<std::uint8_t, Latest> latest_{};
    bool is_other_schema_{false};
};

int run(const Options &options) {
    cluon::OD4Session od4{options.cid};
    sensedsl::Serial serial(options.device, options.baud);
    Publisher publisher(od4, options);
    sensedsl::Decoder decoder(board::schema(), board::schema().sensors, publisher);
    if (serial.is_terminal() && !serial.write(sensedsl::hello_request(board::schema()))) {
        std::cerr << "the board does not take bytes" << std::endl;
    }
    using Clock = std::chrono::steady_clock;
    const bool is_paced{options.frequency_hz > 0.0F};
    const auto period = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<float>(is_paced ? 1.0F / options.frequency_hz : 1.0F));
    auto due = Clock::now() + period;
    sensedsl::Bytes bytes;
    auto state = sensedsl::Serial::silent;
    while (od4.isRunning() && !publisher.is_other_schema() && state != sensedsl::Serial::ended) {
        int timeout_ms{100};
        if (is_paced) {
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(due - Clock::now()).count();
            timeout_ms = left < 0 ? 0 : left < 100 ? static_cast<int>(left) : 100;
        }
        state = serial.read(bytes, timeout_ms);
        decoder.feed(bytes.data(), bytes.size());
        if (is_paced && Clock::now() >= due) {
            publisher.publish_latest();
            due += period;
        }
    }
    publisher.publish_latest();
    std::cerr << decoder.frames() << " frames, " << decoder.dropped_bytes() << " bytes dropped"
              << std::endl;
    if (publisher.is_other_schema()) {
        std::cerr << "the board was built from another version of the design" << std::endl;
        return 1;
    }
    if (state == sensedsl::Serial::ended) {
        std::cerr << options.device << " is gone" << std::endl;
        return 1;
    }
    return 0;
}

/// False when an option is missing or is no number.
bool read_options(std::map<std::string, std::string> given, Options &options) {
    options.device = given["device"];
    options.is_verbose = given.count("verbose") != 0;
    options.has_sender_stamp = given.count("id") != 0;
    return !options.device.empty() && sensedsl::parse(given["cid"], options.cid) &&
           options.cid >= 1 && options.cid <= 254 &&
           (given.count("baud") == 0 || sensedsl::parse(given["baud"], options.baud)) &&
           (given.count("id") == 0 || sensedsl::parse(given["id"], options.sender_stamp)) &&
           (given.count("freq") == 0 || sensedsl::parse(given["freq"], options.frequency_hz));
}

} // namespace

int main(int argc, char **argv) {
    Options options;
    if (!read_options(cluon::getCommandlineArguments(argc, argv), options)) {
        std::cerr << argv[0] << " publishes what board STM32F4DiscoveryBoard says to an OD4 session.\n"
                  << "Usage: " << argv[0]
                  << " --cid=<OD4 session 1..254> --device=<serial device> [--baud=115200]"
                     " [--id=<sender stamp>] [--freq=<Hz>] [--verbose]\n"
                  << "  --id    sender stamp of all messages; without it each message has the\n"
                     "          identifier that its sensor has on the wire\n"
                  << "  --freq  send the latest values that often; without it each when it comes\n"
                  << "Example: " << argv[0] << " --cid=111 --device=/dev/ttyACM0 --verbose"
                  << std::endl;
        return 1;
    }
    try {
        return run(options);
    } catch (const std::exception &problem) {
        std::cerr << problem.what() << std::endl;
        return 1;
    }
}
