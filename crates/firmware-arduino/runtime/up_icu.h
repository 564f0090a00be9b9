/*
 * Pulses: handlers of interrupts keep the times of edges, polls make values of them.
 *
 * The times come from the capture input of a timer, to half a microsecond, or from the framework's clock, to four.
 */
#ifndef UP_ICU_H
#define UP_ICU_H

#include "up_capture.h"
#include "up_elements.h"
#include "up_ppm.h"
#include "up_rt.h"

/* The edges of one wire. All zero at the start. */
typedef struct {
  up_capture_raw_t raw;
#if UP_USES_CAPTURE_TIMES
  uint32_t began; /* the last active edge */
#endif
  bool has_begun;
} up_edges_t;

/* The time of an edge that no timer captures; of no meaning where edges are only counted. */
#if UP_USES_CAPTURE_TIMES
#define UP_EDGE_US() micros()
#else
#define UP_EDGE_US() 0U
#endif

/* A sensor. */
typedef struct {
  up_edges_t *edges; /* one for each element */
  up_capture_config_t capture;
  up_capture_state_t *states; /* one for each element */
  uint8_t *flags;             /* of an array: one for each element */
  void *latest;               /* of an array: the last value of each element; otherwise NULL */
  uint32_t clock_hz;          /* of the times of edges */
  uint16_t field;
  uint8_t inputs_count;
  bool is_complete; /* an array is told when each element is new */
} up_icu_t;

/* A train of pulses. */
typedef struct {
  UP_ROM up_ppm_config_t *config;
  const up_ppm_raw_t *raw;
  uint32_t *trains_seen;
  uint16_t field;
} up_train_t;

/* A wire that gets a pulse, and the time from it to the next wire's. */
typedef struct {
  uint16_t apart_ms;
  uint8_t pin;
} up_pulse_line_t;

/* Devices that measure after a pulse. */
typedef struct {
  UP_ROM up_pulse_line_t *lines;
  uint8_t *at; /* the next of them */
  uint16_t pulse_us;
  uint8_t lines_count;
} up_pulse_t;

/* An edge at `now`, in ticks of the clock that counts all 32 bits. From an interrupt. */
void up_edges_on_change(up_edges_t *edges, bool is_active, uint32_t now, bool counts_both_edges);

/* Tells what is new. */
void up_icu_poll(UP_ROM up_icu_t *icu);
void up_train_poll(UP_ROM up_train_t *train);

/* Sends a pulse to each of its wires, one after the other. */
uint32_t up_pulse_cycle(UP_ROM void *work);

#endif
