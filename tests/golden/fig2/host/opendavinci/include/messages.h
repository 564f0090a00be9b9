// The messages of this design for OpenDaVINCI 4. Written by SenseDSL; do not edit.
// These are the classes that `sense.odvd` describes, in the form in which OpenDaVINCI serializes them.
#ifndef SENSE_fig2_MESSAGES_H
#define SENSE_fig2_MESSAGES_H

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

#include "sense/fig2/STM32F4DiscoveryBoard_schema.hpp"
#include "sensedsl/command.hpp"
#include "sensedsl/text.hpp"

namespace sense {
namespace fig2 {

/// sensor IRFront uint16
class IRFront : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 17;
    static constexpr std::size_t COUNT = 1;

    IRFront() = default;
    IRFront(const IRFront &) = default;
    IRFront &operator=(const IRFront &) = default;

    static std::int32_t ID() { return 21017; }
    static const std::string ShortName() { return "IRFront"; }
    static const std::string LongName() { return "sense.fig2." + ShortName(); }
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
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::fig2::scaling::IRFront(), "");
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

/// sensor IRFrontRight uint16
class IRFrontRight : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 18;
    static constexpr std::size_t COUNT = 1;

    IRFrontRight() = default;
    IRFrontRight(const IRFrontRight &) = default;
    IRFrontRight &operator=(const IRFrontRight &) = default;

    static std::int32_t ID() { return 21018; }
    static const std::string ShortName() { return "IRFrontRight"; }
    static const std::string LongName() { return "sense.fig2." + ShortName(); }
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
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::fig2::scaling::IRFrontRight(), "");
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

/// sensor USRear uint8
class USRear : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 19;
    static constexpr std::size_t COUNT = 1;

    USRear() = default;
    USRear(const USRear &) = default;
    USRear &operator=(const USRear &) = default;

    static std::int32_t ID() { return 21019; }
    static const std::string ShortName() { return "USRear"; }
    static const std::string LongName() { return "sense.fig2." + ShortName(); }
    std::int32_t getID() const override { return ID(); }
    const std::string getShortName() const override { return ShortName(); }
    const std::string getLongName() const override { return LongName(); }

    uint8_t getRaw() const { return m_raw[0]; }
    void setRaw(uint8_t raw) { m_raw[0] = raw; }
    const uint8_t *begin() const { return m_raw.data(); }
    uint8_t *begin() { return m_raw.data(); }

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
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::fig2::scaling::USRear(), " cm");
    }

    const std::string toString() const override {
        std::ostringstream text;
        text << ShortName() << " = ";
        sensedsl::print_all(text, m_raw.data(), COUNT);
        sensedsl::print_scaled(text, m_raw.data(), COUNT, ::sense::fig2::scaling::USRear(), " cm");
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
        return ::sense::fig2::scaling::USRear().of(static_cast<double>(m_raw[element]));
    }
    std::array<uint8_t, 1> m_raw{};
};

/// sensor WheelEncoder uint32
class WheelEncoder : public odcore::data::SerializableData, public odcore::base::Visitable {
public:
    static constexpr std::uint8_t WIRE_ID = 20;
    static constexpr std::size_t COUNT = 1;

    WheelEncoder() = default;
    WheelEncoder(const WheelEncoder &) = default;
    WheelEncoder &operator=(const WheelEncoder &) = default;

    static std::int32_t ID() { return 21020; }
    static const std::string ShortName() { return "WheelEncoder"; }
    static const std::string LongName() { return "sense.fig2." + ShortName(); }
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
        return sensedsl::outside_of(limits, m_raw.data(), COUNT, ::sense::fig2::scaling::WheelEncoder(), "");
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

} // namespace fig2
} // namespace sense

#endif
