/*
 * A timer/counter: what timers.c, which counts, and waves.c, which makes outputs of it, have in common.
 */
#ifndef TIMERS_H
#define TIMERS_H

#include "board.h"

typedef enum { NORMAL, CLEARED, FAST, PHASE, PHASE_AND_FREQUENCY } kind_t;
typedef enum { OF_MODE, OF_COMPARE, OF_CAPTURE } top_t;

typedef struct {
  kind_t kind;
  top_t from;
  uint16_t top;
} timer_mode_t;

typedef struct {
  bool is_there;
  bool is_high; /* outside the modes with waves */
  uint64_t period;
  uint64_t width;
} output_t;

typedef struct {
  unsigned number;
  const timer_facts_t *facts;
  timer_mode_t mode;
  uint32_t cycles;    /* of a tick; 0 where it stands, or counts edges */
  bool counts_edges;
  bool is_rising;
  uint64_t edges;
  uint64_t held;      /* the number of ticks while it stands */
  uint64_t origin;    /* the tick at which this round began */
  uint32_t seen;      /* how far into the round everything has happened */
  uint64_t blocked;   /* a tick at which nothing matches, because the count was written */
  uint16_t used[CHANNELS];
  uint16_t written[CHANNELS];
  uint16_t captured;
  uint8_t high;       /* the byte that waits for the other one */
  output_t outputs[CHANNELS];
  const request_t *overflow;
  const request_t *compares[CHANNELS];
  const request_t *capture;
} timer_unit_t;

static inline unsigned channels_of(const timer_unit_t *timer) {
  return timer->facts->is_wide ? 3 : 2;
}

static inline bool goes_down(const timer_unit_t *timer) {
  return timer->mode.kind == PHASE || timer->mode.kind == PHASE_AND_FREQUENCY;
}

static inline bool has_waves(const timer_unit_t *timer) {
  return timer->mode.kind == FAST || goes_down(timer);
}

uint16_t timer_top(const timer_unit_t *timer);
/* The number of ticks of the round that is under way. */
uint32_t timer_length(const timer_unit_t *timer);
/* The count at a time. */
uint16_t timer_count(const timer_unit_t *timer, uint64_t cycle);

/* waves.c */

/* The mode, the clock, a compare value or a direction has changed. */
void waves_look(timer_unit_t *timer);
/* The count has met the value of a channel. */
void waves_match(timer_unit_t *timer, unsigned channel);
int waves_level(const timer_unit_t *timer, unsigned channel);

#endif
