/* The two steps of a filter that need double precision; up_filter.c has them in single precision. */
#include <string.h>

#include "up_filter.h"

#if UP_USES_DOUBLES && UP_USES_WIDE

static double double_of(uint64_t bits) {
  double number;

  memcpy(&number, &bits, sizeof number);
  return number;
}

static uint64_t bits_of_double(double number) {
  uint64_t bits;

  memcpy(&bits, &number, sizeof bits);
  return bits;
}

static bool is_finite(uint64_t bits) {
  const uint64_t exponent = (uint64_t)0x7FF00000U << 32;

  return (bits & exponent) != exponent;
}

static void smooth(uint64_t *state, uint32_t decay, void *element) {
  const uint64_t bits = up_element_load(UP_TYPE_FLOAT64, element);
  const double gain = 1.0 - (double)decay / 4294967296.0;
  const double old = double_of(state[0]), rest = double_of(state[1]);
  double step, sum;

  if (!is_finite(bits) || !is_finite(state[0]) || decay == 0U) {
    state[0] = bits;
    state[1] = 0U;
    return;
  }
  step = rest + (double_of(bits) - old - rest) * gain;
  sum = old + step;
  state[0] = bits_of_double(sum);
  state[1] = bits_of_double(step - (sum - old));
  up_element_store(UP_TYPE_FLOAT64, state[0], element);
}

static bool is_far(uint64_t from_bits, uint64_t to_bits, double distance) {
  const double difference = double_of(from_bits) - double_of(to_bits);

  return !(difference < distance && difference > -distance);
}

UP_ROM up_filter_double_t up_filter_double = {smooth, is_far};

#endif
