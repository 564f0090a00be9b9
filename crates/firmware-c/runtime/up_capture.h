/*
 * What an input-capture channel has seen, and the values that a sensor makes of it.
 *
 * The interrupt side only counts and copies (a few instructions per edge); the reader does the arithmetic. Captures are
 * counted in timer ticks; `tick_hz` is the tick frequency, set by the sensor's resolution.
 */
#ifndef UP_CAPTURE_H
#define UP_CAPTURE_H

#include "up_schema.h"

typedef enum {
  UP_CAPTURE_COUNT,     /* edges since the start, wraps at 2^32 */
  UP_CAPTURE_WIDTH,     /* last pulse, in ticks */
  UP_CAPTURE_PERIOD,    /* last period, in ticks */
  UP_CAPTURE_FREQUENCY, /* frequency of the last period, in Hz */
  UP_CAPTURE_DUTY       /* active part of the last period, in units of 0.01 % */
} up_capture_mode_t;

typedef struct {
  uint8_t mode;      /* up_capture_mode_t */
  bool both_edges;   /* count both edges; only for UP_CAPTURE_COUNT */
  uint32_t tick_hz;
  uint32_t silent_ms; /* time without an edge after which frequency and duty are 0 */
} up_capture_config_t;

/* Written by the interrupt, copied by the reader with interrupts masked. */
typedef struct {
  uint32_t edges;
#if UP_USES_CAPTURE_TIMES
  uint32_t widths;  /* captures of a pulse */
  uint32_t periods; /* captures of a whole period */
  uint32_t width_ticks;
  uint32_t period_ticks;
#endif
} up_capture_raw_t;

/* What the reader remembers from one read to the next. */
typedef struct {
  uint32_t captures; /* edges, pulses or periods at the last read */
  uint32_t reported_ms; /* when something new was last stored */
  bool has_reported;
  bool is_silent;
} up_capture_state_t;

/* Interrupt side: the end of a pulse and the end of a period. A driver reports neither if its timer wrapped
 * meanwhile. */
void up_capture_on_width(up_capture_raw_t *raw, uint32_t width_ticks, bool both_edges);
void up_capture_on_period(up_capture_raw_t *raw, uint32_t period_ticks);

/* Reader side: true if there is something new; then one element was stored. `first_edge_seen` makes up for an edge
 * that a driver does not report: the one that starts the first period. */
bool up_capture_read(UP_ROM up_capture_config_t *config, up_capture_state_t *state, const up_capture_raw_t *raw,
                     bool first_edge_seen, uint32_t now_ms, uint8_t type, void *element);

#endif
