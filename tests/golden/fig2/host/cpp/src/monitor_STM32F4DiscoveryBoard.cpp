// Prints what board STM32F4DiscoveryBoard says. Written by SenseDSL; do not edit: copy it
// to start a program of your own.
#include "sense/STM32F4DiscoveryBoard.hpp"

#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include "sensedsl/serial.hpp"

namespace {

namespace board = ::sense::STM32F4DiscoveryBoard;

volatile std::sig_atomic_t stopped = 0;

extern "C" void stop(int) { stopped = 1; }

int run(const std::string &device, unsigned baud) {
    bool is_other_schema = false;
    board::Decoder decoder(sensedsl::Handlers{
        [&is_other_schema](const auto &message) {
            if (!is_other_schema) {
                std::cout << message << "\n";
            }
        },
        [&is_other_schema](const sensedsl::Hello &hello) {
            is_other_schema = !hello.is_same_schema;
        },
    });
    sensedsl::Serial serial(device, baud);
    if (serial.is_terminal() && !serial.write(board::hello_request())) {
        std::cerr << "the board does not take bytes\n";
    }
    sensedsl::Bytes bytes;
    while (stopped == 0 && !is_other_schema) {
        const sensedsl::Serial::State state = serial.read(bytes, 100);
        decoder.feed(bytes);
        std::cout.flush();
        if (state == sensedsl::Serial::ended) {
            break;
        }
    }
    std::cerr << decoder.frames() << " frames, " << decoder.dropped_bytes() << " bytes dropped\n";
    if (is_other_schema) {
        std::cerr << "the board was built from another version of the design\n";
        return 1;
    }
    return 0;
}

} // namespace

int main(int argc, char **argv) {
    if (argc < 2 || argc > 3) {
        std::cerr << "usage: " << argv[0] << " DEVICE|FILE|- [BAUD]\n";
        return 2;
    }
    std::signal(SIGINT, stop);
    std::signal(SIGTERM, stop);
    unsigned baud = 115200;
    if (argc == 3 && !sensedsl::parse(argv[2], baud)) {
        std::cerr << "no baud rate: " << argv[2] << "\n";
        return 2;
    }
    try {
        return run(argv[1], baud);
    } catch (const std::exception &problem) {
        std::cerr << problem.what() << "\n";
        return 2;
    }
}
