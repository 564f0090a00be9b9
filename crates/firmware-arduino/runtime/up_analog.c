#include "up_analog.h"

#include <Arduino.h>

#include "up_convert.h"

/* Raw values go from 0 to this, whatever the converter's resolution. */
#define RAW_FULL 4095U
#define CONVERTER_FULL 1023U

static uint32_t sum_of(UP_ROM up_analog_input_t *input) {
  uint32_t sum = 0U;
  uint16_t i;

  for (i = 0U; i < input->samples; i++) {
    sum += (uint16_t)analogRead(input->pin);
  }
  return sum;
}

/* The mean as a raw value, rounded; the product of the greatest sum has 32 bits. */
static uint16_t mean_of(UP_ROM up_analog_input_t *input, uint32_t sum) {
  const uint32_t full = (uint32_t)input->samples * CONVERTER_FULL;

  return (uint16_t)((sum * RAW_FULL + full / 2U) / full);
}

/* The formula takes the mean as two bytes, the most significant first. */
static up_result_t compute(UP_ROM up_analog_input_t *input, uint32_t sum, uint8_t type, void *element) {
#if UP_HAS_FORMULAS
  const uint16_t mean = mean_of(input, sum);
  const uint8_t raw[2] = {(uint8_t)(mean >> 8), (uint8_t)(mean & 0xFFU)};
  int64_t outputs[UP_FORMULA_OUTPUTS_MAX];

  if (!input->formula->compute(NULL, input->parameters, raw, outputs)) {
    return UP_INVALID;
  }
  up_store_output(type, outputs[input->output], element);
  return UP_FRESH;
#else
  (void)input;
  (void)sum;
  (void)type;
  (void)element;
  return UP_INVALID;
#endif
}

static up_result_t take(UP_ROM up_analog_input_t *input) {
  const uint8_t type = up_type_of(input->field);
  uint8_t *element = &((uint8_t *)up_scratch)[input->element * up_type_bytes(type)];
  const uint32_t sum = sum_of(input);

  if (UP_HAS_FORMULAS && input->formula != UP_ROM_NULL) {
    return compute(input, sum, type, element);
  }
#if UP_USES_REALS
  if (type == (uint8_t)UP_TYPE_FLOAT32) {
    up_store_scaled(type, sum, RAW_FULL, (uint32_t)input->samples * CONVERTER_FULL, element);
    return UP_FRESH;
  }
#endif
  up_store_unsigned(type, mean_of(input, sum), element);
  return UP_FRESH;
}

uint32_t up_analog_cycle(UP_ROM void *work) {
  UP_ROM up_analog_t *own = work;
  up_result_t result = UP_FRESH;
  uint8_t i;

  for (i = 0U; i < own->inputs_count; i++) {
    UP_ROM up_analog_input_t *input = &own->inputs[i];
    const up_result_t of_element = take(input);

    /* A value is there once all of its elements are; if one failed, the whole value did. */
    result = (result == UP_FRESH) ? of_element : result;
    if (i + 1U == own->inputs_count || own->inputs[i + 1U].field != input->field) {
      up_result(input->field, result, up_scratch);
      result = UP_FRESH;
    }
  }
  return 0U;
}
