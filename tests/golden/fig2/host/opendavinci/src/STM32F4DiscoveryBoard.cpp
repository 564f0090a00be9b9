// OpenDaVINCI application of board STM32F4DiscoveryBoard: each value that the board sends is an event that goes out in a
// Container. Written by SenseDSL; do not edit.
#include "messages.h"

#include <atomic>
#include <exception>
#include <iostream>
#include <memory>
#include <string>

#include "opendavinci/generated/odcore/data/dmcp/ModuleExitCodeMessage.h"
#include "opendavinci/generated/odcore/data/dmcp/ModuleStateMessage.h"
#include "opendavinci/odcore/base/CommandLineArgument.h"
#include "opendavinci/odcore/base/CommandLineParser.h"
#include "opendavinci/odcore/base/KeyValueConfiguration.h"
#include "opendavinci/odcore/base/module/DataTriggeredConferenceClientModule.h"
#include "opendavinci/odcore/data/Container.h"
#include "opendavinci/odcore/data/TimeStamp.h"
#include "opendavinci/odcore/io/ConnectionListener.h"
#include "opendavinci/odcore/io/StringListener.h"
#include "opendavinci/odcore/io/conference/ContainerConference.h"
#include "opendavinci/odcore/wrapper/SerialPort.h"
#include "opendavinci/odcore/wrapper/SerialPortFactory.h"

#include "sense/STM32F4DiscoveryBoard_schema.hpp"

namespace {

namespace board = ::sense::STM32F4DiscoveryBoard;

using odcore::data::dmcp::ModuleExitCodeMessage;
using odcore::data::dmcp::ModuleStateMessage;

class Board final : public odcore::base::module::DataTriggeredConferenceClientModule,
                    public odcore::io::ConnectionListener,
                    public odcore::io::StringListener,
                    public sensedsl::Sink {
public:
    Board(int argc, char **argv)
        : odcore::base::module::DataTriggeredConferenceClientModule(argc, argv, "sense_STM32F4DiscoveryBoard"),
          m_decoder(board::schema(), board::schema().sensors, *this) {
        odcore::base::CommandLineParser parser;
        parser.addCommandLineArgument("device");
        parser.addCommandLineArgument("baud");
        parser.parse(argc, argv);
        odcore::base::CommandLineArgument device = parser.getCommandLineArgument("device");
        odcore::base::CommandLineArgument baud = parser.getCommandLineArgument("baud");
        if (device.isSet()) {
            m_device = device.getValue<std::string>();
        }
        if (baud.isSet()) {
            m_baud = baud.getValue<std::uint32_t>();
        }
    }

    /// Everything happens when bytes or Containers come; here is only waited for the end.
    ModuleExitCodeMessage::ModuleExitCode body() override {
        while (getModuleStateAndWaitForRemainingTimeInTimeslice() == ModuleStateMessage::RUNNING) {
            if (m_isOtherSchema) {
                std::cerr << "the board was built from another version of the design" << std::endl;
                return ModuleExitCodeMessage::SERIOUS_ERROR;
            }
            if (m_isGone) {
                std::cerr << m_device << " is gone" << std::endl;
                return ModuleExitCodeMessage::CONNECTION_LOST;
            }
        }
        return ModuleExitCodeMessage::OKAY;
    }

private:
    /// The device comes from `--device=` or, without it, from odsupercomponent's configuration.
    void setUp() override {
        if (m_device.empty()) {
            m_device = getKeyValueConfiguration().getValue<std::string>("sense_STM32F4DiscoveryBoard.device");
        }
        m_serial.reset(odcore::wrapper::SerialPortFactory::createSerialPort(m_device, m_baud));
        m_serial->setConnectionListener(this);
        m_serial->setStringListener(this);
        m_serial->start();
        send(sensedsl::hello_request(board::schema()));
    }

    void tearDown() override {
        m_serial->stop();
        m_serial->setStringListener(nullptr);
        m_serial->setConnectionListener(nullptr);
        std::clog << m_decoder.frames() << " frames, " << m_decoder.dropped_bytes()
                  << " bytes dropped" << std::endl;
    }

    void nextString(const std::string &bytes) override {
        m_decoder.feed(reinterpret_cast<const std::uint8_t *>(bytes.data()), bytes.size());
    }

    void handleConnectionError() override { m_isGone = true; }

    void on_hello(std::uint32_t hash) override { m_isOtherSchema = hash != board::schema().hash; }

    void on_value(std::uint8_t id, const std::uint8_t *bytes) override {
        if (m_isOtherSchema) {
            return;
        }
        switch (id) {
        case ::sense::IRFront::WIRE_ID: {
            ::sense::IRFront message;
            sensedsl::load_all(bytes, message.begin(), 1);
            publish(message);
            break;
        }
        case ::sense::IRFrontRight::WIRE_ID: {
            ::sense::IRFrontRight message;
            sensedsl::load_all(bytes, message.begin(), 1);
            publish(message);
            break;
        }
        case ::sense::USRear::WIRE_ID: {
            ::sense::USRear message;
            sensedsl::load_all(bytes, message.begin(), 1);
            publish(message);
            break;
        }
        case ::sense::WheelEncoder::WIRE_ID: {
            ::sense::WheelEncoder message;
            sensedsl::load_all(bytes, message.begin(), 1);
            publish(message);
            break;
        }
        default:
            break;
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
        (void)container;
    }

    void send(const sensedsl::Bytes &frame) {
        if (m_serial) {
            m_serial->send(std::string(frame.begin(), frame.end()));
        }
    }

    std::string m_device{};
    std::uint32_t m_baud{115200};
    std::unique_ptr<odcore::wrapper::SerialPort> m_serial{};
    sensedsl::Decoder m_decoder;
    std::atomic<bool> m_isOtherSchema{false};
    std::atomic<bool> m_isGone{false};
};

} // namespace

int main(int argc, char **argv) {
    try {
        Board board(argc, argv);
        return board.runModule();
    } catch (const std::exception &problem) {
        std::cerr << problem.what() << "\nusage: " << argv[0]
                  << " --cid=2..253 --freq=HZ [--device=DEVICE] [--baud=115200] [--verbose=1]"
                  << std::endl;
        return 2;
    }
}
