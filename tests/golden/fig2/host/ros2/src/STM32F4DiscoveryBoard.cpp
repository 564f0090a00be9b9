// Node of board STM32F4DiscoveryBoard: what its sensors say is published.
// Written by SenseDSL; do not edit. C++17, ROS 2.
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>

#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/range.hpp>
#include <std_msgs/msg/u_int16.hpp>
#include <std_msgs/msg/u_int32.hpp>

#include "sense/fig2/STM32F4DiscoveryBoard.hpp"
#include "sensedsl/ros2.hpp"

namespace {

using Board = ::sense::fig2::STM32F4DiscoveryBoard;

class Node final : public sensedsl::RosNode {
    // Before the constructor, which needs to know its type.
    auto handlers() {
        return sensedsl::Handlers{
            [this](const ::sense::fig2::IRFront &in) { publish_IRFront(in); },
            [this](const ::sense::fig2::IRFrontRight &in) { publish_IRFrontRight(in); },
            [this](const ::sense::fig2::USRear &in) { publish_USRear(in); },
            [this](const ::sense::fig2::WheelEncoder &in) { publish_WheelEncoder(in); },
            [this](const sensedsl::Health &health) { take(health); },
            [this](const sensedsl::Note &note) { take(note); },
        };
    }

public:
    Node() : RosNode("stm32f4discoveryboard", ::sense::fig2::facts::STM32F4DiscoveryBoard(), Board::default_baud), board_(handlers()) {
        publisher_IRFront = create_publisher<std_msgs::msg::UInt16>("~/IRFront", rclcpp::SensorDataQoS());
        publisher_IRFrontRight = create_publisher<std_msgs::msg::UInt16>("~/IRFrontRight", rclcpp::SensorDataQoS());
        publisher_USRear = create_publisher<sensor_msgs::msg::Range>("~/USRear", rclcpp::SensorDataQoS());
        publisher_WheelEncoder = create_publisher<std_msgs::msg::UInt32>("~/WheelEncoder", rclcpp::SensorDataQoS());
    }

    /// Until ROS ends, or the board is gone for good. Returns the exit status.
    int run() { return run_board(board_); }

private:
    [[nodiscard]] std_msgs::msg::Header header(const char *device) const { return RosNode::header(device, 0); }

    void publish_IRFront(const ::sense::fig2::IRFront &in) {
        std_msgs::msg::UInt16 out;
        out.data = in.raw;
        publisher_IRFront->publish(out);
    }

    void publish_IRFrontRight(const ::sense::fig2::IRFrontRight &in) {
        std_msgs::msg::UInt16 out;
        out.data = in.raw;
        publisher_IRFrontRight->publish(out);
    }

    void publish_USRear(const ::sense::fig2::USRear &in) {
        sensor_msgs::msg::Range out;
        out.header = header("USRear");
        out.radiation_type = settings.radiation_type("USRear");
        out.min_range = 0.0F;
        out.max_range = std::numeric_limits<float>::infinity();
        out.range = static_cast<float>(in.value() * 0.01);
        publisher_USRear->publish(out);
    }

    void publish_WheelEncoder(const ::sense::fig2::WheelEncoder &in) {
        std_msgs::msg::UInt32 out;
        out.data = in.raw;
        publisher_WheelEncoder->publish(out);
    }

    rclcpp::Publisher<std_msgs::msg::UInt16>::SharedPtr publisher_IRFront{};
    rclcpp::Publisher<std_msgs::msg::UInt16>::SharedPtr publisher_IRFrontRight{};
    rclcpp::Publisher<sensor_msgs::msg::Range>::SharedPtr publisher_USRear{};
    rclcpp::Publisher<std_msgs::msg::UInt32>::SharedPtr publisher_WheelEncoder{};
    Board board_;
};

} // namespace

int main(int argc, char **argv) {
    rclcpp::init(argc, argv);
    int status = 2;
    try {
        status = std::make_shared<Node>()->run();
    } catch (const std::exception &error) {
        RCLCPP_FATAL(rclcpp::get_logger("stm32f4discoveryboard"), "%s", error.what());
    }
    rclcpp::shutdown();
    return status;
}
