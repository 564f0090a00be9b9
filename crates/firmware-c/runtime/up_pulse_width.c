#include "up_pulse_width.h"

#include "up_convert.h"

uint32_t up_pulse_level(uint8_t type, const void *element) {
  bool is_negative;
  const up_unsigned_t level = up_load_magnitude(type, element, &is_negative);

  if (is_negative) {
    return 0U;
  }
  return (level > UP_LEVEL_FULL) ? UP_LEVEL_FULL : (uint32_t)level;
}

uint32_t up_pulse_ticks(UP_ROM up_pulse_width_t *width, uint32_t level) {
  const uint32_t least = width->least_ticks;
  const uint32_t greatest = width->greatest_ticks;
  const uint32_t span = (greatest > least) ? greatest - least : least - greatest;
  const uint32_t share = (span * ((level > UP_LEVEL_FULL) ? UP_LEVEL_FULL : level) + UP_LEVEL_FULL / 2U) / UP_LEVEL_FULL;

  return (greatest > least) ? least + share : least - share;
}
