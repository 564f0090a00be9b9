// Prints what board Rover says and sends it what is typed. Written by SenseDSL; do not edit: copy it
// to start a program of your own.
#include "sense/curves/Rover.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <exception>
#include <iostream>
#include <string>

#include "sensedsl/options.hpp"

namespace {

using Board = ::sense::curves::Rover;

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

/// Sends the lines typed since the last time. False when there will be no more.
bool send_typed_lines(Board &board, sensedsl::Serial &input, std::string &typed) {
    sensedsl::Bytes bytes;
    const auto state = input.read(bytes, 0);
    typed.append(bytes.begin(), bytes.end());
    for (auto end = typed.find('\n'); end != std::string::npos; end = typed.find('\n')) {
        const std::string line = typed.substr(0, end);
        std::string sent;
        const std::string problem = board.send_line(line, &sent);
        if (!line.empty() && !problem.empty()) {
            std::cerr << "not sent: " << line << ": " << problem << std::endl;
        } else if (!line.empty()) {
            std::cerr << "sent: " << sent << std::endl;
        }
        typed.erase(0, end + 1);
    }
    return state != sensedsl::Serial::ended;
}

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
    // What was typed stays until something else is, or this program ends.
    board.hold_commands(true);
    board.open(device, baud);
    sensedsl::Serial input("-", 0);
    std::string typed;
    bool is_typing = device != "-";
    while (!stopped && board.poll(50)) {
        std::cout.flush();
        is_typing = is_typing && send_typed_lines(board, input, typed);
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
                  << "prints what board " << "Rover" << " says; plays a recorded FILE or standard input\n"
                  << "a typed line NAME VALUE... goes to the actuator of that name: values as they\n"
                  << "are shown, with or without their unit; NAME raw CODE... gives codes of the wire\n"
                  << "\n" << options.help() << "\n" << Board::devices()
                  << "\nexit status: 0 ended by you or the recording; 1 other firmware, or the device is gone;\n"
                  << "2 wrong call, or the device cannot be opened\n";
        return 0;
    }
    if (options.has("version")) {
        std::cout << "design curves, board " << "Rover" << ", schema 0x0ca56b7cU\n";
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
