/* A thermistor by its beta formula, 1/T = 1/T25 + ln(R/R25)/beta, in integers. */
#include "up_formula.h"

#define FULL 4095U
#define T25_CENTI 29815
#define ZERO_CENTI 27315
#define RESISTANCE_MAX 100000000
#define BETA_MAX 20000
/* ln(2) times 2^24. */
#define LN2_Q24 11629080
/* Fractional bits of the logarithm. */
#define LOG_BITS 24U

/* log2(number) times 2^24, for a number of at least 1: the position of the highest bit, then one bit per squaring. */
static int64_t log2_q24(uint64_t number) {
  int64_t result = 63;
  uint32_t mantissa;
  unsigned bit;

  while ((number >> 63) == 0U && result > 0) {
    number <<= 1;
    result--;
  }
  mantissa = (uint32_t)(number >> 32); /* here 2^31 stands for 1 */
  for (bit = 0U; bit < LOG_BITS; bit++) {
    const uint64_t square = (uint64_t)mantissa * mantissa;
    const bool is_two = (square >> 63) != 0U;
    result = 2 * result + (is_two ? 1 : 0);
    mantissa = (uint32_t)(square >> (is_two ? 32 : 31));
  }
  return result;
}

static bool compute_ntc(const uint8_t *calibration, UP_ROM int32_t *parameters, const uint8_t *raw, int64_t *outputs) {
  const uint32_t level = (uint32_t)raw[0] << 8 | raw[1];
  const int64_t beta = parameters[0], r25 = parameters[1], series = parameters[2];
  int64_t log_ratio, divisor, kelvin_centi;

  (void)calibration;
  if (level == 0U || level >= FULL || beta < 1 || beta > BETA_MAX || r25 < 1 || r25 > RESISTANCE_MAX || series < 1 ||
      series > RESISTANCE_MAX) {
    return false;
  }
  /* The resistance is series * level / (FULL - level). */
  log_ratio = log2_q24((uint64_t)series * level) - log2_q24((uint64_t)r25 * (FULL - level));
  log_ratio = log_ratio * LN2_Q24 / ((int64_t)1 << LOG_BITS);
  /* T = T25 * beta / (beta + T25 * ln), everything times 100 * 2^24. */
  divisor = beta * 100 * ((int64_t)1 << LOG_BITS) + T25_CENTI * log_ratio;
  if (divisor <= 0) {
    return false;
  }
  kelvin_centi = (beta * 100 * T25_CENTI * ((int64_t)1 << LOG_BITS) + divisor / 2) / divisor;
  outputs[0] = kelvin_centi - ZERO_CENTI;
  return true;
}

UP_ROM up_formula_t up_formula_ntc = {
    .calibration_bytes = 0U, .raw_bytes = 2U, .parameters_count = 3U, .outputs_count = 1U, .compute = compute_ntc};
