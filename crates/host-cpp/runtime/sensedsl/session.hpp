// Whether the board at the other end speaks of the same devices, and what to do until that is known.
//
// In: bytes of the link and the time. Out: bytes to send, and values, but none before the board's
// hello has told the schema hash of this program. It asks for the hello until it is answered. When
// the hash is another one it asks the board's shell for the whole schema, so that the devices that
// differ can be named. No I/O and no clock in here; C++98.
#ifndef SENSEDSL_SESSION_HPP
#define SENSEDSL_SESSION_HPP

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <string>

#include "sensedsl/difference.hpp"
#include "sensedsl/link.hpp"

namespace sensedsl {

/// A sensor beside its bytes on the wire.
struct SensorFacts {
    const char *name;
    /// From one value to the next; 0 when values come only when something happens.
    uint32_t cycle_ms;
};

/// A board as this program was generated for it.
struct BoardFacts {
    const char *name;
    const Schema *schema;
    /// The text that the schema hash is made of.
    const char *schema_text;
    /// In the order of the schema's sensors.
    const SensorFacts *sensors;
    /// In the order of the schema's devices.
    const DeviceFacts *devices;
    /// After how long without a frame from here actuators take their failsafe; 0 for never.
    uint32_t silence_ms;
};

/// Milliseconds of a clock that only goes forward.
typedef int64_t Milliseconds;

const Milliseconds ask_every_ms = 250;
const Milliseconds ask_rarely_after_ms = 5000;
const Milliseconds ask_rarely_every_ms = 1000;
const Milliseconds unanswered_after_ms = 1500;
const Milliseconds shell_answers_within_ms = 1000;
const Milliseconds health_at_most_every_ms = 1000;
const Milliseconds health_answers_within_ms = 2000;

/// One session with a board, from opening the device to losing it.
class Session : private Sink {
public:
    enum State {
        /// The board has not told its schema hash yet: nothing is believed.
        asking,
        /// Same schema: values are handed on.
        matched,
        /// A recording has nobody to ask: values are handed on until a hello says otherwise.
        playing,
        /// Another schema: the board's shell is asked for it.
        comparing,
        /// Another schema, and all that can be known of it is known.
        refused
    };

    Session(const BoardFacts &facts, Sink &sink)
        : facts_(&facts), sink_(&sink), is_recording_(false), state_(asking), now_(0), started_(0), asked_(-1), last_received_(0),
          requests_(0), health_every_(0), health_asked_(-1), health_due_since_(0),
          is_health_wanted_(false), is_health_due_(false), other_form_hash_(0), bytes_(0), withheld_(0), step_(0), board_hash_(0), reader_(0),
          decoder_(*facts.schema, facts.schema->sensors, *this),
          first_other_(*this, facts.schema->checksum == checksum_none ? checksum_crc16 : checksum_none),
          second_other_(*this, facts.schema->checksum == checksum_crc32 ? checksum_crc16 : checksum_crc32) {}

    /// For a recording.
    void play() {
        is_recording_ = true;
        state_ = playing;
    }

    /// Begins to ask.
    void start(Milliseconds now) {
        now_ = now;
        ask_anew();
    }

    /// Takes the next bytes, however the stream is cut.
    void feed(const uint8_t *bytes, size_t count, Milliseconds now) {
        now_ = now;
        bytes_ += count;
        if (state_ == comparing && reader_.feed(bytes, count)) {
            state_ = refused;
        }
        if (state_ == asking) {
            first_other_.decoder.feed(bytes, count);
            second_other_.decoder.feed(bytes, count);
        }
        decoder_.feed(bytes, count);
    }

    /// What to send now; mostly nothing.
    Bytes to_send(Milliseconds now) {
        now_ = now;
        if (state_ == asking) {
            return request();
        }
        if (state_ == matched) {
            return ask_for_health();
        }
        return state_ == comparing ? shell_command() : Bytes();
    }

    /// Asks for health that often from now on; 0 for only when it is wanted.
    void health_every(Milliseconds every) { health_every_ = every; }
    /// Asks for health once, soon.
    void want_health() { is_health_wanted_ = true; }
    /// True when the board should have told its health by now.
    bool is_health_unanswered() const {
        return state_ == matched && is_health_due_ && now_ - health_due_since_ >= health_answers_within_ms;
    }

    State state() const { return state_; }
    /// When the last whole frame came.
    Milliseconds last_received() const { return last_received_; }
    /// True when the board should have answered by now.
    bool is_unanswered() const {
        return state_ == asking && now_ - started_ >= unanswered_after_ms;
    }
    /// A board that says nothing for long may have been restarted, with whatever firmware.
    void ask_anew() {
        state_ = asking;
        started_ = now_;
        asked_ = -1;
        requests_ = 0;
    }

    uint64_t frames() const { return decoder_.frames(); }
    uint64_t dropped_bytes() const { return decoder_.dropped_bytes(); }
    uint64_t bytes() const { return bytes_; }
    /// Frames with values that came while nothing was believed.
    uint64_t withheld_frames() const { return withheld_; }

    /// What is known of a board with another schema.
    std::string difference() const {
        char hashes[64];
        snprintf(hashes, sizeof hashes, " (schema 0x%08x instead of 0x%08x)",
                 static_cast<unsigned>(board_hash_), static_cast<unsigned>(facts_->schema->hash));
        if (is_recording_) {
            return std::string("this is a recording of other firmware than this program was generated for") +
                   hashes;
        }
        return std::string("the board runs other firmware than this program was generated for") + hashes +
               (reader_.is_whole() ? ":\n" + differences(facts_->schema_text, reader_.text())
                                   : "; it does not say in which devices\n") +
               "generate again and flash the board, or take the program of the board's design";
    }

private:
    Session(const Session &);
    Session &operator=(const Session &);

    /// The hello of a board whose frames have another checksum than ours.
    class OtherSink : public Sink {
    public:
        explicit OtherSink(Session &session) : session_(&session) {}
        virtual void on_hello(uint32_t hash) { session_->on_other_form(hash); }
        virtual void on_value(uint8_t, const uint8_t *) {}

    private:
        Session *session_;
    };

    /// Frames with another checksum.
    struct OtherForm {
        OtherForm(Session &session, Checksum checksum)
            : schema(other_form(*session.facts_->schema, checksum)), sink(session), decoder(schema, schema.sensors, sink) {}
        Schema schema;
        OtherSink sink;
        Decoder decoder;

    private:
        OtherForm(const OtherForm &);
        OtherForm &operator=(const OtherForm &);
    };

    static Schema other_form(const Schema &own, Checksum checksum) {
        Schema other = own;
        other.checksum = checksum;
        other.sensors.items = NULL;
        other.sensors.item_count = 0;
        other.device_ids = NULL;
        other.device_count = 0;
        other.sensors.short_bytes_max = other.sensors.hello_bytes;
        other.sensors.payload_bytes_max = other.sensors.hello_bytes + Crc(checksum).size_bytes();
        return other;
    }

    Bytes request() {
        const Milliseconds every =
            now_ - started_ < ask_rarely_after_ms ? ask_every_ms : ask_rarely_every_ms;
        if (asked_ >= 0 && now_ - asked_ < every) {
            return Bytes();
        }
        asked_ = now_;
        ++requests_;
        // A board that does not answer may have another form of frames.
        const Schema &other = requests_ % 2 != 0 ? first_other_.schema : second_other_.schema;
        return hello_request(requests_ % 3 == 0 ? other : *facts_->schema);
    }

    Bytes ask_for_health() {
        const bool is_first = health_asked_ < 0;
        const Milliseconds waited = now_ - health_asked_;
        const bool is_wanted = is_health_wanted_ && (is_first || waited >= health_at_most_every_ms);
        const bool is_time = health_every_ > 0 && (is_first || waited >= health_every_);
        if (!is_wanted && !is_time) {
            return Bytes();
        }
        // The first of several questions counts for how long the answer takes.
        health_due_since_ = is_health_due_ ? health_due_since_ : now_;
        health_asked_ = now_;
        is_health_due_ = true;
        is_health_wanted_ = false;
        return health_request(*facts_->schema);
    }

    /// `q` brings the shell back from frames; the return before the command ends what was typed.
    Bytes shell_command() {
        static const char *const commands[] = {"q", "\rschema\r", "q", "\rschema\r"};
        static const Milliseconds at[] = {0, 150, shell_answers_within_ms,
                                          shell_answers_within_ms + 150};
        const size_t count = sizeof commands / sizeof commands[0];
        if (step_ < count && now_ - started_ >= at[step_]) {
            const char *command = commands[step_];
            ++step_;
            return Bytes(command, command + strlen(command));
        }
        if (now_ - started_ >= 2 * shell_answers_within_ms) {
            state_ = refused;
        }
        return Bytes();
    }

    virtual void on_hello(uint32_t hash) {
        last_received_ = now_;
        if (hash == facts_->schema->hash) {
            if (state_ == asking || state_ == playing) {
                state_ = matched;
            }
            return;
        }
        if (state_ == comparing || state_ == refused) {
            return;
        }
        board_hash_ = hash;
        reader_ = SchemaReader(hash);
        step_ = 0;
        state_ = is_recording_ ? refused : comparing;
        started_ = now_;
    }

    /// Bytes of a value may look like a hello; two equal ones are one.
    void on_other_form(uint32_t hash) {
        if (hash == other_form_hash_) {
            on_hello(hash);
        }
        other_form_hash_ = hash;
    }

    virtual void on_stamp(const Stamp &stamp) {
        if (state_ == matched || state_ == playing) {
            sink_->on_stamp(stamp);
        }
    }

    virtual void on_health(const Health &health) {
        last_received_ = now_;
        is_health_due_ = false;
        if (state_ == matched || state_ == playing) {
            sink_->on_health(health);
        }
    }

    virtual void on_other_health(uint8_t version) {
        last_received_ = now_;
        is_health_due_ = false;
        if (state_ == matched || state_ == playing) {
            sink_->on_other_health(version);
        }
    }

    virtual void on_value(uint8_t id, const uint8_t *bytes) {
        if (state_ == matched || state_ == playing) {
            sink_->on_value(id, bytes);
        }
    }

    virtual void on_frame_end() {
        last_received_ = now_;
        if (state_ == matched || state_ == playing) {
            sink_->on_frame_end();
        } else {
            ++withheld_;
        }
    }

    const BoardFacts *facts_;
    Sink *sink_;
    bool is_recording_;
    State state_;
    Milliseconds now_;
    Milliseconds started_;
    /// When a hello was asked for; negative before the first time.
    Milliseconds asked_;
    Milliseconds last_received_;
    unsigned requests_;
    Milliseconds health_every_;
    /// When health was asked for last; negative before the first time.
    Milliseconds health_asked_;
    Milliseconds health_due_since_;
    bool is_health_wanted_;
    /// An answer is awaited.
    bool is_health_due_;
    uint32_t other_form_hash_;
    uint64_t bytes_;
    uint64_t withheld_;
    size_t step_;
    uint32_t board_hash_;
    SchemaReader reader_;
    Decoder decoder_;
    OtherForm first_other_;
    OtherForm second_other_;
};

} // namespace sensedsl

#endif
