// Node of board STM32F4DiscoveryBoard: what its sensors say is published.
// Written by SenseDSL; do not edit. C++17, ROS 2.
#include <cstddef>
#include <exception>
#include <limits>
#include <memory>

#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/range.hpp>
#include <std_msgs/msg/float64.hpp>
#include <std_msgs/msg/u_int16.hpp>
#include <std_msgs/msg/u_int32.hpp>

#include "sense/miniature_car/STM32F4DiscoveryBoard.hpp"
#include "sensedsl/ros2.hpp"

namespace {

using Board = ::sense::miniature_car::STM32F4DiscoveryBoard;

class Node final : public sensedsl::RosNode {
    // Before the constructor, which needs to know its type.
    auto handlers() {
        return sensedsl::Handlers{
            [this](const ::sense::miniature_car::IRFrontRight &in) { publish_IRFrontRight(in); },
            [this](const ::sense::miniature_car::IRRearRight &in) { publish_IRRearRight(in); },
            [this](const ::sense::miniature_car::IRRear &in) { publish_IRRear(in); },
            [this](const ::sense::miniature_car::USFront &in) { publish_USFront(in); },
            [this](const ::sense::miniature_car::USFrontRight &in) { publish_USFrontRight(in); },
            [this](const ::sense::miniature_car::USRear &in) { publish_USRear(in); },
            [this](const ::sense::miniature_car::WheelLeftA &in) { publish_WheelLeftA(in); },
            [this](const ::sense::miniature_car::WheelLeftB &in) { publish_WheelLeftB(in); },
            [this](const ::sense::miniature_car::WheelRightA &in) { publish_WheelRightA(in); },
            [this](const ::sense::miniature_car::WheelRightB &in) { publish_WheelRightB(in); },
            [this](const ::sense::miniature_car::RCSteering &in) { publish_RCSteering(in); },
            [this](const ::sense::miniature_car::RCThrottle &in) { publish_RCThrottle(in); },
            [this](const ::sense::miniature_car::RCSwitch &in) { publish_RCSwitch(in); },
            [this](const sensedsl::Health &health) { take(health); },
            [this](const sensedsl::Note &note) { take(note); },
        };
    }

public:
    Node() : RosNode("stm32f4discoveryboard", ::sense::miniature_car::facts::STM32F4DiscoveryBoard(), Board::default_baud), board_(handlers()) {
        publisher_IRFrontRight = create_publisher<std_msgs::msg::UInt16>("~/IRFrontRight", rclcpp::SensorDataQoS());
        publisher_IRRearRight = create_publisher<std_msgs::msg::UInt16>("~/IRRearRight", rclcpp::SensorDataQoS());
        publisher_IRRear = create_publisher<std_msgs::msg::UInt16>("~/IRRear", rclcpp::SensorDataQoS());
        publisher_USFront = create_publisher<sensor_msgs::msg::Range>("~/USFront", rclcpp::SensorDataQoS());
        publisher_USFrontRight = create_publisher<sensor_msgs::msg::Range>("~/USFrontRight", rclcpp::SensorDataQoS());
        publisher_USRear = create_publisher<sensor_msgs::msg::Range>("~/USRear", rclcpp::SensorDataQoS());
        publisher_WheelLeftA = create_publisher<std_msgs::msg::UInt32>("~/WheelLeftA", rclcpp::SensorDataQoS());
        publisher_WheelLeftB = create_publisher<std_msgs::msg::UInt32>("~/WheelLeftB", rclcpp::SensorDataQoS());
        publisher_WheelRightA = create_publisher<std_msgs::msg::UInt32>("~/WheelRightA", rclcpp::SensorDataQoS());
        publisher_WheelRightB = create_publisher<std_msgs::msg::UInt32>("~/WheelRightB", rclcpp::SensorDataQoS());
        publisher_RCSteering = create_publisher<std_msgs::msg::Float64>("~/RCSteering", rclcpp::SensorDataQoS());
        publisher_RCThrottle = create_publisher<std_msgs::msg::Float64>("~/RCThrottle", rclcpp::SensorDataQoS());
        publisher_RCSwitch = create_publisher<std_msgs::msg::Float64>("~/RCSwitch", rclcpp::SensorDataQoS());
    }

    /// Until ROS ends, or the board is gone for good. Returns the exit status.
    int run() { return run_board(board_); }

private:
    [[nodiscard]] std_msgs::msg::Header header(const char *device) const { return RosNode::header(device, 0); }

    void publish_IRFrontRight(const ::sense::miniature_car::IRFrontRight &in) {
        std_msgs::msg::UInt16 out;
        out.data = in.raw;
        publisher_IRFrontRight->publish(out);
    }

    void publish_IRRearRight(const ::sense::miniature_car::IRRearRight &in) {
        std_msgs::msg::UInt16 out;
        out.data = in.raw;
        publisher_IRRearRight->publish(out);
    }

    void publish_IRRear(const ::sense::miniature_car::IRRear &in) {
        std_msgs::msg::UInt16 out;
        out.data = in.raw;
        publisher_IRRear->publish(out);
    }

    void publish_USFront(const ::sense::miniature_car::USFront &in) {
        sensor_msgs::msg::Range out;
        out.header = header("USFront");
        out.radiation_type = settings.radiation_type("USFront");
        out.min_range = 0.0F;
        out.max_range = std::numeric_limits<float>::infinity();
        out.range = static_cast<float>(in.value() * 0.01);
        publisher_USFront->publish(out);
    }

    void publish_USFrontRight(const ::sense::miniature_car::USFrontRight &in) {
        sensor_msgs::msg::Range out;
        out.header = header("USFrontRight");
        out.radiation_type = settings.radiation_type("USFrontRight");
        out.min_range = 0.0F;
        out.max_range = std::numeric_limits<float>::infinity();
        out.range = static_cast<float>(in.value() * 0.01);
        publisher_USFrontRight->publish(out);
    }

    void publish_USRear(const ::sense::miniature_car::USRear &in) {
        sensor_msgs::msg::Range out;
        out.header = header("USRear");
        out.radiation_type = settings.radiation_type("USRear");
        out.min_range = 0.0F;
        out.max_range = std::numeric_limits<float>::infinity();
        out.range = static_cast<float>(in.value() * 0.01);
        publisher_USRear->publish(out);
    }

    void publish_WheelLeftA(const ::sense::miniature_car::WheelLeftA &in) {
        std_msgs::msg::UInt32 out;
        out.data = in.raw;
        publisher_WheelLeftA->publish(out);
    }

    void publish_WheelLeftB(const ::sense::miniature_car::WheelLeftB &in) {
        std_msgs::msg::UInt32 out;
        out.data = in.raw;
        publisher_WheelLeftB->publish(out);
    }

    void publish_WheelRightA(const ::sense::miniature_car::WheelRightA &in) {
        std_msgs::msg::UInt32 out;
        out.data = in.raw;
        publisher_WheelRightA->publish(out);
    }

    void publish_WheelRightB(const ::sense::miniature_car::WheelRightB &in) {
        std_msgs::msg::UInt32 out;
        out.data = in.raw;
        publisher_WheelRightB->publish(out);
    }

    void publish_RCSteering(const ::sense::miniature_car::RCSteering &in) {
        std_msgs::msg::Float64 out;
        out.data = in.value();
        publisher_RCSteering->publish(out);
    }

    void publish_RCThrottle(const ::sense::miniature_car::RCThrottle &in) {
        std_msgs::msg::Float64 out;
        out.data = in.value();
        publisher_RCThrottle->publish(out);
    }

    void publish_RCSwitch(const ::sense::miniature_car::RCSwitch &in) {
        std_msgs::msg::Float64 out;
        out.data = in.value();
        publisher_RCSwitch->publish(out);
    }

    rclcpp::Publisher<std_msgs::msg::UInt16>::SharedPtr publisher_IRFrontRight{};
    rclcpp::Publisher<std_msgs::msg::UInt16>::SharedPtr publisher_IRRearRight{};
    rclcpp::Publisher<std_msgs::msg::UInt16>::SharedPtr publisher_IRRear{};
    rclcpp::Publisher<sensor_msgs::msg::Range>::SharedPtr publisher_USFront{};
    rclcpp::Publisher<sensor_msgs::msg::Range>::SharedPtr publisher_USFrontRight{};
    rclcpp::Publisher<sensor_msgs::msg::Range>::SharedPtr publisher_USRear{};
    rclcpp::Publisher<std_msgs::msg::UInt32>::SharedPtr publisher_WheelLeftA{};
    rclcpp::Publisher<std_msgs::msg::UInt32>::SharedPtr publisher_WheelLeftB{};
    rclcpp::Publisher<std_msgs::msg::UInt32>::SharedPtr publisher_WheelRightA{};
    rclcpp::Publisher<std_msgs::msg::UInt32>::SharedPtr publisher_WheelRightB{};
    rclcpp::Publisher<std_msgs::msg::Float64>::SharedPtr publisher_RCSteering{};
    rclcpp::Publisher<std_msgs::msg::Float64>::SharedPtr publisher_RCThrottle{};
    rclcpp::Publisher<std_msgs::msg::Float64>::SharedPtr publisher_RCSwitch{};
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
