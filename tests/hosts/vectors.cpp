// Runs wire vectors through the C++ decoder and encoder of a generated host.
//
// In, a line each: `hash`, `decode sensors|actuators HEX...`, `encode sensors|actuators ID=V,V...` (behind
// `sensors` comes `stamp=MICROSECONDS/COUNTER` where there are stamps), `encode-health` and what the vector
// files call `got health`.
// Out: what the vector files call `hash`, `got`, `dropped` and `frame`, and `end` behind each command.
// A stream is decoded at once, byte by byte, as given and cut at each place; `differs` says that
// two of these did not agree. `items.h` is `#define ITEMS(X) X(17, uint16_t, 1) ...`, made by the test.
#include "sense/robot/Vectors_schema.hpp"
#include "items.h"

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "sensedsl/link.hpp"
#include "sensedsl/text.hpp"

using sensedsl::Bytes;

namespace {

const sensedsl::Schema &schema() { return *sense::robot::facts::Vectors().schema; }

template <typename T> void print_values(std::ostream &out, const uint8_t *bytes, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        out << (i == 0 ? '=' : ',');
        sensedsl::print(out, sensedsl::load<T>(bytes + i * sizeof(T)));
    }
}

class Log : public sensedsl::Sink {
public:
    Log() : text_(), line_() {}
    std::string text() const { return text_.str(); }

private:
    virtual void on_hello(uint32_t hash) {
        char digits[16];
        snprintf(digits, sizeof digits, "0x%08x", static_cast<unsigned>(hash));
        text_ << "got hello " << digits << "\n";
    }
    virtual void on_hello_request() { text_ << "got hello-request\n"; }
    virtual void on_health_request() { text_ << "got health-request\n"; }
    virtual void on_other_health(uint8_t version) { text_ << "got health-version " << +version << "\n"; }
    virtual void on_health(const sensedsl::Health &health) {
        text_ << "got health " << health.uptime_ms << ' ' << +health.reset_cause << ' ' << +health.reset_device << ' '
              << health.reports_sent << ' ' << health.reports_refused << ' ' << +health.load_percent << ' '
              << health.stack_left_bytes;
        for (size_t i = 0; i < health.devices.size(); ++i) {
            const sensedsl::DeviceHealth &device = health.devices[i];
            text_ << ' ' << +device.id << '=' << +device.status << '/' << device.age_ms;
            for (size_t cause = 0; cause < sensedsl::cause_count; ++cause) {
                text_ << '/' << device.counts[cause];
            }
        }
        text_ << "\n";
    }
    virtual void on_stamp(const sensedsl::Stamp &stamp) {
        line_ << " stamp=" << stamp.time_us << '/' << +stamp.counter;
    }
    virtual void on_value(uint8_t id, const uint8_t *bytes) {
        line_ << ' ' << +id;
        switch (id) {
#define ITEM(ID, TYPE, COUNT)                                                                      \
    case ID:                                                                                       \
        print_values<TYPE>(line_, bytes, COUNT);                                                   \
        break;
            ITEMS(ITEM)
#undef ITEM
        default:
            break;
        }
    }
    virtual void on_frame_end() {
        text_ << "got" << line_.str() << "\n";
        line_.str("");
    }

    std::ostringstream text_;
    std::ostringstream line_;
};

std::string decode(const sensedsl::Direction &direction, const std::vector<Bytes> &chunks) {
    Log log;
    sensedsl::Decoder decoder(schema(), direction, log);
    for (size_t i = 0; i < chunks.size(); ++i) {
        // A copy of the exact size lets a sanitizer see each byte read too far.
        const Bytes chunk(chunks[i]);
        decoder.feed(chunk.empty() ? NULL : &chunk[0], chunk.size());
    }
    std::ostringstream text;
    text << log.text() << "dropped " << decoder.dropped_bytes() << "\n";
    return text.str();
}

void decode_every_way(const sensedsl::Direction &direction, const std::vector<Bytes> &chunks) {
    const std::string text = decode(direction, chunks);
    Bytes all;
    for (size_t i = 0; i < chunks.size(); ++i) {
        all.insert(all.end(), chunks[i].begin(), chunks[i].end());
    }
    std::vector<Bytes> single;
    for (size_t cut = 0; cut <= all.size(); ++cut) {
        const Bytes::iterator at = all.begin() + static_cast<Bytes::difference_type>(cut);
        std::vector<Bytes> halves;
        halves.push_back(Bytes(all.begin(), at));
        halves.push_back(Bytes(at, all.end()));
        if (decode(direction, halves) != text) {
            std::cout << "differs when cut at " << cut << "\n";
        }
        if (cut < all.size()) {
            single.push_back(Bytes(1, all[cut]));
        }
    }
    if (decode(direction, single) != text) {
        std::cout << "differs byte by byte\n";
    }
    std::cout << text;
}

template <typename T> void set(sensedsl::Report &report, uint8_t id, size_t count, std::string text) {
    std::vector<T> scalars;
    for (size_t i = 0; i < text.size(); ++i) {
        text[i] = text[i] == ',' ? ' ' : text[i];
    }
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        T value = T();
        if (!sensedsl::parse(word, value)) {
            std::cout << "no value: " << word << "\n";
        }
        scalars.push_back(value);
    }
    // Not of the vector itself: the vector of bool has no elements to point to.
    T array[64] = {};
    for (size_t i = 0; i < scalars.size() && i < 64; ++i) {
        array[i] = scalars[i];
    }
    if (scalars.size() != count || !report.set(id, array, count)) {
        std::cout << "not set: " << +id << "\n";
    }
}

void print_hex(const Bytes &bytes) {
    for (size_t i = 0; i < bytes.size(); ++i) {
        char digits[4];
        snprintf(digits, sizeof digits, "%02x", static_cast<unsigned>(bytes[i]));
        std::cout << digits;
    }
    std::cout << "\n";
}

void encode(const sensedsl::Direction &direction, std::istream &words) {
    sensedsl::Report report(schema(), direction);
    sensedsl::Stamp stamp = {0, 0};
    bool has_stamp = false;
    for (std::string word; words >> word;) {
        const size_t equals = word.find('=');
        if (word.compare(0, equals, "stamp") == 0) {
            const size_t slash = word.find('/');
            has_stamp = sensedsl::parse(word.substr(equals + 1, slash - equals - 1), stamp.time_us) &&
                        sensedsl::parse(word.substr(slash + 1), stamp.counter);
            continue;
        }
        uint8_t id = 0;
        if (!sensedsl::parse(word.substr(0, equals), id)) {
            std::cout << "no identifier: " << word << "\n";
        }
        const std::string text = word.substr(equals + 1);
        switch (id) {
#define ITEM(ID, TYPE, COUNT)                                                                      \
    case ID:                                                                                       \
        set<TYPE>(report, id, COUNT, text);                                                        \
        break;
            ITEMS(ITEM)
#undef ITEM
        default:
            break;
        }
    }
    std::cout << "frame ";
    print_hex(has_stamp ? report.frame(stamp) : report.frame());
}

/// The next number of a text, whatever stands between numbers.
template <typename T> T number(std::istream &text) {
    while (text.peek() == ' ' || text.peek() == '=' || text.peek() == '/') {
        text.get();
    }
    uint32_t wide = 0;
    text >> wide;
    return static_cast<T>(wide);
}

void encode_health(std::istream &words) {
    sensedsl::Health health;
    health.uptime_ms = number<uint32_t>(words);
    health.reset_cause = number<uint8_t>(words);
    health.reset_device = number<uint8_t>(words);
    health.reports_sent = number<uint32_t>(words);
    health.reports_refused = number<uint32_t>(words);
    health.load_percent = number<uint8_t>(words);
    health.stack_left_bytes = number<uint16_t>(words);
    for (size_t i = 0; i < schema().device_count; ++i) {
        sensedsl::DeviceHealth device;
        device.id = number<uint8_t>(words);
        device.status = number<uint8_t>(words);
        device.age_ms = number<uint32_t>(words);
        for (size_t cause = 0; cause < sensedsl::cause_count; ++cause) {
            device.counts[cause] = number<uint16_t>(words);
        }
        health.devices.push_back(device);
    }
    std::cout << "frame ";
    print_hex(sensedsl::health_frame(schema(), health));
}

Bytes from_hex(const std::string &text) {
    Bytes bytes;
    for (size_t i = 0; i + 1 < text.size(); i += 2) {
        bytes.push_back(static_cast<uint8_t>(strtoul(text.substr(i, 2).c_str(), NULL, 16)));
    }
    return bytes;
}

} // namespace

int main() {
    for (std::string line; std::getline(std::cin, line);) {
        std::istringstream words(line);
        std::string command;
        std::string way;
        words >> command;
        if (command == "encode-health") {
            encode_health(words);
            std::cout << "end" << std::endl;
            continue;
        }
        words >> way;
        const sensedsl::Direction &direction =
            way == "actuators" ? schema().actuators : schema().sensors;
        if (command == "decode") {
            std::vector<Bytes> chunks;
            for (std::string word; words >> word;) {
                chunks.push_back(from_hex(word));
            }
            decode_every_way(direction, chunks);
        } else if (command == "encode") {
            encode(direction, words);
        } else if (command == "hash") {
            std::cout << "hello ";
            print_hex(sensedsl::hello(schema()));
            std::cout << "hello-request ";
            print_hex(sensedsl::hello_request(schema()));
            std::cout << "health-request ";
            print_hex(sensedsl::health_request(schema()));
        }
        std::cout << "end" << std::endl;
    }
    return 0;
}
