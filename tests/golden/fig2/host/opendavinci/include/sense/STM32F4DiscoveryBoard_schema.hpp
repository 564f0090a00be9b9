// The link of board STM32F4DiscoveryBoard as tables. Written by SenseDSL; do not edit.
#ifndef SENSE_STM32F4DiscoveryBoard_SCHEMA_HPP
#define SENSE_STM32F4DiscoveryBoard_SCHEMA_HPP

#include "sensedsl/link.hpp"

namespace sense {
namespace STM32F4DiscoveryBoard {

/// Identifier, bytes of a scalar, whether it is a bool, number of scalars; in the file's order.
inline const ::sensedsl::Schema &schema() {
    static const ::sensedsl::Item sensors[] = {
        {17, 2, false, 1}, // sensor IRFront uint16
        {18, 2, false, 1}, // sensor IRFrontRight uint16
        {19, 1, false, 1}, // sensor USRear uint8
        {20, 4, false, 1}, // sensor WheelEncoder uint32
    };
    static const ::sensedsl::Schema schema = {
        0xb2d2a70bU,
        false,
        {sensors, 4, 13, 5},
        {NULL, 0, 1, 1}};
    return schema;
}

} // namespace STM32F4DiscoveryBoard
} // namespace sense

#endif
