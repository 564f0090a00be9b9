// What is on the wire: the tables of one board, scalars in network byte order, the checksum.
//
// In: tables that a generator printed. Out: what decoder and encoder are made of. It needs C++98 and
// nothing else.
#ifndef SENSEDSL_WIRE_HPP
#define SENSEDSL_WIRE_HPP

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <vector>

namespace sensedsl {

/// Bytes of a frame or a stream.
typedef std::vector<uint8_t> Bytes;

/// Identifier of the link's hello, and of the stamp that a report may begin with; a device never has it.
const uint8_t id_hello = 0;
/// Identifier of the optional trailing checksum; a device never has it.
const uint8_t id_checksum = 255;
/// What health begins with; the checksum, which is the same, stands last.
const uint8_t id_health = 255;
/// What stands behind the 0 of the request for health.
const uint8_t ask_health = 1;
/// Bytes of a stamp: identifier, time, counter.
const size_t stamp_bytes = 6;
/// Bytes of health before the devices, and of each device.
const size_t health_head_bytes = 19;
const size_t health_device_bytes = 17;

/// What travels under one identifier.
struct Item {
    uint8_t id;
    uint8_t scalar_bytes;
    bool is_bool;
    uint16_t count;

    size_t size_bytes() const { return static_cast<size_t>(scalar_bytes) * count; }
};

/// All items that travel in one direction, in the order of the file.
struct Direction {
    const Item *items;
    size_t item_count;
    size_t payload_bytes_max;
    /// Bytes of the longest payload but health, without a checksum.
    size_t short_bytes_max;
    /// Bytes of this direction's hello: 5 with the schema hash, 1 as the host's request.
    size_t hello_bytes;
};

/// One board's link.
struct Schema {
    uint32_t hash;
    bool has_checksum;
    /// Whether each report from the board begins with its time and a counter.
    bool has_stamp;
    Direction sensors;
    Direction actuators;
    /// All devices in the file's order, which is that of their health.
    const uint8_t *device_ids;
    size_t device_count;

    size_t health_bytes() const { return health_head_bytes + health_device_bytes * device_count; }
};

/// When a report was put together, and its number.
struct Stamp {
    /// Microseconds since the board started; wraps.
    uint32_t time_us;
    /// Counts the reports that were put together; wraps. A gap tells of lost ones.
    uint8_t counter;
};

/// What a byte in the upper half of the register does to a CRC-16/CCITT-FALSE, and the same with one,
/// two and three zero bytes behind it.
struct Crc16Tables {
    Crc16Tables() {
        for (unsigned byte = 0; byte < 256; ++byte) {
            unsigned crc = byte << 8;
            for (int table = 0; table < 4; ++table) {
                for (int bit = 0; bit < 8; ++bit) {
                    crc = (crc & 0x8000U) != 0 ? ((crc << 1) ^ 0x1021U) & 0xFFFFU : (crc << 1);
                }
                with_zeros[table][byte] = static_cast<uint16_t>(crc);
            }
        }
    }
    /// The register behind one more byte.
    uint16_t step(unsigned crc, uint8_t byte) const {
        return static_cast<uint16_t>((crc << 8) ^ with_zeros[0][(crc >> 8) ^ byte]);
    }
    uint16_t with_zeros[4][256];
};

inline const Crc16Tables &crc16_tables() {
    static const Crc16Tables tables;
    return tables;
}

/// CRC-16/CCITT-FALSE: polynomial 0x1021, start 0xFFFF, not reflected, no final inversion.
inline uint16_t crc16_ccitt_false(const uint8_t *bytes, size_t count) {
    const Crc16Tables &tables = crc16_tables();
    uint16_t crc = 0xFFFFU;
    for (; count >= 4; count -= 4, bytes += 4) {
        crc = static_cast<uint16_t>(
            tables.with_zeros[3][bytes[0] ^ (crc >> 8)] ^ tables.with_zeros[2][bytes[1] ^ (crc & 0xFFU)] ^
            tables.with_zeros[1][bytes[2]] ^ tables.with_zeros[0][bytes[3]]);
    }
    for (; count > 0; --count, ++bytes) {
        crc = tables.step(crc, *bytes);
    }
    return crc;
}

/// The unsigned integer of as many bytes as the scalar it stands for.
template <size_t size> struct Bits;
template <> struct Bits<1> { typedef uint8_t type; };
template <> struct Bits<2> { typedef uint16_t type; };
template <> struct Bits<4> { typedef uint32_t type; };
template <> struct Bits<8> { typedef uint64_t type; };

/// Reads one scalar in network byte order.
template <typename T> inline T load(const uint8_t *bytes) {
    typedef typename Bits<sizeof(T)>::type Unsigned;
    uint64_t bits = 0;
    for (size_t i = 0; i < sizeof(T); ++i) {
        bits = (bits << 8) | bytes[i];
    }
    const Unsigned narrow = static_cast<Unsigned>(bits);
    T value;
    memcpy(&value, &narrow, sizeof value);
    return value;
}
template <> inline bool load<bool>(const uint8_t *bytes) { return bytes[0] != 0; }

/// Reads `count` scalars, one behind the other.
template <typename T> inline void load_all(const uint8_t *bytes, T *scalars, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        scalars[i] = load<T>(bytes + i * sizeof(T));
    }
}

/// Appends one scalar in network byte order.
template <typename T> inline void store(Bytes &bytes, T value) {
    typename Bits<sizeof(T)>::type narrow;
    memcpy(&narrow, &value, sizeof value);
    const uint64_t bits = narrow;
    for (size_t i = sizeof(T); i-- > 0;) {
        bytes.push_back(static_cast<uint8_t>((bits >> (8 * i)) & 0xFFU));
    }
}
template <> inline void store<bool>(Bytes &bytes, bool value) {
    bytes.push_back(value ? uint8_t(1) : uint8_t(0));
}

} // namespace sensedsl

#endif
