/* Voltages of DAC outputs: from a value to the converter's code. */
#include "up_dac.h"
#include "up_rt.h"

#if HAL_USE_DAC == TRUE

#include "up_convert.h"

#define CODE_FULL 4095U

void up_dac_set(DACDriver *driver, size_t field, const void *value, uint16_t element) {
  const uint8_t type = up_config.schema->fields[field].type;
  const uint8_t *own = &((const uint8_t *)value)[element * up_type_bytes(type)];
  bool is_negative = false;
  up_unsigned_t code = up_load_magnitude(type, own, &is_negative);

  if (is_negative) {
    code = 0U;
  } else if (code > CODE_FULL) {
    code = CODE_FULL;
  }
  /* Each driver object is one output, whatever its number in the unit. */
  (void)dacPutChannelX(driver, 0U, (dacsample_t)code);
}

#endif
