/*
 * Formulas that need more than scale and offset: from the raw bytes of one reading, the part's calibration and its
 * parameters to physical quantities, in integers.
 *
 * A table refers to a formula by its address, so that only the formulas that a board uses are linked.
 */
#ifndef UP_FORMULA_H
#define UP_FORMULA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "up_rom.h"

/* The most outputs that any formula has. */
#define UP_FORMULA_OUTPUTS_MAX 3U

typedef struct {
  uint16_t calibration_bytes; /* size of all calibration blocks, one after the other */
  uint16_t raw_bytes;         /* size of the raw block that it is computed from */
  uint8_t parameters_count;
  uint8_t outputs_count;
  /* False if the raw block is not a measurement (switched off, out of range, an open wire). */
  bool (*compute)(const uint8_t *calibration, UP_ROM int32_t *parameters, const uint8_t *raw, int64_t *outputs);
} up_formula_t;

/* BMP280. Outputs: 0 temperature in 0.01 degC, 1 pressure in Pa/256. Calibration: 0x88, 24 bytes. Raw: 0xF7, 6
 * bytes. */
extern UP_ROM up_formula_t up_formula_bmp280;

/* BME280. Outputs: 0 and 1 as for BMP280, 2 relative humidity in %/1024. Calibration: 0x88, 24 bytes; 0xA1, 1; 0xE1,
 * 7. Raw: 0xF7, 8 bytes. */
extern UP_ROM up_formula_t up_formula_bme280;

/* A thermistor from the pin to ground, with a series resistor to the supply. Output: 0 temperature in 0.01 degC.
 * Parameters: beta in K (1 to 20000), resistance at 25 degC in ohms, series resistance in ohms (both 1 to
 * 100000000). Raw: the analog value 0 to 4095, 2 bytes, most significant first; 0 and 4095 mean a short circuit and
 * an open circuit. */
extern UP_ROM up_formula_t up_formula_ntc;

/* TSL2561 in the T, FN and CL packages. Output: 0 illuminance in mlx. Parameters: integration time in ms (13, 101 or
 * 402), gain (1 or 16); none (NULL): 402 and 16. Raw: both channels from 0x8C, 4 bytes, each least significant
 * first; a saturated channel is not a measurement. */
extern UP_ROM up_formula_t up_formula_tsl2561;

/* HX711 on SPI, channel A, gain 128. Output: 0 the conversion, 24 bits with sign. Raw: 8 bytes that come back while 00,
 * six times AA and 80 are sent, two bits a clock. Not a measurement if the part was not ready before the first clock
 * (its output was high), or if its output is not high after the last one. */
extern UP_ROM up_formula_t up_formula_hx711;

#endif
