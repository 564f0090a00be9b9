/* BMP280 and BME280: the integer formulas of their data sheets, with pressure in 64 bits. Results that no working
 * part and no air on earth can produce are rejected before they could overflow. */
#include "up_formula.h"

/* t_fine has 5120 units per degree; the parts measure -40 to 85 degC. */
#define FINE_MIN (-(int64_t)60 * 5120)
#define FINE_MAX ((int64_t)110 * 5120)
/* The raw value of a quantity that is switched off, in 20 and in 16 bits. */
#define SKIPPED 0x80000
#define SKIPPED_HUMIDITY 0x8000
/* The raw value of an undriven line. */
#define ONES 0xFFFFF
/* 100 %, in the unit before the last division by 2^12. */
#define HUMIDITY_FULL 419430400

static int64_t unsigned16(const uint8_t *bytes) {
  return (int64_t)((unsigned)bytes[0] | (unsigned)bytes[1] << 8);
}

static int64_t signed16(const uint8_t *bytes) {
  return ((unsigned16(bytes)) ^ 0x8000) - 0x8000;
}

/* 20 bits, most significant first, in the upper bits of three bytes. */
static int64_t raw20(const uint8_t *bytes) {
  return (int64_t)((uint32_t)bytes[0] << 12 | (uint32_t)bytes[1] << 4 | (uint32_t)bytes[2] >> 4);
}

/* Division by 2^bits, rounded down: most machines shift negative numbers in this way, but C does not guarantee it. */
static int64_t shift_down(int64_t number, unsigned bits) {
  return (number < 0) ? -1 - ((-1 - number) >> bits) : number >> bits;
}

/* The fine temperature; false if it is far out of range. */
static bool fine_temperature(const uint8_t *calibration, const uint8_t *raw, int64_t *fine) {
  const int64_t t1 = unsigned16(&calibration[0]), t2 = signed16(&calibration[2]), t3 = signed16(&calibration[4]);
  const int64_t adc = raw20(&raw[3]);
  const int64_t near = shift_down(adc, 4) - t1;

  *fine = shift_down((shift_down(adc, 3) - 2 * t1) * t2, 11) + shift_down(shift_down(near * near, 12) * t3, 14);
  return adc != SKIPPED && adc != ONES && *fine >= FINE_MIN && *fine <= FINE_MAX;
}

/* Pressure in Pa times 256; false if there is none. */
static bool pressure(const uint8_t *calibration, const uint8_t *raw, int64_t fine, int64_t *result) {
  const uint8_t *p = &calibration[6];
  const int64_t adc = raw20(raw);
  const int64_t from = fine - 128000;
  const int64_t offset =
      from * from * signed16(&p[10]) + from * signed16(&p[8]) * 131072 + signed16(&p[6]) * ((int64_t)1 << 35);
  const int64_t bend = shift_down(from * from * signed16(&p[4]), 8);
  const int64_t slope = ((int64_t)1 << 47) + bend + from * signed16(&p[2]) * 4096;
  int64_t divisor, gross, high;

  if (adc == SKIPPED || slope <= 0 || slope >= (int64_t)1 << 48) {
    return false;
  }
  divisor = (int64_t)(((uint64_t)slope * (uint64_t)unsigned16(p)) >> 33);
  gross = (1048576 - adc) * ((int64_t)1 << 31) - offset;
  if (divisor == 0 || gross <= 0 || gross > INT64_MAX / 3125) {
    return false;
  }
  gross = gross * 3125 / divisor;
  if (gross >= (int64_t)1 << 35) {
    return false;
  }
  high = gross >> 13;
  gross += shift_down(signed16(&p[16]) * high * high, 25) + shift_down(signed16(&p[14]) * gross, 19);
  *result = shift_down(gross, 8) + signed16(&p[12]) * 16;
  return *result > 0;
}

/* Relative humidity in percent times 1024. */
static int64_t humidity(const uint8_t *calibration, const uint8_t *raw, int64_t fine) {
  const int64_t adc = (int64_t)((unsigned)raw[6] << 8 | raw[7]);
  const int64_t h1 = calibration[24], h2 = signed16(&calibration[25]), h3 = calibration[27];
  /* Two 12-bit numbers share a byte. */
  const int64_t h4 = (((int64_t)calibration[28] ^ 0x80) - 0x80) * 16 + (calibration[29] & 0xF);
  const int64_t h5 = (((int64_t)calibration[30] ^ 0x80) - 0x80) * 16 + (calibration[29] >> 4);
  const int64_t h6 = ((int64_t)calibration[31] ^ 0x80) - 0x80;
  const int64_t from = fine - 76800;
  const int64_t level = shift_down(adc * 16384 - h4 * 1048576 - h5 * from + 16384, 15);
  const int64_t bend = shift_down(shift_down(from * h6, 10) * (shift_down(from * h3, 11) + 32768), 10) + 2097152;
  int64_t result = level * shift_down(bend * h2 + 8192, 14);
  int64_t high = shift_down(result, 15);

  if (high > 131072 || high < -131072) {
    /* Far out of range; the square below must not overflow. */
    high = 0;
  }
  result -= shift_down(shift_down(high * high, 7) * h1, 4);
  if (result < 0) {
    result = 0;
  } else if (result > HUMIDITY_FULL) {
    result = HUMIDITY_FULL;
  }
  return result >> 12;
}

static bool compute_bmp280(const uint8_t *calibration, UP_ROM int32_t *parameters, const uint8_t *raw,
                           int64_t *outputs) {
  int64_t fine;

  (void)parameters;
  if (!fine_temperature(calibration, raw, &fine)) {
    return false;
  }
  outputs[0] = shift_down(fine * 5 + 128, 8);
  return pressure(calibration, raw, fine, &outputs[1]);
}

static bool compute_bme280(const uint8_t *calibration, UP_ROM int32_t *parameters, const uint8_t *raw,
                           int64_t *outputs) {
  int64_t fine;

  if (!compute_bmp280(calibration, parameters, raw, outputs) || !fine_temperature(calibration, raw, &fine) ||
      ((unsigned)raw[6] << 8 | raw[7]) == SKIPPED_HUMIDITY) {
    return false;
  }
  outputs[2] = humidity(calibration, raw, fine);
  return true;
}

UP_ROM up_formula_t up_formula_bmp280 = {
    .calibration_bytes = 24U, .raw_bytes = 6U, .parameters_count = 0U, .outputs_count = 2U, .compute = compute_bmp280};

UP_ROM up_formula_t up_formula_bme280 = {
    .calibration_bytes = 32U, .raw_bytes = 8U, .parameters_count = 0U, .outputs_count = 3U, .compute = compute_bme280};
