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

#include "sensedsl/clock.hpp"
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

/// The same in microseconds.
inline int64_t now_us() {
    struct timespec now;
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    return static_cast<int64_t>(now.tv_sec) * 1000000 + now.tv_nsec / 1000;
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
    /// Where the link has stamps: what that of a report says, before its values.
    virtual void on_moment(const Moment &moment) { (void)moment; }
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
          silent_(-1), matched_(0), looked_(0), trouble_(), frames_(0), dropped_(0), health_every_(0),
          other_healths_(0), is_health_missed_(false), has_uptime_(false), uptime_ms_(0), holds_(false), sent_(0),
          clock_(), serial_(), lock_(), values_(facts.schema->sensors.item_count),
          worries_(facts.schema->device_count) {
        ::pthread_mutex_init(&lock_, NULL);
    }
    ~Connection() {
        delete session_;
        ::pthread_mutex_destroy(&lock_);
    }

    /// Whether a device that goes is waited for; it is unless told otherwise.
    void reconnect(bool wanted) { reconnects_ = wanted; }

    /// How often the board is asked for its health; 0 for when it is met, and when a value is overdue.
    void health_every(Milliseconds every) {
        health_every_ = every;
        if (session_ != NULL) {
            session_->health_every(every);
        }
    }
    /// Whether actuators keep what they were told as long as this program runs, whatever their `silence`.
    /// Without that they take their failsafe when nothing is sent.
    void hold_commands(bool wanted) { holds_ = wanted; }

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
        if (!is_recording_ && !write(to_send())) {
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
        if (!is_ready_ || frame.empty() || !serial_.write(frame)) {
            return false;
        }
        sent_ = now_ms();
        return true;
    }

    /// When the board put the latest report together, where the link has stamps.
    const Moment &moment() const { return clock_.moment(); }
    /// Reports that the counters of stamps say were lost.
    uint64_t lost_reports() const { return clock_.lost(); }
    /// Answers of a version of health that is not known here.
    uint64_t other_healths() const { return other_healths_; }

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
        if (facts_->schema->has_stamp) {
            text << ", " << lost_reports() << " reports lost";
        }
        return text.str();
    }

private:
    enum Said { nothing, said_unanswered, said_unverified };

    struct Value {
        Value() : came(-1), is_reported(false) {}
        Milliseconds came;
        /// Its being overdue was noted.
        bool is_reported;
    };

    /// What is told of a device is told once, until it is well again.
    struct Worry {
        Worry() : status(status_never) {}
        uint8_t status;
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
        session_->health_every(health_every_);
        session_->start(now_ms());
        clock_.restart();
        is_health_missed_ = false;
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
        if (!bytes.empty()) {
            sent_ = now_ms();
        }
        return bytes.empty() || serial_.write(bytes);
    }

    Bytes to_send() {
        const Bytes bytes = session_->to_send(now_ms());
        const bool is_held = holds_ && is_ready() && facts_->silence_ms > 0;
        Lock lock(lock_);
        return bytes.empty() && is_held && now_ms() - sent_ >= hold_ms() ? hello_request(*facts_->schema) : bytes;
    }

    /// Several frames may be lost on the way.
    Milliseconds hold_ms() const { return (facts_->silence_ms + 3) / 4; }

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
        const Milliseconds most = holds_ && facts_->silence_ms > 0 && hold_ms() < 50 ? hold_ms() : 50;
        const bool is_pressed = is_waiting || (holds_ && facts_->silence_ms > 0) || health_every_ > 0;
        return is_pressed && timeout_ms > most ? static_cast<int>(most) : timeout_ms;
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
            note_missing_health();
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
        // What happened to it meanwhile is in its health.
        session_->want_health();
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
            if (limit > 0 && !values_[i].is_reported && session_->last_received() > since + limit) {
                values_[i].is_reported = true;
                note(std::string(facts_->sensors[i].name) + ": no value for " + seconds(now - since) +
                     " (expected every " + seconds(facts_->sensors[i].cycle_ms) + ")");
                session_->want_health();
            }
        }
        const Milliseconds silence = shortest > 1000 ? shortest : 1000;
        const Milliseconds received = session_->last_received() < matched_ ? matched_ : session_->last_received();
        if (shortest > 0 && now - received > silence) {
            Lock lock(lock_);
            is_ready_ = false;
            silent_ = received;
            session_->ask_anew();
        }
    }

    /// Age from which a value is overdue; 0 for a sensor without a cycle.
    Milliseconds limit_ms(size_t sensor) const {
        const Milliseconds cycle = facts_->sensors[sensor].cycle_ms;
        return cycle == 0 ? 0 : 3 * cycle + 100;
    }

    void note_missing_health() {
        if (session_->is_health_unanswered() && !is_health_missed_ && health_every_ > 0) {
            is_health_missed_ = true;
            note(std::string(facts_->name) + " does not tell its health: is its firmware older than this program?");
        }
    }

    virtual void on_stamp(const Stamp &stamp) { receiver_->on_moment(clock_.take(stamp, is_recording_ ? -1 : now_us())); }

    virtual void on_other_health(uint8_t version) {
        if (other_healths_++ == 0) {
            std::ostringstream text;
            text << facts_->name << " tells its health in version " << +version << ", and this program knows version "
                 << +health_version << ": not believed; generate again";
            note(text.str());
        }
        receiver_->on_other_health(version);
    }

    virtual void on_health(const Health &health) {
        is_health_missed_ = false;
        // Once for each start of the board.
        if (!has_uptime_ || health.uptime_ms < uptime_ms_) {
            note_reset(health);
        }
        has_uptime_ = true;
        uptime_ms_ = health.uptime_ms;
        for (size_t i = 0; i < health.devices.size(); ++i) {
            note_worry(health.devices[i], facts_->devices[i], worries_[i]);
        }
        receiver_->on_health(health);
    }

    void note_reset(const Health &health) {
        if (health.is_watchdog() || health.reset_cause == reset_halt) {
            note(std::string(facts_->name) + " was reset " + span_text(health.uptime_ms) + " ago by " +
                 reset_text(*facts_->schema, facts_->devices, health));
        }
    }

    void note_worry(const DeviceHealth &device, const DeviceFacts &facts, Worry &worry) {
        const bool is_bad = device.status == status_failed || device.status == status_stale;
        const bool was_bad = worry.status == status_failed || worry.status == status_stale;
        if (is_bad && device.status != worry.status) {
            const std::string causes = causes_text(device);
            note(std::string(facts.name) + ": " + status_text(device.status, facts.is_actuator) +
                 (causes.empty() ? "" : " (" + causes + ")"));
        } else if (was_bad && device.status == status_good) {
            note(std::string(facts.name) + ": good again");
        }
        if (is_bad || device.status == status_good) {
            worry.status = device.status;
        }
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
        if (value.is_reported) {
            const Milliseconds since = value.came < matched_ ? matched_ : value.came;
            note(std::string(facts_->sensors[sensor].name) + ": values again after " + seconds(now - since));
        }
        value.is_reported = false;
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
    /// When the board last sent something before it was asked again; negative while it sends.
    Milliseconds silent_;
    Milliseconds matched_;
    Milliseconds looked_;
    std::string trouble_;
    uint64_t frames_;
    uint64_t dropped_;
    Milliseconds health_every_;
    uint64_t other_healths_;
    /// That the board tells no health was noted.
    bool is_health_missed_;
    bool has_uptime_;
    /// When the board told its health last.
    uint32_t uptime_ms_;
    bool holds_;
    /// When something went to the board last.
    Milliseconds sent_;
    BoardClock clock_;
    Serial serial_;
    mutable pthread_mutex_t lock_;
    std::vector<Value> values_;
    /// By the place in the schema's devices.
    std::vector<Worry> worries_;
};

} // namespace sensedsl

#endif
