/*
 * The runtime of a sketch: the latest values, tasks that run in their cycles, and the link.
 *
 * There is one loop and no operating system: what one task waits for, all wait for. Handlers of interrupts only count and
 * keep times; tasks and polls make values of that.
 */
#ifndef UP_RT_H
#define UP_RT_H

#include "sense_conf.h"

#include "up_chip.h"
#include "up_filter.h"
#include "up_health.h"
#include "up_report.h"
#include "up_rom.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* ---- what is generated ---- */

/* Work that is done in each cycle. */
typedef struct {
  /* Returns 0, or after how many milliseconds it wants to go on within this cycle. */
  uint32_t (*cycle)(UP_ROM void *work);
  UP_ROM void *work;
  uint32_t delay_ms;
  uint32_t start_ms; /* the delay of the first cycle, so that devices of a group take turns */
  uint16_t field;    /* the first value that it serves: a cycle that is left out counts as its time-out */
} up_task_t;

/* The filter for the values of a field; NULL for none. */
typedef struct {
  UP_ROM up_filter_t *filter;
  up_filter_state_t *state;
} up_filtered_t;

extern UP_ROM up_task_t sense_tasks[];
/* How often each value comes; 0: when something happens. */
extern UP_ROM uint32_t sense_cycles_ms[];
#if UP_HAS_FILTERS
extern UP_ROM up_filtered_t sense_filters[]; /* one for each field */
#endif

/* Starts pads and drivers: once, before any task. */
void sense_start(void);

/* Takes what interrupts have collected: before each report, and before each step of the user's code. */
void sense_poll(void);

/* Takes what has come at serial ports: in each turn of the loop. */
void sense_drain(void);

/* The host, or the user's code, has set an actuator. */
void sense_apply(size_t field, const void *value);

/* The host has been silent for too long. */
void sense_failsafe(void);

/* Opens the port of the link; the bytes that have come, the room for bytes, sending. */
void sense_link_start(void);
size_t sense_link_read(void *context, uint8_t *bytes, size_t size);
size_t sense_link_room(void *context);
size_t sense_link_write(void *context, const uint8_t *bytes, size_t size);
bool sense_link_is_open(void *context);

/* ---- the sketch ---- */

/* To be called by setup() and loop(). */
void up_setup(void);
void up_loop(void);

/* ---- values ---- */

/* Memory for one value of any field, for whoever puts one together. A call of up_result() may change it. */
extern uint64_t up_scratch[(UP_VALUE_BYTES_MAX + 7U) / 8U];

/* Milliseconds since the start; wraps at 2^32. */
uint32_t up_now_ms(void);

/* The type of a field's elements. */
uint8_t up_type_of(size_t field);

/* The outcome of one reading: a value (UP_FRESH) goes through the field's filter and the user's transform, and becomes
 * due; a fault is counted. */
void up_result(size_t field, up_result_t result, void *value);

/* up_result() as a sink for the core's functions; its context is not used. */
extern const up_value_sink_t up_values;

/* Stores a value without filter or transform. */
void up_put(size_t field, const void *value);

/* A device has answered, and its value is the one that is known. */
void up_note_good(size_t field);

/* Copies the latest value; false if there is none yet. */
bool up_get(size_t field, void *value);

/* Whether the last reading was a measurement that is not old, and its age. */
bool up_is_good(size_t field, uint32_t *age_ms);

/* Sets an actuator as if the host had sent the value. */
void up_fall_back(size_t field, const void *value);

/* Sets an actuator: stores the value and moves the output. */
void up_set(size_t field, const void *value);

/* ---- the user's part; empty unless src/user/ defines it ---- */

/* Called once, before any sensor is read. */
void up_user_init(void);

/* Called after a frame from the host has changed an actuator's value. */
void up_user_received(size_t field);

#if defined(__cplusplus)
}
#endif

#endif
