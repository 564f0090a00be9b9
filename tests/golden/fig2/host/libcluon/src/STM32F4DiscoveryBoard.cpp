// OD4 microservice of board STM32F4DiscoveryBoard: what the board says becomes messages. Written by SenseDSL; do not edit. C++14, libcluon.
#include "cluon-complete.hpp"
#include "sense.hpp"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <exception>
#include <iostream>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "sense/fig2/STM32F4DiscoveryBoard_schema.hpp"
#include "sensedsl/connection.hpp"
#include "sensedsl/options.hpp"
#include "sensedsl/text.hpp"

namespace {

const sensedsl::BoardFacts &facts() { return ::sense::fig2::facts::STM32F4DiscoveryBoard(); }

const sensedsl::Option known[] = {
    {"cid", "SESSION", "OD4 session, 1 to 254"},
    {"device", "DEVICE", "serial device of the board, for example /dev/ttyACM0"},
    {"baud", "RATE", "of a serial link, 115200 by default; of no effect over USB"},
    {"id", "STAMP", "sender stamp of all messages; without it a sensor's identifier"},
    {"freq", "HZ", "send the latest values that often; without it each when it comes"},
    {"verbose", nullptr, "print each value"},
    {"health", "[SECONDS]", "ask the board for its health that often, each second without a\n"
                            "                        number, and print it on standard error"},
    {"no-reconnect", nullptr, "end when the device is gone, instead of waiting for it"},
    {"version", nullptr, "the design and its schema hash"},
    {"help", nullptr, "this text"},
};

struct Settings {
    std::uint16_t cid{0};
    std::string device{};
    unsigned baud{115200};
    /// Each message's own wire identifier when not given.
    bool has_sender_stamp{false};
    std::uint32_t sender_stamp{0};
    bool is_verbose{false};
    bool reconnect{true};
    /// 0: the board's health is not printed.
    std::int64_t health_ms{0};
    /// 0: each value is sent when it comes.
    float frequency_hz{0.0F};
};

class Publisher final : public sensedsl::Receiver {
public:
    Publisher(cluon::OD4Session &od4, const Settings &settings) : od4_(od4), settings_(settings) {}

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

    void on_value(std::uint8_t id, const std::uint8_t *bytes) override {
        const cluon::data::TimeStamp sampled{cluon::time::now()};
        if (!(settings_.frequency_hz > 0.0F)) {
            publish(id, bytes, sampled);
            return;
        }
        const sensedsl::Direction &sensors = facts().schema->sensors;
        for (std::size_t i{0}; i < sensors.item_count; ++i) {
            if (sensors.items[i].id == id) {
                const std::size_t size = sensors.items[i].size_bytes();
                latest_[id] = Latest{sensedsl::Bytes(bytes, bytes + size), sampled};
            }
        }
    }
    void on_health(const sensedsl::Health &health) override {
        if (settings_.health_ms > 0) {
            std::cerr << sensedsl::health_text(*facts().schema, facts().name, facts().devices, health) << std::endl;
        }
    }

    void publish(std::uint8_t id, const std::uint8_t *bytes,
                 const cluon::data::TimeStamp &sampled) {
        const std::uint32_t stamp{settings_.has_sender_stamp ? settings_.sender_stamp : id};
        switch (id) {
        case 17: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::fig2::IRFront message;
            message.raw(raw[0]);
            report("IRFront", raw, 1, false, ::sense::fig2::scaling::IRFront(), {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}, "");
            od4_.send(message, sampled, stamp);
            break;
        }
        case 18: {
            uint16_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::fig2::IRFrontRight message;
            message.raw(raw[0]);
            report("IRFrontRight", raw, 1, false, ::sense::fig2::scaling::IRFrontRight(), {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}, "");
            od4_.send(message, sampled, stamp);
            break;
        }
        case 19: {
            uint8_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::fig2::USRear message;
            message.raw(raw[0]);
            message.value(::sense::fig2::scaling::USRear().of(static_cast<double>(raw[0])));
            report("USRear", raw, 1, true, ::sense::fig2::scaling::USRear(), {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}, " cm");
            od4_.send(message, sampled, stamp);
            break;
        }
        case 20: {
            uint32_t raw[1];
            sensedsl::load_all(bytes, raw, 1);
            ::sense::fig2::WheelEncoder message;
            message.raw(raw[0]);
            report("WheelEncoder", raw, 1, false, ::sense::fig2::scaling::WheelEncoder(), {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}, "");
            od4_.send(message, sampled, stamp);
            break;
        }
        default:
            break;
        }
    }

    template <typename T>
    void report(const char *name, const T *raw, std::size_t count, bool has_value,
              const sensedsl::Scaling &scaling, const sensedsl::Limits &limits,
              const char *quantity) const {
        if (settings_.is_verbose) {
            std::cout << name << " = ";
            sensedsl::print_all(std::cout, raw, count);
            if (has_value) {
                sensedsl::print_scaled(std::cout, raw, count, scaling, quantity);
            }
            std::cout << sensedsl::outside_of(limits, raw, count, scaling, quantity) << std::endl;
        }
    }

    cluon::OD4Session &od4_;
    const Settings &settings_;
    std::map<std::uint8_t, Latest> latest_{};
};

int run(const Settings &settings) {
    cluon::OD4Session od4{settings.cid};
    Publisher publisher(od4, settings);
    sensedsl::Connection connection(facts(), publisher);
    connection.reconnect(settings.reconnect);
    connection.health_every(settings.health_ms);
    connection.open(settings.device, settings.baud);
    using Clock = std::chrono::steady_clock;
    const bool is_paced{settings.frequency_hz > 0.0F};
    const auto period = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<float>(is_paced ? 1.0F / settings.frequency_hz : 1.0F));
    auto due = Clock::now() + period;
    int timeout_ms{50};
    while (od4.isRunning() && connection.poll(timeout_ms)) {
        if (is_paced) {
            if (Clock::now() >= due) {
                publisher.publish_latest();
                due += period;
            }
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(due - Clock::now()).count();
            timeout_ms = left < 0 ? 0 : left < 50 ? static_cast<int>(left) : 50;
        }
    }
    publisher.publish_latest();
    std::cerr << connection.summary() << std::endl;
    return connection.exit_status();
}

/// What is wrong with the options; empty when nothing is.
std::string read_settings(const sensedsl::Options &options, Settings &settings) {
    settings.device = options.value("device");
    settings.is_verbose = options.has("verbose");
    settings.reconnect = !options.has("no-reconnect");
    settings.has_sender_stamp = options.has("id");
    if (!options.words().empty()) {
        return "what is " + options.words()[0] + "? see --help";
    }
    if (!sensedsl::parse(options.value("cid"), settings.cid) || settings.cid < 1 || settings.cid > 254) {
        return "which OD4 session? --cid=1 to --cid=254; see --help";
    }
    if (settings.device.empty()) {
        return "which device? for example --device=/dev/ttyACM0; see --help";
    }
    if (options.has("baud") &&
        (!sensedsl::parse(options.value("baud"), settings.baud) || settings.baud == 0)) {
        return "no baud rate: " + options.value("baud");
    }
    if (options.has("id") && !sensedsl::parse(options.value("id"), settings.sender_stamp)) {
        return "no sender stamp: " + options.value("id");
    }
    if (options.has("freq") && (!sensedsl::parse(options.value("freq"), settings.frequency_hz) ||
                                !(settings.frequency_hz >= 0.0F))) {
        return "no frequency: " + options.value("freq");
    }
    return options.read_health(settings.health_ms);
}

} // namespace

int main(int argc, char **argv) {
    sensedsl::Options options(known, sizeof known / sizeof known[0]);
    std::string problem = options.read(argc, argv);
    if (options.has("help")) {
        std::cout << "usage: " << argv[0] << " --cid=SESSION --device=DEVICE [OPTIONS]\n\n"
                  << "publishes what board " << "STM32F4DiscoveryBoard" << " says to an OD4 session\n\n"
                  << options.help()
                  << "\nexit status: 0 ended by you; 1 other firmware, or the device is gone;\n"
                  << "2 wrong call, or the device cannot be opened\n";
        return 0;
    }
    if (options.has("version")) {
        std::cout << "design fig2, board " << "STM32F4DiscoveryBoard" << ", schema 0xb2d2a70bU\n";
        return 0;
    }
    Settings settings;
    problem = problem.empty() ? read_settings(options, settings) : problem;
    if (!problem.empty()) {
        std::cerr << problem << std::endl;
        return 2;
    }
    try {
        return run(settings);
    } catch (const std::exception &error) {
        std::cerr << error.what() << std::endl;
        return 2;
    }
}
