/*
 * How the devices of a board are: what their last readings came to, how long ago, and how often each fault was met.
 *
 * Nothing here locks or knows a clock: the caller serialises the functions, and time comes in.
 */
#ifndef UP_HEALTH_H
#define UP_HEALTH_H

#include "up_result.h"
#include "up_schema.h"

/* No value yet; and none for so long that the clock cannot tell (24 days). */
#define UP_AGE_NEVER 0xFFFFFFFFU
#define UP_AGE_LONG 0xFFFFFFFEU

/* A device without a value for so many of its cycles is stale. */
#define UP_STALE_CYCLES 3U

typedef enum {
  UP_STATUS_NEVER,  /* never read */
  UP_STATUS_GOOD,   /* the last reading was a measurement, and is not old */
  UP_STATUS_STALE,  /* no value for three cycles */
  UP_STATUS_FAILED, /* the last reading did not come through */
  UP_STATUS_INVALID /* the last answer was no measurement */
} up_status_t;

typedef enum {
  UP_FAULT_NOT_ACKNOWLEDGED,
  UP_FAULT_BUS,
  UP_FAULT_ARBITRATION,
  UP_FAULT_TIME_OUT,
  UP_FAULT_CRC,
  UP_FAULT_INVALID /* another device's answers as well */
} up_fault_t;
#define UP_FAULTS 6U

/* What is known of one device. All zero at the start. */
typedef struct {
  uint32_t good_ms;           /* when the last value came; the clock may wrap */
  uint16_t counts[UP_FAULTS]; /* by up_fault_t; they stop at 65535 */
  uint8_t last;               /* up_result_t of the last reading; UP_NOTHING before the first */
  bool has_value;
  bool is_ancient; /* the clock cannot tell how old the value is */
} up_health_device_t;

typedef struct {
  up_health_device_t *devices; /* one for each field of the schema */
  const uint32_t *cycles_ms;   /* for each how often it is read; 0: only when something happens, then it is never stale.
                                * NULL: all are like that */
  uint8_t devices_count;
  uint8_t looked_at; /* the device that up_health_tick() looks at next */
} up_health_t;

/* One device as the host is told of it. */
typedef struct {
  uint32_t age_ms;
  uint16_t counts[UP_FAULTS];
  uint8_t status; /* up_status_t */
} up_health_row_t;

/* The board itself, as the host is told of it. */
typedef struct {
  uint32_t uptime_ms;
  uint32_t reports_sent;
  uint32_t reports_refused;
  uint16_t stack_left_bytes; /* bytes never used of the fullest stack; UP_STACK_UNKNOWN */
  uint8_t reset_cause;       /* up_cause_t */
  uint8_t reset_device;      /* after a watchdog's reset the identifier of the first device of the thread that hung */
  uint8_t load_percent;      /* the highest so far; UP_LOAD_UNKNOWN */
} up_health_board_t;
#define UP_LOAD_UNKNOWN 255U
#define UP_STACK_UNKNOWN 65535U

/* Why the board started. */
typedef enum {
  UP_CAUSE_UNKNOWN,
  UP_CAUSE_POWER, /* switched on, or a brown-out */
  UP_CAUSE_PIN,
  UP_CAUSE_SOFTWARE,
  UP_CAUSE_WATCHDOG,
  UP_CAUSE_WINDOW_WATCHDOG,
  UP_CAUSE_LOW_POWER,
  UP_CAUSE_HALT /* the kernel stopped itself */
} up_cause_t;

/* On the wire: what the request says, the frame's version, and its parts. */
#define UP_HEALTH_REQUEST 1U
#define UP_HEALTH_VERSION 1U
#define UP_HEALTH_BOARD_BYTES 19U
#define UP_HEALTH_DEVICE_BYTES 17U

/* What a reading of a field came to, before any filter keeps it from the host. UP_NOTHING says nothing of it. */
void up_health_note(up_health_t *health, size_t field, up_result_t result, uint32_t now_ms);

/* Call it now and then, at least so often that each device has its turn within 24 days: the clock wraps. */
void up_health_tick(up_health_t *health, uint32_t now_ms);

/* Of a payload that a decoder has delivered to a host: the board, and device `index` in the schema's order. False where
 * there is none, or the payload is of another version. */
bool up_health_read_board(const uint8_t *payload, size_t size, up_health_board_t *board);
bool up_health_read_row(const uint8_t *payload, size_t size, size_t index, up_health_row_t *row);

/* How a device is. */
void up_health_row(const up_health_t *health, size_t field, uint32_t now_ms, up_health_row_t *row);

#endif
