// What the nodes of boards have in common in ROS 2: parameters, headers, diagnostics, the loop.
//
// In: a board's facts, its notes and health. Out: parameters of the node, log lines, diagnostics each second. C++17,
// rclcpp from Humble on.
#ifndef SENSEDSL_ROS2_HPP
#define SENSEDSL_ROS2_HPP

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <diagnostic_msgs/msg/diagnostic_array.hpp>
#include <diagnostic_msgs/msg/diagnostic_status.hpp>
#include <diagnostic_msgs/msg/key_value.hpp>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/header.hpp>

#include "sensedsl/board.hpp"

namespace sensedsl {

/// How messages of distances say what they are measured with; the numbers are those of sensor_msgs/Range.
enum class Radiation : std::uint8_t { ultrasound = 0, infrared = 1 };

/// What the parameters of a node say of its messages.
class RosSettings {
public:
    /// Declares the parameters.
    RosSettings(rclcpp::Node &node, const BoardFacts &facts)
        : frame_(node.declare_parameter<std::string>("frame", facts.name)),
          infrared_(node.declare_parameter<std::vector<std::string>>("infrared", std::vector<std::string>())) {
        for (std::size_t i = 0; i < facts.schema->device_count; ++i) {
            const std::string name = facts.devices[i].name;
            frames_[name] = node.declare_parameter<std::string>("frames." + name, std::string());
        }
    }

    /// The frame of a device: that of the board, unless a parameter says otherwise.
    [[nodiscard]] const std::string &frame(const std::string &device) const {
        const auto own = frames_.find(device);
        return own == frames_.end() || own->second.empty() ? frame_ : own->second;
    }

    [[nodiscard]] std::uint8_t radiation_type(const std::string &device) const {
        const bool is_infrared = std::find(infrared_.begin(), infrared_.end(), device) != infrared_.end();
        return static_cast<std::uint8_t>(is_infrared ? Radiation::infrared : Radiation::ultrasound);
    }

private:
    std::string frame_;
    std::vector<std::string> infrared_;
    std::map<std::string, std::string> frames_{};
};

/// A node of one board.
class RosNode : public rclcpp::Node {
public:
    RosNode(const std::string &name, const BoardFacts &facts, unsigned baud)
        : rclcpp::Node(name), settings(*this, facts), facts_(facts),
          port_(declare_parameter<std::string>("port", "/dev/ttyACM0")),
          baud_(static_cast<unsigned>(declare_parameter<std::int64_t>("baud", static_cast<std::int64_t>(baud)))),
          reconnects_(declare_parameter<bool>("reconnect", true)),
          holds_(declare_parameter<bool>("hold_commands", false)),
          health_s_(declare_parameter<double>("health_s", rarely_s(facts))),
          diagnostics_(create_publisher<diagnostic_msgs::msg::DiagnosticArray>("/diagnostics", rclcpp::QoS(10))) {}

protected:
    /// When a value was taken, by the board's clock where the link has stamps, and where.
    [[nodiscard]] std_msgs::msg::Header header(const char *device, std::int64_t late_us) const {
        std_msgs::msg::Header header;
        header.stamp = now() - rclcpp::Duration::from_nanoseconds(late_us * 1000);
        header.frame_id = settings.frame(device);
        return header;
    }

    /// Says why a command was not sent.
    void tell(const char *device, Sent sent) const {
        if (sent == Sent::no_board) {
            RCLCPP_WARN(get_logger(), "%s: not sent: the board is not there", device);
        } else if (sent == Sent::outside_limits) {
            RCLCPP_WARN(get_logger(), "%s: not sent: beyond the limits of the design or of its type", device);
        }
    }

    void take(const Health &health) { health_ = health; }
    void take(const Note &note) const { RCLCPP_INFO(get_logger(), "%s", note.text.c_str()); }

    /// Until ROS ends, or the board is gone for good. Returns the exit status.
    template <typename BoardOfNode> int run_board(BoardOfNode &board) {
        using Clock = std::chrono::steady_clock;
        board.reconnect(reconnects_);
        board.hold_commands(holds_);
        board.health_every(health_s_);
        board.open(port_, baud_);
        rclcpp::executors::SingleThreadedExecutor executor;
        executor.add_node(get_node_base_interface());
        auto due = Clock::now();
        while (rclcpp::ok() && board.poll(10)) {
            executor.spin_some();
            if (Clock::now() >= due) {
                due += std::chrono::seconds(1);
                diagnose(board.is_ready(), board.lost_reports());
            }
        }
        RCLCPP_INFO(get_logger(), "%s", board.summary().c_str());
        return board.exit_status();
    }

    const RosSettings settings;

private:
    using Status = diagnostic_msgs::msg::DiagnosticStatus;

    /// Questions for health hold commands, where they come more often than the silence of the design.
    static double rarely_s(const BoardFacts &facts) {
        return std::max(1.0, 2.0 * static_cast<double>(facts.silence_ms) / 1000.0);
    }

    void diagnose(bool is_ready, std::uint64_t lost_reports) {
        diagnostic_msgs::msg::DiagnosticArray all;
        all.header.stamp = now();
        Status board = status(facts_.name, is_ready ? Status::OK : Status::ERROR,
                              is_ready ? "firmware and design agree" : "the board is not there");
        add(board, "port", port_);
        add(board, "lost reports", std::to_string(lost_reports));
        if (is_ready && health_) {
            add(board, "up", span_text(health_->uptime_ms));
            add(board, "started by", reset_text(*facts_.schema, facts_.devices, *health_));
            add(board, "reports sent", std::to_string(health_->reports_sent));
            add(board, "reports refused", std::to_string(health_->reports_refused));
            if (health_->load_percent != unknown_load) {
                add(board, "load in %", std::to_string(health_->load_percent));
            }
        }
        all.status.push_back(board);
        for (std::size_t i = 0; is_ready && health_ && i < health_->devices.size(); ++i) {
            all.status.push_back(of_device(facts_.devices[i], health_->devices[i]));
        }
        diagnostics_->publish(all);
    }

    [[nodiscard]] Status of_device(const DeviceFacts &facts, const DeviceHealth &health) const {
        unsigned char level = Status::ERROR;
        if (health.status == status_good || (health.status == status_never && facts.is_actuator)) {
            level = Status::OK;
        } else if (health.status == status_stale || health.status == status_never) {
            level = Status::STALE;
        }
        Status one = status(std::string(facts_.name) + ": " + facts.name, level,
                            status_text(health.status, facts.is_actuator));
        if (health.age_ms != never_ms) {
            add(one, "age", span_text(health.age_ms));
        }
        const std::string causes = causes_text(health);
        if (!causes.empty()) {
            add(one, "failures", causes);
        }
        return one;
    }

    [[nodiscard]] Status status(const std::string &name, unsigned char level, const std::string &message) const {
        Status one;
        one.name = name;
        one.level = level;
        one.message = message;
        one.hardware_id = facts_.name;
        return one;
    }

    static void add(Status &status, const std::string &key, const std::string &value) {
        diagnostic_msgs::msg::KeyValue pair;
        pair.key = key;
        pair.value = value;
        status.values.push_back(pair);
    }

    const BoardFacts &facts_;
    std::string port_;
    unsigned baud_;
    bool reconnects_;
    bool holds_;
    double health_s_;
    rclcpp::Publisher<diagnostic_msgs::msg::DiagnosticArray>::SharedPtr diagnostics_;
    std::optional<Health> health_{};
};

} // namespace sensedsl

#endif
