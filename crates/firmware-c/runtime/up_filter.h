/*
 * What becomes of a value on the board before it is reported: invalid, median, smooth, change with heartbeat; in this
 * order, each only where the table asks for it.
 *
 * Integers of all sizes are handled without losing a bit; arrays element by element, but an invalid element makes the
 * whole value invalid, because half a value cannot be reported.
 */
#ifndef UP_FILTER_H
#define UP_FILTER_H

#include "up_value.h"

/* An odd number up to this. */
#define UP_FILTER_MEDIAN_MAX 15U

/* A number of the field's type. */
typedef union {
  uint64_t u; /* bool and unsigned integers */
  int64_t i;  /* signed integers */
  float f;    /* float32 */
  double d;   /* float64 */
} up_number_t;

/* Both ends belong to it; a single value has both ends equal. */
typedef struct {
  up_number_t low;
  up_number_t high;
} up_range_t;

/* Arithmetic in double precision, for fields of float64: a table names it only for these, so that other boards have
 * none of it. */
typedef struct {
  void (*smooth)(uint64_t *state, uint32_t decay, void *element);
  bool (*is_far)(uint64_t from_bits, uint64_t to_bits, double distance);
} up_filter_double_t;
extern const up_filter_double_t up_filter_double;

typedef struct {
  const up_range_t *invalid; /* raw elements that are not a measurement */
  const up_filter_double_t *wide; /* &up_filter_double for a float64 with `smooth` or `change`, otherwise NULL; without
                                   * it these two leave a float64 alone */
  uint8_t invalid_count;     /* 0 to 255 */
  uint8_t median;            /* of so many values: odd, 3 to 15; 0: off. At first it is of those that there are */
  bool has_change;           /* report only what changed */
  uint32_t smooth_ms;        /* time constant of a first-order low-pass; 0: off */
  up_number_t change;        /* how far an element must be from what was reported last; for bool and all integers `u`,
                              * for floats `f` or `d`; not negative */
  uint32_t heartbeat_ms;     /* with has_change: the longest time from report to report while values come; 0: any */
} up_filter_t;

/* 64-bit words of memory for a field with `count` elements of `element_bytes`. */
#define UP_FILTER_SMOOTH_WORDS(count) (2U * (count))
#define UP_FILTER_VALUE_WORDS(count, element_bytes) (((count) * (element_bytes) + 7U) / 8U)
#define UP_FILTER_WORDS(count, element_bytes, median, has_smooth, has_change)                              \
  (((median) * (count) * (element_bytes) + 7U) / 8U + ((has_smooth) ? UP_FILTER_SMOOTH_WORDS(count) : 0U) + \
   ((has_change) ? UP_FILTER_VALUE_WORDS(count, element_bytes) : 0U))

/* All zero but `memory`. */
typedef struct {
  uint64_t *memory; /* UP_FILTER_WORDS() words; NULL where that is 0 */
  uint32_t seen_ms; /* when the last valid value came; the clock may wrap */
  uint32_t told_ms; /* when it was reported last */
  uint8_t window_at;
  uint8_t window_count;
  bool has_seen;
  bool has_told;
} up_filter_state_t;

/* One value, changed in place. UP_FRESH: to be reported. UP_NOTHING: valid, but not changed enough to be reported.
 * UP_INVALID: not a measurement; `value` and the filter's state are as before. */
up_result_t up_filter_apply(const up_filter_t *filter, up_filter_state_t *state, const up_field_t *field,
                            uint32_t now_ms, void *value);

/* exp(-elapsed/constant) times 2^32, at most 2^32 - 1; 0 where the constant is 0. Within 6 of the exact number. */
uint32_t up_filter_decay(uint32_t elapsed_ms, uint32_t constant_ms);

#endif
