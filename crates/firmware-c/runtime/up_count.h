/*
 * Counts: what a hardware counter of 16 bits has counted in all, in the type of a field, told when it is due.
 *
 * A count wraps in its type, as a counter does, so that the difference of two values is right whatever lies between.
 */
#ifndef UP_COUNT_H
#define UP_COUNT_H

#include "up_schema.h"

/* All zero at the start, when the hardware counter is 0 as well. */
typedef struct {
  uint32_t total; /* two's complement; wraps */
  uint16_t last;  /* of the hardware counter */
} up_count_t;

/* The hardware counter was read. Between two calls it moves by at most 32767 up or 32768 down; else a wrap is lost. */
void up_count_step(up_count_t *count, uint16_t now);

/* Counts since the start; backwards is negative. */
int32_t up_count_total(const up_count_t *count);

/* Stores a count as one element: integers get its low bits, so that it wraps; bool is "not zero". */
void up_count_store(uint8_t type, int64_t count, void *element);

/* When a value that stands still is told again. All zero at the start. */
typedef struct {
  uint32_t told_ms;
  bool has_told;
} up_repeat_t;

/* True when a value is to be told: it has changed, was never told, or not for `repeat_ms`. */
bool up_repeat_is_due(up_repeat_t *repeat, bool has_changed, uint32_t repeat_ms, uint32_t now_ms);

#endif
