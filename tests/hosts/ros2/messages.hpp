// The messages that generated nodes use, with the fields that ROS 2 gives them, and how they are printed.
#ifndef STAND_IN_MESSAGES_HPP
#define STAND_IN_MESSAGES_HPP

#include <array>
#include <cstdint>
#include <cstdlib>
#include <istream>
#include <limits>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace builtin_interfaces::msg {
struct Time {
    std::int32_t sec{0};
    std::uint32_t nanosec{0};
};
} // namespace builtin_interfaces::msg

namespace stand_in {

template <typename Message> struct Name;

template <typename T> void print(std::ostream &out, const T &value) {
    const auto precision = out.precision(std::numeric_limits<T>::max_digits10);
    out << +value;
    out.precision(precision);
}
template <typename T> void print(std::ostream &out, const std::vector<T> &values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        out << (i > 0 ? "," : "");
        print(out, values[i]);
    }
}

template <typename T> bool read(std::istream &in, T &value) {
    if constexpr (sizeof(T) == 1 && !std::is_same_v<T, bool>) {
        int wide = 0;
        in >> wide;
        value = static_cast<T>(wide);
    } else if constexpr (std::is_floating_point_v<T>) {
        // A stream does not read what is no number.
        std::string word;
        in >> word;
        value = static_cast<T>(std::strtod(word.c_str(), nullptr));
    } else {
        in >> value;
    }
    return !in.fail();
}
template <typename T> bool read(std::istream &in, std::vector<T> &values) {
    for (T value{}; read(in, value);) {
        values.push_back(value);
    }
    return true;
}

} // namespace stand_in

namespace std_msgs::msg {

struct Header {
    builtin_interfaces::msg::Time stamp{};
    std::string frame_id{};
};

struct MultiArrayDimension {
    std::string label{};
    std::uint32_t size{0};
    std::uint32_t stride{0};
};

struct MultiArrayLayout {
    std::vector<MultiArrayDimension> dim{};
    std::uint32_t data_offset{0};
};

#define ONE(NAME, TYPE)                                                                                                \
    struct NAME {                                                                                                      \
        TYPE data{};                                                                                                   \
    };                                                                                                                 \
    inline std::ostream &operator<<(std::ostream &out, const NAME &message) {                                          \
        stand_in::print(out, message.data);                                                                            \
        return out;                                                                                                    \
    }                                                                                                                  \
    inline std::istream &operator>>(std::istream &in, NAME &message) {                                                 \
        stand_in::read(in, message.data);                                                                              \
        return in;                                                                                                     \
    }
#define BOTH(NAME, TYPE)                                                                                               \
    ONE(NAME, TYPE)                                                                                                    \
    struct NAME##MultiArray {                                                                                          \
        MultiArrayLayout layout{};                                                                                     \
        std::vector<TYPE> data{};                                                                                      \
    };                                                                                                                 \
    inline std::ostream &operator<<(std::ostream &out, const NAME##MultiArray &message) {                              \
        stand_in::print(out, message.data);                                                                            \
        return out;                                                                                                    \
    }                                                                                                                  \
    inline std::istream &operator>>(std::istream &in, NAME##MultiArray &message) {                                     \
        stand_in::read(in, message.data);                                                                              \
        in.clear();                                                                                                    \
        return in;                                                                                                     \
    }

ONE(Bool, bool)
BOTH(UInt8, std::uint8_t)
BOTH(Int8, std::int8_t)
BOTH(UInt16, std::uint16_t)
BOTH(Int16, std::int16_t)
BOTH(UInt32, std::uint32_t)
BOTH(Int32, std::int32_t)
BOTH(UInt64, std::uint64_t)
BOTH(Int64, std::int64_t)
BOTH(Float32, float)
BOTH(Float64, double)
#undef ONE
#undef BOTH

} // namespace std_msgs::msg

namespace geometry_msgs::msg {
struct Vector3 {
    double x{0.0};
    double y{0.0};
    double z{0.0};
};
struct Quaternion {
    double x{0.0};
    double y{0.0};
    double z{0.0};
    double w{1.0};
};
inline std::ostream &operator<<(std::ostream &out, const Vector3 &vector) {
    return out << vector.x << "," << vector.y << "," << vector.z;
}
} // namespace geometry_msgs::msg

namespace sensor_msgs::msg {

struct Range {
    static constexpr std::uint8_t ULTRASOUND = 0;
    static constexpr std::uint8_t INFRARED = 1;
    std_msgs::msg::Header header{};
    std::uint8_t radiation_type{0};
    float field_of_view{0.0F};
    float min_range{0.0F};
    float max_range{0.0F};
    float range{0.0F};
};
inline std::ostream &operator<<(std::ostream &out, const Range &one) {
    return out << "frame=" << one.header.frame_id << " type=" << +one.radiation_type << " min=" << one.min_range
               << " max=" << one.max_range << " range=" << one.range;
}

#define FIELD(NAME, FIELD)                                                                                             \
    struct NAME {                                                                                                      \
        std_msgs::msg::Header header{};                                                                                \
        double FIELD{0.0};                                                                                             \
        double variance{0.0};                                                                                          \
    };                                                                                                                 \
    inline std::ostream &operator<<(std::ostream &out, const NAME &one) {                                              \
        return out << "frame=" << one.header.frame_id << " " #FIELD "=" << one.FIELD;                                  \
    }
FIELD(Temperature, temperature)
FIELD(FluidPressure, fluid_pressure)
FIELD(Illuminance, illuminance)
FIELD(RelativeHumidity, relative_humidity)
#undef FIELD

struct Imu {
    std_msgs::msg::Header header{};
    geometry_msgs::msg::Quaternion orientation{};
    std::array<double, 9> orientation_covariance{};
    geometry_msgs::msg::Vector3 angular_velocity{};
    std::array<double, 9> angular_velocity_covariance{};
    geometry_msgs::msg::Vector3 linear_acceleration{};
    std::array<double, 9> linear_acceleration_covariance{};
};
inline std::ostream &operator<<(std::ostream &out, const Imu &one) {
    out << "frame=" << one.header.frame_id;
    if (one.angular_velocity_covariance[0] >= 0.0) {
        out << " angular_velocity=" << one.angular_velocity;
    }
    if (one.linear_acceleration_covariance[0] >= 0.0) {
        out << " linear_acceleration=" << one.linear_acceleration;
    }
    return out << (one.orientation_covariance[0] >= 0.0 ? " orientation" : "");
}

struct MagneticField {
    std_msgs::msg::Header header{};
    geometry_msgs::msg::Vector3 magnetic_field{};
    std::array<double, 9> magnetic_field_covariance{};
};
inline std::ostream &operator<<(std::ostream &out, const MagneticField &one) {
    return out << "frame=" << one.header.frame_id << " magnetic_field=" << one.magnetic_field;
}

} // namespace sensor_msgs::msg

namespace diagnostic_msgs::msg {

struct KeyValue {
    std::string key{};
    std::string value{};
};

struct DiagnosticStatus {
    static constexpr unsigned char OK = 0;
    static constexpr unsigned char WARN = 1;
    static constexpr unsigned char ERROR = 2;
    static constexpr unsigned char STALE = 3;
    unsigned char level{0};
    std::string name{};
    std::string message{};
    std::string hardware_id{};
    std::vector<KeyValue> values{};
};

struct DiagnosticArray {
    std_msgs::msg::Header header{};
    std::vector<DiagnosticStatus> status{};
};
inline std::ostream &operator<<(std::ostream &out, const DiagnosticArray &all) {
    for (const auto &one : all.status) {
        out << "[" << one.name << " " << +one.level << " " << one.message;
        for (const auto &pair : one.values) {
            out << "; " << pair.key << ": " << pair.value;
        }
        out << "]";
    }
    return out;
}

} // namespace diagnostic_msgs::msg

#endif
