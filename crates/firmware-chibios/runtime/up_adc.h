/*
 * Analog sensors on ChibiOS: the generated tables, and the function of their threads.
 */
#ifndef UP_ADC_H
#define UP_ADC_H

#include "hal.h"

#include "up_formula.h"

#if HAL_USE_ADC == TRUE

/* The conversions of one unit in a cycle. */
typedef struct {
  ADCDriver *driver;
  const ADCConversionGroup *group;
  adcsample_t *samples; /* depth rows of num_channels columns, in memory that a DMA reaches */
  uint16_t depth;
  uint16_t full; /* the sample value at the reference voltage: 4095 or 65535 */
  uint32_t timeout_ms;
} up_adc_group_t;

/* A value that is computed from the voltage. */
typedef struct {
  const up_formula_t *formula;
  const int32_t *parameters;
  uint8_t output;
} up_adc_formula_t;

/* One element of a value: the mean of the first `samples` rows of a column. */
typedef struct {
  uint16_t field;
  uint16_t element;
  uint16_t samples;
  uint8_t group;
  uint8_t column;
  const up_adc_formula_t *formula; /* NULL if the value is the voltage, 0 to 4095 */
} up_adc_input_t;

/* The work of one thread: groups that are started together, and the values made of them. */
typedef struct {
  const up_adc_group_t *groups; /* one per unit, in the order of the units */
  const up_adc_input_t *inputs; /* the elements of a field one after the other */
  uint64_t *value;              /* as large as the largest value */
  uint8_t groups_count;
  uint16_t inputs_count;
} up_adc_t;

void up_adc_cycle(const void *work);

/* Stores the errors for the thread that waits. */
void up_adc_on_error(ADCDriver *driver, adcerror_t errors);

#endif

#endif
