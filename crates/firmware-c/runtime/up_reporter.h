/*
 * One end of a link on a board: takes what the host sends, and sends what is due, over a channel of functions.
 *
 * An operating system, or a program on a computer, calls up_reporter_cycle() at the link's rate. Nothing waits.
 * A report is only put together when the one before it has left the channel, so that its values have waited for one
 * report at most, however slow the line. A frame that the channel does not take at once is finished in the next cycles.
 */
#ifndef UP_REPORTER_H
#define UP_REPORTER_H

#include "up_decode.h"
#include "up_health.h"
#include "up_report.h"
#include "up_silence.h"

typedef struct {
  /* Whether somebody listens, as far as the channel can tell. */
  bool (*is_open)(void *context);
  /* Takes what has come, at most `size` bytes; returns how many. */
  size_t (*read)(void *context, uint8_t *bytes, size_t size);
  /* How many bytes write() takes now; `room_max` when all that it took has left. */
  size_t (*room)(void *context);
  /* Takes all of the bytes, which are no more than there is room for. False: the other end has gone. */
  bool (*write)(void *context, const uint8_t *bytes, size_t size);
  void *context;
  size_t room_max; /* at least 1 */
} up_channel_t;

/* What a generator and a system say of it. The functions behind `apply` may be NULL. */
typedef struct {
  const up_schema_t *schema;
  const up_wire_t *reports;
  const up_wire_t *commands;
  const up_channel_t *channel;
  up_store_t *store;
  up_health_t *health; /* NULL: nobody notes it, and no request is answered */
  uint8_t *frame;      /* UP_WIRE_FRAME_BYTES(reports) */
  uint8_t *buffer;     /* of the decoder; twice as long as a frame, or that and what up_decode.h says */
  void *received;      /* as large as the store's values; NULL where the host has nothing to set */
  size_t frame_bytes;
  size_t buffer_bytes;
  uint32_t cycle_ms;   /* of up_reporter_cycle() */
  uint32_t silence_ms; /* see up_silence_init() */
  /* The host has set an actuator: puts the value into the store, and sets it. Once for each value of a valid frame. */
  void (*apply)(void *context, size_t field, const void *value);
  /* The host has been silent for too long. */
  void (*failsafe)(void *context);
  /* Completes what is known of the board: causes of the reset, load and stack. Uptime and counts are there. */
  void (*describe)(void *context, up_health_board_t *board);
  /* A byte between two frames, before the decoder gets it: true when it was meant for somebody else. */
  bool (*intercept)(void *context, uint8_t byte);
  /* Around store and health, where other threads use them. */
  void (*lock)(void *context);
  void (*unlock)(void *context);
  void *context;
} up_reporter_config_t;

/* Since the start; they wrap at 2^32. */
typedef struct {
  uint32_t reports_sent;
  uint32_t reports_refused; /* cycles in which something was due and the line had not done with a frame */
  uint32_t frames_torn;     /* the other end went away in the middle of one */
  uint32_t values_dropped;  /* too old to be reported when the channel had room */
} up_reporter_counts_t;

typedef struct {
  const up_reporter_config_t *config;
  up_decoder_t decoder;
  up_sink_t sink;
  up_silence_t silence;
  up_reporter_counts_t counts;
  uint64_t now_us;
  size_t frame_size;                    /* of the frame that is being sent; 0 for none */
  size_t frame_sent;                    /* bytes of it */
  uint8_t taken[UP_FIELD_BITMAP_BYTES]; /* values of the report that is being sent */
  bool is_report;
  uint8_t counter;
  bool is_open;
  bool hello_due;
  bool health_due;
  bool has_answered; /* with the last frame: a report's turn is next */
} up_reporter_t;

/* False when a buffer is too small. */
bool up_reporter_init(up_reporter_t *reporter, const up_reporter_config_t *config, uint64_t now_us);

/* One cycle. */
void up_reporter_cycle(up_reporter_t *reporter, uint64_t now_us);

/* Called instead while somebody else has the channel: frames begin with a hello when their turn comes again. */
void up_reporter_pause(up_reporter_t *reporter, uint64_t now_us);

/* A byte that somebody else has read: true when it ends a request of the host, who wants frames. */
bool up_reporter_peek(up_reporter_t *reporter, uint8_t byte);

#endif
