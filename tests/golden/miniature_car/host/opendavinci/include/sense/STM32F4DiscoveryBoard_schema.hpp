// The link of board STM32F4DiscoveryBoard as tables. Written by SenseDSL; do not edit.
#ifndef SENSE_STM32F4DiscoveryBoard_SCHEMA_HPP
#define SENSE_STM32F4DiscoveryBoard_SCHEMA_HPP

#include "sensedsl/link.hpp"

namespace sense {
namespace STM32F4DiscoveryBoard {

/// Identifier, bytes of a scalar, whether it is a bool, number of scalars; in the file's order.
inline const ::sensedsl::Schema &schema() {
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
    static const ::sensedsl::Schema schema = {
        0x64783683U,
        false,
        {sensors, 13, 47, 5},
        {NULL, 0, 1, 1}};
    return schema;
}

} // namespace STM32F4DiscoveryBoard
} // namespace sense

#endif
