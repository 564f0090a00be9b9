#include "up_filter.h"

#include <string.h>

/* log2(e) - 1 and ln(2), times 2^32. */
#define LOG2E_REST 1901360723U
#define LN2 2977044472U
/* exp(-23) is below 2^-32. */
#define DECAY_END 23U
#define ROOTS 16U

/* 2^-(2^-i) times 2^32, for i from 1. */
static UP_ROM uint32_t roots[ROOTS] = {
    0xB504F334U, 0xD744FCCBU, 0xEAC0C6E8U, 0xF5257D15U, 0xFA83B2DBU, 0xFD3E0C0DU, 0xFE9E115CU, 0xFF4ECB59U,
    0xFFA75652U, 0xFFD3A752U, 0xFFE9D2B3U, 0xFFF4E91CU, 0xFFFA747FU, 0xFFFD3A3BU, 0xFFFE9D1DU, 0xFFFF4E8EU,
};

uint32_t up_filter_decay(uint32_t elapsed_ms, uint32_t constant_ms) {
  uint64_t exponent, result = (uint64_t)1U << 32;
  uint32_t fraction;
  unsigned i;

  if (constant_ms == 0U || elapsed_ms / constant_ms >= DECAY_END) {
    return 0U;
  }
  /* exp(-x) is 2^-(x * log2(e)): halvings for the integer part, then a root for each bit of the fraction. */
  exponent = ((uint64_t)(elapsed_ms % constant_ms) << 32) / constant_ms;
  exponent += (exponent * LOG2E_REST) >> 32;
  exponent += (uint64_t)(elapsed_ms / constant_ms) * (((uint64_t)1U << 32) + LOG2E_REST);
  fraction = (uint32_t)exponent;
  for (i = 0U; i < ROOTS; i++) {
    if ((fraction & (0x80000000U >> i)) != 0U) {
      result = (result * roots[i] + 0x80000000U) >> 32;
    }
  }
  result -= (result * (((uint64_t)(fraction & 0xFFFFU) * LN2) >> 32)) >> 32;
  result >>= exponent >> 32;
  return (result > UINT32_MAX) ? UINT32_MAX : (uint32_t)result;
}

/* ---- numbers that compare ---- */

static bool is_real(uint8_t type) {
  return UP_USES_REALS && (type == UP_TYPE_FLOAT32 || type == UP_TYPE_FLOAT64);
}

static bool is_signed(uint8_t type) {
  return type == UP_TYPE_INT8 || type == UP_TYPE_INT16 || type == UP_TYPE_INT32 || type == UP_TYPE_INT64;
}

static up_unsigned_t sign_of(uint8_t type) {
  return (up_unsigned_t)1U << (8U * up_type_bytes(type) - 1U);
}

/* The bits of an element as an unsigned number with the same order. */
static up_unsigned_t key_of(uint8_t type, up_unsigned_t bits) {
  const up_unsigned_t sign = sign_of(type);

  if (is_real(type) && (bits & sign) != 0U) {
    return (2U * sign - 1U) - bits;
  }
  return (is_real(type) || is_signed(type)) ? bits ^ sign : bits;
}

static up_unsigned_t bits_of_key(uint8_t type, up_unsigned_t key) {
  return is_signed(type) ? key ^ sign_of(type) : key;
}

/* ---- invalid ---- */

#if UP_USES_REALS
static up_unsigned_t bits_of_real(uint8_t type, UP_ROM up_number_t *number) {
  uint32_t single;
  uint64_t wide;

  if (type == UP_TYPE_FLOAT32) {
    up_rom_copy(&single, &number->f, sizeof single);
    return single;
  }
  up_rom_copy(&wide, &number->d, sizeof wide);
  return wide;
}
#endif

static bool is_within(UP_ROM up_range_t *range, uint8_t type, up_unsigned_t bits) {
  const up_unsigned_t sign = sign_of(type);
  up_unsigned_t flip = 0U;

#if UP_USES_REALS
  if (is_real(type)) {
    const up_unsigned_t key = key_of(type, bits);

    return key >= key_of(type, bits_of_real(type, &range->low)) && key <= key_of(type, bits_of_real(type, &range->high));
  }
#endif
  if (is_signed(type)) {
    /* As wide as the numbers of the range, whose order is that of unsigned ones with the sign turned round. */
    bits = (bits ^ sign) - sign;
    flip = UP_UNSIGNED_MAX / 2U + 1U;
  }
  bits ^= flip;
  return bits >= (range->low.u ^ flip) && bits <= (range->high.u ^ flip);
}

static bool is_invalid(UP_ROM up_filter_t *filter, UP_ROM up_field_t *field, const uint8_t *value) {
  const size_t element_bytes = up_type_bytes(field->type);
  size_t element, i;

  for (element = 0U; element < field->count; element++) {
    const up_unsigned_t bits = up_element_load(field->type, &value[element * element_bytes]);
    for (i = 0U; i < filter->invalid_count; i++) {
      if (is_within(&filter->invalid[i], field->type, bits)) {
        return true;
      }
    }
  }
  return false;
}

/* ---- median ---- */

/* The bits of the median element in the window. It is found by counting, which needs no memory for a sorted copy. */
static up_unsigned_t middle(uint8_t type, const uint8_t *window, size_t stride, size_t count) {
  const size_t rank = (count - 1U) / 2U;
  up_unsigned_t bits = 0U;
  size_t candidate, i;

  for (candidate = 0U; candidate < count; candidate++) {
    const up_unsigned_t key = key_of(type, up_element_load(type, &window[candidate * stride]));
    size_t below = 0U, equal = 0U;
    for (i = 0U; i < count; i++) {
      const up_unsigned_t other = key_of(type, up_element_load(type, &window[i * stride]));
      below += (other < key) ? 1U : 0U;
      equal += (other == key) ? 1U : 0U;
    }
    if (below <= rank && rank < below + equal) {
      bits = up_element_load(type, &window[candidate * stride]);
      break;
    }
  }
  return bits;
}

static void take_median(UP_ROM up_filter_t *filter, up_filter_state_t *state, UP_ROM up_field_t *field, uint8_t *window,
                        uint8_t *value) {
  const size_t element_bytes = up_type_bytes(field->type);
  const size_t stride = up_field_bytes(field);
  size_t element;

  memcpy(&window[state->window_at * stride], value, stride);
  state->window_at = (uint8_t)((state->window_at + 1U) % filter->median);
  if (state->window_count < filter->median) {
    state->window_count++;
  }
  for (element = 0U; element < field->count; element++) {
    const up_unsigned_t bits = middle(field->type, &window[element * element_bytes], stride, state->window_count);
    up_element_store(field->type, bits, &value[element * element_bytes]);
  }
}

/* ---- smooth ---- */

/* A 64-bit number with 32 more bits of fraction, as in the state. */
typedef struct {
  uint64_t whole;
  uint32_t fraction;
} fixed_t;

static fixed_t times_decay(fixed_t number, uint32_t decay) {
  const uint64_t low = (number.whole & UINT32_MAX) * decay;
  const uint64_t fraction = (low & UINT32_MAX) + (((uint64_t)number.fraction * decay) >> 32);
  fixed_t result;

  result.whole = (number.whole >> 32) * decay + (low >> 32) + (fraction >> 32);
  result.fraction = (uint32_t)fraction;
  return result;
}

/* The remaining distance to the input is rounded towards 0 from either side: there is no drift, and the input is
 * reached. */
static uint64_t smooth_key(uint64_t *state, uint32_t decay, uint64_t key) {
  fixed_t now = {state[0], (uint32_t)state[1]};
  fixed_t distance;

  if (now.whole >= key) {
    distance.whole = now.whole - key;
    distance.fraction = now.fraction;
    distance = times_decay(distance, decay);
    now.whole = key + distance.whole;
    now.fraction = distance.fraction;
  } else {
    distance.whole = key - now.whole - ((now.fraction > 0U) ? 1U : 0U);
    distance.fraction = (uint32_t)(0U - now.fraction);
    distance = times_decay(distance, decay);
    now.whole = key - distance.whole - ((distance.fraction > 0U) ? 1U : 0U);
    now.fraction = (uint32_t)(0U - distance.fraction);
  }
  state[0] = now.whole;
  state[1] = now.fraction;
  return now.whole + (now.fraction >> 31);
}

#if UP_USES_REALS
static float single_of(uint64_t bits) {
  const uint32_t word = (uint32_t)bits;
  float number;

  memcpy(&number, &word, sizeof number);
  return number;
}

static uint64_t bits_of_single(float number) {
  uint32_t word;

  memcpy(&word, &number, sizeof word);
  return word;
}

static bool is_finite(uint64_t bits) {
  return (bits & 0x7F800000U) != 0x7F800000U;
}

/* state[1] is the rounding error of state[0], without which small steps would be lost. */
static void smooth_single(uint64_t *state, uint32_t decay, void *element) {
  const uint64_t bits = up_element_load(UP_TYPE_FLOAT32, element);
  const float gain = (float)(uint32_t)(0U - decay) / 4294967296.0F;
  const float old = single_of(state[0]), rest = single_of(state[1]);
  float step, sum;

  if (!is_finite(bits) || !is_finite(state[0]) || decay == 0U) {
    state[0] = bits;
    state[1] = 0U;
    return;
  }
  step = rest + (single_of(bits) - old - rest) * gain;
  sum = old + step;
  state[0] = bits_of_single(sum);
  state[1] = bits_of_single(step - (sum - old));
  up_element_store(UP_TYPE_FLOAT32, state[0], element);
}
#endif

static void smooth_element(UP_ROM up_filter_t *filter, uint8_t type, uint64_t *state, uint32_t decay, void *element) {
  uint64_t key;

  (void)filter;
#if UP_USES_REALS
  if (type == UP_TYPE_FLOAT32) {
    smooth_single(state, decay, element);
    return;
  }
  if (type == UP_TYPE_FLOAT64) {
    if (filter->wide != UP_ROM_NULL) {
      filter->wide->smooth(state, decay, element);
    }
    return;
  }
#endif
  key = smooth_key(state, decay, key_of(type, up_element_load(type, element)));
  up_element_store(type, bits_of_key(type, (up_unsigned_t)key), element);
}

static void smooth(UP_ROM up_filter_t *filter, up_filter_state_t *state, UP_ROM up_field_t *field, uint32_t now_ms,
                   uint8_t *value) {
  const size_t element_bytes = up_type_bytes(field->type);
  const uint32_t elapsed_ms = (uint32_t)(now_ms - state->seen_ms);
  /* The first value is taken as it is. */
  const uint32_t decay = state->has_seen ? up_filter_decay(elapsed_ms, filter->smooth_ms) : 0U;
  size_t i;

  for (i = 0U; i < field->count; i++) {
    smooth_element(filter, field->type, &state->memory[UP_FILTER_SMOOTH_WORDS(i)], decay, &value[i * element_bytes]);
  }
}

/* ---- change ---- */

static bool is_far(UP_ROM up_filter_t *filter, uint8_t type, up_unsigned_t from, up_unsigned_t to) {
  const up_unsigned_t from_key = key_of(type, from), to_key = key_of(type, to);

#if UP_USES_REALS
  if (type == UP_TYPE_FLOAT32) {
    const float distance = single_of(from) - single_of(to);
    /* NaN is far from all other numbers. */
    return !(distance < filter->change.f && distance > -filter->change.f);
  }
  if (type == UP_TYPE_FLOAT64) {
    return filter->wide == UP_ROM_NULL || filter->wide->is_far(from, to, filter->change.d);
  }
#endif
  return ((from_key > to_key) ? from_key - to_key : to_key - from_key) >= filter->change.u;
}

static bool has_changed(UP_ROM up_filter_t *filter, UP_ROM up_field_t *field, const uint8_t *reported,
                        const uint8_t *value) {
  const size_t element_bytes = up_type_bytes(field->type);
  size_t i;

  for (i = 0U; i < field->count; i++) {
    if (is_far(filter, field->type, up_element_load(field->type, &reported[i * element_bytes]),
               up_element_load(field->type, &value[i * element_bytes]))) {
      return true;
    }
  }
  return false;
}

/* Whether the next value would be too late for the heartbeat if it comes after three quarters of the present
 * interval. */
static bool is_heartbeat(UP_ROM up_filter_t *filter, const up_filter_state_t *state, uint32_t now_ms) {
  const uint32_t silent_ms = (uint32_t)(now_ms - state->reported_ms);
  const uint32_t interval_ms = (uint32_t)(now_ms - state->seen_ms);
  const uint32_t longest_ms = filter->heartbeat_ms;

  return longest_ms != 0U && (silent_ms > longest_ms || interval_ms - interval_ms / 4U > longest_ms - silent_ms);
}

up_result_t up_filter_apply(UP_ROM up_filter_t *filter, up_filter_state_t *state, UP_ROM up_field_t *field,
                            uint32_t now_ms, void *value) {
  const size_t count = field->count;
  const size_t smooth_words = (UP_USES_SMOOTH && filter->smooth_ms > 0U) ? UP_FILTER_SMOOTH_WORDS(count) : 0U;
  const bool has_change = UP_USES_CHANGE && filter->has_change;
  const size_t reported_words = has_change ? UP_FILTER_VALUE_WORDS(count, up_type_bytes(field->type)) : 0U;
  uint64_t *reported = (smooth_words > 0U) ? &state->memory[smooth_words] : state->memory;
  uint64_t *window = (reported_words > 0U) ? &reported[reported_words] : reported;
  bool is_reported = true;

  if (UP_USES_INVALID && is_invalid(filter, field, value)) {
    return UP_INVALID;
  }
  if (UP_USES_MEDIAN && filter->median > 1U) {
    take_median(filter, state, field, (uint8_t *)window, value);
  }
  if (smooth_words > 0U) {
    smooth(filter, state, field, now_ms, value);
  }
  if (has_change) {
    is_reported = !state->has_reported || has_changed(filter, field, (uint8_t *)reported, value) ||
              is_heartbeat(filter, state, now_ms);
    if (is_reported) {
      memcpy(reported, value, up_field_bytes(field));
    }
  }
  state->seen_ms = now_ms;
  state->has_seen = true;
  if (is_reported) {
    state->reported_ms = now_ms;
    state->has_reported = true;
  }
  return is_reported ? UP_FRESH : UP_NOTHING;
}
