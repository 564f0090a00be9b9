// OpenDaVINCI application of board Rover: each value that the board sends is an event that goes out in a
// Container, and Containers for its actuators go to the board. Written by SenseDSL; do not edit.
#include "messages.h"

#include <exception>
#include <iostream>
#include <set>
#include <string>

#include "opendavinci/generated/odcore/data/dmcp/ModuleExitCodeMessage.h"
#include "opendavinci/generated/odcore/data/dmcp/ModuleStateMessage.h"
#include "opendavinci/odcore/base/KeyValueConfiguration.h"
#include "opendavinci/odcore/base/module/DataTriggeredConferenceClientModule.h"
#include "opendavinci/odcore/data/Container.h"
#include "opendavinci/odcore/data/TimeStamp.h"
#include "opendavinci/odcore/io/conference/ContainerConference.h"

#include "sense/curves/Rover_schema.hpp"
#include "sensedsl/options.hpp"
#include "sensedsl/thread.hpp"

namespace {

const sensedsl::BoardFacts &facts() { return ::sense::curves::facts::Rover(); }

using odcore::data::dmcp::ModuleExitCodeMessage;
using odcore::data::dmcp::ModuleStateMessage;

const sensedsl::Option known[] = {
    {"cid", "SESSION", "conference, 2 to 253"},
    {"freq", "HZ", "how often the module looks at its own state"},
    {"device", "DEVICE", "serial device of the board; without it the configuration's key\n"
                         "                        curves_Rover.device"},
    {"baud", "RATE", "of a serial link, 115200 by default; of no effect over USB"},
    {"id", "NUMBER", "tells several modules of one name apart"},
    {"verbose", "1", "print each value"},
    {"health", "[SECONDS]", "ask the board for its health that often, each second without a\n"
                            "                        number, and print it on standard error"},
    {"profiling", "1", "OpenDaVINCI's own"},
    {"realtime", "PRIORITY", "OpenDaVINCI's own"},
    {"no-reconnect", nullptr, "end when the device is gone, instead of waiting for it"},
    {"version", nullptr, "the design and its schema hash"},
    {"help", nullptr, "this text"},
};

/// Values come from the connection's thread, Containers from the conference's.
class Board final : public odcore::base::module::DataTriggeredConferenceClientModule,
                    public sensedsl::Receiver {
public:
    Board(int argc, char **argv, const sensedsl::Options &options, unsigned baud, int64_t healthMs)
        : odcore::base::module::DataTriggeredConferenceClientModule(argc, argv,
                                                                    "curves_Rover"),
          m_device(options.value("device")), m_baud(baud), m_isHealthPrinted(healthMs > 0), m_connection(facts(), *this),
          m_thread(m_connection) {
        m_connection.reconnect(!options.has("no-reconnect"));
        m_connection.health_every(healthMs);
    }

    /// 1 when the firmware is another or the device is gone, 2 when it cannot be opened, otherwise 0.
    int exitStatus() const { return m_isOpen ? m_connection.exit_status() : m_isRefused ? 2 : 0; }

    /// Everything happens when bytes or Containers come; here is only waited for the end.
    ModuleExitCodeMessage::ModuleExitCode body() override {
        if (m_isRefused) {
            return ModuleExitCodeMessage::SERIOUS_ERROR;
        }
        while (getModuleStateAndWaitForRemainingTimeInTimeslice() == ModuleStateMessage::RUNNING) {
            switch (m_connection.end()) {
            case sensedsl::Connection::other_firmware:
                return ModuleExitCodeMessage::SERIOUS_ERROR;
            case sensedsl::Connection::device_gone:
                return ModuleExitCodeMessage::CONNECTION_LOST;
            case sensedsl::Connection::recording_over:
                return ModuleExitCodeMessage::OKAY;
            case sensedsl::Connection::none:
            default:
                break;
            }
        }
        return ModuleExitCodeMessage::OKAY;
    }

private:
    /// The device comes from `--device=` or, without it, from odsupercomponent's configuration.
    void setUp() override {
        if (m_device.empty()) {
            m_device = getKeyValueConfiguration().getValue<std::string>("curves_Rover.device");
        }
        try {
            m_connection.open(m_device, m_baud);
            m_isOpen = true;
        } catch (const std::exception &error) {
            std::cerr << error.what() << std::endl;
            m_isRefused = true;
            return;
        }
        m_thread.start();
    }

    void tearDown() override {
        m_thread.stop();
        std::clog << m_connection.summary() << std::endl;
    }

    void on_value(std::uint8_t id, const std::uint8_t *bytes) override {
        switch (id) {
        case ::sense::curves::Ranger::WIRE_ID: {
            ::sense::curves::Ranger message;
            sensedsl::load_all(bytes, message.begin(), 1);
            publish(message);
            break;
        }
        case ::sense::curves::Line::WIRE_ID: {
            ::sense::curves::Line message;
            sensedsl::load_all(bytes, message.begin(), 8);
            publish(message);
            break;
        }
        case ::sense::curves::Bumper::WIRE_ID: {
            ::sense::curves::Bumper message;
            sensedsl::load_all(bytes, message.begin(), 3);
            publish(message);
            break;
        }
        case ::sense::curves::Wheels::WIRE_ID: {
            ::sense::curves::Wheels message;
            sensedsl::load_all(bytes, message.begin(), 2);
            publish(message);
            break;
        }
        case ::sense::curves::Bent::WIRE_ID: {
            ::sense::curves::Bent message;
            sensedsl::load_all(bytes, message.begin(), 1);
            publish(message);
            break;
        }
        case ::sense::curves::Acceleration::WIRE_ID: {
            ::sense::curves::Acceleration message;
            sensedsl::load_all(bytes, message.begin(), 3);
            publish(message);
            break;
        }
        case ::sense::curves::Rate::WIRE_ID: {
            ::sense::curves::Rate message;
            sensedsl::load_all(bytes, message.begin(), 3);
            publish(message);
            break;
        }
        case ::sense::curves::Position::WIRE_ID: {
            ::sense::curves::Position message;
            sensedsl::load_all(bytes, message.begin(), 1);
            publish(message);
            break;
        }
        default:
            break;
        }
    }
    void on_health(const sensedsl::Health &health) override {
        if (m_isHealthPrinted) {
            std::cerr << sensedsl::health_text(*facts().schema, facts().name, facts().devices, health) << std::endl;
        }
    }

    template <typename Message> void publish(const Message &message) {
        if (isVerbose()) {
            std::cout << message.toString() << std::endl;
        }
        odcore::data::Container container(message);
        container.setSampleTimeStamp(odcore::data::TimeStamp());
        container.setSenderStamp(Message::WIRE_ID);
        getConference().send(container);
    }

    void nextContainer(odcore::data::Container &container) override {
        if (container.getDataType() == ::sense::curves::Escs::ID()) {
            command(container.getData< ::sense::curves::Escs>());
        }
        if (container.getDataType() == ::sense::curves::Lamps::ID()) {
            command(container.getData< ::sense::curves::Lamps>());
        }
        if (container.getDataType() == ::sense::curves::Winch::ID()) {
            command(container.getData< ::sense::curves::Winch>());
        }
        if (container.getDataType() == ::sense::curves::Speed::ID()) {
            command(container.getData< ::sense::curves::Speed>());
        }
    }

    /// A value outside the design's limits is not sent. A problem is told once, until that actuator
    /// takes a command again.
    template <typename Message> void command(const Message &message) {
        const auto refused = message.refused();
        sensedsl::Report report(*facts().schema, facts().schema->actuators);
        const std::uint8_t id = Message::WIRE_ID;
        report.set(id, message.begin(), Message::COUNT);
        if (refused.empty() && m_connection.send(report.frame())) {
            m_told.erase(id);
        } else if (m_told.insert(id).second) {
            std::cerr << Message::ShortName() << ": not sent:"
                      << (refused.empty() ? " the board is not there" : refused) << std::endl;
        }
    }

    std::string m_device;
    unsigned m_baud;
    bool m_isHealthPrinted;
    std::set<std::uint8_t> m_told{};
    bool m_isOpen{false};
    bool m_isRefused{false};
    sensedsl::Connection m_connection;
    sensedsl::ConnectionThread m_thread;
};

} // namespace

int main(int argc, char **argv) {
    sensedsl::Options options(known, sizeof known / sizeof known[0]);
    std::string problem = options.read(argc, argv);
    if (options.has("help")) {
        std::cout << "usage: " << argv[0] << " --cid=SESSION --freq=HZ --device=DEVICE [OPTIONS]\n\n"
                  << "sends what board " << "Rover" << " says to an OpenDaVINCI conference\n\n"
                  << options.help()
                  << "\nexit status: 0 ended by you or supercomponent; 1 other firmware, or the device is gone;\n"
                  << "2 wrong call, or the device cannot be opened; 4 no supercomponent\n";
        return 0;
    }
    if (options.has("version")) {
        std::cout << "design curves, board " << "Rover" << ", schema 0x0ca56b7cU\n";
        return 0;
    }
    unsigned baud = 115200;
    if (problem.empty() && !options.words().empty()) {
        problem = "what is " + options.words()[0] + "? see --help";
    }
    if (problem.empty() && (!options.has("cid") || !options.has("freq"))) {
        problem = "which conference, and how often? --cid=2..253 --freq=HZ; see --help";
    }
    if (problem.empty() && options.has("baud") && (!sensedsl::parse(options.value("baud"), baud) || baud == 0)) {
        problem = "no baud rate: " + options.value("baud");
    }
    int64_t health_ms = 0;
    problem = problem.empty() ? options.read_health(health_ms) : problem;
    if (!problem.empty()) {
        std::cerr << problem << std::endl;
        return 2;
    }
    try {
        Board board(argc, argv, options, baud, health_ms);
        const int code = board.runModule();
        return board.exitStatus() != 0 ? board.exitStatus() : code;
    } catch (const std::exception &error) {
        std::cerr << error.what() << std::endl;
        return 2;
    }
}
