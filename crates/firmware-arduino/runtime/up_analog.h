/*
 * Analog sensors: conversions one after the other, a tenth of a millisecond each.
 */
#ifndef UP_ANALOG_H
#define UP_ANALOG_H

#include "up_formula.h"
#include "up_rt.h"

typedef struct {
  UP_ROM up_formula_t *formula; /* of the mean as two bytes; NULL for none */
  UP_ROM int32_t *parameters;
  uint16_t field;
  uint16_t samples; /* 1 to 1024, of which the mean is taken */
  uint8_t pin;      /* as the framework counts them */
  uint8_t element;  /* of the field */
  uint8_t output;   /* of the formula */
} up_analog_input_t;

/* The sensors of one cycle; the elements of a value follow one another. */
typedef struct {
  UP_ROM up_analog_input_t *inputs;
  uint8_t inputs_count;
} up_analog_t;

uint32_t up_analog_cycle(UP_ROM void *work);

#endif
