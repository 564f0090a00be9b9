// The messages of this design for OpenDaVINCI 4. Written by SenseDSL; do not edit.
// These are the classes that `sense.odvd` describes, in the form in which OpenDaVINCI serializes them.
#ifndef SENSE_miniature_car_MESSAGES_H
#define SENSE_miniature_car_MESSAGES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <sstream>
#include <string>

#include "opendavinci/odcore/base/Visitable.h"
#include "opendavinci/odcore/base/Visitor.h"
#include "opendavinci/odcore/data/SerializableData.h"
#include "opendavinci/odcore/serialization/Deserializer.h"
#include "opendavinci/odcore/serialization/SerializationFactory.h"
#include "opendavinci/odcore/serialization/Serializer.h"

#include "sense/miniature_car/STM32F4DiscoveryBoard_schema.hpp"
#include "sensedsl/command.hpp"
#include "sensedsl/text.hpp"

namespace sense {
namespace miniature_car {

/// sensor IRFrontRight uint16
class IRFrontRight : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 1;
    static constexpr std::size_t COUNT = 1;

    IRFrontRight() = default;
    IRFrontRight(const IRFrontRight &) = default;
    IRFrontRight &operator=(const IRFrontRight &) = default;

    static std::int32_t ID() { return 21001; }
    static const std::string ShortName() { return "IRFrontRight"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::IRFrontRight(), "");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    std::array<uint16_t, 1> m_raw{};
};

/// sensor IRRearRight uint16
class IRRearRight : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 2;
    static constexpr std::size_t COUNT = 1;

    IRRearRight() = default;
    IRRearRight(const IRRearRight &) = default;
    IRRearRight &operator=(const IRRearRight &) = default;

    static std::int32_t ID() { return 21002; }
    static const std::string ShortName() { return "IRRearRight"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::IRRearRight(), "");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    std::array<uint16_t, 1> m_raw{};
};

/// sensor IRRear uint16
class IRRear : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 3;
    static constexpr std::size_t COUNT = 1;

    IRRear() = default;
    IRRear(const IRRear &) = default;
    IRRear &operator=(const IRRear &) = default;

    static std::int32_t ID() { return 21003; }
    static const std::string ShortName() { return "IRRear"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::IRRear(), "");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    std::array<uint16_t, 1> m_raw{};
};

/// sensor USFront uint16
class USFront : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 4;
    static constexpr std::size_t COUNT = 1;

    USFront() = default;
    USFront(const USFront &) = default;
    USFront &operator=(const USFront &) = default;

    static std::int32_t ID() { return 21004; }
    static const std::string ShortName() { return "USFront"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "cm"; }
    double getValue() const { return scaled(0); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        double value0 = scaled(0);
        visitor.visit(2, LongName() + ".value", "value", value0);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::USFront(), " cm");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::miniature_car::scaling::USFront(), " cm");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, scaled(0));
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::miniature_car::scaling::USFront().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 1> m_raw{};
};

/// sensor USFrontRight uint16
class USFrontRight : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 5;
    static constexpr std::size_t COUNT = 1;

    USFrontRight() = default;
    USFrontRight(const USFrontRight &) = default;
    USFrontRight &operator=(const USFrontRight &) = default;

    static std::int32_t ID() { return 21005; }
    static const std::string ShortName() { return "USFrontRight"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "cm"; }
    double getValue() const { return scaled(0); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        double value0 = scaled(0);
        visitor.visit(2, LongName() + ".value", "value", value0);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::USFrontRight(), " cm");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::miniature_car::scaling::USFrontRight(), " cm");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, scaled(0));
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::miniature_car::scaling::USFrontRight().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 1> m_raw{};
};

/// sensor USRear uint16
class USRear : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 6;
    static constexpr std::size_t COUNT = 1;

    USRear() = default;
    USRear(const USRear &) = default;
    USRear &operator=(const USRear &) = default;

    static std::int32_t ID() { return 21006; }
    static const std::string ShortName() { return "USRear"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "cm"; }
    double getValue() const { return scaled(0); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        double value0 = scaled(0);
        visitor.visit(2, LongName() + ".value", "value", value0);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::USRear(), " cm");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::miniature_car::scaling::USRear(), " cm");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, scaled(0));
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::miniature_car::scaling::USRear().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 1> m_raw{};
};

/// sensor WheelLeftA uint32
class WheelLeftA : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 7;
    static constexpr std::size_t COUNT = 1;

    WheelLeftA() = default;
    WheelLeftA(const WheelLeftA &) = default;
    WheelLeftA &operator=(const WheelLeftA &) = default;

    static std::int32_t ID() { return 21007; }
    static const std::string ShortName() { return "WheelLeftA"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint32_t getRaw() const { return m_raw[0]; }
    void setRaw(uint32_t raw) { m_raw[0] = raw; }
    const uint32_t *begin() const { return m_raw.data(); }
    uint32_t *begin() { return m_raw.data(); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::WheelLeftA(), "");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    std::array<uint32_t, 1> m_raw{};
};

/// sensor WheelLeftB uint32
class WheelLeftB : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 8;
    static constexpr std::size_t COUNT = 1;

    WheelLeftB() = default;
    WheelLeftB(const WheelLeftB &) = default;
    WheelLeftB &operator=(const WheelLeftB &) = default;

    static std::int32_t ID() { return 21008; }
    static const std::string ShortName() { return "WheelLeftB"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint32_t getRaw() const { return m_raw[0]; }
    void setRaw(uint32_t raw) { m_raw[0] = raw; }
    const uint32_t *begin() const { return m_raw.data(); }
    uint32_t *begin() { return m_raw.data(); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::WheelLeftB(), "");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    std::array<uint32_t, 1> m_raw{};
};

/// sensor WheelRightA uint32
class WheelRightA : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 9;
    static constexpr std::size_t COUNT = 1;

    WheelRightA() = default;
    WheelRightA(const WheelRightA &) = default;
    WheelRightA &operator=(const WheelRightA &) = default;

    static std::int32_t ID() { return 21009; }
    static const std::string ShortName() { return "WheelRightA"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint32_t getRaw() const { return m_raw[0]; }
    void setRaw(uint32_t raw) { m_raw[0] = raw; }
    const uint32_t *begin() const { return m_raw.data(); }
    uint32_t *begin() { return m_raw.data(); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::WheelRightA(), "");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    std::array<uint32_t, 1> m_raw{};
};

/// sensor WheelRightB uint32
class WheelRightB : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 10;
    static constexpr std::size_t COUNT = 1;

    WheelRightB() = default;
    WheelRightB(const WheelRightB &) = default;
    WheelRightB &operator=(const WheelRightB &) = default;

    static std::int32_t ID() { return 21010; }
    static const std::string ShortName() { return "WheelRightB"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint32_t getRaw() const { return m_raw[0]; }
    void setRaw(uint32_t raw) { m_raw[0] = raw; }
    const uint32_t *begin() const { return m_raw.data(); }
    uint32_t *begin() { return m_raw.data(); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::WheelRightB(), "");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    std::array<uint32_t, 1> m_raw{};
};

/// sensor RCSteering uint16
class RCSteering : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 11;
    static constexpr std::size_t COUNT = 1;

    RCSteering() = default;
    RCSteering(const RCSteering &) = default;
    RCSteering &operator=(const RCSteering &) = default;

    static std::int32_t ID() { return 21011; }
    static const std::string ShortName() { return "RCSteering"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "us"; }
    double getValue() const { return scaled(0); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        double value0 = scaled(0);
        visitor.visit(2, LongName() + ".value", "value", value0);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {1000.0, 2000.0};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::RCSteering(), " us");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::miniature_car::scaling::RCSteering(), " us");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, scaled(0));
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::miniature_car::scaling::RCSteering().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 1> m_raw{};
};

/// sensor RCThrottle uint16
class RCThrottle : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 12;
    static constexpr std::size_t COUNT = 1;

    RCThrottle() = default;
    RCThrottle(const RCThrottle &) = default;
    RCThrottle &operator=(const RCThrottle &) = default;

    static std::int32_t ID() { return 21012; }
    static const std::string ShortName() { return "RCThrottle"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "us"; }
    double getValue() const { return scaled(0); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        double value0 = scaled(0);
        visitor.visit(2, LongName() + ".value", "value", value0);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {1000.0, 2000.0};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::RCThrottle(), " us");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::miniature_car::scaling::RCThrottle(), " us");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, scaled(0));
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::miniature_car::scaling::RCThrottle().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 1> m_raw{};
};

/// sensor RCSwitch uint16
class RCSwitch : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 13;
    static constexpr std::size_t COUNT = 1;

    RCSwitch() = default;
    RCSwitch(const RCSwitch &) = default;
    RCSwitch &operator=(const RCSwitch &) = default;

    static std::int32_t ID() { return 21013; }
    static const std::string ShortName() { return "RCSwitch"; }
    static const std::string LongName() { return "sense.miniature_car." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "us"; }
    double getValue() const { return scaled(0); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        double value0 = scaled(0);
        visitor.visit(2, LongName() + ".value", "value", value0);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {1000.0, 2000.0};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::miniature_car::scaling::RCSwitch(), " us");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::miniature_car::scaling::RCSwitch(), " us");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, scaled(0));
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::miniature_car::scaling::RCSwitch().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 1> m_raw{};
};

} // namespace miniature_car
} // namespace sense

#endif
