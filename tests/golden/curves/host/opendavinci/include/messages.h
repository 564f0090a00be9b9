// The messages of this design for OpenDaVINCI 4. Written by SenseDSL; do not edit.
// These are the classes that `sense.odvd` describes, in the form in which OpenDaVINCI serializes them.
#ifndef SENSE_curves_MESSAGES_H
#define SENSE_curves_MESSAGES_H

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

#include "sense/curves/Rover_schema.hpp"
#include "sensedsl/command.hpp"
#include "sensedsl/text.hpp"

namespace sense {
namespace curves {

/// sensor Ranger uint16: a GP2Y0A21 behind the bumper
class Ranger : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 1;
    static constexpr std::size_t COUNT = 1;

    Ranger() = default;
    Ranger(const Ranger &) = default;
    Ranger &operator=(const Ranger &) = default;

    static std::int32_t ID() { return 21001; }
    static const std::string ShortName() { return "Ranger"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
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
        const sensedsl::Limits limits = {8.0, 70.0};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Ranger(), " cm");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::curves::scaling::Ranger(), " cm");
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
        return ::sense::curves::scaling::Ranger().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 1> m_raw{};
};

/// sensor Line uint16[8]
class Line : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 10;
    static constexpr std::size_t COUNT = 8;

    Line() = default;
    Line(const Line &) = default;
    Line &operator=(const Line &) = default;

    static std::int32_t ID() { return 21010; }
    static const std::string ShortName() { return "Line"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw(std::size_t element) const { return m_raw[element]; }
    void setRaw(std::size_t element, uint16_t raw) { m_raw[element] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "percent"; }
    double getValue(std::size_t element) const { return scaled(element); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw0", "raw0", m_raw[0]);
        visitor.visit(2, LongName() + ".raw1", "raw1", m_raw[1]);
        visitor.visit(3, LongName() + ".raw2", "raw2", m_raw[2]);
        visitor.visit(4, LongName() + ".raw3", "raw3", m_raw[3]);
        visitor.visit(5, LongName() + ".raw4", "raw4", m_raw[4]);
        visitor.visit(6, LongName() + ".raw5", "raw5", m_raw[5]);
        visitor.visit(7, LongName() + ".raw6", "raw6", m_raw[6]);
        visitor.visit(8, LongName() + ".raw7", "raw7", m_raw[7]);
        double value0 = scaled(0);
        visitor.visit(9, LongName() + ".value0", "value0", value0);
        double value1 = scaled(1);
        visitor.visit(10, LongName() + ".value1", "value1", value1);
        double value2 = scaled(2);
        visitor.visit(11, LongName() + ".value2", "value2", value2);
        double value3 = scaled(3);
        visitor.visit(12, LongName() + ".value3", "value3", value3);
        double value4 = scaled(4);
        visitor.visit(13, LongName() + ".value4", "value4", value4);
        double value5 = scaled(5);
        visitor.visit(14, LongName() + ".value5", "value5", value5);
        double value6 = scaled(6);
        visitor.visit(15, LongName() + ".value6", "value6", value6);
        double value7 = scaled(7);
        visitor.visit(16, LongName() + ".value7", "value7", value7);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {1.0, std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Line(), " percent");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::curves::scaling::Line(), " percent");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, m_raw[1]);
        serializer->write(3, m_raw[2]);
        serializer->write(4, m_raw[3]);
        serializer->write(5, m_raw[4]);
        serializer->write(6, m_raw[5]);
        serializer->write(7, m_raw[6]);
        serializer->write(8, m_raw[7]);
        serializer->write(9, scaled(0));
        serializer->write(10, scaled(1));
        serializer->write(11, scaled(2));
        serializer->write(12, scaled(3));
        serializer->write(13, scaled(4));
        serializer->write(14, scaled(5));
        serializer->write(15, scaled(6));
        serializer->write(16, scaled(7));
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        deserializer->read(2, m_raw[1]);
        deserializer->read(3, m_raw[2]);
        deserializer->read(4, m_raw[3]);
        deserializer->read(5, m_raw[4]);
        deserializer->read(6, m_raw[5]);
        deserializer->read(7, m_raw[6]);
        deserializer->read(8, m_raw[7]);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::curves::scaling::Line().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 8> m_raw{};
};

/// sensor Bumper bool[3]
class Bumper : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 12;
    static constexpr std::size_t COUNT = 3;

    Bumper() = default;
    Bumper(const Bumper &) = default;
    Bumper &operator=(const Bumper &) = default;

    static std::int32_t ID() { return 21012; }
    static const std::string ShortName() { return "Bumper"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    bool getRaw(std::size_t element) const { return m_raw[element]; }
    void setRaw(std::size_t element, bool raw) { m_raw[element] = raw; }
    const bool *begin() const { return m_raw.data(); }
    bool *begin() { return m_raw.data(); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw0", "raw0", m_raw[0]);
        visitor.visit(2, LongName() + ".raw1", "raw1", m_raw[1]);
        visitor.visit(3, LongName() + ".raw2", "raw2", m_raw[2]);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Bumper(), "");
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
        serializer->write(2, m_raw[1]);
        serializer->write(3, m_raw[2]);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        deserializer->read(2, m_raw[1]);
        deserializer->read(3, m_raw[2]);
        return in;
    }

private:
    std::array<bool, 3> m_raw{};
};

/// sensor Wheels int32[2]
class Wheels : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 13;
    static constexpr std::size_t COUNT = 2;

    Wheels() = default;
    Wheels(const Wheels &) = default;
    Wheels &operator=(const Wheels &) = default;

    static std::int32_t ID() { return 21013; }
    static const std::string ShortName() { return "Wheels"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    int32_t getRaw(std::size_t element) const { return m_raw[element]; }
    void setRaw(std::size_t element, int32_t raw) { m_raw[element] = raw; }
    const int32_t *begin() const { return m_raw.data(); }
    int32_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return ""; }
    double getValue(std::size_t element) const { return scaled(element); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw0", "raw0", m_raw[0]);
        visitor.visit(2, LongName() + ".raw1", "raw1", m_raw[1]);
        double value0 = scaled(0);
        visitor.visit(3, LongName() + ".value0", "value0", value0);
        double value1 = scaled(1);
        visitor.visit(4, LongName() + ".value1", "value1", value1);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Wheels(), "");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::curves::scaling::Wheels(), "");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, m_raw[1]);
        serializer->write(3, scaled(0));
        serializer->write(4, scaled(1));
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        deserializer->read(2, m_raw[1]);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::curves::scaling::Wheels().of(static_cast<double>(m_raw[element]));
    }
    std::array<int32_t, 2> m_raw{};
};

/// sensor Bent uint16
class Bent : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 14;
    static constexpr std::size_t COUNT = 1;

    Bent() = default;
    Bent(const Bent &) = default;
    Bent &operator=(const Bent &) = default;

    static std::int32_t ID() { return 21014; }
    static const std::string ShortName() { return "Bent"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return ""; }
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
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Bent(), "");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::curves::scaling::Bent(), "");
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
        return ::sense::curves::scaling::Bent().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 1> m_raw{};
};

/// sensor Acceleration int16[3]
class Acceleration : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 30;
    static constexpr std::size_t COUNT = 3;

    Acceleration() = default;
    Acceleration(const Acceleration &) = default;
    Acceleration &operator=(const Acceleration &) = default;

    static std::int32_t ID() { return 21030; }
    static const std::string ShortName() { return "Acceleration"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    int16_t getRaw(std::size_t element) const { return m_raw[element]; }
    void setRaw(std::size_t element, int16_t raw) { m_raw[element] = raw; }
    const int16_t *begin() const { return m_raw.data(); }
    int16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "g"; }
    double getValue(std::size_t element) const { return scaled(element); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw0", "raw0", m_raw[0]);
        visitor.visit(2, LongName() + ".raw1", "raw1", m_raw[1]);
        visitor.visit(3, LongName() + ".raw2", "raw2", m_raw[2]);
        double value0 = scaled(0);
        visitor.visit(4, LongName() + ".value0", "value0", value0);
        double value1 = scaled(1);
        visitor.visit(5, LongName() + ".value1", "value1", value1);
        double value2 = scaled(2);
        visitor.visit(6, LongName() + ".value2", "value2", value2);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Acceleration(), " g");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::curves::scaling::Acceleration(), " g");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, m_raw[1]);
        serializer->write(3, m_raw[2]);
        serializer->write(4, scaled(0));
        serializer->write(5, scaled(1));
        serializer->write(6, scaled(2));
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        deserializer->read(2, m_raw[1]);
        deserializer->read(3, m_raw[2]);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::curves::scaling::Acceleration().of(static_cast<double>(m_raw[element]));
    }
    std::array<int16_t, 3> m_raw{};
};

/// sensor Rate int16[3]
class Rate : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 31;
    static constexpr std::size_t COUNT = 3;

    Rate() = default;
    Rate(const Rate &) = default;
    Rate &operator=(const Rate &) = default;

    static std::int32_t ID() { return 21031; }
    static const std::string ShortName() { return "Rate"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    int16_t getRaw(std::size_t element) const { return m_raw[element]; }
    void setRaw(std::size_t element, int16_t raw) { m_raw[element] = raw; }
    const int16_t *begin() const { return m_raw.data(); }
    int16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "deg/s"; }
    double getValue(std::size_t element) const { return scaled(element); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw0", "raw0", m_raw[0]);
        visitor.visit(2, LongName() + ".raw1", "raw1", m_raw[1]);
        visitor.visit(3, LongName() + ".raw2", "raw2", m_raw[2]);
        double value0 = scaled(0);
        visitor.visit(4, LongName() + ".value0", "value0", value0);
        double value1 = scaled(1);
        visitor.visit(5, LongName() + ".value1", "value1", value1);
        double value2 = scaled(2);
        visitor.visit(6, LongName() + ".value2", "value2", value2);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Rate(), " deg/s");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::curves::scaling::Rate(), " deg/s");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, m_raw[1]);
        serializer->write(3, m_raw[2]);
        serializer->write(4, scaled(0));
        serializer->write(5, scaled(1));
        serializer->write(6, scaled(2));
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        deserializer->read(2, m_raw[1]);
        deserializer->read(3, m_raw[2]);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::curves::scaling::Rate().of(static_cast<double>(m_raw[element]));
    }
    std::array<int16_t, 3> m_raw{};
};

/// sensor Position int32
class Position : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 41;
    static constexpr std::size_t COUNT = 1;

    Position() = default;
    Position(const Position &) = default;
    Position &operator=(const Position &) = default;

    static std::int32_t ID() { return 21041; }
    static const std::string ShortName() { return "Position"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    int32_t getRaw() const { return m_raw[0]; }
    void setRaw(int32_t raw) { m_raw[0] = raw; }
    const int32_t *begin() const { return m_raw.data(); }
    int32_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "deg"; }
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
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Position(), " deg");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::curves::scaling::Position(), " deg");
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
        return ::sense::curves::scaling::Position().of(static_cast<double>(m_raw[element]));
    }
    std::array<int32_t, 1> m_raw{};
};

/// actuator Escs uint16[4]
class Escs : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 20;
    static constexpr std::size_t COUNT = 4;

    Escs() = default;
    Escs(const Escs &) = default;
    Escs &operator=(const Escs &) = default;

    static std::int32_t ID() { return 21020; }
    static const std::string ShortName() { return "Escs"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw(std::size_t element) const { return m_raw[element]; }
    void setRaw(std::size_t element, uint16_t raw) { m_raw[element] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "percent"; }
    double getValue(std::size_t element) const { return scaled(element); }

    /// Takes the value that is shown as `shown`, in its quantity. False, and nothing is taken, where no code is.
    bool setValue(std::size_t element, double shown) {
        return sensedsl::take_code(::sense::curves::scaling::Escs().raw_of(shown), m_raw[element]);
    }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw0", "raw0", m_raw[0]);
        visitor.visit(2, LongName() + ".raw1", "raw1", m_raw[1]);
        visitor.visit(3, LongName() + ".raw2", "raw2", m_raw[2]);
        visitor.visit(4, LongName() + ".raw3", "raw3", m_raw[3]);
        double value0 = scaled(0);
        visitor.visit(5, LongName() + ".value0", "value0", value0);
        double value1 = scaled(1);
        visitor.visit(6, LongName() + ".value1", "value1", value1);
        double value2 = scaled(2);
        visitor.visit(7, LongName() + ".value2", "value2", value2);
        double value3 = scaled(3);
        visitor.visit(8, LongName() + ".value3", "value3", value3);
        bool isRaw = true;
        visitor.visit(9, LongName() + ".is_raw", "is_raw", isRaw);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Escs(), " percent");
    }

    /// Why a board does not get this command, for people; empty when it does.
    std::string refused() const { return m_refused.empty() ? outsideLimits() : m_refused; }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::curves::scaling::Escs(), " percent");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, m_raw[1]);
        serializer->write(3, m_raw[2]);
        serializer->write(4, m_raw[3]);
        serializer->write(5, scaled(0));
        serializer->write(6, scaled(1));
        serializer->write(7, scaled(2));
        serializer->write(8, scaled(3));
        serializer->write(9, true);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        deserializer->read(2, m_raw[1]);
        deserializer->read(3, m_raw[2]);
        deserializer->read(4, m_raw[3]);
        // Written by this class it has codes; by another program perhaps values alone.
        std::array<double, COUNT> shown{};
        bool isRaw = false;
        deserializer->read(5, shown[0]);
        deserializer->read(6, shown[1]);
        deserializer->read(7, shown[2]);
        deserializer->read(8, shown[3]);
        deserializer->read(9, isRaw);
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        m_refused = sensedsl::take_command(::sense::curves::scaling::Escs(), limits, " percent", isRaw, shown.data(),
                                           m_raw.data(), COUNT);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::curves::scaling::Escs().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 4> m_raw{};
    std::string m_refused{};
};

/// actuator Lamps bool[3]
class Lamps : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 21;
    static constexpr std::size_t COUNT = 3;

    Lamps() = default;
    Lamps(const Lamps &) = default;
    Lamps &operator=(const Lamps &) = default;

    static std::int32_t ID() { return 21021; }
    static const std::string ShortName() { return "Lamps"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    bool getRaw(std::size_t element) const { return m_raw[element]; }
    void setRaw(std::size_t element, bool raw) { m_raw[element] = raw; }
    const bool *begin() const { return m_raw.data(); }
    bool *begin() { return m_raw.data(); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw0", "raw0", m_raw[0]);
        visitor.visit(2, LongName() + ".raw1", "raw1", m_raw[1]);
        visitor.visit(3, LongName() + ".raw2", "raw2", m_raw[2]);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Lamps(), "");
    }

    /// Why a board does not get this command, for people; empty when it does.
    std::string refused() const { return outsideLimits(); }

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
        serializer->write(2, m_raw[1]);
        serializer->write(3, m_raw[2]);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        deserializer->read(2, m_raw[1]);
        deserializer->read(3, m_raw[2]);
        return in;
    }

private:
    std::array<bool, 3> m_raw{};
};

/// actuator Winch uint16
class Winch : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 22;
    static constexpr std::size_t COUNT = 1;

    Winch() = default;
    Winch(const Winch &) = default;
    Winch &operator=(const Winch &) = default;

    static std::int32_t ID() { return 21022; }
    static const std::string ShortName() { return "Winch"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint16_t getRaw() const { return m_raw[0]; }
    void setRaw(uint16_t raw) { m_raw[0] = raw; }
    const uint16_t *begin() const { return m_raw.data(); }
    uint16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "N"; }
    double getValue() const { return scaled(0); }

    /// Takes the value that is shown as `shown`, in its quantity. False, and nothing is taken, where no code is.
    bool setValue(double shown) { return sensedsl::take_code(::sense::curves::scaling::Winch().raw_of(shown), m_raw[0]); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        double value0 = scaled(0);
        visitor.visit(2, LongName() + ".value", "value", value0);
        bool isRaw = true;
        visitor.visit(3, LongName() + ".is_raw", "is_raw", isRaw);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-25.0, 100.0};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Winch(), " N");
    }

    /// Why a board does not get this command, for people; empty when it does.
    std::string refused() const { return m_refused.empty() ? outsideLimits() : m_refused; }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::curves::scaling::Winch(), " N");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, scaled(0));
        serializer->write(3, true);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        // Written by this class it has codes; by another program perhaps values alone.
        std::array<double, COUNT> shown{};
        bool isRaw = false;
        deserializer->read(2, shown[0]);
        deserializer->read(3, isRaw);
        const sensedsl::Limits limits = {-25.0, 100.0};
        m_refused = sensedsl::take_command(::sense::curves::scaling::Winch(), limits, " N", isRaw, shown.data(),
                                           m_raw.data(), COUNT);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::curves::scaling::Winch().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint16_t, 1> m_raw{};
    std::string m_refused{};
};

/// actuator Speed int16
class Speed : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 40;
    static constexpr std::size_t COUNT = 1;

    Speed() = default;
    Speed(const Speed &) = default;
    Speed &operator=(const Speed &) = default;

    static std::int32_t ID() { return 21040; }
    static const std::string ShortName() { return "Speed"; }
    static const std::string LongName() { return "sense.curves." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    int16_t getRaw() const { return m_raw[0]; }
    void setRaw(int16_t raw) { m_raw[0] = raw; }
    const int16_t *begin() const { return m_raw.data(); }
    int16_t *begin() { return m_raw.data(); }

    static std::string Quantity() { return "%"; }
    double getValue() const { return scaled(0); }

    /// Takes the value that is shown as `shown`, in its quantity. False, and nothing is taken, where no code is.
    bool setValue(double shown) { return sensedsl::take_code(::sense::curves::scaling::Speed().raw_of(shown), m_raw[0]); }

    void accept(odcore::base::Visitor &visitor) override {
        visitor.beginVisit(ID(), ShortName(), LongName());
        visitor.visit(1, LongName() + ".raw", "raw", m_raw[0]);
        double value0 = scaled(0);
        visitor.visit(2, LongName() + ".value", "value", value0);
        bool isRaw = true;
        visitor.visit(3, LongName() + ".is_raw", "is_raw", isRaw);
        visitor.endVisit();
    }

    /// What is outside the limits that the design gives, for people; empty when nothing is.
    std::string outsideLimits() const {
        const sensedsl::Limits limits = {-100.0, 100.0};
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::curves::scaling::Speed(), " %");
    }

    /// Why a board does not get this command, for people; empty when it does.
    std::string refused() const { return m_refused.empty() ? outsideLimits() : m_refused; }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::curves::scaling::Speed(), " %");
        text << outsideLimits();
        return text.str();
    }

    std::ostream &operator<<(std::ostream &out) const override {
        auto serializer = odcore::serialization::SerializationFactory::getInstance().getSerializer(out);
        serializer->write(1, m_raw[0]);
        serializer->write(2, scaled(0));
        serializer->write(3, true);
        return out;
    }

    std::istream &operator>>(std::istream &in) override {
        auto deserializer = odcore::serialization::SerializationFactory::getInstance().getDeserializer(in);
        deserializer->read(1, m_raw[0]);
        // Written by this class it has codes; by another program perhaps values alone.
        std::array<double, COUNT> shown{};
        bool isRaw = false;
        deserializer->read(2, shown[0]);
        deserializer->read(3, isRaw);
        const sensedsl::Limits limits = {-100.0, 100.0};
        m_refused = sensedsl::take_command(::sense::curves::scaling::Speed(), limits, " %", isRaw, shown.data(),
                                           m_raw.data(), COUNT);
        return in;
    }

private:
    double scaled(std::size_t element) const {
        return ::sense::curves::scaling::Speed().of(static_cast<double>(m_raw[element]));
    }
    std::array<int16_t, 1> m_raw{};
    std::string m_refused{};
};

} // namespace curves
} // namespace sense

#endif
