// The messages of this design for OpenDaVINCI as it was in 2014. Written by SenseDSL; do not edit.
// A message travels as its wire bytes, in a Container whose data type is 700 + the wire identifier.
#ifndef SENSE_miniature_car_MESSAGES_H
#define SENSE_miniature_car_MESSAGES_H

#include <limits>
#include <sstream>
#include <string>

#include "core/platform.h"

#include "core/base/Deserializer.h"
#include "core/base/SerializationFactory.h"
#include "core/base/Serializer.h"
#include "core/data/Container.h"
#include "core/data/SerializableData.h"

#include "sense/miniature_car/STM32F4DiscoveryBoard_schema.hpp"
#include "sensedsl/link.hpp"
#include "sensedsl/text.hpp"

namespace sense {
namespace miniature_car {

/// sensor IRFrontRight uint16
class IRFrontRight : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 1;
    static const size_t COUNT = 1;

    IRFrontRight() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(701);
    }
    static std::string ShortName() { return "IRFrontRight"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::IRFrontRight(), "");
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

/// sensor IRRearRight uint16
class IRRearRight : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 2;
    static const size_t COUNT = 1;

    IRRearRight() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(702);
    }
    static std::string ShortName() { return "IRRearRight"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::IRRearRight(), "");
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

/// sensor IRRear uint16
class IRRear : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 3;
    static const size_t COUNT = 1;

    IRRear() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(703);
    }
    static std::string ShortName() { return "IRRear"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::IRRear(), "");
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

/// sensor USFront uint16
class USFront : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 4;
    static const size_t COUNT = 1;

    USFront() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(704);
    }
    static std::string ShortName() { return "USFront"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return "cm"; }
    double getValue() const { return ::sense::miniature_car::scaling::USFront().of(static_cast<double>(m_raw[0])); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::USFront(), " cm");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::miniature_car::scaling::USFront(), " cm");
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

/// sensor USFrontRight uint16
class USFrontRight : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 5;
    static const size_t COUNT = 1;

    USFrontRight() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(705);
    }
    static std::string ShortName() { return "USFrontRight"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return "cm"; }
    double getValue() const { return ::sense::miniature_car::scaling::USFrontRight().of(static_cast<double>(m_raw[0])); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::USFrontRight(), " cm");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::miniature_car::scaling::USFrontRight(), " cm");
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

/// sensor USRear uint16
class USRear : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 6;
    static const size_t COUNT = 1;

    USRear() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(706);
    }
    static std::string ShortName() { return "USRear"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return "cm"; }
    double getValue() const { return ::sense::miniature_car::scaling::USRear().of(static_cast<double>(m_raw[0])); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::USRear(), " cm");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::miniature_car::scaling::USRear(), " cm");
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

/// sensor WheelLeftA uint32
class WheelLeftA : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 7;
    static const size_t COUNT = 1;

    WheelLeftA() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint32_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(707);
    }
    static std::string ShortName() { return "WheelLeftA"; }

    uint32_t getRaw() const { return m_raw[0]; }
    void setRaw(uint32_t raw) { m_raw[0] = raw; }
    const uint32_t *begin() const { return m_raw; }
    uint32_t *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::WheelLeftA(), "");
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

/// sensor WheelLeftB uint32
class WheelLeftB : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 8;
    static const size_t COUNT = 1;

    WheelLeftB() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint32_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(708);
    }
    static std::string ShortName() { return "WheelLeftB"; }

    uint32_t getRaw() const { return m_raw[0]; }
    void setRaw(uint32_t raw) { m_raw[0] = raw; }
    const uint32_t *begin() const { return m_raw; }
    uint32_t *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::WheelLeftB(), "");
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

/// sensor WheelRightA uint32
class WheelRightA : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 9;
    static const size_t COUNT = 1;

    WheelRightA() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint32_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(709);
    }
    static std::string ShortName() { return "WheelRightA"; }

    uint32_t getRaw() const { return m_raw[0]; }
    void setRaw(uint32_t raw) { m_raw[0] = raw; }
    const uint32_t *begin() const { return m_raw; }
    uint32_t *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::WheelRightA(), "");
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

/// sensor WheelRightB uint32
class WheelRightB : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 10;
    static const size_t COUNT = 1;

    WheelRightB() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint32_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(710);
    }
    static std::string ShortName() { return "WheelRightB"; }

    uint32_t getRaw() const { return m_raw[0]; }
    void setRaw(uint32_t raw) { m_raw[0] = raw; }
    const uint32_t *begin() const { return m_raw; }
    uint32_t *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::WheelRightB(), "");
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

/// sensor RCSteering uint16
class RCSteering : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 11;
    static const size_t COUNT = 1;

    RCSteering() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(711);
    }
    static std::string ShortName() { return "RCSteering"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return "us"; }
    double getValue() const { return ::sense::miniature_car::scaling::RCSteering().of(static_cast<double>(m_raw[0])); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {1000.0, 2000.0};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::RCSteering(), " us");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::miniature_car::scaling::RCSteering(), " us");
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

/// sensor RCThrottle uint16
class RCThrottle : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 12;
    static const size_t COUNT = 1;

    RCThrottle() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(712);
    }
    static std::string ShortName() { return "RCThrottle"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return "us"; }
    double getValue() const { return ::sense::miniature_car::scaling::RCThrottle().of(static_cast<double>(m_raw[0])); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {1000.0, 2000.0};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::RCThrottle(), " us");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::miniature_car::scaling::RCThrottle(), " us");
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

/// sensor RCSwitch uint16
class RCSwitch : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 13;
    static const size_t COUNT = 1;

    RCSwitch() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(713);
    }
    static std::string ShortName() { return "RCSwitch"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return "us"; }
    double getValue() const { return ::sense::miniature_car::scaling::RCSwitch().of(static_cast<double>(m_raw[0])); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {1000.0, 2000.0};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::miniature_car::scaling::RCSwitch(), " us");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::miniature_car::scaling::RCSwitch(), " us");
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

} // namespace miniature_car
} // namespace sense

#endif
