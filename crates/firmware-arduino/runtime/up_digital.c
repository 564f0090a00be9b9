#include "up_digital.h"

#include <Arduino.h>

#include "up_convert.h"

static bool level_of(UP_ROM up_digital_t *sensor, uint8_t i) {
  return digitalRead(sensor->pins[i]) == HIGH;
}

void up_digital_set(UP_ROM up_digital_output_t *output, const void *value) {
  const uint8_t type = up_type_of(output->field);
  const uint8_t element_bytes = (uint8_t)up_type_bytes(type);
  const uint8_t *elements = value;
  uint8_t i;

  for (i = 0U; i < output->pins_count; i++) {
    const bool is_on = up_element_load(type, &elements[i * element_bytes]) != 0U;

    digitalWrite(output->pins[i], (is_on != output->is_low_active) ? HIGH : LOW);
  }
}

/* ---- in cycles ---- */

void up_digital_look(UP_ROM up_digital_t *sensor) {
  uint8_t i;

  for (i = 0U; i < sensor->pins_count; i++) {
    up_contact_sample(sensor->contact, &sensor->states[i].contact, level_of(sensor, i), micros());
  }
}

uint32_t up_digital_cycle(UP_ROM void *work) {
  UP_ROM up_digital_class_t *own = work;
  uint8_t at;
  uint8_t i;

  for (at = 0U; at < own->sensors_count; at++) {
    UP_ROM up_digital_t *sensor = &own->sensors[at];
    const uint8_t type = up_type_of(sensor->field);
    const uint8_t element_bytes = (uint8_t)up_type_bytes(type);

    for (i = 0U; i < sensor->pins_count; i++) {
      const bool is_high = (sensor->states != NULL) ? sensor->states[i].contact.level : level_of(sensor, i);

      up_element_store(type, (is_high != sensor->is_low_active) ? 1U : 0U,
                       &((uint8_t *)up_scratch)[i * element_bytes]);
    }
    up_result(sensor->field, UP_FRESH, up_scratch);
  }
  return 0U;
}

/* ---- with interrupts ---- */

void up_digital_on_change(UP_ROM up_digital_t *sensor, uint8_t element, bool level) {
  const uint8_t edge = sensor->contact->edge;

  /* Handlers see both edges; without debouncing, only those that count may be told. */
  if (sensor->contact->lasting == 0U && edge != (uint8_t)UP_EDGE_BOTH && level != (edge == (uint8_t)UP_EDGE_RISING)) {
    return;
  }
  up_contact_on_edge(sensor->contact, &sensor->states[element].contact, level, micros());
}

/* Takes a level or a count; true if it is new. */
static bool take(UP_ROM up_digital_t *sensor, uint8_t i, uint8_t type, void *element) {
  up_contact_report_t *reported = &sensor->states[i].reported;
  up_contact_t contact;
  bool is_news;

  noInterrupts();
  up_contact_look(sensor->contact, &sensor->states[i].contact, level_of(sensor, i), micros());
  contact = sensor->states[i].contact;
  interrupts();
  if (type == (uint8_t)UP_TYPE_BOOL) {
    is_news = up_contact_report(sensor->contact, &contact, reported);
    up_element_store(type, (reported->level != sensor->is_low_active) ? 1U : 0U, element);
  } else {
    is_news = contact.edges != reported->edges;
    reported->edges = contact.edges;
    up_count_store(type, (up_signed_t)contact.edges, element);
  }
  return is_news;
}

void up_digital_poll(UP_ROM up_digital_t *sensor) {
  const uint8_t type = up_type_of(sensor->field);
  const uint8_t element_bytes = (uint8_t)up_type_bytes(type);
  bool is_news = false;
  uint8_t i;

  for (i = 0U; i < sensor->pins_count; i++) {
    is_news = take(sensor, i, type, &((uint8_t *)up_scratch)[i * element_bytes]) || is_news;
  }
  if (up_repeat_is_due(sensor->repeat, is_news, sensor->repeat_ms, up_now_ms())) {
    up_result(sensor->field, UP_FRESH, up_scratch);
  }
}
