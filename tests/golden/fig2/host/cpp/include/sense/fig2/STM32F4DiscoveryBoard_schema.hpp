// Board STM32F4DiscoveryBoard as tables. Written by SenseDSL; do not edit.
#ifndef SENSE_fig2_STM32F4DiscoveryBoard_SCHEMA_HPP
#define SENSE_fig2_STM32F4DiscoveryBoard_SCHEMA_HPP

#include "sensedsl/link.hpp"
#include "sensedsl/scaling.hpp"
#include "sensedsl/session.hpp"

namespace sense {
namespace fig2 {
namespace facts {

inline const ::sensedsl::BoardFacts &STM32F4DiscoveryBoard() {
    // Identifier, bytes of a scalar, whether it is a bool, number of scalars; in the file's order.
    static const ::sensedsl::Item sensors[] = {
        {17, 2, false, 1}, // sensor IRFront uint16
        {18, 2, false, 1}, // sensor IRFrontRight uint16
        {19, 1, false, 1}, // sensor USRear uint8
        {20, 4, false, 1}, // sensor WheelEncoder uint32
    };
    // Name, cycle time in milliseconds.
    static const ::sensedsl::SensorFacts sensor_facts[] = {
        {"IRFront", 1000},
        {"IRFrontRight", 60},
        {"USRear", 80},
        {"WheelEncoder", 0},
    };
    // All devices in the file's order, which is that of their health: identifiers; names and whether they are actuators.
    static const uint8_t device_ids[] = {17, 18, 19, 20};
    static const ::sensedsl::DeviceFacts device_facts[] = {
        {"IRFront", false},
        {"IRFrontRight", false},
        {"USRear", false},
        {"WheelEncoder", false},
    };
    static const ::sensedsl::Schema schema = {
        0xb2d2a70bU,
        ::sensedsl::checksum_none,
        false,
        {sensors, 4, 87, 13, 5},
        {NULL, 0, 2, 2, 1},
        device_ids, 4};
    static const ::sensedsl::BoardFacts facts = {
        "STM32F4DiscoveryBoard", &schema,
        "checksum none\012"
        "17 sensor IRFront uint16\012"
        "18 sensor IRFrontRight uint16\012"
        "19 sensor USRear uint8\012"
        "20 sensor WheelEncoder uint32\012",
        sensor_facts, device_facts, 0};
    return facts;
}

} // namespace facts

/// How the values of each message are shown.
namespace scaling {

inline ::sensedsl::Scaling IRFront() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling IRFrontRight() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling USRear() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling WheelEncoder() { return ::sensedsl::Scaling(1.0, 0.0); }

} // namespace scaling
} // namespace fig2
} // namespace sense

#endif
