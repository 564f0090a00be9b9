/*
 * Counts: the total of a 16-bit hardware counter, in the type of a field, when it must be reported, and which of many
 * values is taken.
 *
 * A count wraps in its type, as a counter does, so that the difference of two values is right even across a wrap.
 */
#ifndef UP_COUNT_H
#define UP_COUNT_H

#include "up_schema.h"

/* All zero at the start, when the hardware counter must be 0, too. */
typedef struct {
  uint32_t total; /* two's complement; wraps */
  uint16_t last;  /* the last value of the hardware counter */
} up_count_t;

/* The hardware counter was read. Between two calls it may move by at most 32767 up or 32768 down; otherwise a wrap
 * is lost. */
void up_count_step(up_count_t *count, uint16_t now);

/* The counts since the start; negative if backwards. */
int32_t up_count_total(const up_count_t *count);

/* Stores a count as one element: integers get its low bits, so that they wrap; bool is "not zero". */
void up_count_store(uint8_t type, up_signed_t count, void *element);

/* When an unchanged value is reported again. All zero at the start. */
typedef struct {
  uint32_t reported_ms;
  bool has_reported;
} up_repeat_t;

/* True if a value must be reported: it has changed, or was never reported, or not for `repeat_ms`. */
bool up_repeat_is_due(up_repeat_t *repeat, bool has_changed, uint32_t repeat_ms, uint32_t now_ms);

/* Which of the values that others send by their own clocks is taken: one in each cycle, on average. All zero at the
 * start. */
typedef struct {
  uint32_t last_ms; /* the turn of the last value that was taken */
  bool has_taken;
} up_turn_t;

/* True if a value that comes now is taken. Turns are a cycle apart, and one that comes up to a quarter of a cycle early
 * has its turn: otherwise every second one of a sender that is as fast as the cycle would be left out. */
bool up_turn_is_next(up_turn_t *turn, uint32_t cycle_ms, uint32_t now_ms);

#endif
