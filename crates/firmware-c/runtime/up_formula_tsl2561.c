/* TSL2561: the piecewise linear formula of the data sheet for the T, FN and CL packages, in integers, but in
 * millilux instead of rounded to lux. */
#include "up_formula.h"

/* The integration time and gain that the constants are for. */
#define NOMINAL_MS 402
#define NOMINAL_GAIN 16

/* Up to this ratio of channel 1 to channel 0 (times 2^9), lux = (b * channel 0 - m * channel 1) / 2^14. */
typedef struct {
  uint16_t ratio;
  uint16_t b;
  uint16_t m;
} piece_t;

static UP_ROM piece_t pieces[] = {
    {0x0040U, 0x01F2U, 0x01BEU}, {0x0080U, 0x0214U, 0x02D1U}, {0x00C0U, 0x023FU, 0x037BU}, {0x0100U, 0x0270U, 0x03FEU},
    {0x0138U, 0x016FU, 0x01FCU}, {0x019AU, 0x00D2U, 0x00FBU}, {0x029AU, 0x0018U, 0x0012U},
};

/* An integration time, its factor to counts at 402 ms times 2^10, and the count at which it saturates. */
typedef struct {
  int32_t time_ms;
  uint32_t scale;
  uint32_t end;
} timing_t;

static UP_ROM timing_t timings[] = {{13, 0x7517U, 5047U}, {101, 0x0FE7U, 37177U}, {402, 0x0400U, 65535U}};

static UP_ROM timing_t *timing_of(int32_t time_ms) {
  size_t i;

  for (i = 0U; i < sizeof timings / sizeof timings[0]; i++) {
    if (timings[i].time_ms == time_ms) {
      return &timings[i];
    }
  }
  return UP_ROM_NULL;
}

static int64_t millilux(uint64_t channel0, uint64_t channel1) {
  const uint64_t ratio = (channel0 == 0U) ? 0U : (((channel1 << 10) / channel0) + 1U) >> 1;
  int64_t sum = 0;
  size_t i;

  for (i = 0U; i < sizeof pieces / sizeof pieces[0]; i++) {
    if (ratio <= pieces[i].ratio) {
      sum = (int64_t)(channel0 * pieces[i].b) - (int64_t)(channel1 * pieces[i].m);
      break;
    }
  }
  return (sum <= 0) ? 0 : (sum * 1000 + 8192) >> 14;
}

static bool compute_tsl2561(const uint8_t *calibration, UP_ROM int32_t *parameters, const uint8_t *raw,
                            int64_t *outputs) {
  const uint32_t channel0 = (uint32_t)raw[1] << 8 | raw[0];
  const uint32_t channel1 = (uint32_t)raw[3] << 8 | raw[2];
  const int32_t gain = (parameters != UP_ROM_NULL) ? parameters[1] : NOMINAL_GAIN;
  UP_ROM timing_t *timing = timing_of((parameters != UP_ROM_NULL) ? parameters[0] : NOMINAL_MS);
  uint64_t scale;

  (void)calibration;
  if (timing == UP_ROM_NULL || (gain != 1 && gain != NOMINAL_GAIN) || channel0 >= timing->end ||
      channel1 >= timing->end) {
    return false;
  }
  scale = (uint64_t)timing->scale * (uint32_t)(NOMINAL_GAIN / gain);
  outputs[0] = millilux((channel0 * scale) >> 10, (channel1 * scale) >> 10);
  return true;
}

UP_ROM up_formula_t up_formula_tsl2561 = {
    .calibration_bytes = 0U, .raw_bytes = 4U, .parameters_count = 2U, .outputs_count = 1U, .compute = compute_tsl2561};
