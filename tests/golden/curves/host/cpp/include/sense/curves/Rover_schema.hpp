// Board Rover as tables. Written by SenseDSL; do not edit.
#ifndef SENSE_curves_Rover_SCHEMA_HPP
#define SENSE_curves_Rover_SCHEMA_HPP

#include "sensedsl/link.hpp"
#include "sensedsl/scaling.hpp"
#include "sensedsl/session.hpp"

namespace sense {
namespace curves {
namespace facts {

inline const ::sensedsl::BoardFacts &Rover() {
    // Identifier, bytes of a scalar, whether it is a bool, number of scalars; in the file's order.
    static const ::sensedsl::Item sensors[] = {
        {1, 2, false, 1}, // sensor Ranger uint16: a GP2Y0A21 behind the bumper
        {10, 2, false, 8}, // sensor Line uint16[8]
        {12, 1, true, 3}, // sensor Bumper bool[3]
        {13, 4, false, 2}, // sensor Wheels int32[2]
        {14, 2, false, 1}, // sensor Bent uint16
        {30, 2, false, 3}, // sensor Acceleration int16[3]
        {31, 2, false, 3}, // sensor Rate int16[3]
        {41, 4, false, 1}, // sensor Position int32
    };
    // Name, cycle time in milliseconds.
    static const ::sensedsl::SensorFacts sensor_facts[] = {
        {"Ranger", 1000},
        {"Line", 1000},
        {"Bumper", 1000},
        {"Wheels", 0},
        {"Bent", 1000},
        {"Acceleration", 10},
        {"Rate", 10},
        {"Position", 0},
    };
    static const ::sensedsl::Item actuators[] = {
        {20, 2, false, 4}, // actuator Escs uint16[4]
        {21, 1, true, 3}, // actuator Lamps bool[3]
        {22, 2, false, 1}, // actuator Winch uint16
        {40, 2, false, 1}, // actuator Speed int16
    };
    // All devices in the file's order, which is that of their health: identifiers; names and whether they are actuators.
    static const uint8_t device_ids[] = {1, 10, 12, 13, 14, 20, 21, 22, 30, 31, 40, 41};
    static const ::sensedsl::DeviceFacts device_facts[] = {
        {"Ranger", false},
        {"Line", false},
        {"Bumper", false},
        {"Wheels", false},
        {"Bent", false},
        {"Escs", true},
        {"Lamps", true},
        {"Winch", true},
        {"Acceleration", false},
        {"Rate", false},
        {"Speed", true},
        {"Position", false},
    };
    static const ::sensedsl::Schema schema = {
        0x0ca56b7cU,
        ::sensedsl::checksum_none,
        false,
        {sensors, 8, 223, 55, 5},
        {actuators, 4, 19, 19, 1},
        device_ids, 12};
    static const ::sensedsl::BoardFacts facts = {
        "Rover", &schema,
        "checksum none\012"
        "1 sensor Ranger uint16\012"
        "10 sensor Line uint16[8]\012"
        "12 sensor Bumper bool[3]\012"
        "13 sensor Wheels int32[2]\012"
        "14 sensor Bent uint16\012"
        "20 actuator Escs uint16[4]\012"
        "21 actuator Lamps bool[3]\012"
        "22 actuator Winch uint16\012"
        "30 sensor Acceleration int16[3]\012"
        "31 sensor Rate int16[3]\012"
        "40 actuator Speed int16\012"
        "41 sensor Position int32\012",
        sensor_facts, device_facts, 500};
    return facts;
}

} // namespace facts

/// How the values of each message are shown.
namespace scaling {

inline ::sensedsl::Scaling Ranger() {
    static const ::sensedsl::Point curve[] = {{0.4, 80.0}, {0.5, 60.0}, {0.75, 40.0}, {1.3, 20.0}, {2.3, 10.0}, {3.1, 6.0}};
    return ::sensedsl::Scaling(0.0008056640625, 0.0, curve);
}
inline ::sensedsl::Scaling Line() {
    static const ::sensedsl::Point curve[] = {{200.0, 0.0}, {3800.0, 100.0}};
    return ::sensedsl::Scaling(1.0, 0.0, curve);
}
inline ::sensedsl::Scaling Bumper() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling Wheels() { return ::sensedsl::Scaling(0.25, -90.0); }
inline ::sensedsl::Scaling Bent() {
    static const ::sensedsl::Point curve[] = {{80.0, 8.0}, {250.0, 3.0}};
    return ::sensedsl::Scaling(1.0, 0.0, curve);
}
inline ::sensedsl::Scaling Acceleration() { return ::sensedsl::Scaling(6.103515625e-5, 0.0); }
inline ::sensedsl::Scaling Rate() { return ::sensedsl::Scaling(0.007633587786259542, 0.0); }
inline ::sensedsl::Scaling Position() { return ::sensedsl::Scaling(0.2571428571428571, 0.0); }
inline ::sensedsl::Scaling Escs() {
    static const ::sensedsl::Point curve[] = {{1000.0, 0.0}, {2000.0, 100.0}};
    return ::sensedsl::Scaling(1.0, 0.0, curve);
}
inline ::sensedsl::Scaling Lamps() { return ::sensedsl::Scaling(1.0, 0.0); }
inline ::sensedsl::Scaling Winch() {
    static const ::sensedsl::Point curve[] = {{0.0, -50.0}, {1000.0, 0.0}, {2000.0, 200.0}};
    return ::sensedsl::Scaling(0.5, 0.0, curve);
}
inline ::sensedsl::Scaling Speed() { return ::sensedsl::Scaling(0.01, 0.0); }

} // namespace scaling
} // namespace curves
} // namespace sense

#endif
