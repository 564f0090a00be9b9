/*
 * The runtime on ChibiOS: the tables that describe an application, and what all parts share.
 *
 * The generated folder defines `up_config`; its tables describe everything else of the application. Threads store
 * values with up_put() and up_fail(), and the reporter (the main thread) sends what is due.
 */
#ifndef UP_RT_H
#define UP_RT_H

#include "ch.h"
#include "hal.h"

#include "up_conf.h"
#include "up_dma.h" /* before the core's headers, which use its UP_DMA_BUFFER */

#include "up_chip.h"
#include "up_filter.h"
#include "up_health.h"
#include "up_report.h"

/* ---- tables ---- */

/* How one pad is set up at the start: its level first, so that an output starts with it. */
typedef struct {
  ioline_t line;
  iomode_t mode;
  uint8_t level; /* PAL_LOW or PAL_HIGH; ignored except for outputs */
} up_pad_t;

/* A thread that runs a cycle every `delay_ms`. */
typedef struct {
  const char *name;
  void (*cycle)(const void *work);
  const void *work;
  void *stack; /* a working area and its size */
  size_t stack_bytes;
  uint32_t delay_ms;
  int16_t prio; /* relative to NORMALPRIO */
  uint32_t start_ms; /* delay of the first cycle, so that devices of a group take turns */
  uint8_t device;    /* identifier of the first device that it serves; 0: none */
} up_task_t;

/* The filter for the values of a field; NULL for none. */
typedef struct {
  const up_filter_t *filter;
  up_filter_state_t *state;
} up_filtered_t;

/* A driver's counter besides the health of devices. */
typedef struct {
  const char *title; /* "I2C1 was freed" */
  const uint32_t *count;
} up_counter_t;

#if UP_SHELL == TRUE
/* The subjects of the self test. */

/* A wire that a device drives, or that a resistor pulls up. */
typedef struct {
  const char *title; /* "IRFront at PB0 (ADC12-IN8)" */
  ioline_t line;
  bool is_bus; /* pulled up, not driven */
} up_input_t;

typedef struct {
  const char *title;
  const up_chip_state_t *state;
} up_chip_check_t;

/* A bus whose addresses can be probed. */
typedef struct {
  const char *title;
  bool (*answers)(const void *bus, uint8_t address);
  const void *bus;
  const uint8_t *expected; /* the addresses that the design has there */
  size_t expected_count;
} up_probe_t;

/* A sensor that counts. */
typedef struct {
  const char *title;
  uint16_t field;
} up_edges_t;
#endif

/* A whole application. */
typedef struct {
  const char *board;
  const up_schema_t *schema;
  void *values;
  const uint32_t *cycles_ms; /* one per field, as in up_health_t */
  void (*const *transforms)(void *value); /* one per field, NULL for none */
  const up_pad_t *pads;
  size_t pads_count;
  const up_task_t *tasks;
  size_t tasks_count;
  const up_filtered_t *filters; /* one per field, NULL if no field has one; otherwise `filter` is up_filter_apply */
  up_result_t (*filter)(const up_filter_t *filter, up_filter_state_t *state, const up_field_t *field,
                        uint32_t now_ms, void *value);
  const up_counter_t *counters;
  size_t counters_count;
#if UP_LINK_USB == FALSE
  SerialDriver *link_driver;
  const SerialConfig *link_config;
#endif
#if UP_HAS_BUTTON == TRUE
  ioline_t button;
  uint8_t button_pressed; /* PAL_HIGH or PAL_LOW */
#endif
  uint32_t report_ms; /* the reporter's cycle */
#if UP_SHELL == TRUE
  const up_input_t *inputs;
  size_t inputs_count;
  const up_chip_check_t *chips;
  size_t chips_count;
  const up_probe_t *probes;
  size_t probes_count;
  const up_edges_t *edges;
  size_t edges_count;
#endif
} up_config_t;

extern const up_config_t up_config;

/* ---- generated functions ---- */

/* Starts the drivers: once, after the pads are set up and before any thread. */
void sense_start(void);

/* Processes what interrupts have collected and stores it: from the reporter, in each cycle. */
void sense_poll(void);

/* The host has set an actuator: does what must be done at once. From the reporter, once for each value of a frame. */
void sense_apply(size_t field, const void *value);

/* The host has been silent for too long: sets the failsafe values of the actuators that have one. From the reporter. */
void sense_failsafe(void);

/* Sets an actuator as if the host had sent the value. From sense_failsafe(). */
void up_fall_back(size_t field, const void *value);

/* Held by whoever calls sense_poll() or sets an actuator: the reporter, and the threads of the user's controllers. */
#if UP_HAS_CONTROL == TRUE
void up_io_lock(void);
void up_io_unlock(void);
#else
#define up_io_lock()
#define up_io_unlock()
#endif

/* ---- time ---- */

/* Microseconds per kernel tick. */
#define UP_STEP_US (1000000U / CH_CFG_ST_FREQUENCY)

/* Milliseconds as kernel ticks: there are 1 or 10 per millisecond, so that nothing must be divided. */
#define UP_MS2I(ms) ((sysinterval_t)(ms) * ((sysinterval_t)CH_CFG_ST_FREQUENCY / 1000U))
_Static_assert(CH_CFG_ST_FREQUENCY % 1000U == 0U && 1000000U % CH_CFG_ST_FREQUENCY == 0U,
               "the kernel's time has whole steps in a millisecond, and whole microseconds in a step");

/* ---- values ---- */

/* Milliseconds since the start, from a thread; wraps at 2^32. */
uint32_t up_now_ms(void);

/* A sensor was read: `value` (which the user's transform may change) becomes due. From a thread. */
void up_put(size_t field, void *value);

/* A sensor could not be read; its last value remains. */
void up_fail(size_t field);

/* A device has answered, and its value is the one that is known. */
void up_note_good(size_t field);

/* The outcome of one reading of a sensor: a value (UP_FRESH) goes through the field's filter to up_put(), a fault is
 * counted. From a thread. */
void up_result(size_t field, up_result_t result, void *value);

/* up_result() as a sink for the core's functions; its context is not used. */
extern const up_value_sink_t up_values;

/* Copies the latest value; false if there is none yet. */
bool up_get(size_t field, void *value);

/* How often a value was received (0: never), how often reading it failed, and how old it is. */
uint32_t up_sequence(size_t field);
uint32_t up_errors(size_t field);
uint32_t up_age_ms(size_t field);

/* Before any other of these functions, once the kernel has started. */
void up_store_start(void);

/* For the reporter: the store and the health of the devices, which it uses between up_lock() and up_unlock(). */
up_store_t *up_store(void);
up_health_t *up_health(void);
void up_lock(void);
void up_unlock(void);

/* ---- the user's part; empty unless user/ defines it ---- */

/* Called once after the kernel has started and before any sensor thread runs. */
void up_user_init(void);

/* Called after a frame from the host has changed an actuator's value. From the reporter. */
void up_user_received(size_t field);

#endif
