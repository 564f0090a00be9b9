#include "up_encoder.h"

#include <Arduino.h>

/* How often an unchanged count is told. */
#define REPEAT_MS 1000U

/* A before B counts up: the places of a line are 0, 3, 2, 1. What skips a place has lost edges, and is left out. */
void up_quadrature_on_change(up_quadrature_t *wheel, bool a, bool b) {
  const uint8_t place = (uint8_t)((a ? 2U : 0U) | ((a != b) ? 1U : 0U));
  const uint8_t moved = (uint8_t)(place - wheel->place) & 3U;

  wheel->place = place;
  if (!wheel->has_place) {
    wheel->has_place = true;
  } else if (moved == 3U) {
    wheel->count++;
  } else if (moved == 1U) {
    wheel->count--;
  }
}

void up_encoder_poll(UP_ROM up_encoder_t *encoder) {
  const uint8_t type = up_type_of(encoder->field);
  const uint8_t element_bytes = (uint8_t)up_type_bytes(type);
  bool has_changed = false;
  uint8_t i;

  for (i = 0U; i < encoder->wheels_count; i++) {
    int32_t count;

    noInterrupts();
    count = encoder->wheels[i].count;
    interrupts();
    has_changed = has_changed || count != encoder->reported[i];
    encoder->reported[i] = count;
    up_count_store(type, count, &((uint8_t *)up_scratch)[i * element_bytes]);
  }
  if (up_repeat_is_due(encoder->repeat, has_changed, REPEAT_MS, up_now_ms())) {
    up_result(encoder->field, UP_FRESH, up_scratch);
  }
}
