/*
 * The host's end of a link: frames in, values out, commands and questions back. C99, no allocation, no recursion.
 *
 * A link is given the bytes of a board however they are cut, all at once or one by one:
 *
 *     sensedsl_feed(&board.link, bytes, count, on_event, context);
 *
 * or, without a callback, `sensedsl_next` until it gives none. Nothing is believed before the board's hello has told the
 * hash of this design, for which `sensedsl_to_send` asks.
 */
#ifndef SENSEDSL_H
#define SENSEDSL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The type of shown values; `float` is quicker where the processor has no double precision. */
#ifndef SENSEDSL_REAL
#define SENSEDSL_REAL double
#endif
typedef SENSEDSL_REAL sensedsl_real;

typedef enum { SENSEDSL_NONE, SENSEDSL_CRC16, SENSEDSL_CRC32 } sensedsl_checksum;

typedef enum {
    SENSEDSL_BOOL,
    SENSEDSL_UINT8,
    SENSEDSL_INT8,
    SENSEDSL_UINT16,
    SENSEDSL_INT16,
    SENSEDSL_UINT32,
    SENSEDSL_INT32,
    SENSEDSL_UINT64,
    SENSEDSL_INT64,
    SENSEDSL_FLOAT32,
    SENSEDSL_FLOAT64
} sensedsl_type;

typedef struct {
    sensedsl_real x;
    sensedsl_real y;
} sensedsl_point;

/* What the design says of a device. */
typedef struct {
    uint8_t id;
    bool is_sensor;
    bool is_array;
    sensedsl_type type;
    uint16_t count; /* of elements */
    uint16_t points;
    const sensedsl_point *curve; /* by rising x; none for no curve */
    const char *name;
    const char *unit; /* of what is shown; "" for none */
    bool is_scaled; /* the shown value is another than the raw one */
    bool has_min;
    bool has_max;
    sensedsl_real scale;
    sensedsl_real offset;
    sensedsl_real min;
    sensedsl_real max;
    uint32_t cycle_ms; /* 0 for values that come when something happens */
} sensedsl_device;

/* A board's link. */
typedef struct {
    const char *name;
    uint32_t hash;
    uint32_t baud;
    uint32_t silence_ms; /* after which actuators take their failsafe; 0 for never */
    sensedsl_checksum checksum;
    bool is_stamped;
    uint8_t device_count;
    const sensedsl_device *devices; /* in the design's order */
    size_t short_bytes; /* of the longest payload from the board but health, without a checksum */
    size_t frame_bytes; /* of the longest frame from the board */
} sensedsl_schema;

/* The bytes of a device's value on the wire. */
size_t sensedsl_bytes(const sensedsl_device *device);

/* --- frames -------------------------------------------------------------------------------------------------------- */

typedef enum { SENSEDSL_REPORT, SENSEDSL_HELLO, SENSEDSL_HEALTH, SENSEDSL_OTHER_HEALTH } sensedsl_frame_kind;

/* A frame, in the decoder's memory until the next call. */
typedef struct {
    sensedsl_frame_kind kind;
    bool is_stamped;
    uint8_t counter;
    uint8_t version; /* of health */
    uint32_t time_us;
    uint32_t hash;
    const uint8_t *bytes; /* of the values, or of health behind its version */
    size_t count;
} sensedsl_frame;

/* Finds frames in a stream. */
typedef struct {
    const sensedsl_schema *schema;
    uint8_t *held; /* as many bytes as the schema's longest frame */
    size_t length;
    size_t start; /* of the payload; 0 while its length is read */
    size_t size; /* of the payload */
    size_t at; /* the next identifier */
    size_t looked; /* bytes of a bool that were looked at */
    uint8_t seen[32]; /* a bit for each identifier of this payload */
    bool is_summed; /* the checksum was found right */
    bool is_new; /* held bytes that were not looked at */
    size_t used; /* bytes of the frame that was handed out */
    uint32_t frames;
    uint32_t dropped_bytes;
    sensedsl_frame frame;
} sensedsl_decoder;

/* `held` has as many bytes as the schema's longest frame. */
void sensedsl_decoder_open(sensedsl_decoder *decoder, const sensedsl_schema *schema, uint8_t *held);

/* The next frame of these bytes, which it counts off; none when they are used up. */
const sensedsl_frame *sensedsl_decode(sensedsl_decoder *decoder, const uint8_t **bytes, size_t *count);

/* The next value of a report and its bytes; none at the end. `at` begins with 0. */
const sensedsl_device *sensedsl_value(const sensedsl_schema *schema, const sensedsl_frame *frame, size_t *at,
                                      const uint8_t **bytes);

/* --- health -------------------------------------------------------------------------------------------------------- */

/* How a board is. */
typedef struct {
    uint32_t uptime_ms;
    uint8_t reset_cause; /* 0 unknown, 1 power, 2 pin, 3 software, 4, 5 watchdog, 6 low power, 7 the kernel stopped */
    uint8_t reset_device; /* after a watchdog's reset: of the thread that hung */
    uint32_t reports_sent;
    uint32_t reports_refused;
    uint8_t load_percent; /* 255 unknown */
    uint16_t stack_left_bytes; /* 65535 unknown */
} sensedsl_health;

/* How a device is. */
typedef struct {
    const sensedsl_device *device;
    uint8_t status; /* 0 never read, 1 good, 2 stale, 3 failed, 4 invalid */
    uint32_t age_ms; /* 4294967295 never */
    uint16_t failures[6]; /* not acknowledged, bus error, arbitration lost, timed out, wrong checksum, invalid */
} sensedsl_device_health;

/* How the board is, of a frame of health. */
void sensedsl_read_health(const sensedsl_frame *frame, sensedsl_health *health);

/* --- a link -------------------------------------------------------------------------------------------------------- */

typedef enum {
    SENSEDSL_ASKING, /* the board has not said who it is */
    SENSEDSL_MATCHED, /* it is the one that is meant */
    SENSEDSL_PLAYING, /* a recording: believed until a hello says otherwise */
    SENSEDSL_OTHER /* it has the firmware of another design */
} sensedsl_state;

typedef enum {
    SENSEDSL_EVENT_MATCHED,
    SENSEDSL_EVENT_OTHER, /* firmware of another design: `hash` */
    SENSEDSL_EVENT_VALUE, /* `device`, `bytes`, `frame` with its stamp */
    SENSEDSL_EVENT_HEALTH, /* `health`; `sensedsl_health_of` gives the devices */
    SENSEDSL_EVENT_OTHER_HEALTH /* health of another version, which is not read here */
} sensedsl_event_kind;

/* Something that is believed, until the next call. */
typedef struct {
    sensedsl_event_kind kind;
    uint32_t hash;
    const sensedsl_device *device;
    const uint8_t *bytes; /* of the value, as they travel */
    const sensedsl_frame *frame;
    sensedsl_health health;
} sensedsl_event;

typedef struct {
    sensedsl_decoder decoder;
    sensedsl_state state;
    bool is_asked;
    bool is_health_asked;
    bool is_health_wanted;
    bool has_counter;
    bool is_held; /* commands are to be held: questions go out often enough */
    uint8_t counter;
    uint32_t since_ms;
    uint32_t asked_ms;
    uint32_t lost_reports; /* by the counters of stamps */
    uint32_t withheld_reports; /* that came while nothing was believed */
    const sensedsl_frame *frame; /* a report whose values are handed out */
    size_t at;
    sensedsl_event event;
} sensedsl_link;

/* A callback of `sensedsl_feed`. */
typedef void (*sensedsl_handler)(const sensedsl_event *event, void *context);

/* `held` has as many bytes as the schema's longest frame. */
void sensedsl_open(sensedsl_link *link, const sensedsl_schema *schema, uint8_t *held);

/* From here on the bytes are of a recording, which cannot be asked. */
void sensedsl_play(sensedsl_link *link);

/* Asks anew who the board is, as after a long silence. */
void sensedsl_ask_anew(sensedsl_link *link);

/* Asks how the board is, as soon as it is known. */
void sensedsl_ask_health(sensedsl_link *link);

/* The next event of these bytes, which it counts off; none when they are used up. */
const sensedsl_event *sensedsl_next(sensedsl_link *link, const uint8_t **bytes, size_t *count);

/* All events of these bytes, to a callback. */
void sensedsl_feed(sensedsl_link *link, const uint8_t *bytes, size_t count, sensedsl_handler on_event, void *context);

/* Bytes of a question at most. */
#define SENSEDSL_QUESTION_BYTES 12

/* What to send now, and how many bytes; mostly none. To be called some times a second, with a clock that may wrap. */
size_t sensedsl_to_send(sensedsl_link *link, uint32_t now_ms, uint8_t question[SENSEDSL_QUESTION_BYTES]);

/* How a device is, by its place in the schema; false if there is no such place. */
bool sensedsl_health_of(const sensedsl_schema *schema, const sensedsl_event *event, size_t place,
                        sensedsl_device_health *health);

/* --- values -------------------------------------------------------------------------------------------------------- */

/* The elements of a value, from its bytes on the wire. `raw` is an array of the device's own type. */
void sensedsl_load(const sensedsl_device *device, const uint8_t *bytes, void *raw);

/* An element as a number. */
sensedsl_real sensedsl_number(const sensedsl_device *device, const void *raw, size_t element);

/* The shown number of a raw one. */
sensedsl_real sensedsl_shown(const sensedsl_device *device, sensedsl_real raw);

/* Whether a shown number is within the design's limits. */
bool sensedsl_is_within(const sensedsl_device *device, sensedsl_real shown);

/* The code of a shown number, as an element of the device's own type; false if it is beyond limits or type. */
bool sensedsl_code(const sensedsl_device *device, sensedsl_real shown, void *raw, size_t element);

/* --- commands ------------------------------------------------------------------------------------------------------ */

/* Bytes that the memory for a frame has in front of its payload. */
#define SENSEDSL_HEAD_BYTES 8

/* A frame that is put together. */
typedef struct {
    const sensedsl_schema *schema;
    uint8_t *frame;
    size_t room;
    size_t length;
    bool is_refused;
    uint8_t seen[32];
} sensedsl_writer;

/* Begins a frame in memory of the caller's. */
void sensedsl_begin(sensedsl_writer *writer, const sensedsl_schema *schema, uint8_t *frame, size_t room);

/* Adds the value of an actuator. False, and no frame, if it is beyond the design's limits, there already, or too long. */
bool sensedsl_add(sensedsl_writer *writer, const sensedsl_device *device, const void *raw);

/* The bytes of the frame; 0 if there is none. */
size_t sensedsl_end(sensedsl_writer *writer);

/* The question who the board is or, with `health`, how it is. Returns its bytes. */
size_t sensedsl_question(sensedsl_checksum checksum, bool health, uint8_t question[SENSEDSL_QUESTION_BYTES]);

#ifdef __cplusplus
}
#endif

#endif
