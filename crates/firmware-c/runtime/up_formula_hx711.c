/* HX711 on SPI: the data line of the port is the part's clock, so each of its bits is read twice. */
#include "up_formula.h"

#define DATA_BYTES 6U
/* The output goes high with the 25th clock, of which the first bit is the rising edge. */
#define LAST 0x7FU
#define SIGN 0x800000
#define RANGE 0x1000000

/* Each pair of bits is one clock: the second one is read while the clock is low, when the part's bit is stable. */
static bool compute_hx711(const uint8_t *calibration, UP_ROM int32_t *parameters, const uint8_t *raw,
                          int64_t *outputs) {
  int32_t code = 0;
  size_t i;
  unsigned pair;

  (void)calibration;
  (void)parameters;
  if (raw[0] != 0U || (raw[DATA_BYTES + 1U] & LAST) != LAST) {
    return false;
  }
  for (i = 1U; i <= DATA_BYTES; i++) {
    for (pair = 0U; pair < 4U; pair++) {
      code = code * 2 + (int32_t)((raw[i] >> (6U - 2U * pair)) & 1U);
    }
  }
  outputs[0] = (code >= SIGN) ? code - RANGE : code;
  return true;
}

UP_ROM up_formula_t up_formula_hx711 = {
    .calibration_bytes = 0U, .raw_bytes = 8U, .parameters_count = 0U, .outputs_count = 1U, .compute = compute_hx711};
