// Board STM32F4DiscoveryBoard as tables. Written by SenseDSL; do not edit.
#ifndef SENSE_miniature_car_STM32F4DiscoveryBoard_SCHEMA_HPP
#define SENSE_miniature_car_STM32F4DiscoveryBoard_SCHEMA_HPP

#include "sensedsl/link.hpp"
#include "sensedsl/scaling.hpp"
#include "sensedsl/session.hpp"

namespace sense {
namespace miniature_car {
namespace facts {

inline const ::sensedsl::BoardFacts &STM32F4DiscoveryBoard() {
    // Identifier, bytes of a scalar, whether it is a bool, number of scalars; in the file's order.
    static const ::sensedsl::Item sensors[] = {
        {1, 2, false, 1}, // sensor IRFrontRight uint16
        {2, 2, false, 1}, // sensor IRRearRight uint16
        {3, 2, false, 1}, // sensor IRRear uint16
        {4, 2, false, 1}, // sensor USFront uint16
        {5, 2, false, 1}, // sensor USFrontRight uint16
        {6, 2, false, 1}, // sensor USRear uint16
        {7, 4, false, 1}, // sensor WheelLeftA uint32
        {8, 4, false, 1}, // sensor WheelLeftB uint32
        {9, 4, false, 1}, // sensor WheelRightA uint32
        {10, 4, false, 1}, // sensor WheelRightB uint32
        {11, 2, false, 1}, // sensor RCSteering uint16
        {12, 2, false, 1}, // sensor RCThrottle uint16
        {13, 2, false, 1}, // sensor RCSwitch uint16
    };
    // Name, cycle time in milliseconds.
    static const ::sensedsl::SensorFacts sensor_facts[] = {
        {"IRFrontRight", 60},
        {"IRRearRight", 60},
        {"IRRear", 60},
        {"USFront", 70},
        {"USFrontRight", 70},
        {"USRear", 70},
        {"WheelLeftA", 0},
        {"WheelLeftB", 0},
        {"WheelRightA", 0},
        {"WheelRightB", 0},
        {"RCSteering", 0},
        {"RCThrottle", 0},
        {"RCSwitch", 0},
    };
    // All devices in the file's order, which is that of their health: identifiers; names and whether they are actuators.
    static const uint8_t device_ids[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
    static const ::sensedsl::DeviceFacts device_facts[] = {
        {"IRFrontRight", false},
        {"IRRearRight", false},
        {"IRRear", false},
        {"USFront", false},
        {"USFrontRight", false},
        {"USRear", false},
        {"WheelLeftA", false},
        {"WheelLeftB", false},
        {"WheelRightA", false},
        {"WheelRightB", false},
        {"RCSteering", false},
        {"RCThrottle", false},
        {"RCSwitch", false},
    };
    static const ::sensedsl::Schema schema = {
        0x64783683U,
        ::sensedsl::checksum_none,
        false,
        {sensors, 13, 240, 47, 5},
        {NULL, 0, 2, 2, 1},
        device_ids, 13};
    static const ::sensedsl::BoardFacts facts = {
        "STM32F4DiscoveryBoard", &schema,
        "checksum none\012"
        "1 sensor IRFrontRight uint16\012"
        "2 sensor IRRearRight uint16\012"
        "3 sensor IRRear uint16\012"
        "4 sensor USFront uint16\012"
        "5 sensor USFrontRight uint16\012"
        "6 sensor USRear uint16\012"
        "7 sensor WheelLeftA uint32\012"
        "8 sensor WheelLeftB uint32\012"
        "9 sensor WheelRightA uint32\012"
        "10 sensor WheelRightB uint32\012"
        "11 sensor RCSteering uint16\012"
        "12 sensor RCThrottle uint16\012"
        "13 sensor RCSwitch uint16\012",
        sensor_facts, device_facts, 0};
    return facts;
}

} // namespace facts

/// How the values of each message are shown.
namespace scaling {

inline ::sensedsl::Scaling IRFrontRight() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling IRRearRight() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling IRRear() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling USFront() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling USFrontRight() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling USRear() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling WheelLeftA() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling WheelLeftB() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling WheelRightA() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling WheelRightB() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling RCSteering() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling RCThrottle() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling RCSwitch() { return ::sensedsl::Scaling(1.0, 0.0); }

} // namespace scaling
} // namespace miniature_car
} // namespace sense

#endif
