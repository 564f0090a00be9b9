/* Input capture: interrupts count and the reporter polls; there is no thread. */
#include "up_icu.h"
#include "up_rt.h"

#if HAL_USE_ICU == TRUE

#include <string.h>

void up_icu_start(ICUDriver *driver, const ICUConfig *config) {
  (void)icuStart(driver, config);
  icuStartCapture(driver);
  icuEnableNotifications(driver);
}

void up_icu_on_overflow(ICUDriver *driver) {
  (void)driver;
}

static bool read_input(const up_icu_t *icu, size_t index, uint8_t type, void *element) {
  const up_icu_input_t *input = &icu->inputs[index];
  up_capture_raw_t raw;
  bool first_edge_seen;

  chSysLock();
  raw = *input->raw;
  /* The first edge makes the driver active, without a callback. */
  first_edge_seen = input->driver->state == ICU_ACTIVE;
  chSysUnlock();
  return up_capture_read(&icu->capture, &icu->states[index], &raw, first_edge_seen, up_now_ms(), type, element);
}

static void poll_array(const up_icu_t *icu, const up_field_t *field) {
  const size_t element_bytes = up_type_bytes(field->type);
  uint8_t *latest = (uint8_t *)icu->latest;
  size_t i;

  for (i = 0U; i < icu->inputs_count; i++) {
    if (read_input(icu, i, field->type, &latest[i * element_bytes])) {
      up_elements_note(icu->flags, i);
    }
  }
  if (up_elements_are_due(icu->flags, icu->inputs_count, icu->is_complete)) {
    memcpy(icu->value, latest, up_field_bytes(field));
    up_result(icu->field, UP_FRESH, icu->value);
  }
}

void up_icu_poll(const up_icu_t *icu) {
  const up_field_t *field = &up_config.schema->fields[icu->field];

  if (icu->latest != NULL) {
    poll_array(icu, field);
  } else if (read_input(icu, 0U, field->type, icu->value)) {
    up_result(icu->field, UP_FRESH, icu->value);
  }
}

void up_train_poll(const up_train_t *train) {
  up_ppm_raw_t raw;
  up_result_t result;

  chSysLock();
  raw = *train->raw;
  chSysUnlock();
  result = up_ppm_read(train->config, &raw, train->trains_seen, &up_config.schema->fields[train->field], train->value);
  up_result(train->field, result, train->value);
}

#endif
