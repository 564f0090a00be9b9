// In what two schemas differ, device by device, in words for people.
//
// In: the schema texts of this program and of the board, of which the schema hash is made
// (`17 sensor IRFront uint16`, a line each). Out: a line for each difference. C++98.
#ifndef SENSEDSL_DIFFERENCE_HPP
#define SENSEDSL_DIFFERENCE_HPP

#include <stdint.h>

#include <sstream>
#include <string>
#include <vector>

namespace sensedsl {

/// CRC-32 as zlib has it: of a schema text it is the schema hash.
inline uint32_t crc32(const std::string &text) {
    uint32_t crc = 0xFFFFFFFFU;
    for (size_t i = 0; i < text.size(); ++i) {
        crc ^= static_cast<uint8_t>(text[i]);
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
        }
    }
    return ~crc;
}

/// One line of a schema text.
struct SchemaLine {
    std::string id, direction, name, type;

    /// False when the line is no device.
    bool read(const std::string &line) {
        std::istringstream words(line);
        std::string more;
        return (words >> id >> direction >> name >> type) && !(words >> more) &&
               id.find_first_not_of("0123456789") == std::string::npos &&
               (direction == "sensor" || direction == "actuator");
    }
    bool operator==(const SchemaLine &other) const {
        return id == other.id && direction == other.direction && name == other.name &&
               type == other.type;
    }
    std::string text() const { return direction + " " + type + ", identifier " + id; }
};

/// A schema text, read.
struct SchemaText {
    explicit SchemaText(const std::string &text) : checksum(), has_stamp(false), devices() {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            SchemaLine device;
            if (line.compare(0, 9, "checksum ") == 0) {
                checksum = line.substr(9);
            } else if (line == "stamp") {
                has_stamp = true;
            } else if (device.read(line)) {
                devices.push_back(device);
            }
        }
    }
    const SchemaLine *find(const std::string &name) const {
        for (size_t i = 0; i < devices.size(); ++i) {
            if (devices[i].name == name) {
                return &devices[i];
            }
        }
        return NULL;
    }

    std::string checksum;
    bool has_stamp;
    std::vector<SchemaLine> devices;
};

/// A line for each difference, each ending with a line feed.
inline std::string differences(const std::string &own, const std::string &board) {
    const SchemaText here(own);
    const SchemaText there(board);
    std::string text;
    if (here.checksum != there.checksum) {
        text += "  checksum: " + here.checksum + " here, " + there.checksum + " on the board\n";
    }
    if (here.has_stamp != there.has_stamp) {
        text += here.has_stamp ? "  stamp: reports have one here, none on the board\n"
                               : "  stamp: reports have none here, one on the board\n";
    }
    for (size_t i = 0; i < here.devices.size(); ++i) {
        const SchemaLine &device = here.devices[i];
        const SchemaLine *other = there.find(device.name);
        if (other == NULL) {
            text += "  " + device.name + ": only here (" + device.text() + ")\n";
        } else if (!(*other == device)) {
            text += "  " + device.name + ": " + device.text() + " here, " + other->text() +
                    " on the board\n";
        }
    }
    for (size_t i = 0; i < there.devices.size(); ++i) {
        if (here.find(there.devices[i].name) == NULL) {
            text += "  " + there.devices[i].name + ": only on the board (" +
                    there.devices[i].text() + ")\n";
        }
    }
    return text.empty() ? "  the same devices, in another order\n" : text;
}

/// Takes what a board's shell prints, prompts and echoes included, until the schema text of a known
/// hash is whole.
class SchemaReader {
public:
    explicit SchemaReader(uint32_t hash) : hash_(hash), line_(), text_() {}

    /// True once the text is whole.
    bool feed(const uint8_t *bytes, size_t count) {
        for (size_t i = 0; i < count; ++i) {
            const char character = static_cast<char>(bytes[i]);
            if (character == '\n') {
                take_line();
                if (is_whole()) {
                    return true;
                }
            } else if (character != '\r' && line_.size() < 200) {
                line_ += character;
            }
        }
        return is_whole();
    }

    bool is_whole() const { return !text_.empty() && crc32(text_) == hash_; }
    const std::string &text() const { return text_; }

private:
    void take_line() {
        SchemaLine device;
        const size_t start = line_.find("checksum ");
        if (start != std::string::npos) {
            text_ = line_.substr(start) + "\n";
        } else if (line_ == "stamp" && text_.find('\n') + 1 == text_.size()) {
            text_ += line_ + "\n";
        } else if (!text_.empty() && device.read(line_) && text_.size() < 65536) {
            text_ += line_ + "\n";
        }
        line_.clear();
    }

    uint32_t hash_;
    std::string line_;
    std::string text_;
};

} // namespace sensedsl

#endif
