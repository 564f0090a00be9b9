/* Analog sensors: one conversion group a thread, each sensor the mean of its samples. */
#include "up_rt.h"

#if HAL_USE_ADC == TRUE

#include "up_convert.h"

static void put_sensor(const up_adc_t *adc, const up_analog_t *sensor) {
  const up_field_t *field = &up_config.schema->fields[sensor->field];
  uint64_t value = 0U;

  up_store_mean(field->type, &adc->buffer[sensor->column], sensor->samples, adc->group->num_channels, &value);
  up_put(sensor->field, &value);
}

void up_adc_cycle(const void *work) {
  const up_adc_t *adc = work;
  msg_t result;
  uint8_t i;

  /* Threads with different cycle times may share the unit, and a unit converts one group at a time. */
  adcAcquireBus(adc->driver);
  result = adcConvert(adc->driver, adc->group, adc->buffer, adc->depth);
  adcReleaseBus(adc->driver);
  for (i = 0U; i < adc->sensors_count; i++) {
    if (result == MSG_OK) {
      put_sensor(adc, &adc->sensors[i]);
    } else {
      up_fail(adc->sensors[i].field);
    }
  }
}

#endif
