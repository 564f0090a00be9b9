// What the shared files of the C++ hosts do without a board: typed and scaled values, USB identities in a made-up
// /sys, differences of schemas, sessions with a made-up clock, options, any baud rate on a real
// pseudo-terminal. Argument: an empty folder. Prints `ok`, or each check that failed.
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iostream>
#include <string>

#include "sense/robot/STM32F4DiscoveryBoard_schema.hpp"
#include "sensedsl/command.hpp"
#include "sensedsl/connection.hpp"
#include "sensedsl/options.hpp"
#include "sensedsl/text.hpp"
#include "sensedsl/thread.hpp"

using namespace sensedsl;

static int failures = 0;

static void check(bool is_right, const char *what, int line) {
    if (!is_right) {
        std::cout << line << ": " << what << "\n";
        ++failures;
    }
}
#define CHECK(condition) check(condition, #condition, __LINE__)

template <typename T> static bool reads(const char *text, T expected) {
    T value = T();
    return read_typed(text, value).empty() && !(value < expected) && !(expected < value);
}
template <typename T> static std::string refusal(const char *text) {
    T value = T();
    return read_typed(text, value);
}

static void typed_values() {
    CHECK(reads<uint8_t>("010", 10));
    CHECK(reads<int16_t>("-010", -10));
    CHECK(reads<uint8_t>("+5", 5));
    CHECK(reads<uint16_t>("0x1F", 31));
    CHECK(reads<uint64_t>("18446744073709551615", UINT64_MAX));
    CHECK(reads<int64_t>("-9223372036854775808", INT64_MIN));
    CHECK(reads<uint32_t>("-0", 0));
    CHECK(refusal<uint8_t>("-1") == "is not in the range 0 to 255");
    CHECK(refusal<int8_t>("128") == "is not in the range -128 to 127");
    CHECK(refusal<uint64_t>("18446744073709551616") == "is not in the range 0 to 18446744073709551615");
    CHECK(!refusal<uint8_t>("").empty() && !refusal<uint8_t>(" 5").empty() && !refusal<uint8_t>("5 ").empty());
    CHECK(!refusal<uint8_t>("0x").empty() && !refusal<uint8_t>("--5").empty() && !refusal<uint8_t>("5a").empty());
    CHECK(reads<float>("0.1", 0.1F) && reads<double>("-2.5e3", -2500.0));
    CHECK(!refusal<double>("nan").empty() && !refusal<double>("inf").empty() && !refusal<float>("1e39").empty());
    CHECK(!refusal<double>("1e999").empty() && !refusal<double>("1e").empty() && !refusal<double>("0x10").empty());
    CHECK(reads<bool>("true", true) && reads<bool>("0", false) && !refusal<bool>("yes").empty());
    const Limits limits = {-30.0, 30.0};
    CHECK(outside(limits, 30.0, " deg").empty());
    CHECK(outside(limits, 31.0, " deg") == " (above the maximum of 30 deg)");
    CHECK(outside(limits, -31.0, "") == " (below the minimum of -30)");
}

static bool shows(const Scaling &scaling, double raw, double expected) {
    const double found = scaling.of(raw);
    return !(found < expected) && !(found > expected) && !(found != found);
}

static void scaled_values() {
    static const Point points[] = {{0.0, 10.0}, {4.0, 30.0}, {5.0, -1.0}};
    static const Point one[] = {{2.0, 7.0}};
    const Scaling straight(0.5, -1.0), bent(1.0, 0.0, points), half(0.5, 1.0, points), flat(1.0, 0.0, one);
    CHECK(shows(straight, 6.0, 2.0) && shows(straight, -6.0, -4.0));
    CHECK(shows(bent, 0.0, 10.0) && shows(bent, 4.0, 30.0) && shows(bent, 5.0, -1.0));
    CHECK(shows(bent, 1.0, 15.0) && shows(bent, 4.5, 14.5));
    CHECK(shows(bent, -1e300, 10.0) && shows(bent, 5.25, -1.0));
    CHECK(shows(half, -2.0, 10.0) && shows(half, 0.0, 15.0) && shows(half, 8.0, -1.0));
    CHECK(shows(flat, 1.0, 7.0) && shows(flat, 2.0, 7.0) && shows(flat, 3.0, 7.0));
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK(shows(bent, infinity, -1.0) && shows(bent, -infinity, 10.0));
    CHECK(bent.of(infinity - infinity) != bent.of(infinity - infinity));
    const uint16_t raw[] = {0, 2, 5};
    const Limits limits = {0.0, 25.0};
    CHECK(outside_of(limits, raw, 2, bent, " cm").empty());
    CHECK(outside_of(limits, raw, 3, bent, " cm") == " (below the minimum of 0 cm)");
    std::ostringstream text;
    print_scaled(text, raw, 3, bent, " cm");
    print_scaled(text, raw + 1, 1, bent, "");
    CHECK(text.str() == " ([10, 20, -1] cm) (20)");
    CHECK(shown_text(4294967295.0) == "4294967295" && shown_text(-0.1) == "-0.1");
    CHECK(shown_text(2.0 / 3.0) == "0.666666667" && shown_text(1e300) == "1e+300");
}

template <typename T>
static std::string commanded(const Scaling &scaling, bool is_raw, double shown, T &raw) {
    const Limits limits = {-25.0, 100.0};
    return take_command(scaling, limits, " N", is_raw, &shown, &raw, 1);
}

/// A message to an actuator is taken as it is shown; its codes count where it says so.
static void commands() {
    static const Point points[] = {{0.0, -50.0}, {1000.0, 0.0}, {2000.0, 200.0}};
    const Scaling bent(0.5, 0.0, points), plain(1.0, 0.0), steep(100.0, 0.0);
    uint16_t raw = 0;
    CHECK(commanded(bent, false, 100.0, raw).empty() && raw == 3000);
    raw = 0;
    CHECK(commanded(bent, false, 101.0, raw) == " 101 N (above the maximum of 100 N)" && raw == 0);
    CHECK(commanded(bent, false, std::numeric_limits<double>::quiet_NaN(), raw).find("not a number") != std::string::npos);
    raw = 900;
    CHECK(commanded(bent, true, 0.0, raw) == " (below the minimum of -25 N)");
    CHECK(commanded(bent, false, 0.0, raw).find("`is_raw` is not") != std::string::npos && raw == 900);
    raw = 2000;
    CHECK(commanded(bent, true, 77.0, raw).empty() && raw == 2000);
    int8_t small = 0;
    CHECK(commanded(steep, false, 100.0, small).empty() && small == 1);
    small = 0;
    CHECK(commanded(Scaling(0.5, 0.0), false, 80.0, small) == " 80 N is out of reach of the value" && small == 0);
    bool is_on = false;
    CHECK(commanded(plain, false, 1.0, is_on).empty() && is_on);
    is_on = false;
    CHECK(commanded(plain, false, 2.0, is_on) == " 2 N is out of reach of the value");
    float real = 0.0F;
    CHECK(commanded(plain, false, 0.5, real).empty() && real > 0.4F && real < 0.6F);
}

static void folder(const std::string &path) {
    for (size_t at = 1; at != std::string::npos; at = path.find('/', at + 1)) {
        ::mkdir(path.substr(0, at).c_str(), 0777);
    }
    ::mkdir(path.c_str(), 0777);
}
static void file(const std::string &path, const std::string &line) {
    std::ofstream file(path.c_str());
    file << line << "\n";
}

/// One USB device as Linux shows it: the device, its function, and the link from the port.
static void plug(const std::string &root, const std::string &socket, const std::string &port,
                 const std::string &serial) {
    const std::string device = root + "/sys/devices/usb1/" + socket;
    const std::string function = device + "/" + socket + ":1.0";
    folder(function);
    file(device + "/idVendor", "0483");
    file(device + "/idProduct", "5740");
    if (!serial.empty()) {
        file(device + "/serial", serial);
    }
    file(function + "/bInterfaceNumber", "00");
    folder(root + "/sys/class/tty/" + port);
    folder(root + "/dev");
    file(root + "/dev/" + port, "");
    const std::string link = root + "/sys/class/tty/" + port + "/device";
    ::unlink(link.c_str());
    CHECK(::symlink(function.c_str(), link.c_str()) == 0);
}
static void unplug(const std::string &root, const std::string &port) {
    ::unlink((root + "/sys/class/tty/" + port + "/device").c_str());
    ::unlink((root + "/dev/" + port).c_str());
}

static void usb_identities(const std::string &root) {
    const UsbPorts ports(root + "/sys", root + "/dev");
    plug(root, "1-1", "ttyACM0", "AAAA");
    plug(root, "1-2", "ttyACM1", "BBBB");
    folder(root + "/sys/class/tty/ttyS0");
    const UsbIdentity first = ports.identity(root + "/dev/ttyACM0");
    CHECK(first.vendor == "0483" && first.product == "5740" && first.serial == "AAAA");
    CHECK(ports.find(first) == root + "/dev/ttyACM0");
    CHECK(ports.identity(root + "/dev/ttyS0").empty() && ports.find(UsbIdentity()).empty());
    // It comes back in another socket, and its old name has been given to another device.
    unplug(root, "ttyACM0");
    unplug(root, "ttyACM1");
    CHECK(ports.find(first).empty());
    plug(root, "1-2", "ttyACM0", "BBBB");
    plug(root, "1-4", "ttyACM1", "AAAA");
    CHECK(ports.find(first) == root + "/dev/ttyACM1");
    // Without a serial number only the socket tells two equal devices apart.
    plug(root, "1-5", "ttyACM2", "");
    plug(root, "1-6", "ttyACM3", "");
    const UsbIdentity nameless = ports.identity(root + "/dev/ttyACM3");
    CHECK(ports.find(nameless) == root + "/dev/ttyACM3");
    unplug(root, "ttyACM3");
    CHECK(ports.find(nameless).empty());
}

static void schemas() {
    const BoardFacts &facts = sense::robot::facts::STM32F4DiscoveryBoard();
    const std::string own = facts.schema_text;
    CHECK(crc32("123456789") == 0xCBF43926U && crc32(own) == facts.schema->hash);
    const std::string board = "checksum crc16\n17 sensor IRFront int16\n19 sensor USRear uint8\n"
                              "20 sensor WheelEncoder uint32\n30 actuator Steering int8\n";
    CHECK(differences(own, board) ==
          "  checksum: none here, crc16 on the board\n"
          "  IRFront: sensor uint16, identifier 17 here, sensor int16, identifier 17 on the board\n"
          "  IRFrontRight: only here (sensor uint16, identifier 18)\n"
          "  Steering: only on the board (actuator int8, identifier 30)\n");
    // As a shell prints it, with an echo before and a prompt behind, cut anywhere.
    std::string printed = "\r\nChibiOS/RT Shell\r\nch> schema\r\n";
    for (size_t i = 0; i < board.size(); ++i) {
        printed += board[i] == '\n' ? std::string("\r\n") : std::string(1, board[i]);
    }
    printed += "ch> ";
    SchemaReader reader(crc32(board));
    for (size_t i = 0; i < printed.size(); ++i) {
        const uint8_t byte = static_cast<uint8_t>(printed[i]);
        reader.feed(&byte, 1);
    }
    CHECK(reader.is_whole() && reader.text() == board);
    SchemaReader other(crc32(own));
    const Bytes bytes(printed.begin(), printed.end());
    CHECK(!other.feed(&bytes[0], bytes.size()));
}

class Count : public Sink {
public:
    Count() : values(0) {}
    virtual void on_value(uint8_t, const uint8_t *) { ++values; }
    int values;
};

static void sessions() {
    const BoardFacts &facts = sense::robot::facts::STM32F4DiscoveryBoard();
    const Bytes greeting = hello(*facts.schema);
    Report report(*facts.schema, facts.schema->sensors);
    const uint16_t front = 300;
    CHECK(report.set(17, &front, 1));
    const Bytes frame = report.frame();
    Count count;
    Session session(facts, count);
    session.start(1000);
    int requests = 0;
    for (Milliseconds now = 1000; now < 3000; now += 10) {
        requests += session.to_send(now).empty() ? 0 : 1;
        session.feed(&frame[0], frame.size(), now);
    }
    CHECK(requests == 8 && count.values == 0 && session.is_unanswered());
    CHECK(session.withheld_frames() == 200);
    session.feed(&greeting[0], greeting.size(), 3000);
    session.feed(&frame[0], frame.size(), 3000);
    CHECK(session.state() == Session::matched && count.values == 1 && session.to_send(9000).empty());
    // Restarted with other firmware while the device stayed: not one value more.
    const char other[] = "5:\0\1\2\3\4,";
    session.feed(reinterpret_cast<const uint8_t *>(other), sizeof other - 1, 4000);
    session.feed(&frame[0], frame.size(), 4000);
    CHECK(session.state() == Session::comparing && count.values == 1);
    std::string sent;
    for (Milliseconds now = 4000; now < 7000; now += 10) {
        const Bytes bytes = session.to_send(now);
        sent.append(bytes.begin(), bytes.end());
    }
    CHECK(sent == "q\rschema\rq\rschema\r" && session.state() == Session::refused);
    CHECK(session.difference().find("does not say in which devices") != std::string::npos);
    // A board whose frames have a checksum is heard as well, and told apart.
    Schema with_checksum = *facts.schema;
    const Checksum others[] = {checksum_crc16, checksum_crc32};
    for (size_t i = 0; i < 2; ++i) {
        Session checked(facts, count);
        with_checksum.checksum = others[i];
        with_checksum.hash = 7;
        const Bytes other_form = hello(with_checksum);
        checked.start(0);
        checked.feed(&other_form[0], other_form.size(), 10);
        CHECK(checked.state() == Session::asking);
        checked.feed(&other_form[0], other_form.size(), 20);
        CHECK(checked.state() == Session::comparing);
    }
}

static void options() {
    const Option known[] = {{"cid", "N", "session"}, {"verbose", NULL, "more"}};
    char program[] = "p", cid[] = "--cid=111", verbose[] = "--verbose=1", dashes[] = "--", word[] = "--x";
    char bare[] = "--cid", unknown[] = "--nope";
    char *good[] = {program, cid, verbose, dashes, word};
    Options given(known, 2);
    CHECK(given.read(5, good).empty() && given.value("cid") == "111" && given.has("verbose"));
    CHECK(given.words().size() == 1 && given.words()[0] == "--x");
    char *lacking[] = {program, bare};
    CHECK(given.read(2, lacking) == "--cid needs a value: --cid=N");
    char *strange[] = {program, unknown};
    CHECK(given.read(2, strange) == "unknown option --nope: see --help");
}

static void rates() {
    const int board = ::posix_openpt(O_RDWR | O_NOCTTY);
    CHECK(board >= 0 && ::grantpt(board) == 0 && ::unlockpt(board) == 0);
    const std::string device = ::ptsname(board);
    const unsigned bauds[] = {1200, 115200, 250000, 420000, 2000000, 12345};
    for (size_t i = 0; i < sizeof bauds / sizeof bauds[0]; ++i) {
        Serial serial(device, bauds[i]);
        CHECK(baud_rate::get(serial.descriptor()) == bauds[i]);
    }
    const Serial first(device, 115200);
    std::string refused;
    try {
        const Serial second(device, 115200);
    } catch (const OpenError &error) {
        refused = error.what();
    }
    CHECK(refused == "cannot open " + device + ": this program itself has it open: end that program first");
    ::close(board);
}

int main(int argc, char **argv) {
    const std::string root = argc > 1 ? argv[1] : ".";
    typed_values();
    scaled_values();
    commands();
    usb_identities(real_path(root));
    schemas();
    sessions();
    options();
    rates();
    CHECK(cause_of(root + "/none", ENOENT).find("there is no such device") == 0);
    CHECK(devices_here(real_path(root) + "/dev").find("ttyACM0") != std::string::npos);
    if (failures == 0) {
        std::cout << "ok\n";
    }
    return failures == 0 ? 0 : 1;
}
