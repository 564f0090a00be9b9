// The messages of this design for OpenDaVINCI as it was in 2014. Written by SenseDSL; do not edit.
// A message travels as its wire bytes, in a Container whose data type is 700 + the wire identifier.
#ifndef SENSE_curves_MESSAGES_H
#define SENSE_curves_MESSAGES_H

#include <limits>
#include <sstream>
#include <string>

#include "core/platform.h"

#include "core/base/Deserializer.h"
#include "core/base/SerializationFactory.h"
#include "core/base/Serializer.h"
#include "core/data/Container.h"
#include "core/data/SerializableData.h"

#include "sense/curves/Rover_schema.hpp"
#include "sensedsl/link.hpp"
#include "sensedsl/text.hpp"

namespace sense {
namespace curves {

/// sensor Ranger uint16: a GP2Y0A21 behind the bumper
class Ranger : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 1;
    static const size_t COUNT = 1;

    Ranger() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(701);
    }
    static std::string ShortName() { return "Ranger"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return "cm"; }
    double getValue() const { return ::sense::curves::scaling::Ranger().of(static_cast<double>(m_raw[0])); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {8.0, 70.0};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Ranger(), " cm");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::curves::scaling::Ranger(), " cm");
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

/// sensor Line uint16[8]
class Line : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 10;
    static const size_t COUNT = 8;

    Line() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(710);
    }
    static std::string ShortName() { return "Line"; }

    uint16_t getRaw(size_t element) const { return m_raw[element]; }
    void setRaw(size_t element, uint16_t raw) { m_raw[element] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return "percent"; }
    double getValue(size_t element) const {
        return ::sense::curves::scaling::Line().of(static_cast<double>(m_raw[element]));
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {1.0, std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Line(), " percent");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::curves::scaling::Line(), " percent");
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
    uint16_t m_raw[8];
};

/// sensor Bumper bool[3]
class Bumper : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 12;
    static const size_t COUNT = 3;

    Bumper() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = bool();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(712);
    }
    static std::string ShortName() { return "Bumper"; }

    bool getRaw(size_t element) const { return m_raw[element]; }
    void setRaw(size_t element, bool raw) { m_raw[element] = raw; }
    const bool *begin() const { return m_raw; }
    bool *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Bumper(), "");
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
            sensedsl::store<bool>(bytes, m_raw[i]);
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
    bool m_raw[3];
};

/// sensor Wheels int32[2]
class Wheels : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 13;
    static const size_t COUNT = 2;

    Wheels() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = int32_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(713);
    }
    static std::string ShortName() { return "Wheels"; }

    int32_t getRaw(size_t element) const { return m_raw[element]; }
    void setRaw(size_t element, int32_t raw) { m_raw[element] = raw; }
    const int32_t *begin() const { return m_raw; }
    int32_t *begin() { return m_raw; }

    static std::string Quantity() { return ""; }
    double getValue(size_t element) const {
        return ::sense::curves::scaling::Wheels().of(static_cast<double>(m_raw[element]));
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Wheels(), "");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::curves::scaling::Wheels(), "");
        text << outsideLimits();
        return text.str();
    }

    virtual std::ostream &operator<<(std::ostream &out) const {
        sensedsl::Bytes bytes;
        for (size_t i = 0; i < COUNT; ++i) {
            sensedsl::store<int32_t>(bytes, m_raw[i]);
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
    int32_t m_raw[2];
};

/// sensor Bent uint16
class Bent : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 14;
    static const size_t COUNT = 1;

    Bent() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(714);
    }
    static std::string ShortName() { return "Bent"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return ""; }
    double getValue() const { return ::sense::curves::scaling::Bent().of(static_cast<double>(m_raw[0])); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Bent(), "");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::curves::scaling::Bent(), "");
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

/// sensor Acceleration int16[3]
class Acceleration : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 30;
    static const size_t COUNT = 3;

    Acceleration() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = int16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(730);
    }
    static std::string ShortName() { return "Acceleration"; }

    int16_t getRaw(size_t element) const { return m_raw[element]; }
    void setRaw(size_t element, int16_t raw) { m_raw[element] = raw; }
    const int16_t *begin() const { return m_raw; }
    int16_t *begin() { return m_raw; }

    static std::string Quantity() { return "g"; }
    double getValue(size_t element) const {
        return ::sense::curves::scaling::Acceleration().of(static_cast<double>(m_raw[element]));
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Acceleration(), " g");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::curves::scaling::Acceleration(), " g");
        text << outsideLimits();
        return text.str();
    }

    virtual std::ostream &operator<<(std::ostream &out) const {
        sensedsl::Bytes bytes;
        for (size_t i = 0; i < COUNT; ++i) {
            sensedsl::store<int16_t>(bytes, m_raw[i]);
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
    int16_t m_raw[3];
};

/// sensor Rate int16[3]
class Rate : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 31;
    static const size_t COUNT = 3;

    Rate() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = int16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(731);
    }
    static std::string ShortName() { return "Rate"; }

    int16_t getRaw(size_t element) const { return m_raw[element]; }
    void setRaw(size_t element, int16_t raw) { m_raw[element] = raw; }
    const int16_t *begin() const { return m_raw; }
    int16_t *begin() { return m_raw; }

    static std::string Quantity() { return "deg/s"; }
    double getValue(size_t element) const {
        return ::sense::curves::scaling::Rate().of(static_cast<double>(m_raw[element]));
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Rate(), " deg/s");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::curves::scaling::Rate(), " deg/s");
        text << outsideLimits();
        return text.str();
    }

    virtual std::ostream &operator<<(std::ostream &out) const {
        sensedsl::Bytes bytes;
        for (size_t i = 0; i < COUNT; ++i) {
            sensedsl::store<int16_t>(bytes, m_raw[i]);
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
    int16_t m_raw[3];
};

/// sensor Position int32
class Position : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 41;
    static const size_t COUNT = 1;

    Position() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = int32_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(741);
    }
    static std::string ShortName() { return "Position"; }

    int32_t getRaw() const { return m_raw[0]; }
    void setRaw(int32_t raw) { m_raw[0] = raw; }
    const int32_t *begin() const { return m_raw; }
    int32_t *begin() { return m_raw; }

    static std::string Quantity() { return "deg"; }
    double getValue() const { return ::sense::curves::scaling::Position().of(static_cast<double>(m_raw[0])); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Position(), " deg");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::curves::scaling::Position(), " deg");
        text << outsideLimits();
        return text.str();
    }

    virtual std::ostream &operator<<(std::ostream &out) const {
        sensedsl::Bytes bytes;
        for (size_t i = 0; i < COUNT; ++i) {
            sensedsl::store<int32_t>(bytes, m_raw[i]);
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
    int32_t m_raw[1];
};

/// actuator Escs uint16[4]
class Escs : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 20;
    static const size_t COUNT = 4;

    Escs() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(720);
    }
    static std::string ShortName() { return "Escs"; }

    uint16_t getRaw(size_t element) const { return m_raw[element]; }
    void setRaw(size_t element, uint16_t raw) { m_raw[element] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return "percent"; }
    double getValue(size_t element) const {
        return ::sense::curves::scaling::Escs().of(static_cast<double>(m_raw[element]));
    }

    /// Takes the value that is shown as `shown`, in its quantity. False, and nothing is taken, where no code is.
    bool setValue(size_t element, double shown) {
        return sensedsl::take_code(::sense::curves::scaling::Escs().raw_of(shown), m_raw[element]);
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Escs(), " percent");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::curves::scaling::Escs(), " percent");
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
    uint16_t m_raw[4];
};

/// actuator Lamps bool[3]
class Lamps : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 21;
    static const size_t COUNT = 3;

    Lamps() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = bool();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(721);
    }
    static std::string ShortName() { return "Lamps"; }

    bool getRaw(size_t element) const { return m_raw[element]; }
    void setRaw(size_t element, bool raw) { m_raw[element] = raw; }
    const bool *begin() const { return m_raw; }
    bool *begin() { return m_raw; }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Lamps(), "");
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
            sensedsl::store<bool>(bytes, m_raw[i]);
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
    bool m_raw[3];
};

/// actuator Winch uint16
class Winch : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 22;
    static const size_t COUNT = 1;

    Winch() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = uint16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(722);
    }
    static std::string ShortName() { return "Winch"; }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw; }
    uint16_t *begin() { return m_raw; }

    static std::string Quantity() { return "N"; }
    double getValue() const { return ::sense::curves::scaling::Winch().of(static_cast<double>(m_raw[0])); }

    /// Takes the value that is shown as `shown`, in its quantity. False, and nothing is taken, where no code is.
    bool setValue(double shown) { return sensedsl::take_code(::sense::curves::scaling::Winch().raw_of(shown), m_raw[0]); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-25.0, 100.0};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Winch(), " N");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::curves::scaling::Winch(), " N");
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

/// actuator Speed int16
class Speed : public core::data::SerializableData {
public:
    static const uint8_t WIRE_ID = 40;
    static const size_t COUNT = 1;

    Speed() : core::data::SerializableData() {
        for (size_t i = 0; i < COUNT; ++i) {
            m_raw[i] = int16_t();
        }
    }

    static core::data::Container::DATATYPE ID() {
        return static_cast<core::data::Container::DATATYPE>(740);
    }
    static std::string ShortName() { return "Speed"; }

    int16_t getRaw() const { return m_raw[0]; }
    void setRaw(int16_t raw) { m_raw[0] = raw; }
    const int16_t *begin() const { return m_raw; }
    int16_t *begin() { return m_raw; }

    static std::string Quantity() { return "%"; }
    double getValue() const { return ::sense::curves::scaling::Speed().of(static_cast<double>(m_raw[0])); }

    /// Takes the value that is shown as `shown`, in its quantity. False, and nothing is taken, where no code is.
    bool setValue(double shown) { return sensedsl::take_code(::sense::curves::scaling::Speed().raw_of(shown), m_raw[0]); }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-100.0, 100.0};
        return sensedsl::outside_of(limits, m_raw, COUNT, ::sense::curves::scaling::Speed(), " %");
    }

    virtual const std::string toString() const {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw, COUNT);
        sensedsl::print_scaled(text, m_raw, COUNT, ::sense::curves::scaling::Speed(), " %");
        text << outsideLimits();
        return text.str();
    }

    virtual std::ostream &operator<<(std::ostream &out) const {
        sensedsl::Bytes bytes;
        for (size_t i = 0; i < COUNT; ++i) {
            sensedsl::store<int16_t>(bytes, m_raw[i]);
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
    int16_t m_raw[1];
};

} // namespace curves
} // namespace sense

#endif
