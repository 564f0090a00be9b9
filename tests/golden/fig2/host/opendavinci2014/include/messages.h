// The messages of this design for OpenDaVINCI as it was in 2014. Written by SenseDSL; do not edit.
// A message travels as its wire bytes, in a Container whose data type is 700 + the wire identifier.
#ifndef SENSE_fig2_MESSAGES_H
#define SENSE_fig2_MESSAGES_H

#include <limits>
#include <sstream>
#include <string>

#include "core/platform.h"

#include "core/base/Deserializer.h"
#include "core/base/SerializationFactory.h"
#include "core/base/Serializer.h"
#include "core/data/Container.h"
#include "core/data/SerializableData.h"

#include "sense/fig2/STM32F4DiscoveryBoard_schema.hpp"
#include "sensedsl/link.hpp"
#include "sensedsl/text.hpp"

namespace sense {
namespace fig2 {

/// sensor IRFront uint16
class IRFront : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 17;
    static const size_t COUNT = 1;

    IRFront() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(717);
    }
    static std::string ShortName() { return "IRFront"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::fig2::scaling::IRFront(), "");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        text << outsideLimits();
        return text.str();
    }

    virtual std::ostream &operator<<(std::ostream &out) const {
        sensedsl::Bytes bytes;
        for (size_t i = 0; i < COUNT; ++i) {
            sensedsl::store<uint16_t>(bytes, m_raw[i]);
        }
        core::base::SerializationFactory factory;
        factory.getSerializer(out).write(1, std::string(bytes.begin(), bytes.end()));
        return out;
    }

    virtual std::istream &operator>>(std::istream &in) {
        std::string text;
        core::base::SerializationFactory factory;
        factory.getDeserializer(in).read(1, text);
        const sensedsl::Bytes bytes(text.begin(), text.end());
        if (bytes.size() == COUNT * 2) {
            sensedsl::load_all(&bytes[0], m_raw, COUNT);
        }
        return in;
    }

private:
    uint16_t m_raw[1];
};

/// sensor IRFrontRight uint16
class IRFrontRight : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 18;
    static const size_t COUNT = 1;

    IRFrontRight() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(718);
    }
    static std::string ShortName() { return "IRFrontRight"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::fig2::scaling::IRFrontRight(), "");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        text << outsideLimits();
        return text.str();
    }

    virtual std::ostream &operator<<(std::ostream &out) const {
        sensedsl::Bytes bytes;
        for (size_t i = 0; i < COUNT; ++i) {
            sensedsl::store<uint16_t>(bytes, m_raw[i]);
        }
        core::base::SerializationFactory factory;
        factory.getSerializer(out).write(1, std::string(bytes.begin(), bytes.end()));
        return out;
    }

    virtual std::istream &operator>>(std::istream &in) {
        std::string text;
        core::base::SerializationFactory factory;
        factory.getDeserializer(in).read(1, text);
        const sensedsl::Bytes bytes(text.begin(), text.end());
        if (bytes.size() == COUNT * 2) {
            sensedsl::load_all(&bytes[0], m_raw, COUNT);
        }
        return in;
    }

private:
    uint16_t m_raw[1];
};

/// sensor USRear uint8
class USRear : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 19;
    static const size_t COUNT = 1;

    USRear() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint8_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(719);
    }
    static std::string ShortName() { return "USRear"; }

    uint8_t getRaw() const { return m_raw[0]; }
    void setRaw(uint8_t raw) { m_raw[0] = raw; }
    const uint8_t *begin() const { return m_raw; }
    uint8_t *begin() { return m_raw; }

    static std::string Quantity() { return "cm"; }
    double getValue() const { return ::sense::fig2::scaling::USRear().of(static_cast<double>(m_raw[0])); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::fig2::scaling::USRear(), " cm");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::fig2::scaling::USRear(), " cm");
        text << outsideLimits();
        return text.str();
    }

    virtual std::ostream &operator<<(std::ostream &out) const {
        sensedsl::Bytes bytes;
        for (size_t i = 0; i < COUNT; ++i) {
            sensedsl::store<uint8_t>(bytes, m_raw[i]);
        }
        core::base::SerializationFactory factory;
        factory.getSerializer(out).write(1, std::string(bytes.begin(), bytes.end()));
        return out;
    }

    virtual std::istream &operator>>(std::istream &in) {
        std::string text;
        core::base::SerializationFactory factory;
        factory.getDeserializer(in).read(1, text);
        const sensedsl::Bytes bytes(text.begin(), text.end());
        if (bytes.size() == COUNT * 1) {
            sensedsl::load_all(&bytes[0], m_raw, COUNT);
        }
        return in;
    }

private:
    uint8_t m_raw[1];
};

/// sensor WheelEncoder uint32
class WheelEncoder : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 20;
    static const size_t COUNT = 1;

    WheelEncoder() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint32_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(720);
    }
    static std::string ShortName() { return "WheelEncoder"; }

    uint32_t getRaw() const { return m_raw[0]; }
    void setRaw(uint32_t raw) { m_raw[0] = raw; }
    const uint32_t *begin() const { return m_raw; }
    uint32_t *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::fig2::scaling::WheelEncoder(), "");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        text << outsideLimits();
        return text.str();
    }

    virtual std::ostream &operator<<(std::ostream &out) const {
        sensedsl::Bytes bytes;
        for (size_t i = 0; i < COUNT; ++i) {
            sensedsl::store<uint32_t>(bytes, m_raw[i]);
        }
        core::base::SerializationFactory factory;
        factory.getSerializer(out).write(1, std::string(bytes.begin(), bytes.end()));
        return out;
    }

    virtual std::istream &operator>>(std::istream &in) {
        std::string text;
        core::base::SerializationFactory factory;
        factory.getDeserializer(in).read(1, text);
        const sensedsl::Bytes bytes(text.begin(), text.end());
        if (bytes.size() == COUNT * 4) {
            sensedsl::load_all(&bytes[0], m_raw, COUNT);
        }
        return in;
    }

private:
    uint32_t m_raw[1];
};

} // namespace fig2
} // namespace sense

#endif
