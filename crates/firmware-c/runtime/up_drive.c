#include "up_drive.h"

#include "up_convert.h"

static void put(up_drive_write_t *writes, size_t *count, uint8_t output, uint32_t value) {
  writes[*count].output = output;
  writes[*count].value = value;
  (*count)++;
}

static size_t drive_pins(up_drive_write_t *writes, bool is_turning, int8_t direction, uint32_t magnitude) {
  const uint8_t low = (direction > 0) ? 2U : 1U;
  const uint8_t other = (direction > 0) ? 1U : 2U;
  size_t count = 0U;

  if (is_turning) {
    put(writes, &count, 0U, 0U);
    put(writes, &count, low, 0U);
    put(writes, &count, other, (direction == 0) ? 0U : 1U);
    if (direction == 0) {
      return count;
    }
  }
  put(writes, &count, 0U, magnitude);
  return count;
}

static size_t drive_pin(up_drive_write_t *writes, bool is_turning, int8_t direction, uint32_t magnitude) {
  size_t count = 0U;

  if (is_turning) {
    put(writes, &count, 0U, 0U);
    put(writes, &count, 1U, (direction < 0) ? 1U : 0U);
    if (direction == 0) {
      return count;
    }
  }
  put(writes, &count, 0U, magnitude);
  return count;
}

static size_t drive_pwms(up_drive_write_t *writes, int8_t direction, uint32_t magnitude) {
  const uint8_t idle = (direction > 0) ? 1U : 0U;
  size_t count = 0U;

  put(writes, &count, idle, 0U);
  put(writes, &count, (uint8_t)(1U - idle), magnitude);
  return count;
}

size_t up_drive(UP_ROM up_drive_t *drive, up_drive_state_t *state, uint8_t type, const void *element,
                up_drive_write_t writes[UP_DRIVE_WRITES_MAX]) {
  bool is_negative;
  const up_unsigned_t asked = up_load_magnitude(type, element, &is_negative);
  const uint32_t magnitude = (asked > drive->full) ? drive->full : (uint32_t)asked;
  const int8_t direction = (int8_t)((magnitude == 0U) ? 0 : (is_negative ? -1 : 1));
  const bool is_turning = !state->has_written || direction != state->direction;

  state->has_written = true;
  state->direction = direction;
  if (drive->mode == UP_DRIVE_TWO_PWM) {
    return drive_pwms(writes, direction, magnitude);
  }
  if (drive->mode == UP_DRIVE_DIRECTION_PIN) {
    return drive_pin(writes, is_turning, direction, magnitude);
  }
  return drive_pins(writes, is_turning, direction, magnitude);
}
