/* Filters for values on the board: invalid, median, smooth, change and heartbeat. */
#include <math.h>
#include <string.h>

#include "check.h"
#include "up_filter.h"

static const up_field_t u16_field = {"u", 1U, UP_TYPE_UINT16, UP_TO_HOST, false, 1U, 0U};
static const up_field_t i16_field = {"i", 2U, UP_TYPE_INT16, UP_TO_HOST, false, 1U, 0U};
static const up_field_t u64_field = {"w", 3U, UP_TYPE_UINT64, UP_TO_HOST, false, 1U, 0U};
static const up_field_t i64_field = {"j", 4U, UP_TYPE_INT64, UP_TO_HOST, false, 1U, 0U};
static const up_field_t f32_field = {"f", 5U, UP_TYPE_FLOAT32, UP_TO_HOST, false, 1U, 0U};
static const up_field_t f64_field = {"d", 6U, UP_TYPE_FLOAT64, UP_TO_HOST, false, 1U, 0U};
static const up_field_t bool_field = {"b", 7U, UP_TYPE_BOOL, UP_TO_HOST, false, 1U, 0U};
static const up_field_t pair_field = {"p", 8U, UP_TYPE_INT16, UP_TO_HOST, true, 2U, 0U};

static up_result_t pass_u16(const up_filter_t *filter, up_filter_state_t *state, uint32_t now_ms, uint16_t *value) {
  return up_filter_apply(filter, state, &u16_field, now_ms, value);
}

/* SRF08: 0 means no echo; a thermocouple: everything from 0x7FFC up; an int16 of -32768. */
static void test_invalid(void) {
  static const up_range_t srf[] = {{.low = {.u = 0U}, .high = {.u = 0U}},
                                   {.low = {.u = 11000U}, .high = {.u = 65535U}}};
  static const up_range_t least[] = {{.low = {.i = -32768}, .high = {.i = -32000}}};
  static const up_range_t real[] = {{.low = {.f = -1000.0F}, .high = {.f = -100.0F}}};
  static const up_range_t wide[] = {{.low = {.u = UINT64_MAX}, .high = {.u = UINT64_MAX}}};
  const up_filter_t ranger = {.invalid = srf, .invalid_count = 2U};
  const up_filter_t axes = {.invalid = least, .invalid_count = 1U};
  const up_filter_t floats = {.invalid = real, .invalid_count = 1U};
  const up_filter_t words = {.invalid = wide, .invalid_count = 1U};
  up_filter_state_t state = {0};
  uint16_t echo = 0U;
  int16_t pair[] = {5, -32768};
  float number = -100.0F;
  uint64_t word = UINT64_MAX;

  CHECK(pass_u16(&ranger, &state, 0U, &echo) == UP_INVALID);
  echo = 1U;
  CHECK(pass_u16(&ranger, &state, 0U, &echo) == UP_FRESH && echo == 1U);
  echo = 11000U;
  CHECK(pass_u16(&ranger, &state, 0U, &echo) == UP_INVALID && echo == 11000U);
  CHECK(up_filter_apply(&axes, &state, &pair_field, 0U, pair) == UP_INVALID);
  pair[1] = -31999;
  CHECK(up_filter_apply(&axes, &state, &pair_field, 0U, pair) == UP_FRESH && pair[1] == -31999);
  CHECK(up_filter_apply(&floats, &state, &f32_field, 0U, &number) == UP_INVALID);
  number = -99.9F;
  CHECK(up_filter_apply(&floats, &state, &f32_field, 0U, &number) == UP_FRESH);
  number = 100.0F;
  CHECK(up_filter_apply(&floats, &state, &f32_field, 0U, &number) == UP_FRESH);
  CHECK(up_filter_apply(&words, &state, &u64_field, 0U, &word) == UP_INVALID);
  word--;
  CHECK(up_filter_apply(&words, &state, &u64_field, 0U, &word) == UP_FRESH);
}

static void test_median(void) {
  static const up_range_t zero[] = {{.low = {.u = 0U}, .high = {.u = 0U}}};
  const up_filter_t filter = {.invalid = zero, .invalid_count = 1U, .median = 3U};
  const up_filter_t pairs = {.median = 3U};
  static const uint16_t in[] = {100U, 900U, 102U, 0U, 103U, 1U, 104U, 104U};
  static const uint16_t out[] = {100U, 100U, 102U, 0U, 103U, 102U, 103U, 104U};
  static const int16_t both[][2] = {{-5, 7}, {-300, 8}, {-6, 30000}};
  uint64_t memory[UP_FILTER_WORDS(2U, 2U, 3U, false, false)];
  up_filter_state_t state = {.memory = memory};
  int16_t pair[2] = {0, 0};
  uint32_t i;

  for (i = 0U; i < 8U; i++) {
    uint16_t value = in[i];
    CHECK(pass_u16(&filter, &state, i, &value) == ((in[i] == 0U) ? UP_INVALID : UP_FRESH) && value == out[i]);
  }
  memset(&state, 0, sizeof state);
  state.memory = memory;
  for (i = 0U; i < 3U; i++) {
    memcpy(pair, both[i], sizeof pair);
    CHECK(up_filter_apply(&pairs, &state, &pair_field, i, pair) == UP_FRESH);
  }
  CHECK(pair[0] == -6 && pair[1] == 8);
}

/* Compared with the exponential function of the C library. */
static void test_decay(void) {
  uint32_t seed = 1U, i;

  for (i = 0U; i < 20000U; i++) {
    const uint32_t constant = (seed >> 8) % 100000U + 1U;
    double wanted;
    uint32_t elapsed;
    seed = seed * 1664525U + 1013904223U;
    elapsed = (seed >> 4) >> (i % 28U);
    wanted = exp(-(double)elapsed / (double)constant) * 4294967296.0;
    CHECK(fabs((double)up_filter_decay(elapsed, constant) - wanted) < 6.5);
  }
  CHECK(up_filter_decay(5U, 0U) == 0U && up_filter_decay(UINT32_MAX, 1U) == 0U);
  CHECK(up_filter_decay(0U, 100U) == UINT32_MAX && up_filter_decay(UINT32_MAX, UINT32_MAX) >> 8 == 0x5E2D58U);
}

static void test_step_response(void) {
  const up_filter_t filter = {.smooth_ms = 100U};
  uint64_t memory[UP_FILTER_WORDS(1U, 2U, 0U, true, false)];
  up_filter_state_t state = {.memory = memory};
  uint32_t now_ms = 0xFFFFFFF0U, i;
  uint16_t value = 1000U;

  CHECK(pass_u16(&filter, &state, now_ms, &value) == UP_FRESH && value == 1000U);
  for (i = 1U; i <= 30U; i++) {
    value = 11000U;
    now_ms += 10U;
    CHECK(pass_u16(&filter, &state, now_ms, &value) == UP_FRESH);
    CHECK(fabs((double)value - (11000.0 - 10000.0 * exp(-0.1 * i))) <= 0.51);
  }
  /* Ten steps of 10 ms and one of 100 ms give the same value. */
  value = 1000U;
  now_ms += 3000U;
  CHECK(pass_u16(&filter, &state, now_ms, &value) == UP_FRESH && value == 1000U);
  value = 11000U;
  now_ms += 100U;
  CHECK(pass_u16(&filter, &state, now_ms, &value) == UP_FRESH && value == 7321U);
}

/* However small the steps, a constant input is reached exactly, from above and from below, and the value stays. */
static void test_no_drift(void) {
  const up_filter_t filter = {.smooth_ms = 60000U};
  uint64_t memory[UP_FILTER_WORDS(1U, 8U, 0U, true, false)];
  up_filter_state_t state = {.memory = memory};
  static const int16_t targets[] = {7, -7, 32767, -32768};
  uint32_t now_ms = 0U, i;
  size_t target;

  for (target = 0U; target < 4U; target++) {
    int16_t value = 0;
    for (i = 0U; i < 1500U; i++) {
      value = targets[target];
      now_ms += 1000U + i % 3U;
      CHECK(up_filter_apply(&filter, &state, &i16_field, now_ms, &value) == UP_FRESH);
    }
    CHECK(value == targets[target]);
  }
  memset(&state, 0, sizeof state);
  state.memory = memory;
  for (i = 0U; i < 4000U; i++) {
    uint64_t wide = (i == 0U) ? 0U : UINT64_MAX - 5U;
    now_ms += 1000U;
    CHECK(up_filter_apply(&filter, &state, &u64_field, now_ms, &wide) == UP_FRESH);
    if (i > 3980U) {
      CHECK(wide == UINT64_MAX - 5U);
    }
  }
}

/* The mean of the output is the mean of a noisy input: rounding has no bias. */
static void test_mean_of_noise(void) {
  const up_filter_t filter = {.smooth_ms = 500U};
  uint64_t memory[UP_FILTER_WORDS(1U, 8U, 0U, true, false)];
  up_filter_state_t state = {.memory = memory};
  const int64_t centre = -((int64_t)1 << 62);
  uint32_t seed = 3U, i;
  double sum_in = 0.0, sum_out = 0.0;

  for (i = 0U; i < 20000U; i++) {
    int64_t value;
    seed = seed * 1664525U + 1013904223U;
    value = centre + (int64_t)(seed >> 29);
    sum_in += (double)(value - centre);
    CHECK(up_filter_apply(&filter, &state, &i64_field, i * 10U, &value) == UP_FRESH);
    sum_out += (double)(value - centre);
  }
  CHECK(fabs(sum_in - sum_out) / 20000.0 < 0.03);
}

static void test_smooth_reals(void) {
  const up_filter_t single = {.smooth_ms = 100000U};
  const up_filter_t twice = {.smooth_ms = 100000U, .wide = &up_filter_double};
  uint64_t memory[UP_FILTER_WORDS(1U, 8U, 0U, true, false)], other[2];
  up_filter_state_t state = {.memory = memory}, wide_state = {.memory = other};
  uint32_t i;

  for (i = 0U; i <= 20000U; i++) {
    float number = (i == 0U) ? 1000000.0F : 1000001.0F;
    double wide = (i == 0U) ? 1e12 : 1e12 + 1e-3;
    const double wanted = 1.0 - exp(-0.0001 * i);
    CHECK(up_filter_apply(&single, &state, &f32_field, i * 10U, &number) == UP_FRESH);
    CHECK(up_filter_apply(&twice, &wide_state, &f64_field, i * 10U, &wide) == UP_FRESH);
    /* Half a digit of a float of this size is 0.03; the steps are a thousandth of that. */
    CHECK(fabs((double)number - 1000000.0 - wanted) < 0.04);
    CHECK(fabs((wide - 1e12) * 1e3 - wanted) < 0.13);
  }
  {
    const uint32_t nan_bits = 0x7FC00000U;
    float number;
    memcpy(&number, &nan_bits, sizeof number);
    CHECK(up_filter_apply(&single, &state, &f32_field, i * 10U, &number) == UP_FRESH && isnan(number));
    number = 5.0F;
    CHECK(up_filter_apply(&single, &state, &f32_field, i * 10U + 10U, &number) == UP_FRESH && number > 4.99F);
  }
}

static void test_change(void) {
  const up_filter_t filter = {.has_change = true, .change = {.u = 3U}, .heartbeat_ms = 1000U};
  uint64_t memory[UP_FILTER_WORDS(2U, 2U, 0U, false, true)];
  up_filter_state_t state = {.memory = memory};
  static const uint16_t in[] = {100U, 102U, 98U, 97U, 99U, 100U, 100U};
  static const bool reported[] = {true, false, false, true, false, true, false};
  uint32_t i, count = 0U;
  int16_t pair[] = {-1, 4};

  for (i = 0U; i < 7U; i++) {
    uint16_t value = in[i];
    CHECK(pass_u16(&filter, &state, i * 100U, &value) == (reported[i] ? UP_FRESH : UP_NOTHING) && value == in[i]);
  }
  for (i = 7U; i < 107U; i++) {
    uint16_t value = 100U;
    count += (pass_u16(&filter, &state, i * 100U + i % 2U, &value) == UP_FRESH) ? 1U : 0U;
  }
  CHECK(count == 10U);
  memset(&state, 0, sizeof state);
  state.memory = memory;
  CHECK(up_filter_apply(&filter, &state, &pair_field, 0U, pair) == UP_FRESH);
  pair[0] = 1;
  CHECK(up_filter_apply(&filter, &state, &pair_field, 1U, pair) == UP_NOTHING);
  pair[1] = 1;
  CHECK(up_filter_apply(&filter, &state, &pair_field, 2U, pair) == UP_FRESH);
}

/* With 300 ms between values and a heartbeat of a second, the third is reported, because the fourth is too late. */
static void test_heartbeat(void) {
  const up_filter_t filter = {.has_change = true, .change = {.f = 0.5F}, .heartbeat_ms = 1000U};
  const up_filter_t silent = {.has_change = true, .change = {.u = 1U}};
  uint64_t memory[1];
  up_filter_state_t state = {.memory = memory};
  uint32_t i;
  bool on = true;

  for (i = 0U; i < 13U; i++) {
    float number = 1.0F + 0.01F * (float)i;
    CHECK((up_filter_apply(&filter, &state, &f32_field, i * 300U, &number) == UP_FRESH) == (i % 3U == 0U));
  }
  memset(&state, 0, sizeof state);
  state.memory = memory;
  CHECK(up_filter_apply(&silent, &state, &bool_field, 0U, &on) == UP_FRESH);
  CHECK(up_filter_apply(&silent, &state, &bool_field, 1000000U, &on) == UP_NOTHING);
  on = false;
  CHECK(up_filter_apply(&silent, &state, &bool_field, 1000001U, &on) == UP_FRESH);
}

/* The full width of 64 bits; and without its double part, a float64 is reported each time. */
static void test_wide_change(void) {
  const up_filter_t filter = {.has_change = true, .change = {.u = UINT64_MAX}};
  const up_filter_t narrow = {.has_change = true, .change = {.d = 1.0}};
  const up_filter_t wide = {.has_change = true, .change = {.d = 1.0}, .wide = &up_filter_double};
  uint64_t memory[1];
  up_filter_state_t state = {.memory = memory};
  int64_t number = INT64_MIN;
  double real = 1.0;

  CHECK(up_filter_apply(&filter, &state, &i64_field, 0U, &number) == UP_FRESH);
  number = INT64_MAX - 1;
  CHECK(up_filter_apply(&filter, &state, &i64_field, 0U, &number) == UP_NOTHING);
  number = INT64_MAX;
  CHECK(up_filter_apply(&filter, &state, &i64_field, 0U, &number) == UP_FRESH);
  state.has_reported = false;
  CHECK(up_filter_apply(&wide, &state, &f64_field, 0U, &real) == UP_FRESH);
  real = 1.9;
  CHECK(up_filter_apply(&wide, &state, &f64_field, 0U, &real) == UP_NOTHING);
  CHECK(up_filter_apply(&narrow, &state, &f64_field, 0U, &real) == UP_FRESH);
  real = 0.8;
  CHECK(up_filter_apply(&wide, &state, &f64_field, 0U, &real) == UP_FRESH);
}

/* All filters at once, each with its own memory: the median removes outliers, the rest is smoothed and seldom
 * reported. */
static void test_together(void) {
  static const up_range_t zero[] = {{.low = {.u = 0U}, .high = {.u = 0U}}};
  const up_filter_t filter = {.invalid = zero, .invalid_count = 1U, .median = 15U, .smooth_ms = 50U,
                              .has_change = true, .change = {.u = 50U}, .heartbeat_ms = 500U};
  uint64_t memory[UP_FILTER_WORDS(1U, 2U, 15U, true, true)];
  up_filter_state_t state = {.memory = memory};
  uint32_t i, reported = 0U, invalid = 0U;

  for (i = 0U; i < 200U; i++) {
    uint16_t value = (uint16_t)((i % 10U == 3U) ? 0U : ((i % 7U == 2U) ? 60000U : 1000U + i % 3U));
    const up_result_t result = pass_u16(&filter, &state, i * 10U, &value);
    reported += (result == UP_FRESH) ? 1U : 0U;
    invalid += (result == UP_INVALID) ? 1U : 0U;
    CHECK(result == UP_INVALID || (value >= 1000U && value <= 1002U));
  }
  CHECK(invalid == 20U && reported == 4U);
}

void test_filters(void) {
  test_invalid();
  test_median();
  test_decay();
  test_step_response();
  test_no_drift();
  test_mean_of_noise();
  test_smooth_reals();
  test_change();
  test_heartbeat();
  test_wide_change();
  test_together();
}
