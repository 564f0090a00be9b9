// A board as a C++17 program has it: open it, be called with each message, look at the latest ones,
// send to its actuators. What a generated header says of one board is its messages and its facts.
#ifndef SENSEDSL_BOARD_HPP
#define SENSEDSL_BOARD_HPP

#include <atomic>
#include <cstdint>
#include <functional>
#include <iostream>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "sensedsl/connection.hpp"
#include "sensedsl/handlers.hpp"
#include "sensedsl/link.hpp"
#include "sensedsl/text.hpp"
#include "sensedsl/typed.hpp"

namespace sensedsl {

/// The messages that travel one way, in the order of the file.
template <typename... Message> struct Messages {};

/// The value of one element as the design shows it.
template <typename Message> double shown(const Message &message, std::size_t element) {
    return Message::scaling().of(static_cast<double>(message.data()[element]));
}

/// ` cm`, or nothing where the design gives no quantity.
template <typename Message> std::string quantity_suffix() {
    return *Message::quantity == '\0' ? std::string() : std::string(" ") + Message::quantity;
}

/// What of a message is outside the limits that the design gives; empty when nothing is.
template <typename Message> std::string outside_limits(const Message &message) {
    return outside_of(Message::limits, message.data(), Message::count, Message::scaling(),
                      quantity_suffix<Message>());
}

/// `USRear = 14 (28 cm)`, and what is outside the design's limits.
template <typename Message> std::ostream &print_message(std::ostream &out, const Message &message) {
    out << Message::name << " = ";
    print_all(out, message.data(), Message::count);
    if constexpr (Message::is_scaled) {
        print_scaled(out, message.data(), Message::count, Message::scaling(),
                     quantity_suffix<Message>());
    }
    return out << outside_limits(message);
}

/// Calls `handler` with the message of these bytes, if it is one of these.
template <typename Handler, typename... Message>
void dispatch(Messages<Message...>, std::uint8_t id, const std::uint8_t *bytes, Handler &&handler) {
    const auto call = [&](auto message) {
        load_all(bytes, message.data(), decltype(message)::count);
        handler(message);
    };
    (void)call;
    (void)id;
    (void)bytes;
    ((id == Message::id ? call(Message{}) : void()), ...);
}

/// Calls `handler` with each message of a stream, whoever it is from: for streams that do not come
/// from a device. An overload for `sensedsl::Hello` is told which firmware speaks, one for
/// `sensedsl::Stamp` when the report of the messages behind it was put together, one for
/// `sensedsl::Health` how the board and its devices are.
template <typename Sensors, typename Handler> class MessageDecoder final : private Sink {
public:
    MessageDecoder(const Schema &schema, Handler handler)
        : schema_(schema), handler_(std::move(handler)), decoder_(schema, schema.sensors, *this) {}
    MessageDecoder(const MessageDecoder &) = delete;
    MessageDecoder &operator=(const MessageDecoder &) = delete;

    /// Takes the next bytes of the stream, however it is cut.
    void feed(const std::uint8_t *bytes, std::size_t count) { decoder_.feed(bytes, count); }
    void feed(const Bytes &bytes) { decoder_.feed(bytes.data(), bytes.size()); }

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
    void on_hello(std::uint32_t hash) override { call(Hello{hash, hash == schema_.hash}); }
    void on_stamp(const Stamp &stamp) override { call(stamp); }
    void on_health(const Health &health) override { call(health); }
    void on_value(std::uint8_t id, const std::uint8_t *bytes) override {
        dispatch(Sensors{}, id, bytes, [this](const auto &message) { call(message); });
    }

    const Schema &schema_;
    Handler handler_;
    sensedsl::Decoder decoder_;
};

/// A sensor's latest message.
template <typename Message> struct Latest {
    Message message;
    double age_s;
    /// It is overdue: three of its cycles have passed.
    bool is_stale;
    /// When the board put its report together, since its start; 0 where the link has no stamps.
    double board_s;
};

/// Whether a command went to the board.
enum class Sent { yes, no_board, outside_limits };

/// See the generated header for the boards that there are.
template <typename Sensors, typename Actuators> class Board;

template <typename... Sensor, typename... Actuator>
class Board<Messages<Sensor...>, Messages<Actuator...>> : private Receiver {
public:
    /// The handler has an overload for each message type that is wanted (`sensedsl::Handlers` makes
    /// one of lambdas), one for `sensedsl::Note` to take what else is printed on standard error, and
    /// one for `sensedsl::Health` where that is wanted.
    template <typename Handler>
    Board(const BoardFacts &facts, Handler handler)
        : facts_(facts), connection_(facts, static_cast<Receiver &>(*this)) {
        static_assert((std::is_invocable_v<Handler &, const Sensor &> || ... || (sizeof...(Sensor) == 0)) ||
                          std::is_invocable_v<Handler &, const Note &>,
                      "the handler takes none of this board's messages");
        (set_handler<Sensor>(handler), ...);
        if constexpr (std::is_invocable_v<Handler &, const Note &>) {
            note_ = handler;
        }
        if constexpr (std::is_invocable_v<Handler &, const Health &>) {
            health_ = handler;
        }
    }
    Board(const Board &) = delete;
    Board &operator=(const Board &) = delete;

    /// Opens a serial device for this program alone, or a recording (a file, or `-`). Throws
    /// `sensedsl::OpenError` with the cause and what to do.
    void open(const std::string &device, unsigned baud) { connection_.open(device, baud); }
    /// Whether a device that goes is waited for; it is unless told otherwise.
    void reconnect(bool wanted) { connection_.reconnect(wanted); }
    /// Asks the board for its health that often; 0 for only when it is met and when a value is overdue.
    void health_every(double seconds) { connection_.health_every(static_cast<Milliseconds>(seconds * 1000.0 + 0.5)); }
    /// Whether actuators keep what they were told as long as this program runs. Without that they take
    /// their failsafe when nothing was sent for the `silence` of the design.
    void hold_commands(bool wanted) { connection_.hold_commands(wanted); }
    /// Waits up to that long, and calls the handler with what came. False when it is over.
    bool poll(int timeout_ms) { return connection_.poll(timeout_ms); }
    /// Until it is over, or `stop()` is called, which a signal handler or another thread may do.
    void run() {
        while (!is_stopped_ && poll(50)) {
        }
    }
    void stop() { is_stopped_ = true; }

    /// True while the board is there and its firmware is of this design.
    [[nodiscard]] bool is_ready() const { return connection_.is_ready(); }
    [[nodiscard]] Connection::End end() const { return connection_.end(); }
    /// 0, or 1 when the firmware is another or the device is gone for good.
    [[nodiscard]] int exit_status() const { return connection_.exit_status(); }
    [[nodiscard]] std::string summary() const { return connection_.summary(); }
    /// When the board put together the report whose messages are being handled; nothing where the link
    /// has no stamps.
    [[nodiscard]] const Moment &moment() const { return connection_.moment(); }
    /// Reports that were lost so far, as the counters of stamps tell.
    [[nodiscard]] std::uint64_t lost_reports() const { return connection_.lost_reports(); }
    /// Health as a text of several lines.
    [[nodiscard]] std::string text(const Health &health) const {
        return health_text(*facts_.schema, facts_.name, facts_.devices, health);
    }

    /// The latest message of a sensor; nothing before the first. For the thread that polls.
    template <typename Message> [[nodiscard]] std::optional<Latest<Message>> latest() const {
        const auto &latest = std::get<Kept<Message>>(latest_);
        if (!latest.message) {
            return std::nullopt;
        }
        const std::size_t at = place(Message::id);
        const double age_s = static_cast<double>(connection_.age_ms(at)) / 1000.0;
        return Latest<Message>{*latest.message, age_s, connection_.is_stale(at),
                               static_cast<double>(latest.board_us) / 1e6};
    }

    /// Sends to an actuator; from any thread. A value outside the design's limits is not sent.
    template <typename Message> Sent send(const Message &command) {
        static_assert((std::is_same_v<Message, Actuator> || ...), "this board has no such actuator");
        if (!outside_limits(command).empty()) {
            return Sent::outside_limits;
        }
        Report report(*facts_.schema, facts_.schema->actuators);
        report.set(Message::id, command.data(), Message::count);
        return connection_.send(report.frame()) ? Sent::yes : Sent::no_board;
    }

    /// Sends what a line `NAME VALUE...` says: values as they are shown, codes behind `raw`, a unit behind
    /// a number. Why it was not sent; empty when it was, and then `sent` is what the line has become.
    std::string send_line(const std::string &line, std::string *sent = nullptr) {
        (void)sent;
        std::istringstream words(line);
        std::string name;
        words >> name;
        std::string problem = "no actuator is called " + name + "; there are:";
        ((problem += std::string(" ") + Actuator::name), ...);
        ((name == Actuator::name ? void(problem = send_words<Actuator>(words, sent)) : void()), ...);
        return problem;
    }

    /// A line for each device: what it is and what is expected of it.
    static std::string devices() {
        std::ostringstream text;
        ((text << "  sensor   " << Sensor::summary << "\n"), ...);
        ((text << "  actuator " << Actuator::summary << "\n"), ...);
        return text.str();
    }

private:
    template <typename Message> struct Kept {
        std::optional<Message> message{};
        std::uint64_t board_us{0};
    };

    template <typename Message, typename Handler> void set_handler(Handler &handler) {
        if constexpr (std::is_invocable_v<Handler &, const Message &>) {
            std::get<std::function<void(const Message &)>>(handlers_) = handler;
        }
    }

    template <typename Message> std::string send_words(std::istream &words, std::string *sent) {
        Message command;
        const std::vector<TypedValue> typed = typed_values(words);
        if (typed.size() < Message::count) {
            return std::string(Message::name) + " takes " + std::to_string(Message::count) +
                   (Message::count == 1 ? " value" : " values");
        }
        for (std::size_t i = 0; i < Message::count; ++i) {
            const std::string problem = read_value(typed[i], command, i);
            if (!problem.empty()) {
                return problem;
            }
        }
        if (typed.size() > Message::count) {
            return "what is " + typed[Message::count].number + "? " + Message::name + " takes " +
                   std::to_string(Message::count) + (Message::count == 1 ? " value" : " values");
        }
        if (sent != nullptr) {
            std::ostringstream text;
            text << command;
            *sent = text.str();
        }
        switch (send(command)) {
        case Sent::no_board:
            return "the board is not there";
        case Sent::outside_limits: {
            std::ostringstream text;
            text << command;
            return text.str();
        }
        case Sent::yes:
        default:
            return {};
        }
    }

    void on_value(std::uint8_t id, const std::uint8_t *bytes) override {
        dispatch(Messages<Sensor...>{}, id, bytes, [this](const auto &message) {
            using Message = std::decay_t<decltype(message)>;
            std::get<Kept<Message>>(latest_) = {message, connection_.moment().board_us};
            if (const auto &handler = std::get<std::function<void(const Message &)>>(handlers_)) {
                handler(message);
            }
        });
    }

    void on_note(const std::string &text) override {
        if (note_) {
            note_(Note{text});
        } else {
            std::cerr << text << std::endl;
        }
    }

    void on_health(const Health &health) override {
        if (health_) {
            health_(health);
        }
    }

    static std::size_t place(std::uint8_t id) {
        std::size_t at = 0;
        std::size_t found = 0;
        ((Sensor::id == id ? void(found = at) : void(), ++at), ...);
        return found;
    }

    const BoardFacts &facts_;
    std::tuple<std::function<void(const Sensor &)>...> handlers_{};
    std::function<void(const Note &)> note_{};
    std::function<void(const Health &)> health_{};
    std::tuple<Kept<Sensor>...> latest_{};
    std::atomic<bool> is_stopped_{false};
    Connection connection_;
};

} // namespace sensedsl

#endif
