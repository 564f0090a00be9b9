// OpenDaVINCI application of board STM32F4DiscoveryBoard: each value that the board sends is an event that goes out in a
// Container. Written by SenseDSL; do not edit.
#include "messages.h"

#include <exception>
#include <iostream>
#include <memory>
#include <string>

#include "core/base/CommandLineArgument.h"
#include "core/base/CommandLineParser.h"
#include "core/base/ConferenceClientModule.h"
#include "core/base/ModuleState.h"
#include "core/exceptions/Exceptions.h"
#include "core/wrapper/ConnectionListener.h"
#include "core/wrapper/PartialStringReceiver.h"
#include "core/wrapper/SerialPort.h"
#include "core/wrapper/SerialPortFactory.h"

#include "sense/STM32F4DiscoveryBoard_schema.hpp"

namespace {

namespace board = ::sense::STM32F4DiscoveryBoard;

class Board : public core::base::ConferenceClientModule,
              public core::wrapper::ConnectionListener,
              public core::wrapper::PartialStringReceiver,
              public sensedsl::Sink {
public:
    Board(int argc, char **argv)
        : core::base::ConferenceClientModule(argc, argv, "sense_STM32F4DiscoveryBoard"), m_device(),
          m_baud(115200), m_serial(), m_decoder(board::schema(), board::schema().sensors, *this),
          m_isOtherSchema(false), m_isGone(false) {
        core::base::CommandLineParser parser;
        parser.addCommandLineArgument("device");
        parser.addCommandLineArgument("baud");
        parser.parse(argc, argv);
        core::base::CommandLineArgument device = parser.getCommandLineArgument("device");
        core::base::CommandLineArgument baud = parser.getCommandLineArgument("baud");
        if (device.isSet()) {
            m_device = device.getValue<std::string>();
        }
        if (baud.isSet()) {
            m_baud = baud.getValue<uint32_t>();
        }
    }

private:
    Board(const Board &);
    Board &operator=(const Board &);

    /// The device comes from `--device=` or, without it, from supercomponent's configuration.
    virtual void setUp() {
        if (m_device.empty()) {
            m_device = getKeyValueConfiguration().getValue<std::string>("sense_STM32F4DiscoveryBoard.device");
        }
        m_serial.reset(core::wrapper::SerialPortFactory::createSerialPort(m_device, m_baud));
        m_serial->setConnectionListener(this);
        m_serial->setPartialStringReceiver(this);
        m_serial->start();
        send(sensedsl::hello_request(board::schema()));
    }

    virtual void tearDown() {
        m_serial->stop();
        m_serial->setPartialStringReceiver(NULL);
        m_serial->setConnectionListener(NULL);
        std::clog << m_decoder.frames() << " frames, " << m_decoder.dropped_bytes()
                  << " bytes dropped" << std::endl;
    }

    /// Everything happens when bytes or Containers come; here is only waited for the end.
    virtual core::base::ModuleState::MODULE_EXITCODE body() {
        while (getModuleState() == core::base::ModuleState::RUNNING) {
            if (m_isOtherSchema) {
                std::cerr << "the board was built from another version of the design" << std::endl;
                return core::base::ModuleState::SERIOUS_ERROR;
            }
            if (m_isGone) {
                std::cerr << m_device << " is gone" << std::endl;
                return core::base::ModuleState::CONNECTION_LOST;
            }
        }
        return core::base::ModuleState::OKAY;
    }

    virtual void receivedPartialString(const std::string &bytes) {
        m_decoder.feed(reinterpret_cast<const uint8_t *>(bytes.data()), bytes.size());
    }

    virtual void handleConnectionError() { m_isGone = true; }

    virtual void on_hello(uint32_t hash) { m_isOtherSchema = hash != board::schema().hash; }

    virtual void on_value(uint8_t id, const uint8_t *bytes) {
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
        core::data::Container container(Message::ID(), message);
        getConference().send(container);
    }

    virtual void nextContainer(core::data::Container &container) {
        core::base::ConferenceClientModule::nextContainer(container);
    }

    void send(const sensedsl::Bytes &frame) {
        if (m_serial.get() != NULL) {
            m_serial->send(std::string(frame.begin(), frame.end()));
        }
    }

    std::string m_device;
    uint32_t m_baud;
    std::auto_ptr<core::wrapper::SerialPort> m_serial;
    sensedsl::Decoder m_decoder;
    volatile bool m_isOtherSchema;
    volatile bool m_isGone;
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
