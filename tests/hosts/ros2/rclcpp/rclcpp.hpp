// As much of rclcpp as generated nodes use. Publishers print; lines of the standard input are what others publish.
#ifndef STAND_IN_RCLCPP_HPP
#define STAND_IN_RCLCPP_HPP

#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "messages.hpp"

namespace stand_in {

struct World {
    bool is_over{false};
    std::string typed{};
    std::map<std::string, std::string> parameters{};
    std::map<std::string, std::function<void(std::istream &)>> subscriptions{};
};

inline World &world() {
    static World world;
    return world;
}

/// Hands lines of the standard input to subscriptions.
inline void listen() {
    World &here = world();
    pollfd wait{0, POLLIN, 0};
    char bytes[256];
    while (::poll(&wait, 1, 0) > 0) {
        const ssize_t count = ::read(0, bytes, sizeof bytes);
        if (count <= 0) {
            break;
        }
        here.typed.append(bytes, static_cast<std::size_t>(count));
    }
    for (auto end = here.typed.find('\n'); end != std::string::npos; end = here.typed.find('\n')) {
        std::istringstream line(here.typed.substr(0, end));
        here.typed.erase(0, end + 1);
        std::string topic;
        line >> topic;
        here.is_over = here.is_over || topic == "end";
        const auto found = here.subscriptions.find(topic);
        if (found != here.subscriptions.end()) {
            found->second(line);
        }
    }
}

inline void parse(const std::string &text, std::string &value) { value = text; }
inline void parse(const std::string &text, bool &value) { value = text == "true"; }
inline void parse(const std::string &text, std::int64_t &value) { value = std::stoll(text); }
inline void parse(const std::string &text, double &value) { value = std::stod(text); }
inline void parse(const std::string &text, std::vector<std::string> &value) { value.assign(1, text); }

} // namespace stand_in

namespace rclcpp {

inline void init(int argc, char **argv) {
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto at = word.find(":=");
        if (at != std::string::npos) {
            stand_in::world().parameters[word.substr(0, at)] = word.substr(at + 2);
        }
    }
}
inline bool ok() { return !stand_in::world().is_over; }
inline void shutdown() { stand_in::world().is_over = true; }

class Duration {
public:
    static Duration from_nanoseconds(std::int64_t nanoseconds) { return Duration(nanoseconds); }
    std::int64_t nanoseconds() const { return nanoseconds_; }

private:
    explicit Duration(std::int64_t nanoseconds) : nanoseconds_(nanoseconds) {}
    std::int64_t nanoseconds_;
};

class Time {
public:
    explicit Time(std::int64_t nanoseconds) : nanoseconds_(nanoseconds) {}
    Time operator-(const Duration &span) const { return Time(nanoseconds_ - span.nanoseconds()); }
    operator builtin_interfaces::msg::Time() const {
        builtin_interfaces::msg::Time time;
        time.sec = static_cast<std::int32_t>(nanoseconds_ / 1000000000);
        time.nanosec = static_cast<std::uint32_t>(nanoseconds_ % 1000000000);
        return time;
    }

private:
    std::int64_t nanoseconds_;
};

class QoS {
public:
    explicit QoS(std::size_t) {}
};
class SensorDataQoS : public QoS {
public:
    SensorDataQoS() : QoS(5) {}
};

class Logger {
public:
    explicit Logger(std::string name) : name_(std::move(name)) {}
    const char *get_name() const { return name_.c_str(); }

private:
    std::string name_;
};
inline Logger get_logger(const std::string &name) { return Logger(name); }

#define STAND_IN_LOG(LEVEL, LOGGER, ...)                                                                               \
    do {                                                                                                               \
        std::fprintf(stderr, "[" LEVEL "] [%s]: ", (LOGGER).get_name());                                               \
        std::fprintf(stderr, __VA_ARGS__);                                                                             \
        std::fprintf(stderr, "\n");                                                                                    \
    } while (false)
#define RCLCPP_INFO(LOGGER, ...) STAND_IN_LOG("INFO", LOGGER, __VA_ARGS__)
#define RCLCPP_WARN(LOGGER, ...) STAND_IN_LOG("WARN", LOGGER, __VA_ARGS__)
#define RCLCPP_FATAL(LOGGER, ...) STAND_IN_LOG("FATAL", LOGGER, __VA_ARGS__)

template <typename Message> class Publisher {
public:
    using SharedPtr = std::shared_ptr<Publisher<Message>>;
    explicit Publisher(std::string topic) : topic_(std::move(topic)) {}
    void publish(const Message &message) { std::cout << topic_ << " " << message << std::endl; }

private:
    std::string topic_;
};

template <typename Message> class Subscription {
public:
    using SharedPtr = std::shared_ptr<Subscription<Message>>;
};

namespace node_interfaces {
class NodeBaseInterface {
public:
    using SharedPtr = std::shared_ptr<NodeBaseInterface>;
};
} // namespace node_interfaces

class Node : public std::enable_shared_from_this<Node> {
public:
    explicit Node(std::string name) : name_(std::move(name)) {}
    virtual ~Node() = default;

    template <typename T> T declare_parameter(const std::string &name, const T &otherwise) {
        T value = otherwise;
        const auto given = stand_in::world().parameters.find(name);
        if (given != stand_in::world().parameters.end()) {
            stand_in::parse(given->second, value);
        }
        return value;
    }

    template <typename Message> typename Publisher<Message>::SharedPtr create_publisher(const std::string &topic, const QoS &) {
        return std::make_shared<Publisher<Message>>(whole(topic));
    }

    template <typename Message, typename Callback>
    typename Subscription<Message>::SharedPtr create_subscription(const std::string &topic, const QoS &, Callback callback) {
        stand_in::world().subscriptions[whole(topic)] = [callback](std::istream &words) {
            Message message;
            words >> message;
            callback(message);
        };
        return std::make_shared<Subscription<Message>>();
    }

    Time now() const {
        const auto since = std::chrono::system_clock::now().time_since_epoch();
        return Time(std::chrono::duration_cast<std::chrono::nanoseconds>(since).count());
    }
    Logger get_logger() const { return Logger(name_); }
    node_interfaces::NodeBaseInterface::SharedPtr get_node_base_interface() {
        return std::make_shared<node_interfaces::NodeBaseInterface>();
    }

private:
    std::string whole(const std::string &topic) const {
        return topic.compare(0, 1, "~") == 0 ? "/" + name_ + topic.substr(1) : topic;
    }

    std::string name_;
};

namespace executors {
class SingleThreadedExecutor {
public:
    void add_node(const node_interfaces::NodeBaseInterface::SharedPtr &) {}
    void spin_some() { stand_in::listen(); }
};
} // namespace executors

} // namespace rclcpp

#endif
