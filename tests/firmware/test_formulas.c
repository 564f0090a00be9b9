/* The formulas compared with the examples of data sheets and published tables. */
#include <string.h>

#include "check.h"
#include "up_formula.h"

static void put16(uint8_t *bytes, int number) {
  bytes[0] = (uint8_t)((unsigned)number & 0xFFU);
  bytes[1] = (uint8_t)(((unsigned)number >> 8) & 0xFFU);
}

static void put20(uint8_t *bytes, uint32_t number) {
  bytes[0] = (uint8_t)(number >> 12);
  bytes[1] = (uint8_t)(number >> 4);
  bytes[2] = (uint8_t)(number << 4);
}

/* The example of the BMP280's data sheet, section 3.12, and the humidity trimming of a BME280. The data sheet prints
 * 25767236 for the pressure, which is the result of its floating-point formula; the formula in 64-bit integers gives
 * 25767233, 0.01 Pa less. */
static void bosch_image(uint8_t *calibration, uint8_t *raw) {
  static const int words[] = {27504, 26435, -1000, 36477, -10685, 3024, 2855, 140, -7, 15500, -14600, 6000};
  static const int h2 = 362, h4 = 315, h5 = 50;
  size_t i;

  for (i = 0U; i < sizeof words / sizeof words[0]; i++) {
    put16(&calibration[2U * i], words[i]);
  }
  calibration[24] = 75U;
  put16(&calibration[25], h2);
  calibration[27] = 0U;
  calibration[28] = (uint8_t)(h4 >> 4);
  calibration[29] = (uint8_t)((h4 & 0xF) | ((h5 & 0xF) << 4));
  calibration[30] = (uint8_t)(h5 >> 4);
  calibration[31] = 30U;
  put20(&raw[0], 415148U);
  put20(&raw[3], 519888U);
  raw[6] = 33482U >> 8;
  raw[7] = 33482U & 0xFFU;
}

static void test_bosch(void) {
  uint8_t calibration[32], raw[8];
  int64_t outputs[UP_FORMULA_OUTPUTS_MAX] = {0, 0, 0};

  bosch_image(calibration, raw);
  CHECK(up_formula_bmp280.calibration_bytes == 24U && up_formula_bmp280.raw_bytes == 6U);
  CHECK(up_formula_bmp280.compute(calibration, NULL, raw, outputs));
  CHECK(outputs[0] == 2508 && outputs[1] == 25767233);
  CHECK(up_formula_bme280.calibration_bytes == 32U && up_formula_bme280.raw_bytes == 8U);
  CHECK(up_formula_bme280.compute(calibration, NULL, raw, outputs));
  /* 73.6026 % (75369) by the data sheet's floating-point formula. */
  CHECK(outputs[0] == 2508 && outputs[1] == 25767233 && outputs[2] > 75359 && outputs[2] < 75379);
  raw[6] = 0x80U;
  raw[7] = 0x00U;
  CHECK(!up_formula_bme280.compute(calibration, NULL, raw, outputs));
  put20(&raw[3], 0x80000U);
  CHECK(!up_formula_bmp280.compute(calibration, NULL, raw, outputs));
  bosch_image(calibration, raw);
  put20(&raw[0], 0x80000U);
  CHECK(!up_formula_bmp280.compute(calibration, NULL, raw, outputs));
}

/* Whatever a broken part or wire sends, nothing overflows (a sanitizer checks) and no absurd value results. */
static void test_bosch_noise(void) {
  uint8_t calibration[32], raw[8];
  int64_t outputs[UP_FORMULA_OUTPUTS_MAX];
  uint32_t seed = 7U, round, i, valid = 0U;

  for (round = 0U; round < 20000U; round++) {
    bosch_image(calibration, raw);
    for (i = 0U; i < sizeof calibration + sizeof raw; i++) {
      seed = seed * 1664525U + 1013904223U;
      if ((seed >> 28) != 0U && round % 4U != 0U) {
        continue;
      }
      *((i < sizeof calibration) ? &calibration[i] : &raw[i - sizeof calibration]) = (uint8_t)(seed >> 16);
    }
    if (up_formula_bme280.compute(calibration, NULL, raw, outputs)) {
      valid++;
      CHECK(outputs[0] >= -6000 && outputs[0] <= 11000 && outputs[1] > 0 && outputs[2] >= 0 && outputs[2] <= 102400);
    }
  }
  memset(calibration, 0xFF, sizeof calibration);
  memset(raw, 0xFF, sizeof raw);
  CHECK(!up_formula_bme280.compute(calibration, NULL, raw, outputs));
  memset(calibration, 0, sizeof calibration);
  CHECK(!up_formula_bme280.compute(calibration, NULL, raw, outputs));
  CHECK(valid > 100U);
}

/* The table of a thermistor bead with 10 kOhm and B(25/50) = 3950 K (AMWEI AMF58B-103F3950), in ohm. Real beads
 * deviate from the beta formula away from 25 degC: by 2.4 K at -20 degC, 0.6 K at 0, nothing at 30, 0.7 K at 80, 1.3
 * K at 100. */
static void test_ntc(void) {
  static const struct {
    int16_t degrees;
    int16_t within_centi;
    int32_t ohm;
  } rows[] = {{-20, 245, 90931}, {-10, 140, 53981}, {0, 65, 32581}, {10, 22, 20000}, {20, 5, 12527},
              {25, 3, 10000},    {30, 5, 8034},     {80, 75, 1243}, {100, 135, 673}};
  const int32_t parameters[] = {3950, 10000, 10000};
  const int32_t senseless[] = {0, 10000, 10000};
  int64_t celsius = 0;
  uint8_t raw[2] = {0U, 0U};
  size_t i;

  for (i = 0U; i < sizeof rows / sizeof rows[0]; i++) {
    const uint32_t level = ((uint32_t)rows[i].ohm * 4095U + (uint32_t)(rows[i].ohm + 10000) / 2U) /
                           (uint32_t)(rows[i].ohm + 10000);
    raw[0] = (uint8_t)(level >> 8);
    raw[1] = (uint8_t)level;
    CHECK(up_formula_ntc.compute(NULL, parameters, raw, &celsius));
    CHECK(celsius >= rows[i].degrees * 100 - rows[i].within_centi);
    CHECK(celsius <= rows[i].degrees * 100 + rows[i].within_centi);
  }
  CHECK(!up_formula_ntc.compute(NULL, senseless, raw, &celsius));
  raw[0] = 0x0FU;
  raw[1] = 0xFFU;
  CHECK(!up_formula_ntc.compute(NULL, parameters, raw, &celsius));
  raw[1] = 0xFEU;
  CHECK(up_formula_ntc.compute(NULL, parameters, raw, &celsius) && celsius < -6000);
  raw[0] = 0x00U;
  raw[1] = 0x00U;
  CHECK(!up_formula_ntc.compute(NULL, parameters, raw, &celsius));
  raw[1] = 0x01U;
  CHECK(up_formula_ntc.compute(NULL, parameters, raw, &celsius) && celsius > 30000);
}

/* The defaults are 402 ms and a gain of 16. */
static void test_tsl2561_by_default(void) {
  static const uint8_t raw[] = {0x10U, 0x27U, 0xD0U, 0x07U};
  int64_t millilux = 0;

  CHECK(up_formula_tsl2561.compute(NULL, NULL, raw, &millilux) && millilux == 236694);
}

static int64_t lux(int32_t time_ms, int32_t gain, uint16_t channel0, uint16_t channel1) {
  const int32_t parameters[] = {time_ms, gain};
  const uint8_t raw[] = {(uint8_t)channel0, (uint8_t)(channel0 >> 8), (uint8_t)channel1, (uint8_t)(channel1 >> 8)};
  int64_t millilux = -1;

  return up_formula_tsl2561.compute(NULL, parameters, raw, &millilux) ? millilux : -1;
}

/* lux = channel 0 * (b - m * ratio), with the pieces of the data sheet: 0.0304 and 0.0272 up to a ratio of 0.125. */
static void test_tsl2561(void) {
  CHECK(lux(402, 16, 10000U, 0U) >= 303900 && lux(402, 16, 10000U, 0U) <= 304100);
  CHECK(lux(402, 16, 10000U, 1000U) >= 276600 && lux(402, 16, 10000U, 1000U) <= 277000);
  CHECK(lux(402, 16, 10000U, 2000U) == 236694 && lux(402, 16, 10000U, 3000U) == 187805); /* 236.7 and 187.8 lux */
  CHECK(lux(402, 16, 10000U, 4000U) == 131348 && lux(402, 16, 10000U, 10000U) == 3662);
  CHECK(lux(402, 16, 10000U, 5000U) >= 68800 && lux(402, 16, 10000U, 5000U) <= 69300);
  CHECK(lux(402, 16, 10000U, 6000U) >= 37800 && lux(402, 16, 10000U, 6000U) <= 38400);
  CHECK(lux(402, 16, 10000U, 13100U) == 0 && lux(402, 16, 0U, 0U) == 0);
  CHECK(lux(402, 1, 1000U, 100U) / 100 == lux(402, 16, 16000U, 1600U) / 100);
  CHECK(lux(101, 16, 1000U, 100U) >= 109900 && lux(101, 16, 1000U, 100U) <= 110150); /* 322/81 times the counts */
  CHECK(lux(13, 16, 5047U, 10U) == -1 && lux(13, 16, 5046U, 10U) > 0 && lux(101, 16, 37177U, 10U) == -1);
  CHECK(lux(402, 16, 65535U, 0U) == -1 && lux(402, 2, 1U, 0U) == -1 && lux(400, 16, 1U, 0U) == -1);
}

/* Each bit of -2 and 1 twice, the second of them alone, and parts that are not ready or not there. */
static void test_hx711(void) {
  uint8_t raw[] = {0x00U, 0xFFU, 0xFFU, 0xFFU, 0xFFU, 0xFFU, 0xFCU, 0xFFU};
  int64_t load = 0;

  CHECK(up_formula_hx711.compute(NULL, NULL, raw, &load) && load == -2);
  raw[7] = 0x7FU;
  raw[6] = 0x54U;
  CHECK(up_formula_hx711.compute(NULL, NULL, raw, &load) && load == -2);
  raw[7] = 0x00U;
  CHECK(!up_formula_hx711.compute(NULL, NULL, raw, &load));
  raw[7] = 0xFFU;
  raw[0] = 0x01U;
  CHECK(!up_formula_hx711.compute(NULL, NULL, raw, &load));
  raw[0] = 0xFFU;
  CHECK(!up_formula_hx711.compute(NULL, NULL, raw, &load));
  memset(raw, 0, 6U);
  raw[6] = 0x03U;
  CHECK(up_formula_hx711.compute(NULL, NULL, raw, &load) && load == 1);
}

void test_formulas(void) {
  test_hx711();
  test_bosch();
  test_bosch_noise();
  test_ntc();
  test_tsl2561();
  test_tsl2561_by_default();
}
