/*
 * The byte stream of a serial device: from bytes to messages, from messages to values.
 *
 * A message is `start`, the body, a checksum, `end`; the body has `length` bytes, or ends at the checksum and `end`. A
 * candidate that cannot become a message loses only its first byte, and the rest is scanned again, so the first
 * complete message is found wherever it starts, however the stream is split. A body without length and checksum cannot
 * contain `start`.
 */
#ifndef UP_MESSAGE_H
#define UP_MESSAGE_H

#include "up_value.h"

typedef enum {
  UP_CHECKSUM_NONE,
  UP_CHECKSUM_SUM8,        /* 1 byte: the low byte of the sum */
  UP_CHECKSUM_XOR8,        /* 1 byte: exclusive or */
  UP_CHECKSUM_IBUS,        /* 2 bytes, low byte first: 0xFFFF minus the sum of the bytes */
  UP_CHECKSUM_CRC8_DVB_S2, /* 1 byte: CRC-8 with polynomial 0xD5 and start value 0 */
  UP_CHECKSUM_NMEA,        /* 3 bytes: `*` and two hex digits, exclusive or of the bytes between `start` and `*` */
  UP_CHECKSUM_SUM7,        /* 1 byte: the low seven bits of the sum */
  UP_CHECKSUM_NOT_SUM8,    /* 1 byte: the low byte of the sum, inverted */
  UP_CHECKSUM_NEG_SUM8,    /* 1 byte: what makes the low byte of the sum 0 */
  UP_CHECKSUM_NEG_SUM16,   /* 2 bytes, high byte first: what makes the low two bytes of the sum 0 */
  UP_CHECKSUM_CRC16_UMTS,  /* 2 bytes, low byte first: CRC-16 with polynomial 0x8005 and start value 0 */
  UP_CHECKSUM_CRC16_XMODEM, /* 2 bytes, high byte first: CRC-16 with polynomial 0x1021 and start value 0 */
  UP_CHECKSUM_CRC8_LD06,   /* 1 byte: CRC-8 with polynomial 0x4D and start value 0 */
  UP_CHECKSUM_SUM16,       /* 2 bytes, high byte first: the low 16 bits of the sum */
  UP_CHECKSUM_SLAMTEC      /* no bytes after the body: its first two are 0xA and the low half, 0x5 and the high half of
                            * the exclusive or of all others; for messages without `start` and of known length */
} up_checksum_t;

/* The size of a checksum; 0 for none. */
size_t up_checksum_bytes(uint8_t checksum);

/* Writes the checksum of the first `at` bytes, and returns its size. `from`: the first byte that it covers; for NMEA
 * the first byte after `start_count`. */
#define UP_CHECKSUM_BYTES_MAX 3U
size_t up_checksum_put(uint8_t checksum, uint8_t from, uint8_t start_count, const uint8_t *bytes, size_t at,
                       uint8_t sum[UP_CHECKSUM_BYTES_MAX]);

/* The format of a number in a message. */
typedef enum {
  UP_FORMAT_BINARY,  /* bytes, as given by `byte` and `value` */
  UP_FORMAT_DECIMAL, /* text: sign, digits, point, digits; received only with UP_USES_WIDE */
  UP_FORMAT_DEGREES, /* text: [d]ddmm.mmmm, and N, S, E or W in the next field; in 1e-7 degrees; with UP_USES_WIDE */
  UP_FORMAT_HEX      /* text: hexadecimal digits, at most 16 significant ones */
} up_format_t;

/* A value in a message. An array in text takes one field per element (two for degrees), one after the other. */
typedef struct {
  uint16_t field; /* index into the schema's fields */
  uint8_t format; /* up_format_t */
  /* UP_FORMAT_BINARY */
  uint16_t byte;    /* offset of the value from the first byte after `start` */
  up_value_t value; /* the coding */
  /* Text */
  UP_ROM char *sentence; /* only in a sentence whose first field ends with this ("RMC": any talker); NULL: in any
                          * message */
  char separator;        /* separator between fields; 0: the whole message is field 0 */
  uint8_t index;         /* index of the field, from 0; with a sentence, 0 is the first field after its type */
  uint8_t decimals;      /* decimal: the value is the number times 10^decimals, 0 to 18; integers are rounded */
} up_message_field_t;

typedef struct {
  UP_ROM uint8_t *start; /* first bytes of every message; NULL for none: then everything before the first `end` or the
                          * first gap is dropped, because it is unknown where it began */
  UP_ROM uint8_t *end;   /* last bytes; NULL for none: then `length` is not 0 */
  UP_ROM up_message_field_t *fields;
  uint16_t length;       /* bytes of the body; 0: up to `end` */
  uint16_t bytes_max;    /* bytes of the longest message with start, checksum and end; the size of the buffer */
  uint8_t start_count;   /* 0 to 255 */
  uint8_t end_count;     /* 0 to 255 */
  uint8_t checksum;      /* up_checksum_t */
  uint8_t checksum_from; /* first byte that the checksum covers, counted from the first byte of `start`; not for NMEA */
  uint8_t fields_count;
} up_message_t;

/* All zero except the first two members. */
typedef struct {
  uint8_t *buffer;            /* bytes_max */
  uint64_t *scratch;          /* as large as the largest value */
  uint16_t size;              /* bytes in the buffer: a candidate */
  bool is_aligned;            /* it is known where messages start; only matters without `start` */
  up_events_t messages;       /* complete messages; these counters wrap */
  up_events_t dropped_bytes;  /* in no message */
  up_events_t wrong_checksum; /* candidates with a start, a length and an end, but a wrong checksum */
  up_events_t values;         /* fresh values passed to the sink */
  up_events_t invalid;        /* values that were not a measurement */
} up_message_state_t;

/* One step of setting up a serial device: bytes, then a pause. */
typedef struct {
  UP_ROM uint8_t *bytes; /* sent one after the other; NULL for a pause only */
  uint8_t count;         /* number of bytes, 0 to 255 */
  uint16_t pause_ms;     /* least pause, 0 to 65535; counted from when the bytes are queued, so it includes their time
                          * on the line */
} up_message_init_t;

/* All zero to start from the beginning. */
typedef struct {
  uint32_t pause_until_ms;
  uint8_t at; /* steps that have begun */
  bool is_pausing;
} up_message_start_t;

/* The step whose bytes must be sent now; call again until it is NULL. Then there is a pause (call again in the next
 * cycle), or all `count` steps are done. */
UP_ROM up_message_init_t *up_message_start(UP_ROM up_message_init_t *init, uint8_t count, up_message_start_t *state,
                                           uint32_t now_ms);

/* Takes the next bytes of the stream, and reports the values of each complete message. UP_NOTHING: the field is
 * empty. UP_WRONG_CRC: the checksum of its message is wrong. */
void up_message_feed(UP_ROM up_message_t *message, up_message_state_t *state, UP_ROM up_schema_t *schema,
                     const uint8_t *bytes, size_t count, const up_value_sink_t *sink);

/* The line was silent for longer than within a message (an idle line interrupt reports this): an unfinished message
 * is dropped, and the next byte is taken for the first of a message. Devices with a weak start and no checksum need
 * it: with SBUS a byte of the channels can look like the start, at the same place in every message. */
void up_message_gap(up_message_state_t *state);

/* The value of one field of a body, also for a CAN frame; false if it is not in this message. */
bool up_message_value(UP_ROM up_message_field_t *how, UP_ROM up_field_t *field, const uint8_t *body, size_t body_count,
                      void *value, up_result_t *result);

#endif
