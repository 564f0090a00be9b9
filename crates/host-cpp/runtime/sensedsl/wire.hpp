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
/// What frames of a link end with.
enum Checksum { checksum_none, checksum_crc16, checksum_crc32 };
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
    Checksum checksum;
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

/// The same of CRC-32, whose bytes come in at the lower end.
struct Crc32Tables {
    Crc32Tables() {
        for (unsigned byte = 0; byte < 256; ++byte) {
            uint32_t crc = byte;
            for (int table = 0; table < 4; ++table) {
                for (int bit = 0; bit < 8; ++bit) {
                    crc = shifted(crc);
                }
                with_zeros[table][byte] = crc;
            }
        }
    }
    static uint32_t shifted(uint32_t crc) { return (crc >> 1) ^ (0xEDB88320U & (0U - (crc & 1U))); }
    uint32_t step(uint32_t crc, uint8_t byte) const { return (crc >> 8) ^ with_zeros[0][(crc ^ byte) & 0xFFU]; }
    uint32_t with_zeros[4][256];
};

inline const Crc32Tables &crc32_tables() {
    static const Crc32Tables tables;
    return tables;
}

/// CRC-32/ISO-HDLC, that of Ethernet and zlib: reflected, start 0xFFFFFFFF, inverted at the end.
inline uint32_t crc32_iso_hdlc(const uint8_t *bytes, size_t count) {
    const Crc32Tables &tables = crc32_tables();
    uint32_t crc = 0xFFFFFFFFU;
    for (; count >= 4; count -= 4, bytes += 4) {
        crc = tables.with_zeros[3][bytes[0] ^ (crc & 0xFFU)] ^ tables.with_zeros[2][bytes[1] ^ ((crc >> 8) & 0xFFU)] ^
              tables.with_zeros[1][bytes[2] ^ ((crc >> 16) & 0xFFU)] ^ tables.with_zeros[0][bytes[3] ^ (crc >> 24)];
    }
    for (; count > 0; --count, ++bytes) {
        crc = tables.step(crc, *bytes);
    }
    return crc ^ 0xFFFFFFFFU;
}

/// A checksum as a register that bytes go through: `start`, what it is XORed with at the `end`, and the register that
/// multiplies by `one`. No other code asks which checksum it is.
struct Crc {
    /// Of its number.
    size_t bytes;
    uint32_t start;
    uint32_t end;
    uint32_t one;
    bool is_32;

    explicit Crc(Checksum checksum)
        : bytes(checksum == checksum_none ? 0 : checksum == checksum_crc16 ? 2 : 4),
          start(checksum == checksum_crc32 ? 0xFFFFFFFFU : 0xFFFFU), end(checksum == checksum_crc32 ? 0xFFFFFFFFU : 0U),
          one(checksum == checksum_crc32 ? 0x80000000U : 1U), is_32(checksum == checksum_crc32) {}

    /// Bytes that it adds to a payload: its identifier and its number.
    size_t size_bytes() const { return bytes == 0 ? 0 : 1 + bytes; }
    /// Its number of a payload.
    uint32_t of(const uint8_t *payload, size_t count) const {
        return is_32 ? crc32_iso_hdlc(payload, count) : crc16_ccitt_false(payload, count);
    }
    /// Its number as it stands in a frame.
    uint32_t read(const uint8_t *at) const {
        uint32_t number = 0;
        for (size_t i = 0; i < bytes; ++i) {
            number = (number << 8) | at[i];
        }
        return number;
    }
    /// The register behind one more byte.
    uint32_t step(uint32_t crc, uint8_t byte) const {
        return is_32 ? crc32_tables().step(crc, byte) : crc16_tables().step(crc, byte);
    }
    /// Of two registers as polynomials over GF(2), modulo the one of the CRC.
    uint32_t product(uint32_t left, uint32_t right) const {
        uint32_t result = 0;
        if (is_32) {
            for (int bit = 0; bit < 32; ++bit) {
                result = Crc32Tables::shifted(result) ^ (left & (0U - ((right >> bit) & 1U)));
            }
            return result;
        }
        for (int bit = 15; bit >= 0; --bit) {
            result = ((result << 1) & 0xFFFFU) ^ (0x1021U & (0U - (result >> 15)));
            result ^= left & (0U - ((right >> bit) & 1U));
        }
        return result;
    }
};

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
