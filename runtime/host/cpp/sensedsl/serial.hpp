// A board's serial device, raw: what is sent is not echoed back, and no byte is special.
//
// In: a path and a baud rate. Out: bytes. A file or `-` (standard input) works as well, so that a
// recorded stream can be played. C++98 and POSIX.
#ifndef SENSEDSL_SERIAL_HPP
#define SENSEDSL_SERIAL_HPP

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

#include "sensedsl/link.hpp"

namespace sensedsl {

/// An open device; closed when it goes.
class Serial {
public:
    enum State { data, silent, ended };

    /// Opens the device. Throws std::runtime_error with the reason.
    Serial(const std::string &path, unsigned baud) : fd_(STDIN_FILENO), path_(path) {
        if (path == "-") {
            return;
        }
        fd_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK);
        if (fd_ < 0 && (errno == EACCES || errno == EROFS || errno == EPERM)) {
            fd_ = ::open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK);
        }
        if (fd_ < 0) {
            fail("cannot open");
        }
        try {
            make_raw(baud);
        } catch (...) {
            ::close(fd_);
            throw;
        }
    }

    ~Serial() {
        if (fd_ != STDIN_FILENO) {
            ::close(fd_);
        }
    }

    /// True for a terminal device; only there an answer can be had.
    bool is_terminal() const { return fd_ != STDIN_FILENO && ::isatty(fd_) == 1; }

    /// For waiting on it beside other things.
    int descriptor() const { return fd_; }

    /// Waits for bytes and puts them in `bytes`. `silent` when none came in time or a signal came;
    /// `ended` when the device is gone or the file is over.
    State read(Bytes &bytes, int timeout_ms) {
        bytes.clear();
        struct pollfd wanted;
        wanted.fd = fd_;
        wanted.events = POLLIN;
        wanted.revents = 0;
        const int ready = ::poll(&wanted, 1, timeout_ms);
        if (ready == 0 || (ready < 0 && errno == EINTR)) {
            return silent;
        }
        uint8_t chunk[512];
        const ssize_t count = ::read(fd_, chunk, sizeof chunk);
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
            const ssize_t count = ::write(fd_, &bytes[done], bytes.size() - done);
            if (count > 0) {
                done += static_cast<size_t>(count);
            } else if (count < 0 && errno == EAGAIN) {
                struct pollfd wanted;
                wanted.fd = fd_;
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

    void fail(const char *what) const {
        throw std::runtime_error(std::string(what) + " " + path_ + ": " + strerror(errno));
    }

    void make_raw(unsigned baud) const {
        if (::isatty(fd_) != 1) {
            return;
        }
        struct termios settings;
        if (::tcgetattr(fd_, &settings) != 0) {
            fail("cannot read the settings of");
        }
        settings.c_iflag &= static_cast<tcflag_t>(~static_cast<tcflag_t>(
            IGNBRK | BRKINT | PARMRK | ISTRIP | INLCR | IGNCR | ICRNL | IXON | IXOFF | IXANY));
        settings.c_oflag &= static_cast<tcflag_t>(~static_cast<tcflag_t>(OPOST));
        settings.c_lflag &= static_cast<tcflag_t>(
            ~static_cast<tcflag_t>(ECHO | ECHOE | ECHOK | ECHONL | ICANON | ISIG | IEXTEN));
        settings.c_cflag &= static_cast<tcflag_t>(~static_cast<tcflag_t>(CSIZE | PARENB | CSTOPB));
        settings.c_cflag |= static_cast<tcflag_t>(CS8 | CREAD | CLOCAL);
#ifdef CRTSCTS
        settings.c_cflag &= static_cast<tcflag_t>(~static_cast<tcflag_t>(CRTSCTS));
#endif
        settings.c_cc[VMIN] = 1;
        settings.c_cc[VTIME] = 0;
        speed_t speed = B115200;
        if (!speed_of(baud, speed)) {
            throw std::runtime_error("this system has no such baud rate for " + path_);
        }
        if (::cfsetispeed(&settings, speed) != 0 || ::cfsetospeed(&settings, speed) != 0 ||
            ::tcsetattr(fd_, TCSANOW, &settings) != 0) {
            fail("cannot make raw");
        }
    }

    static bool speed_of(unsigned baud, speed_t &speed) {
        switch (baud) {
        case 1200: speed = B1200; return true;
        case 2400: speed = B2400; return true;
        case 4800: speed = B4800; return true;
        case 9600: speed = B9600; return true;
        case 19200: speed = B19200; return true;
        case 38400: speed = B38400; return true;
        case 57600: speed = B57600; return true;
        case 115200: speed = B115200; return true;
        case 230400: speed = B230400; return true;
#ifdef B460800
        case 460800: speed = B460800; return true;
#endif
#ifdef B500000
        case 500000: speed = B500000; return true;
#endif
#ifdef B921600
        case 921600: speed = B921600; return true;
#endif
#ifdef B1000000
        case 1000000: speed = B1000000; return true;
#endif
#ifdef B2000000
        case 2000000: speed = B2000000; return true;
#endif
#ifdef B3000000
        case 3000000: speed = B3000000; return true;
#endif
#ifdef B4000000
        case 4000000: speed = B4000000; return true;
#endif
        default: return false;
        }
    }

    int fd_;
    std::string path_;
};

} // namespace sensedsl

#endif
