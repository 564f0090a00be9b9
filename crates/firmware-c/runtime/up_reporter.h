/*
 * The board's end of a link: takes what the host sends, and sends what is due, over a channel of functions.
 *
 * An operating system, or a program on a computer, calls up_reporter_cycle() at the link's rate. Nothing waits. A
 * report is only put together when the one before it has left the channel, so that its values have waited for at most
 * one report, however slow the line is. A frame that the channel does not take at once is finished in the next cycles.
 */
#ifndef UP_REPORTER_H
#define UP_REPORTER_H

#include "up_decode.h"
#include "up_health.h"
#include "up_report.h"
#include "up_request.h"
#include "up_silence.h"

/* The bytes that are taken out of the channel at a time, on the stack. */
#ifndef UP_REPORTER_READ_BYTES
#if defined(__AVR__)
#define UP_REPORTER_READ_BYTES 16U
#else
#define UP_REPORTER_READ_BYTES 64U
#endif
#endif

typedef struct {
  /* Whether the other end listens, as far as the channel can tell. */
  bool (*is_open)(void *context);
  /* Reads the bytes that have arrived, at most `size`; returns how many. */
  size_t (*read)(void *context, uint8_t *bytes, size_t size);
  /* The number of bytes that write() should accept now; `room_max` if all bytes that it accepted have left. */
  size_t (*room)(void *context);
  /* Accepts bytes, which are no more than room(); returns how many: fewer if there was less room after all, 0 if the
   * other end has gone. */
  size_t (*write)(void *context, const uint8_t *bytes, size_t size);
  void *context;
  size_t room_max; /* at least 1 */
} up_channel_t;

/* The configuration from a generator and a system. The functions from `apply` on may be NULL. */
typedef struct {
  UP_ROM up_schema_t *schema;
  UP_ROM up_wire_t *reports;
  UP_ROM up_wire_t *commands;
  UP_ROM up_channel_t *channel;
  up_store_t *store;
  up_health_t *health; /* NULL, or without UP_USES_HEALTH: health is not noted, and requests for it are not answered */
  uint8_t *frame;      /* UP_WIRE_FRAME_BYTES(reports) */
  uint8_t *buffer;     /* of the decoder; twice as long as a frame, or that and what up_decode.h adds. Without
                        * UP_USES_COMMANDS there is no decoder */
  void *received;      /* as large as the store's values; NULL if the host has nothing to set */
  size_t frame_bytes;
  size_t buffer_bytes;
  uint32_t cycle_ms;   /* time between calls of up_reporter_cycle() */
  uint32_t silence_ms; /* as in up_silence_init() */
  /* The host has set an actuator: stores the value and sets the output. Once for each value of a valid frame. */
  void (*apply)(void *context, size_t field, const void *value);
  /* The host has been silent for too long: applies the failsafe values. */
  void (*failsafe)(void *context);
  /* Completes the health of the board: reset cause, load and stack. Uptime and counts are already there. */
  void (*describe)(void *context, up_health_board_t *board);
  /* Sees each byte between two frames before the decoder does; returns true if it was meant for something else. Not
   * without UP_USES_COMMANDS. */
  bool (*intercept)(void *context, uint8_t byte);
  /* Called around accesses to store and health, if other threads use them. */
  void (*lock)(void *context);
  void (*unlock)(void *context);
  void *context;
} up_reporter_config_t;

/* Event counts since the start; they wrap, and what hosts are told does at 2^32. */
typedef struct {
  uint32_t reports_sent;
  uint32_t reports_refused; /* cycles in which something was due while the line was still busy with a frame */
  up_events_t frames_torn;    /* frames cut off because the other end went away */
  up_events_t values_dropped; /* values dropped because they were too old when the channel had room */
} up_reporter_counts_t;

typedef struct {
  UP_ROM up_reporter_config_t *config;
#if UP_USES_COMMANDS
  up_decoder_t decoder;
  up_sink_t sink;
#else
  up_requests_t requests;
#endif
  up_silence_t silence;
  up_reporter_counts_t counts;
  uint32_t now_ms;
  size_t frame_size;                    /* size of the frame that is being sent; 0 for none */
  size_t frame_sent;                    /* bytes of it that have been sent */
  uint8_t taken[UP_FIELD_BITMAP_BYTES]; /* values in the report that is being sent */
  bool is_report;
  uint8_t counter;
  bool is_open;
  bool hello_due;
  bool health_due;
  bool has_answered; /* the last frame was an answer: a report's turn is next */
} up_reporter_t;

/* Milliseconds and microseconds are counted from the start of the board, and wrap at 2^32 each for itself. */

/* False if a buffer is too small. */
bool up_reporter_init(up_reporter_t *reporter, UP_ROM up_reporter_config_t *config, uint32_t now_ms);

/* Takes what has come, and goes on with the frame that is being sent, between cycles: where a system keeps few bytes,
 * neither must wait for the next cycle. */
void up_reporter_listen(up_reporter_t *reporter, uint32_t now_ms);

/* Runs one cycle. Only stamps are made of the microseconds. */
void up_reporter_cycle(up_reporter_t *reporter, uint32_t now_ms, uint32_t now_us);

/* Replaces a cycle while something else uses the channel: when it is free again, frames begin with a hello. */
void up_reporter_pause(up_reporter_t *reporter, uint32_t now_ms);

/* Sees a byte that something else has read: true if it ends a request of a host, which wants frames. */
bool up_reporter_peek(up_reporter_t *reporter, uint8_t byte);

#endif
