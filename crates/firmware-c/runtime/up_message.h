/*
 * The byte stream of a serial device: from bytes to messages, from messages to values.
 *
 * A message is `start`, the body, a checksum, `end`; the body has `length` bytes, or ends where checksum and `end` do.
 * A candidate that cannot become a message loses its first byte only, and the rest is looked at again: so the first
 * whole message is found wherever it starts, however the stream is cut. A body without length and checksum has no
 * `start` in it.
 */
#ifndef UP_MESSAGE_H
#define UP_MESSAGE_H

#include "up_value.h"

typedef enum {
  UP_CHECKSUM_NONE,
  UP_CHECKSUM_SUM8,        /* 1 byte: low byte of the sum */
  UP_CHECKSUM_XOR8,        /* 1 byte */
  UP_CHECKSUM_IBUS,        /* 2 bytes, low byte first: 0xFFFF minus the sum of the bytes */
  UP_CHECKSUM_CRC8_DVB_S2, /* 1 byte: polynomial 0xD5 from 0 */
  UP_CHECKSUM_NMEA         /* 3 bytes: `*` and two hex digits, XOR of the bytes between `start` and `*` */
} up_checksum_t;

/* How a number stands in a message. */
typedef enum {
  UP_FORMAT_BINARY,  /* `byte` and `value` say how */
  UP_FORMAT_DECIMAL, /* text: sign, digits, point, digits */
  UP_FORMAT_DEGREES, /* text: [d]ddmm.mmmm, and N, S, E or W in the next field; in 1e-7 degrees */
  UP_FORMAT_HEX      /* text: hexadecimal digits, at most 16 that count */
} up_format_t;

/* A value in a message. An array in text takes one field an element (with degrees two), one behind the other. */
typedef struct {
  uint16_t field; /* index of the schema's fields */
  uint8_t format; /* up_format_t */
  /* UP_FORMAT_BINARY */
  uint16_t byte;    /* where the value begins, counted from the first byte behind `start` */
  up_value_t value; /* how it is coded */
  /* Text */
  const char *sentence; /* only in a sentence whose first field ends so ("RMC": any talker); NULL: in any message */
  char separator;       /* between fields; 0: the whole message is field 0 */
  uint8_t index;        /* which field, from 0; with a sentence, 0 is the first behind its type */
  uint8_t decimals;     /* decimal: the value is the number times 10^decimals, 0 to 18; integers are rounded */
} up_message_field_t;

typedef struct {
  const uint8_t *start; /* first bytes of every message; NULL for none: then what comes before the first `end` or the
                         * first gap is dropped, because nobody knows where it began */
  const uint8_t *end;   /* last bytes; NULL for none: then `length` is not 0 */
  const up_message_field_t *fields;
  uint16_t length;       /* bytes of the body; 0: as far as `end` */
  uint16_t bytes_max;    /* of the longest message with start, checksum and end: the size of the buffer */
  uint8_t start_count;   /* 0 to 255 */
  uint8_t end_count;     /* 0 to 255 */
  uint8_t checksum;      /* up_checksum_t */
  uint8_t checksum_from; /* first byte that is summed, counted from the first byte of `start`; not for NMEA */
  uint8_t fields_count;
} up_message_t;

/* All zero but the first two members. */
typedef struct {
  uint8_t *buffer;   /* bytes_max */
  uint64_t *scratch; /* as large as the largest value */
  uint16_t size;     /* bytes in the buffer: a candidate */
  bool is_aligned;   /* where messages start is known; only matters without `start` */
  uint32_t messages; /* whole ones; these counters wrap at 2^32 */
  uint32_t dropped_bytes;  /* that were in no message */
  uint32_t wrong_checksum; /* candidates with a start, a length and an end, but not the checksum */
  uint32_t values;         /* fresh ones that went to the sink */
  uint32_t invalid;        /* values */
} up_message_state_t;

/* One step of setting a serial device up: bytes, then a pause. */
typedef struct {
  const uint8_t *bytes; /* sent one behind the other; NULL where there is only a pause */
  uint8_t count;        /* of the bytes, 0 to 255 */
  uint16_t pause_ms;    /* waited at least, 0 to 65535; counted from when they are queued, so the time that they take on
                         * the line is in it */
} up_message_init_t;

/* All zero to start from the beginning. */
typedef struct {
  uint32_t pause_until_ms;
  uint8_t at; /* steps that were begun */
  bool is_pausing;
} up_message_start_t;

/* The step whose bytes are to be sent now; ask again until it is NULL. Then it pauses (and is asked in the next cycle),
 * or all `count` steps are done. */
const up_message_init_t *up_message_start(const up_message_init_t *init, uint8_t count, up_message_start_t *state,
                                          uint32_t now_ms);

/* Takes the next bytes of the stream, and says the values of each whole message. UP_NOTHING: the field is empty.
 * UP_WRONG_CRC: the checksum of its message does not fit. */
void up_message_feed(const up_message_t *message, up_message_state_t *state, const up_schema_t *schema,
                     const uint8_t *bytes, size_t count, const up_value_sink_t *sink);

/* The line was silent for longer than within a message (an idle interrupt tells): what has begun is dropped, and the
 * next byte is taken for the first of a message. Devices with a weak start and no checksum need it: with SBUS a byte
 * of the channels can look like the start, in every message at the same place. */
void up_message_gap(up_message_state_t *state);

/* The value of one field of a body, also for a frame of CAN; false when it is not in this message. */
bool up_message_value(const up_message_field_t *how, const up_field_t *field, const uint8_t *body, size_t body_count,
                      void *value, up_result_t *result);

#endif
