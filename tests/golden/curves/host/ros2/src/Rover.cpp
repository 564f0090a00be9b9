// Node of board Rover: what its sensors say is published, and its actuators are subscriptions.
// Written by SenseDSL; do not edit. C++17, ROS 2.
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>

#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/imu.hpp>
#include <sensor_msgs/msg/range.hpp>
#include <std_msgs/msg/float64.hpp>
#include <std_msgs/msg/float64_multi_array.hpp>
#include <std_msgs/msg/u_int8_multi_array.hpp>

#include "sense/curves/Rover.hpp"
#include "sensedsl/ros2.hpp"

namespace {

using Board = ::sense::curves::Rover;

class Node final : public sensedsl::RosNode {
    // Before the constructor, which needs to know its type.
    auto handlers() {
        return sensedsl::Handlers{
            [this](const ::sense::curves::Ranger &in) { publish_Ranger(in); },
            [this](const ::sense::curves::Line &in) { publish_Line(in); },
            [this](const ::sense::curves::Bumper &in) { publish_Bumper(in); },
            [this](const ::sense::curves::Wheels &in) { publish_Wheels(in); },
            [this](const ::sense::curves::Bent &in) { publish_Bent(in); },
            [this](const ::sense::curves::Acceleration &in) { publish_Acceleration(in); },
            [this](const ::sense::curves::Rate &in) { publish_Rate(in); },
            [this](const ::sense::curves::Position &in) { publish_Position(in); },
            [this](const sensedsl::Health &health) { take(health); },
            [this](const sensedsl::Note &note) { take(note); },
        };
    }

public:
    Node() : RosNode("rover", ::sense::curves::facts::Rover(), Board::default_baud), board_(handlers()) {
        publisher_Ranger = create_publisher<sensor_msgs::msg::Range>("~/Ranger", rclcpp::SensorDataQoS());
        publisher_Line = create_publisher<std_msgs::msg::Float64MultiArray>("~/Line", rclcpp::SensorDataQoS());
        publisher_Bumper = create_publisher<std_msgs::msg::UInt8MultiArray>("~/Bumper", rclcpp::SensorDataQoS());
        publisher_Wheels = create_publisher<std_msgs::msg::Float64MultiArray>("~/Wheels", rclcpp::SensorDataQoS());
        publisher_Bent = create_publisher<std_msgs::msg::Float64>("~/Bent", rclcpp::SensorDataQoS());
        publisher_Acceleration = create_publisher<sensor_msgs::msg::Imu>("~/Acceleration", rclcpp::SensorDataQoS());
        publisher_Rate = create_publisher<sensor_msgs::msg::Imu>("~/Rate", rclcpp::SensorDataQoS());
        publisher_Position = create_publisher<std_msgs::msg::Float64>("~/Position", rclcpp::SensorDataQoS());
        subscription_Escs = create_subscription<std_msgs::msg::Float64MultiArray>(
            "~/Escs", rclcpp::QoS(10), [this](const std_msgs::msg::Float64MultiArray &in) { set_Escs(in); });
        subscription_Lamps = create_subscription<std_msgs::msg::UInt8MultiArray>(
            "~/Lamps", rclcpp::QoS(10), [this](const std_msgs::msg::UInt8MultiArray &in) { set_Lamps(in); });
        subscription_Winch = create_subscription<std_msgs::msg::Float64>(
            "~/Winch", rclcpp::QoS(10), [this](const std_msgs::msg::Float64 &in) { set_Winch(in); });
        subscription_Speed = create_subscription<std_msgs::msg::Float64>(
            "~/Speed", rclcpp::QoS(10), [this](const std_msgs::msg::Float64 &in) { set_Speed(in); });
    }

    /// Until ROS ends, or the board is gone for good. Returns the exit status.
    int run() { return run_board(board_); }

private:
    [[nodiscard]] std_msgs::msg::Header header(const char *device) const { return RosNode::header(device, 0); }

    void publish_Ranger(const ::sense::curves::Ranger &in) {
        sensor_msgs::msg::Range out;
        out.header = header("Ranger");
        out.radiation_type = settings.radiation_type("Ranger");
        out.min_range = 0.08F;
        out.max_range = 0.7F;
        out.range = static_cast<float>(in.value() * 0.01);
        publisher_Ranger->publish(out);
    }

    void publish_Line(const ::sense::curves::Line &in) {
        std_msgs::msg::Float64MultiArray out;
        for (std::size_t i = 0; i < ::sense::curves::Line::count; ++i) { out.data.push_back(in.value(i)); }
        publisher_Line->publish(out);
    }

    void publish_Bumper(const ::sense::curves::Bumper &in) {
        std_msgs::msg::UInt8MultiArray out;
        for (std::size_t i = 0; i < ::sense::curves::Bumper::count; ++i) { out.data.push_back(in.raw[i] ? 1 : 0); }
        publisher_Bumper->publish(out);
    }

    void publish_Wheels(const ::sense::curves::Wheels &in) {
        std_msgs::msg::Float64MultiArray out;
        for (std::size_t i = 0; i < ::sense::curves::Wheels::count; ++i) { out.data.push_back(in.value(i)); }
        publisher_Wheels->publish(out);
    }

    void publish_Bent(const ::sense::curves::Bent &in) {
        std_msgs::msg::Float64 out;
        out.data = in.value();
        publisher_Bent->publish(out);
    }

    void publish_Acceleration(const ::sense::curves::Acceleration &in) {
        sensor_msgs::msg::Imu out;
        out.header = header("Acceleration");
        out.orientation_covariance[0] = -1.0;
        out.angular_velocity_covariance[0] = -1.0;
        out.linear_acceleration.x = in.value(0) * 9.80665;
        out.linear_acceleration.y = in.value(1) * 9.80665;
        out.linear_acceleration.z = in.value(2) * 9.80665;
        publisher_Acceleration->publish(out);
    }

    void publish_Rate(const ::sense::curves::Rate &in) {
        sensor_msgs::msg::Imu out;
        out.header = header("Rate");
        out.orientation_covariance[0] = -1.0;
        out.linear_acceleration_covariance[0] = -1.0;
        out.angular_velocity.x = in.value(0) * 0.017453292519943295;
        out.angular_velocity.y = in.value(1) * 0.017453292519943295;
        out.angular_velocity.z = in.value(2) * 0.017453292519943295;
        publisher_Rate->publish(out);
    }

    void publish_Position(const ::sense::curves::Position &in) {
        std_msgs::msg::Float64 out;
        out.data = in.value();
        publisher_Position->publish(out);
    }

    void set_Escs(const std_msgs::msg::Float64MultiArray &in) {
        ::sense::curves::Escs command;
        bool is_fine = in.data.size() == ::sense::curves::Escs::count;
        for (std::size_t i = 0; is_fine && i < ::sense::curves::Escs::count; ++i) { is_fine = command.value(i, in.data[i]); }
        tell("Escs", is_fine ? board_.send(command) : sensedsl::Sent::outside_limits);
    }

    void set_Lamps(const std_msgs::msg::UInt8MultiArray &in) {
        ::sense::curves::Lamps command;
        bool is_fine = in.data.size() == ::sense::curves::Lamps::count;
        for (std::size_t i = 0; is_fine && i < ::sense::curves::Lamps::count; ++i) { command.raw[i] = in.data[i] != 0; }
        tell("Lamps", is_fine ? board_.send(command) : sensedsl::Sent::outside_limits);
    }

    void set_Winch(const std_msgs::msg::Float64 &in) {
        ::sense::curves::Winch command;
        const bool is_fine = command.value(in.data);
        tell("Winch", is_fine ? board_.send(command) : sensedsl::Sent::outside_limits);
    }

    void set_Speed(const std_msgs::msg::Float64 &in) {
        ::sense::curves::Speed command;
        const bool is_fine = command.value(in.data);
        tell("Speed", is_fine ? board_.send(command) : sensedsl::Sent::outside_limits);
    }

    rclcpp::Publisher<sensor_msgs::msg::Range>::SharedPtr publisher_Ranger{};
    rclcpp::Publisher<std_msgs::msg::Float64MultiArray>::SharedPtr publisher_Line{};
    rclcpp::Publisher<std_msgs::msg::UInt8MultiArray>::SharedPtr publisher_Bumper{};
    rclcpp::Publisher<std_msgs::msg::Float64MultiArray>::SharedPtr publisher_Wheels{};
    rclcpp::Publisher<std_msgs::msg::Float64>::SharedPtr publisher_Bent{};
    rclcpp::Publisher<sensor_msgs::msg::Imu>::SharedPtr publisher_Acceleration{};
    rclcpp::Publisher<sensor_msgs::msg::Imu>::SharedPtr publisher_Rate{};
    rclcpp::Publisher<std_msgs::msg::Float64>::SharedPtr publisher_Position{};
    rclcpp::Subscription<std_msgs::msg::Float64MultiArray>::SharedPtr subscription_Escs{};
    rclcpp::Subscription<std_msgs::msg::UInt8MultiArray>::SharedPtr subscription_Lamps{};
    rclcpp::Subscription<std_msgs::msg::Float64>::SharedPtr subscription_Winch{};
    rclcpp::Subscription<std_msgs::msg::Float64>::SharedPtr subscription_Speed{};
    Board board_;
};

} // namespace

int main(int argc, char **argv) {
    rclcpp::init(argc, argv);
    int status = 2;
    try {
        status = std::make_shared<Node>()->run();
    } catch (const std::exception &error) {
        RCLCPP_FATAL(rclcpp::get_logger("rover"), "%s", error.what());
    }
    rclcpp::shutdown();
    return status;
}
