/* Input capture: the interrupts count, the reporter looks; no thread of its own. */
#include "up_rt.h"

#if HAL_USE_ICU == TRUE

void up_icu_start(const up_icu_t *icu) {
  (void)icuStart(icu->driver, icu->config);
  icuStartCapture(icu->driver);
  icuEnableNotifications(icu->driver);
}

void up_icu_on_overflow(ICUDriver *driver) {
  (void)driver;
}

void up_icu_poll(const up_icu_t *icu) {
  const up_field_t *field = &up_config.schema->fields[icu->field];
  up_capture_raw_t raw;
  bool first_edge_seen;
  uint64_t value = 0U;

  chSysLock();
  raw = *icu->raw;
  /* The driver turns active with the first edge, which it does not notify. */
  first_edge_seen = icu->driver->state == ICU_ACTIVE;
  chSysUnlock();
  if (up_capture_read(&icu->capture, icu->state, &raw, first_edge_seen, up_now_ms(), field->type, &value)) {
    up_put(icu->field, &value);
  }
}

#endif
