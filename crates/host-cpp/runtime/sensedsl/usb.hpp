// Which USB device a serial port is, so that it is found again under another name.
//
// In: the path of a serial port, and the kernel's description of devices (Linux: /sys). Out: its
// identity, and the path of the port that has it now. C++98.
#ifndef SENSEDSL_USB_HPP
#define SENSEDSL_USB_HPP

#include <sys/stat.h>

#include <string>
#include <vector>

#include "sensedsl/cause.hpp"

namespace sensedsl {

/// What tells one serial port of one USB device from all others.
struct UsbIdentity {
    std::string vendor, product, serial;
    /// Which of the device's functions: one device may be several serial ports.
    std::string function;
    /// Where it is plugged in; counts only for devices without a serial number.
    std::string socket;

    bool empty() const { return vendor.empty(); }

    bool is(const UsbIdentity &other) const {
        return !empty() && vendor == other.vendor && product == other.product &&
               serial == other.serial && function == other.function &&
               (!serial.empty() || socket == other.socket);
    }
};

/// The serial ports of this machine; the folders are the system's unless a test has others.
class UsbPorts {
public:
    explicit UsbPorts(const std::string &sys = "/sys", const std::string &dev = "/dev")
        : ports_(real_path(sys + "/class/tty")), dev_(dev) {}

    /// The identity of a port; empty when it is not a USB device or the system does not say.
    UsbIdentity identity(const std::string &path) const {
        const std::string real = real_path(path);
        return identity_of(real.substr(real.rfind('/') + 1));
    }

    /// The path of the port with that identity; empty when it is not there.
    std::string find(const UsbIdentity &wanted) const {
        const std::vector<std::string> names = names_in(ports_);
        for (size_t i = 0; i < names.size(); ++i) {
            if (wanted.is(identity_of(names[i]))) {
                return dev_ + "/" + names[i];
            }
        }
        return std::string();
    }

private:
    /// The device's folder is a few levels above its port: port, function, device.
    UsbIdentity identity_of(const std::string &name) const {
        UsbIdentity identity;
        const std::string link = ports_ + "/" + name + "/device";
        std::string folder = real_path(link);
        for (int level = 0; level < 4 && folder != link && folder.size() > 1; ++level) {
            if (identity.function.empty()) {
                identity.function = first_line(folder + "/bInterfaceNumber");
            }
            const std::string vendor = first_line(folder + "/idVendor");
            if (!vendor.empty()) {
                identity.vendor = vendor;
                identity.product = first_line(folder + "/idProduct");
                identity.serial = first_line(folder + "/serial");
                identity.socket = folder.substr(folder.rfind('/') + 1);
                return identity;
            }
            folder.erase(folder.rfind('/'));
        }
        return UsbIdentity();
    }

    std::string ports_;
    std::string dev_;
};

} // namespace sensedsl

#endif
