/*
 * The health of a board's devices: the outcome of their last readings, how long ago those were, and how often each fault
 * occurred.
 *
 * Nothing here locks or has a clock: the caller serialises the functions and passes the time.
 */
#ifndef UP_HEALTH_H
#define UP_HEALTH_H

#include "up_result.h"
#include "up_schema.h"

/* The age of a value that does not exist yet, and of one that is older than the clock can tell (24 days). */
#define UP_AGE_NEVER 0xFFFFFFFFU
#define UP_AGE_LONG 0xFFFFFFFEU

/* A device is stale after this many of its cycles without a value. */
#define UP_STALE_CYCLES 3U

typedef enum {
  UP_STATUS_NEVER,  /* never read */
  UP_STATUS_GOOD,   /* the last reading was a measurement, and is not old */
  UP_STATUS_STALE,  /* no value for three cycles */
  UP_STATUS_FAILED, /* the last reading did not come through */
  UP_STATUS_INVALID /* the last answer was not a measurement */
} up_status_t;

typedef enum {
  UP_FAULT_NOT_ACKNOWLEDGED,
  UP_FAULT_BUS,
  UP_FAULT_ARBITRATION,
  UP_FAULT_TIME_OUT,
  UP_FAULT_CRC,
  UP_FAULT_INVALID /* also answers of the wrong device */
} up_fault_t;
#define UP_FAULTS 6U

/* The state of one device. All zero at the start. */
typedef struct {
  uint32_t good_ms;                   /* when the last value came; the clock may wrap */
  up_fault_count_t counts[UP_FAULTS]; /* by up_fault_t; they stop at UP_FAULT_COUNT_MAX */
  uint8_t last;                       /* up_result_t of the last reading; UP_NOTHING before the first */
  bool has_value;
  bool is_ancient; /* the clock cannot tell how old the value is */
} up_health_device_t;

typedef struct {
  up_health_device_t *devices; /* one for each field of the schema */
  UP_ROM uint32_t *cycles_ms;  /* how often each is read; 0: only when something happens, and then it is never stale.
                                * NULL: all are like that */
  uint8_t devices_count;
  uint8_t looked_at; /* the next device for up_health_tick() */
} up_health_t;

/* The health of one device, as reported to the host. */
typedef struct {
  uint32_t age_ms;
  uint16_t counts[UP_FAULTS];
  uint8_t status; /* up_status_t */
} up_health_row_t;

/* The health of the board itself, as reported to the host. */
typedef struct {
  uint32_t uptime_ms;
  uint32_t reports_sent;
  uint32_t reports_refused;
  uint16_t stack_left_bytes; /* bytes of the fullest stack that were never used; UP_STACK_UNKNOWN */
  uint8_t reset_cause;       /* up_cause_t */
  uint8_t reset_device;      /* after a watchdog reset, identifier of the first device of the thread that hung */
  uint8_t load_percent;      /* highest load so far; UP_LOAD_UNKNOWN */
} up_health_board_t;
#define UP_LOAD_UNKNOWN 255U
#define UP_STACK_UNKNOWN 65535U

/* Why the board started. */
typedef enum {
  UP_CAUSE_UNKNOWN,
  UP_CAUSE_POWER, /* power-on or brown-out */
  UP_CAUSE_PIN,
  UP_CAUSE_SOFTWARE,
  UP_CAUSE_WATCHDOG,
  UP_CAUSE_WINDOW_WATCHDOG,
  UP_CAUSE_LOW_POWER,
  UP_CAUSE_HALT /* the kernel stopped itself */
} up_cause_t;

/* On the wire: the content of a request, the version of the format, and the sizes of its parts. */
#define UP_HEALTH_REQUEST 1U
#define UP_HEALTH_VERSION 1U
#define UP_HEALTH_BOARD_BYTES 19U
#define UP_HEALTH_DEVICE_BYTES 17U

/* Notes the outcome of a reading of a field, before any filter withholds it from the host. UP_NOTHING is ignored. */
void up_health_note(up_health_t *health, size_t field, up_result_t result, uint32_t now_ms);

/* Must be called from time to time, so often that each device has its turn within 24 days, because the clock wraps. */
void up_health_tick(up_health_t *health, uint32_t now_ms);

/* Read the board, and device `index` in the schema's order, from a payload that a decoder has delivered to a host.
 * False if there is none, or the payload has another version. */
bool up_health_read_board(const uint8_t *payload, size_t size, up_health_board_t *board);
bool up_health_read_row(const uint8_t *payload, size_t size, size_t index, up_health_row_t *row);

/* The age of a device's value: UP_AGE_NEVER, UP_AGE_LONG, or milliseconds. */
uint32_t up_health_age(const up_health_t *health, size_t field, uint32_t now_ms);

/* The health of a device. */
void up_health_row(const up_health_t *health, size_t field, uint32_t now_ms, up_health_row_t *row);

#endif
