#include "up_icu.h"

#include <Arduino.h>
#include <string.h>

#include "sense_model.h"
#include "up_convert.h"

void up_edges_on_change(up_edges_t *edges, bool is_active, uint32_t now, bool counts_both_edges) {
#if UP_USES_CAPTURE_TIMES
  const uint32_t passed = now - edges->began;
#else
  const uint32_t passed = now;
#endif

  if (!is_active) {
    if (edges->has_begun) {
      up_capture_on_width(&edges->raw, passed, counts_both_edges);
    }
    return;
  }
  if (edges->has_begun) {
    up_capture_on_period(&edges->raw, passed);
  }
#if UP_USES_CAPTURE_TIMES
  edges->began = now;
#endif
  edges->has_begun = true;
}

#if UP_USES_CAPTURE_TIMES
/* Ticks of the clock as ticks of the sensor, of which there are no more; rounded. */
static uint32_t ticks(UP_ROM up_icu_t *icu, uint32_t clocks) {
  return up_scale(clocks, icu->capture.tick_hz, icu->clock_hz);
}
#endif

static bool read_input(UP_ROM up_icu_t *icu, uint8_t index, uint8_t type, void *element) {
  const up_edges_t *edges = &icu->edges[index];
  up_capture_raw_t raw;
  bool has_begun;

  noInterrupts();
  raw = edges->raw;
  has_begun = edges->has_begun;
  interrupts();
#if UP_USES_CAPTURE_TIMES
  raw.width_ticks = ticks(icu, raw.width_ticks);
  raw.period_ticks = ticks(icu, raw.period_ticks);
#endif
  return up_capture_read(&icu->capture, &icu->states[index], &raw, has_begun, up_now_ms(), type, element);
}

static void poll_array(UP_ROM up_icu_t *icu, uint8_t type) {
  const uint8_t element_bytes = (uint8_t)up_type_bytes(type);
  uint8_t *latest = icu->latest;
  uint8_t i;

  for (i = 0U; i < icu->inputs_count; i++) {
    if (read_input(icu, i, type, &latest[i * element_bytes])) {
      up_elements_note(icu->flags, i);
    }
  }
  if (up_elements_are_due(icu->flags, icu->inputs_count, icu->is_complete)) {
    memcpy(up_scratch, latest, (size_t)element_bytes * icu->inputs_count);
    up_result(icu->field, UP_FRESH, up_scratch);
  }
}

void up_icu_poll(UP_ROM up_icu_t *icu) {
  const uint8_t type = up_type_of(icu->field);

  if (icu->latest != NULL) {
    poll_array(icu, type);
  } else if (read_input(icu, 0U, type, up_scratch)) {
    up_result(icu->field, UP_FRESH, up_scratch);
  }
}

void up_train_poll(UP_ROM up_train_t *train) {
  up_ppm_raw_t raw;
  up_result_t result;

  noInterrupts();
  raw = *train->raw;
  interrupts();
  result = up_ppm_read(train->config, &raw, train->trains_seen, &sense_schema.fields[train->field], up_scratch);
  up_result(train->field, result, up_scratch);
}

uint32_t up_pulse_cycle(UP_ROM void *work) {
  UP_ROM up_pulse_t *own = work;

  while (*own->at < own->lines_count) {
    UP_ROM up_pulse_line_t *line = &own->lines[*own->at];

    (*own->at)++;
    digitalWrite(line->pin, HIGH);
    delayMicroseconds(own->pulse_us);
    digitalWrite(line->pin, LOW);
    if (line->apart_ms > 0U) {
      return line->apart_ms;
    }
  }
  *own->at = 0U;
  return 0U;
}
