#include "up_ppm.h"

#include <string.h>

#include "up_convert.h"

#define US_PER_S 1000000U

static void end_train(up_ppm_raw_t *raw) {
  if (raw->is_inside && raw->building_count > 0U) {
    memcpy(raw->channels, raw->building, raw->building_count * sizeof raw->building[0]);
    raw->channels_count = raw->building_count;
    raw->trains++;
  }
  raw->is_inside = true;
  raw->building_count = 0U;
}

void up_ppm_on_interval(UP_ROM up_ppm_config_t *config, up_ppm_raw_t *raw, uint32_t interval_ticks) {
  if (interval_ticks > config->gap_ticks) {
    end_train(raw);
  } else if (!raw->is_inside) {
    return;
  } else if (interval_ticks < config->min_ticks || raw->building_count >= UP_PPM_CHANNELS_MAX) {
    raw->is_inside = false;
    raw->spoilt++;
  } else {
    raw->building[raw->building_count] = interval_ticks;
    raw->building_count++;
  }
}

void up_ppm_on_edge(UP_ROM up_ppm_config_t *config, up_ppm_raw_t *raw, uint32_t time_ticks) {
  if (raw->has_edge) {
    up_ppm_on_interval(config, raw, (uint32_t)(time_ticks - raw->last_ticks));
  }
  raw->has_edge = true;
  raw->last_ticks = time_ticks;
}

up_result_t up_ppm_read(UP_ROM up_ppm_config_t *config, const up_ppm_raw_t *raw, uint32_t *trains_seen,
                        UP_ROM up_field_t *field, void *value) {
  const size_t element_bytes = up_type_bytes(field->type);
  uint8_t *memory = value;
  size_t i;

  if (raw->trains == *trains_seen) {
    return UP_NOTHING;
  }
  *trains_seen = raw->trains;
  if (raw->channels_count < field->count) {
    return UP_INVALID;
  }
  for (i = 0U; i < field->count; i++) {
    up_store_scaled(field->type, raw->channels[i], US_PER_S, config->tick_hz, &memory[i * element_bytes]);
  }
  return UP_FRESH;
}
