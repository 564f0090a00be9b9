// A board's serial device, raw and for this program alone: what is sent is not echoed back, no byte
// is special, and nobody else takes a part of the bytes.
//
// In: a path and a baud rate. Out: bytes. A file or `-` (standard input) works as well, so that a
// recorded stream can be played. C++98 and POSIX.
#ifndef SENSEDSL_SERIAL_HPP
#define SENSEDSL_SERIAL_HPP

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <sstream>
#include <string>

#include "sensedsl/cause.hpp"
#include "sensedsl/link.hpp"

#if defined(__APPLE__)
#include <IOKit/serial/ioss.h>
#endif

namespace sensedsl {

/// Any baud rate, whatever names the system has for some.
namespace baud_rate {
#if defined(__linux__) && defined(TCGETS2) && !defined(__mips__) && !defined(__sparc__)
/// The kernel's own structure: the C library's header and the kernel's cannot be included together.
struct termios2 {
    uint32_t c_iflag, c_oflag, c_cflag, c_lflag;
    uint8_t c_line;
    uint8_t c_cc[19];
    uint32_t c_ispeed, c_ospeed;
};

inline bool set(int descriptor, unsigned baud) {
    const uint32_t any_rate = 0x1000, rates = 0x100F, input_shift = 16;
    struct termios2 settings;
    if (::ioctl(descriptor, TCGETS2, &settings) != 0) {
        return false;
    }
    settings.c_cflag &= ~(rates | rates << input_shift);
    settings.c_cflag |= any_rate | any_rate << input_shift;
    settings.c_ispeed = baud;
    settings.c_ospeed = baud;
    return ::ioctl(descriptor, TCSETS2, &settings) == 0;
}

/// The rate that the device really has; 0 when it does not say.
inline unsigned get(int descriptor) {
    struct termios2 settings;
    return ::ioctl(descriptor, TCGETS2, &settings) == 0 ? settings.c_ospeed : 0;
}
#else
inline bool set(int descriptor, unsigned baud) {
#if defined(__APPLE__)
    speed_t speed = baud;
    return ::ioctl(descriptor, IOSSIOSPEED, &speed) == 0;
#else
    struct termios settings;
    return ::tcgetattr(descriptor, &settings) == 0 && ::cfsetspeed(&settings, baud) == 0 &&
           ::tcsetattr(descriptor, TCSANOW, &settings) == 0;
#endif
}

inline unsigned get(int) { return 0; }
#endif
} // namespace baud_rate

/// A device; closed when it goes.
class Serial {
public:
    enum State { data, silent, ended };

    Serial() : descriptor_(-1), path_() {}
    /// Opens the device. Throws OpenError with the cause and what to do.
    Serial(const std::string &path, unsigned baud) : descriptor_(-1), path_() { open(path, baud); }
    ~Serial() { close(); }

    /// Opens the device, for this program alone if it is a terminal device. Throws OpenError.
    void open(const std::string &path, unsigned baud) {
        close();
        path_ = path;
        if (path == "-") {
            descriptor_ = STDIN_FILENO;
            return;
        }
        struct stat status;
        if (::stat(path.c_str(), &status) != 0) {
            throw OpenError(path, errno);
        }
        if (S_ISDIR(status.st_mode)) {
            throw OpenError(path, EISDIR);
        }
        const int mode = S_ISCHR(status.st_mode) ? O_RDWR | O_NONBLOCK : O_RDONLY;
        descriptor_ = ::open(path.c_str(), mode | O_NOCTTY | O_CLOEXEC);
        if (descriptor_ < 0) {
            throw OpenError(path, errno);
        }
        try {
            if (is_terminal()) {
                take_for_this_program();
                make_raw();
                set_baud(baud);
                // What other firmware sent before is nobody's any more.
                ::tcflush(descriptor_, TCIFLUSH);
            }
        } catch (...) {
            ::close(descriptor_);
            descriptor_ = -1;
            throw;
        }
    }

    void close() {
        if (is_terminal()) {
            ::ioctl(descriptor_, TIOCNXCL);
        }
        if (descriptor_ > STDIN_FILENO) {
            ::close(descriptor_);
        }
        descriptor_ = -1;
    }

    bool is_open() const { return descriptor_ >= 0; }

    /// True for a terminal device; only there an answer can be had.
    bool is_terminal() const { return descriptor_ > STDIN_FILENO && ::isatty(descriptor_) == 1; }

    /// For waiting on it beside other things.
    int descriptor() const { return descriptor_; }

    /// Waits for bytes and puts them in `bytes`. `silent` when none came in time or a signal came;
    /// `ended` when the device is gone or the file is over.
    State read(Bytes &bytes, int timeout_ms) {
        bytes.clear();
        struct pollfd wanted;
        wanted.fd = descriptor_;
        wanted.events = POLLIN;
        wanted.revents = 0;
        const int ready = ::poll(&wanted, 1, timeout_ms);
        if (ready == 0 || (ready < 0 && errno == EINTR)) {
            return silent;
        }
        uint8_t chunk[4096];
        const ssize_t count = ::read(descriptor_, chunk, sizeof chunk);
        if (count > 0) {
            bytes.assign(chunk, chunk + count);
            return data;
        }
        return count < 0 && (errno == EAGAIN || errno == EINTR) ? silent : ended;
    }

    /// Writes all bytes, waiting up to a second for room each time. False when that fails.
    bool write(const Bytes &bytes) {
        size_t done = 0;
        while (done < bytes.size()) {
            const ssize_t count = ::write(descriptor_, &bytes[done], bytes.size() - done);
            if (count > 0) {
                done += static_cast<size_t>(count);
            } else if (count < 0 && errno == EAGAIN) {
                struct pollfd wanted;
                wanted.fd = descriptor_;
                wanted.events = POLLOUT;
                wanted.revents = 0;
                if (::poll(&wanted, 1, 1000) == 0) {
                    return false;
                }
            } else if (count == 0 || errno != EINTR) {
                return false;
            }
        }
        return true;
    }

private:
    Serial(const Serial &);
    Serial &operator=(const Serial &);

    /// The lock stops other programs that ask for it, and root; TIOCEXCL stops all others.
    void take_for_this_program() const {
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
            throw OpenError(path_, errno == EWOULDBLOCK ? EBUSY : errno);
        }
        ::ioctl(descriptor_, TIOCEXCL);
    }

    void make_raw() const {
        struct termios settings;
        if (::tcgetattr(descriptor_, &settings) != 0) {
            throw OpenError(path_, errno);
        }
        ::cfmakeraw(&settings);
        settings.c_iflag &= ~static_cast<tcflag_t>(IXOFF | IXANY);
        settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB);
        settings.c_cflag |= static_cast<tcflag_t>(CREAD | CLOCAL);
#ifdef CRTSCTS
        settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS);
#endif
        settings.c_cc[VMIN] = 1;
        settings.c_cc[VTIME] = 0;
        if (::tcsetattr(descriptor_, TCSANOW, &settings) != 0) {
            throw OpenError(path_, errno);
        }
    }

    /// An adapter takes the nearest rate it has; more than 2.5 % off, bytes are misread.
    void set_baud(unsigned baud) const {
        const bool is_set = baud_rate::set(descriptor_, baud);
        const double real = is_set ? baud_rate::get(descriptor_) : 0.0;
        const bool is_near = real < 1.0 || (real > 0.975 * baud && real < 1.025 * baud);
        if (!is_set || !is_near) {
            std::ostringstream text;
            text << "cannot open " << path_ << ": this adapter has no " << baud << " baud";
            if (is_set) {
                text << "; the nearest it has is " << real;
            }
            throw OpenError(text.str());
        }
    }

    int descriptor_;
    std::string path_;
};

} // namespace sensedsl

#endif
