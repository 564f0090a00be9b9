/*
 * Filtering of a value on the board before it is reported: invalid, median, smooth, change with heartbeat; in this
 * order, each only if the table asks for it.
 *
 * Integers of all sizes are handled without losing a bit. Arrays are filtered element by element, but an invalid
 * element makes the whole value invalid, because half a value cannot be reported.
 */
#ifndef UP_FILTER_H
#define UP_FILTER_H

#include "up_value.h"

/* The most values that a median may be taken of; their number must be odd. */
#define UP_FILTER_MEDIAN_MAX 15U

/* A number of the field's type. */
typedef union {
  up_unsigned_t u; /* bool and unsigned integers */
  up_signed_t i;   /* signed integers */
#if UP_USES_WIDE
  float f;  /* float32 */
  double d; /* float64 */
#endif
} up_number_t;

/* A range that includes both ends; for a single value they are equal. */
typedef struct {
  up_number_t low;
  up_number_t high;
} up_range_t;

/* Arithmetic in double precision, for fields of float64: only their tables refer to it, so that other boards do not
 * link it. */
typedef struct {
  void (*smooth)(uint64_t *state, uint32_t decay, void *element);
  bool (*is_far)(uint64_t from_bits, uint64_t to_bits, double distance);
} up_filter_double_t;
extern UP_ROM up_filter_double_t up_filter_double;

typedef struct {
  UP_ROM up_range_t *invalid; /* raw elements that are not a measurement */
  UP_ROM up_filter_double_t *wide; /* &up_filter_double for a float64 with `smooth` or `change`, otherwise NULL;
                                    * without it these two do nothing to a float64 */
  uint8_t invalid_count;      /* 0 to 255 */
  uint8_t median;             /* number of values for the median: odd, 3 to 15; 0: off. At first, those received so
                               * far */
  bool has_change;            /* report only changes */
  uint32_t smooth_ms;         /* time constant of a first-order low-pass; 0: off */
  up_number_t change;         /* how far an element must be from the last one reported; `u` for bool and all integers,
                               * `f` or `d` for floats; not negative */
  uint32_t heartbeat_ms;      /* with has_change: the longest time between reports while values come; 0: unlimited */
} up_filter_t;

/* 64-bit words of memory for a field with `count` elements of `element_bytes`. */
#define UP_FILTER_SMOOTH_WORDS(count) (2U * (count))
#define UP_FILTER_VALUE_WORDS(count, element_bytes) (((count) * (element_bytes) + 7U) / 8U)
#define UP_FILTER_WORDS(count, element_bytes, median, has_smooth, has_change)                              \
  (((median) * (count) * (element_bytes) + 7U) / 8U + ((has_smooth) ? UP_FILTER_SMOOTH_WORDS(count) : 0U) + \
   ((has_change) ? UP_FILTER_VALUE_WORDS(count, element_bytes) : 0U))

/* All zero except `memory`. */
typedef struct {
  uint64_t *memory; /* UP_FILTER_WORDS() words; NULL if that is 0 */
  uint32_t seen_ms; /* when the last valid value came; the clock may wrap */
  uint32_t reported_ms; /* when a value was last reported */
  uint8_t window_at;
  uint8_t window_count;
  bool has_seen;
  bool has_reported;
} up_filter_state_t;

/* Filters one value in place. UP_FRESH: report it. UP_NOTHING: valid, but too little changed to be reported.
 * UP_INVALID: not a measurement; `value` and the filter's state are unchanged. */
up_result_t up_filter_apply(UP_ROM up_filter_t *filter, up_filter_state_t *state, UP_ROM up_field_t *field,
                            uint32_t now_ms, void *value);

/* exp(-elapsed/constant) times 2^32, at most 2^32 - 1; 0 if the constant is 0. Within 6 of the exact value. */
uint32_t up_filter_decay(uint32_t elapsed_ms, uint32_t constant_ms);

#endif
