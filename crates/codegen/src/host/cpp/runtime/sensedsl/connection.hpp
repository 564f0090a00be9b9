// A board's link that comes back: the device is opened, the board is asked who it is, and when the
// device goes it is looked for, by its USB identity, and all of that begins anew.
//
// In: a path, a baud rate and what the host knows of the board. Out: values of a board with the same
// schema, and a note for people on each thing that happens. C++98 and POSIX.
#ifndef SENSEDSL_CONNECTION_HPP
#define SENSEDSL_CONNECTION_HPP

#include <pthread.h>
#include <time.h>

#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "sensedsl/serial.hpp"
#include "sensedsl/session.hpp"
#include "sensedsl/usb.hpp"

namespace sensedsl {

/// Now, of a clock that only goes forward.
inline Milliseconds now_ms() {
    struct timespec now;
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<Milliseconds>(now.tv_sec) * 1000 + now.tv_nsec / 1000000;
}

/// `0.4 s`
inline std::string seconds(Milliseconds milliseconds) {
    std::ostringstream text;
    text << static_cast<double>(milliseconds / 10) / 100.0 << " s";
    return text.str();
}

const Milliseconds look_every_ms = 50;

/// Takes what comes over a connection.
class Receiver : public Sink {
public:
    /// Something happened that people want to know; one or more lines without the last line feed.
    virtual void on_note(const std::string &note) { std::cerr << note << std::endl; }
};

/// One board's link. One thread polls it; any thread may send.
class Connection : private Sink {
public:
    enum End {
        /// It goes on.
        none,
        /// A recording is over.
        recording_over,
        other_firmware,
        /// The device is gone and shall not be waited for.
        device_gone
    };

    Connection(const BoardFacts &facts, Receiver &receiver)
        : facts_(&facts), receiver_(&receiver), session_(NULL), path_(), baud_(0), identity_(), ports_(),
          reconnects_(true), is_ready_(false), is_recording_(false), said_(nothing), end_(none), lost_(-1),
          silent_(-1), matched_(0), looked_(0), trouble_(), frames_(0), dropped_(0), serial_(),
          lock_(), values_(facts.schema->sensors.item_count) {
        ::pthread_mutex_init(&lock_, NULL);
    }
    ~Connection() {
        delete session_;
        ::pthread_mutex_destroy(&lock_);
    }

    /// Whether a device that goes is waited for; it is unless told otherwise.
    void reconnect(bool wanted) { reconnects_ = wanted; }

    /// Throws OpenError with the cause and what to do.
    void open(const std::string &path, unsigned baud) {
        path_ = path;
        baud_ = baud;
        end_ = none;
        lost_ = -1;
        open_now(path);
        is_recording_ = !serial_.is_terminal();
        if (is_recording_) {
            session_->play();
            return;
        }
        identity_ = ports_.identity(path);
        const std::string other = holder_of(path);
        if (!other.empty()) {
            note(other + " has " + path + " open as well: bytes will be missing here and there");
        }
    }

    /// Waits for bytes up to that long and handles what came. False when it is over: see `end()`.
    bool poll(int timeout_ms) {
        if (end_ != none) {
            return false;
        }
        if (!serial_.is_open()) {
            look_for_device(timeout_ms);
            return true;
        }
        if (!is_recording_ && !write(session_->to_send(now_ms()))) {
            return lose();
        }
        Bytes bytes;
        const Serial::State state = serial_.read(bytes, wait_ms(timeout_ms));
        if (!bytes.empty()) {
            session_->feed(&bytes[0], bytes.size(), now_ms());
        }
        if (state == Serial::ended) {
            return is_recording_ ? finish(recording_over) : lose();
        }
        return look_at_session();
    }

    End end() const {
        Lock lock(lock_);
        return end_;
    }
    /// What a program ends with: 0, or 1 when the firmware is another or the device is gone.
    int exit_status() const { return end() == other_firmware || end() == device_gone ? 1 : 0; }

    /// True while the board is there and has the same schema.
    bool is_ready() const {
        Lock lock(lock_);
        return is_ready_;
    }

    /// Sends a frame to the board. False when it is not there, or not this program's.
    bool send(const Bytes &frame) {
        Lock lock(lock_);
        return is_ready_ && !frame.empty() && serial_.write(frame);
    }

    /// Age of a sensor's latest value by its place in the schema; negative before the first.
    Milliseconds age_ms(size_t sensor) const {
        return values_[sensor].came < 0 ? -1 : now_ms() - values_[sensor].came;
    }
    /// Whether a sensor's value is overdue: three cycles and a bit.
    bool is_stale(size_t sensor) const {
        const Milliseconds age = age_ms(sensor);
        return age < 0 || (limit_ms(sensor) > 0 && age > limit_ms(sensor));
    }

    uint64_t frames() const { return frames_ + (session_ != NULL ? session_->frames() : 0); }
    uint64_t dropped_bytes() const {
        return dropped_ + (session_ != NULL ? session_->dropped_bytes() : 0);
    }
    /// `12 frames, 3 bytes dropped`, for the end.
    std::string summary() const {
        std::ostringstream text;
        text << frames() << " frames, " << dropped_bytes() << " bytes dropped";
        return text.str();
    }

private:
    enum Said { nothing, said_unanswered, said_unverified };

    struct Value {
        Value() : came(-1), is_told(false) {}
        Milliseconds came;
        /// Its being overdue was noted.
        bool is_told;
    };

    class Lock {
    public:
        explicit Lock(pthread_mutex_t &mutex) : mutex_(&mutex) { ::pthread_mutex_lock(mutex_); }
        ~Lock() { ::pthread_mutex_unlock(mutex_); }

    private:
        Lock(const Lock &);
        Lock &operator=(const Lock &);
        pthread_mutex_t *mutex_;
    };

    Connection(const Connection &);
    Connection &operator=(const Connection &);

    void note(const std::string &text) { receiver_->on_note(text); }

    /// One session ends, another begins.
    void open_now(const std::string &path) {
        Lock lock(lock_);
        serial_.open(path, baud_);
        keep_counts();
        session_ = new Session(*facts_, *this);
        session_->start(now_ms());
        said_ = nothing;
        trouble_.clear();
    }

    void keep_counts() {
        frames_ = frames();
        dropped_ = dropped_bytes();
        delete session_;
        session_ = NULL;
    }

    bool write(const Bytes &bytes) {
        Lock lock(lock_);
        return bytes.empty() || serial_.write(bytes);
    }

    bool finish(End end) {
        Lock lock(lock_);
        end_ = end;
        is_ready_ = false;
        serial_.close();
        return false;
    }

    /// The device went.
    bool lose() {
        if (!reconnects_) {
            note("lost " + path_ + ": the device is gone");
            return finish(device_gone);
        }
        {
            Lock lock(lock_);
            is_ready_ = false;
            silent_ = -1;
            serial_.close();
        }
        if (lost_ < 0) {
            lost_ = now_ms();
            note("lost " + path_ + ": the device is gone; waiting for it");
        }
        return true;
    }

    /// By its USB identity where it has one: another device may have got its old name.
    void look_for_device(int timeout_ms) {
        const Milliseconds left = looked_ + look_every_ms - now_ms();
        if (left > 0) {
            const int pause_ms = left < timeout_ms ? static_cast<int>(left) : timeout_ms;
            ::poll(NULL, 0, pause_ms);
            return;
        }
        looked_ = now_ms();
        const std::string found = identity_.empty() ? path_ : ports_.find(identity_);
        if (found.empty() || ::access(found.c_str(), F_OK) != 0) {
            return;
        }
        try {
            open_now(found);
            path_ = found == real_path(path_) ? path_ : found;
        } catch (const OpenError &error) {
            // Rights are given a moment after the device appears.
            if (now_ms() - lost_ > 2000 && trouble_ != error.what()) {
                trouble_ = error.what();
                note(trouble_);
            }
        }
    }

    /// Not longer than until there is something to do.
    int wait_ms(int timeout_ms) const {
        const bool is_waiting = session_->state() == Session::asking ||
                                session_->state() == Session::comparing;
        return is_waiting && timeout_ms > 50 ? 50 : timeout_ms;
    }

    bool look_at_session() {
        switch (session_->state()) {
        case Session::asking:
            if (session_->is_unanswered() && said_ != said_unanswered) {
                note_unanswered();
            }
            return true;
        case Session::matched:
            note_matched();
            note_silence();
            return true;
        case Session::refused:
            note(session_->difference());
            return finish(other_firmware);
        case Session::playing:
        case Session::comparing:
        default:
            return true;
        }
    }

    void note_unanswered() {
        said_ = said_unanswered;
        std::ostringstream text;
        if (silent_ >= 0) {
            note(std::string(facts_->name) + " on " + path_ + " says nothing for " +
                 seconds(now_ms() - silent_) + "; asking it again");
            return;
        }
        text << path_ << ": the board does not say which firmware it runs; asking again.";
        if (session_->bytes() == 0) {
            text << " Nothing comes at all: does it run firmware of SenseDSL?";
        } else if (session_->withheld_frames() > 0) {
            text << " Frames come, but are not believed before it has answered";
        } else {
            text << " What comes are no frames: is the link at " << baud_ << " baud?";
        }
        note(text.str());
    }

    void note_matched() {
        if (is_ready_) {
            return;
        }
        {
            Lock lock(lock_);
            is_ready_ = true;
        }
        // Where only the sensors were silent, and not the board, they are overdue all the same.
        if (silent_ < 0 || said_ == said_unanswered) {
            matched_ = now_ms();
        }
        if (lost_ >= 0) {
            note("back on " + path_ + " after " + seconds(now_ms() - lost_));
        } else if (silent_ >= 0) {
            if (said_ == said_unanswered) {
                note(std::string(facts_->name) + " answers again after " + seconds(now_ms() - silent_));
            }
        } else {
            note(std::string(facts_->name) + " on " + path_ + ": firmware and program agree");
        }
        lost_ = -1;
        silent_ = -1;
        said_ = nothing;
    }

    /// A sensor that is overdue while others come is noted; where nothing comes, the board is asked.
    void note_silence() {
        const Milliseconds now = now_ms();
        Milliseconds shortest = 0;
        for (size_t i = 0; i < values_.size(); ++i) {
            const Milliseconds limit = limit_ms(i);
            shortest = limit > 0 && (shortest == 0 || limit < shortest) ? limit : shortest;
            const Milliseconds since = values_[i].came < matched_ ? matched_ : values_[i].came;
            if (limit > 0 && !values_[i].is_told && session_->heard() > since + limit) {
                values_[i].is_told = true;
                note(std::string(facts_->sensors[i].name) + ": no value for " + seconds(now - since) +
                     " (expected every " + seconds(facts_->sensors[i].cycle_ms) + ")");
            }
        }
        const Milliseconds silence = shortest > 1000 ? shortest : 1000;
        const Milliseconds heard = session_->heard() < matched_ ? matched_ : session_->heard();
        if (shortest > 0 && now - heard > silence) {
            Lock lock(lock_);
            is_ready_ = false;
            silent_ = heard;
            session_->ask_anew();
        }
    }

    /// Age from which a value is overdue; 0 for a sensor without a cycle.
    Milliseconds limit_ms(size_t sensor) const {
        const Milliseconds cycle = facts_->sensors[sensor].cycle_ms;
        return cycle == 0 ? 0 : 3 * cycle + 100;
    }

    virtual void on_value(uint8_t id, const uint8_t *bytes) {
        if (is_recording_) {
            note_unverified();
        } else {
            note_matched();
        }
        for (size_t i = 0; i < values_.size(); ++i) {
            if (facts_->schema->sensors.items[i].id == id) {
                take(i);
            }
        }
        receiver_->on_value(id, bytes);
    }

    void take(size_t sensor) {
        Value &value = values_[sensor];
        const Milliseconds now = now_ms();
        if (value.is_told) {
            const Milliseconds since = value.came < matched_ ? matched_ : value.came;
            note(std::string(facts_->sensors[sensor].name) + ": values again after " + seconds(now - since));
        }
        value.is_told = false;
        value.came = now;
    }

    void note_unverified() {
        if (session_->state() == Session::playing && said_ == nothing) {
            said_ = said_unverified;
            note(path_ + ": no hello before the first value: nobody knows whether it is a recording of "
                         "this firmware");
        }
    }

    virtual void on_frame_end() { receiver_->on_frame_end(); }

    const BoardFacts *facts_;
    Receiver *receiver_;
    Session *session_;
    std::string path_;
    unsigned baud_;
    UsbIdentity identity_;
    UsbPorts ports_;
    bool reconnects_;
    bool is_ready_;
    bool is_recording_;
    Said said_;
    End end_;
    /// When the device went; negative while it is there.
    Milliseconds lost_;
    /// When it was last heard before it was asked anew; negative while it speaks.
    Milliseconds silent_;
    Milliseconds matched_;
    Milliseconds looked_;
    std::string trouble_;
    uint64_t frames_;
    uint64_t dropped_;
    Serial serial_;
    mutable pthread_mutex_t lock_;
    std::vector<Value> values_;
};

} // namespace sensedsl

#endif
