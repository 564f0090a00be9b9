// Prints what board STM32F4DiscoveryBoard says. Written by SenseDSL; do not edit: copy it
// to start a program of your own.
#include "sense/fig2/STM32F4DiscoveryBoard.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>

#include "sensedsl/options.hpp"

namespace {

using Board = ::sense::fig2::STM32F4DiscoveryBoard;

std::atomic<bool> stopped{false};

extern "C" void stop(int) { stopped = true; }

const sensedsl::Option known[] = {
    {"baud", "RATE", "of a serial link, 115200 by default; of no effect over USB"},
    {"health", "[SECONDS]", "ask the board for its health that often, each second without a\n"
                            "                        number, and print it"},
    {"no-reconnect", nullptr, "end when the device is gone, instead of waiting for it"},
    {"version", nullptr, "the design and its schema hash"},
    {"help", nullptr, "this text"},
};

int run(const sensedsl::Options &options, const std::string &device, unsigned baud, std::int64_t health_ms) {
    Board *self = nullptr;
    Board board(sensedsl::Handlers{
        [](const auto &message) { std::cout << message << "\n"; },
        [&](const sensedsl::Health &health) {
            if (health_ms > 0) {
                std::cout << self->text(health) << "\n";
            }
        },
        [](const sensedsl::Note &note) { std::cerr << note.text << std::endl; },
    });
    self = &board;
    board.reconnect(!options.has("no-reconnect"));
    board.health_every(static_cast<double>(health_ms) / 1000.0);
    board.open(device, baud);
    while (!stopped && board.poll(50)) {
        std::cout.flush();
    }
    std::cout.flush();
    std::cerr << board.summary() << std::endl;
    return board.exit_status();
}

} // namespace

int main(int argc, char **argv) {
    sensedsl::Options options(known, std::size(known));
    std::string problem = options.read(argc, argv);
    if (options.has("help")) {
        std::cout << "usage: " << argv[0] << " [OPTIONS] DEVICE|FILE|- [RATE]\n\n"
                  << "prints what board " << "STM32F4DiscoveryBoard" << " says; plays a recorded FILE or standard input\n"
                  << "\n" << options.help() << "\n" << Board::devices()
                  << "\nexit status: 0 ended by you or the recording; 1 other firmware, or the device is gone;\n"
                  << "2 wrong call, or the device cannot be opened\n";
        return 0;
    }
    if (options.has("version")) {
        std::cout << "design fig2, board " << "STM32F4DiscoveryBoard" << ", schema 0xb2d2a70bU\n";
        return 0;
    }
    unsigned baud = Board::default_baud;
    const auto words = options.words().size();
    const std::string rate = words == 2 ? options.words()[1] : options.value("baud");
    if (problem.empty() && (words < 1 || words > 2)) {
        problem = "which device? for example: " + std::string(argv[0]) + " /dev/ttyACM0";
    }
    if (problem.empty() && !rate.empty() && (!sensedsl::parse(rate, baud) || baud == 0)) {
        problem = "no baud rate: " + rate;
    }
    std::int64_t health_ms = 0;
    problem = problem.empty() ? options.read_health(health_ms) : problem;
    if (!problem.empty()) {
        std::cerr << problem << std::endl;
        return 2;
    }
    std::signal(SIGINT, stop);
    std::signal(SIGTERM, stop);
    try {
        return run(options, options.words()[0], baud, health_ms);
    } catch (const std::exception &error) {
        std::cerr << error.what() << std::endl;
        return 2;
    }
}
