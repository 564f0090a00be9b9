/*
 * Analog sensors: a thread starts the groups of its units together, waits for each for at most its time-out, and stores
 * the mean of each input's samples.
 */
#include "up_adc.h"
#include "up_rt.h"

#if HAL_USE_ADC == TRUE

#include "up_convert.h"

/* Raw values go from 0 to this, whatever the converter's resolution. */
#define RAW_FULL 4095U

/* The most units of any MCU. */
#define GROUPS_MAX 5U

void up_adc_on_error(ADCDriver *driver, adcerror_t errors) {
  driver->up_errors |= errors;
}

/* Threads with different cycle times may share a unit, and a unit converts one group at a time. All threads take units
 * in the same order. */
static void start(const up_adc_group_t *one) {
  adcAcquireBus(one->driver);
  one->driver->up_errors = 0U;
  adcStartConversion(one->driver, one->group, one->samples, one->depth);
}

static up_result_t finish(const up_adc_group_t *one) {
  bool is_late, has_failed;

  osalSysLock();
  if (one->driver->state == ADC_ACTIVE) {
    (void)osalThreadSuspendTimeoutS(&one->driver->thread, UP_MS2I(one->timeout_ms));
  }
  is_late = one->driver->state == ADC_ACTIVE;
  has_failed = one->driver->up_errors != 0U;
  osalSysUnlock();
  if (is_late) {
    adcStopConversion(one->driver);
  }
  adcReleaseBus(one->driver);
  if (is_late) {
    return UP_TIMED_OUT;
  }
  return has_failed ? UP_BUS_ERROR : UP_FRESH;
}

static void store_mean(const up_adc_group_t *group, const up_adc_input_t *input, uint8_t type, void *element) {
  const size_t stride = group->group->num_channels;
  const uint32_t count = input->samples;
  uint32_t sum = 0U;
  size_t row;

  for (row = 0U; row < input->samples; row++) {
    sum += group->samples[row * stride + input->column];
  }
  /* Twelve-bit samples need no scaling, and 32-bit numbers divide quickly. */
  if (UP_ADC_WIDE && group->full != RAW_FULL) {
    up_store_scaled(type, sum, RAW_FULL, count * group->full, element);
  } else if (UP_USES_REALS && (type == (uint8_t)UP_TYPE_FLOAT32 || type == (uint8_t)UP_TYPE_FLOAT64)) {
    up_store_ratio(type, sum, count, element);
  } else {
    up_store_unsigned(type, (sum + count / 2U) / count, element);
  }
}

/* The formula takes the mean as two bytes, the most significant first. */
static up_result_t compute(const up_adc_group_t *group, const up_adc_input_t *input, uint8_t type, void *element) {
  const up_adc_formula_t *own = input->formula;
  int64_t outputs[UP_FORMULA_OUTPUTS_MAX];
  uint16_t mean = 0U;
  uint8_t raw[2];

  store_mean(group, input, UP_TYPE_UINT16, &mean);
  raw[0] = (uint8_t)(mean >> 8);
  raw[1] = (uint8_t)(mean & 0xFFU);
  if (!own->formula->compute(NULL, own->parameters, raw, outputs)) {
    return UP_INVALID;
  }
  up_store_output(type, outputs[own->output], element);
  return UP_FRESH;
}

static up_result_t take(const up_adc_t *adc, const up_adc_input_t *input) {
  const up_adc_group_t *group = &adc->groups[input->group];
  const uint8_t type = up_config.schema->fields[input->field].type;
  uint8_t *element = &((uint8_t *)adc->value)[input->element * up_type_bytes(type)];

  if (input->formula != NULL) {
    return compute(group, input, type, element);
  }
  store_mean(group, input, type, element);
  return UP_FRESH;
}

void up_adc_cycle(const void *work) {
  const up_adc_t *adc = work;
  up_result_t results[GROUPS_MAX];
  up_result_t result = UP_FRESH;
  uint16_t i;

  for (i = 0U; i < adc->groups_count; i++) {
    start(&adc->groups[i]);
  }
  for (i = 0U; i < adc->groups_count; i++) {
    results[i] = finish(&adc->groups[i]);
  }
  for (i = 0U; i < adc->inputs_count; i++) {
    const up_adc_input_t *input = &adc->inputs[i];
    const up_result_t group_result = results[input->group];
    const up_result_t own = (group_result == UP_FRESH) ? take(adc, input) : group_result;

    /* A value is reported once all of its elements are there; if one failed, the whole value did. */
    result = (result == UP_FRESH) ? own : result;
    if (i + 1U == adc->inputs_count || adc->inputs[i + 1U].field != input->field) {
      up_result(input->field, result, adc->value);
      result = UP_FRESH;
    }
  }
}

#endif
