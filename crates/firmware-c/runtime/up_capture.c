#include "up_capture.h"

#include "up_convert.h"
#include "up_count.h"

#define COUNT_REPEAT_MS 1000U

void up_capture_on_width(up_capture_raw_t *raw, uint32_t width_ticks, bool both_edges) {
#if UP_USES_CAPTURE_TIMES
  raw->width_ticks = width_ticks;
  raw->widths++;
#endif
  (void)width_ticks;
  if (both_edges) {
    raw->edges++;
  }
}

void up_capture_on_period(up_capture_raw_t *raw, uint32_t period_ticks) {
  raw->edges++;
#if UP_USES_CAPTURE_TIMES
  raw->period_ticks = period_ticks;
  raw->periods++;
#endif
  (void)period_ticks;
}

static bool read_count(up_capture_state_t *state, const up_capture_raw_t *raw, bool first_edge_seen,
                       uint32_t now_ms, uint8_t type, void *element) {
  const uint32_t edges = raw->edges + (first_edge_seen ? 1U : 0U);

  /* An unchanged count is news as well: it is reported once at the start and repeated from time to time. */
  if (state->has_reported && edges == state->captures && (uint32_t)(now_ms - state->reported_ms) < COUNT_REPEAT_MS) {
    return false;
  }
  state->has_reported = true;
  state->captures = edges;
  state->reported_ms = now_ms;
  up_count_store(type, (up_signed_t)edges, element);
  return true;
}

#if UP_USES_CAPTURE_TIMES
static void store_capture(UP_ROM up_capture_config_t *config, const up_capture_raw_t *raw, uint8_t type,
                          void *element) {
  switch ((up_capture_mode_t)config->mode) {
  case UP_CAPTURE_WIDTH:
    up_store_unsigned(type, raw->width_ticks, element);
    break;
  case UP_CAPTURE_FREQUENCY:
    up_store_ratio(type, config->tick_hz, raw->period_ticks, element);
    break;
  case UP_CAPTURE_DUTY:
    up_store_scaled(type, raw->width_ticks, 10000U, raw->period_ticks, element);
    break;
  case UP_CAPTURE_COUNT:
  case UP_CAPTURE_PERIOD:
  default:
    up_store_unsigned(type, raw->period_ticks, element);
    break;
  }
}

/* A signal that has stopped has no frequency; its last width and period remain. */
static bool read_silence(UP_ROM up_capture_config_t *config, up_capture_state_t *state, uint32_t now_ms,
                         uint8_t type, void *element) {
  const bool tells_silence = config->mode == UP_CAPTURE_FREQUENCY || config->mode == UP_CAPTURE_DUTY;

  if (!tells_silence || state->is_silent || (uint32_t)(now_ms - state->reported_ms) < config->silent_ms) {
    return false;
  }
  state->is_silent = true;
  up_store_unsigned(type, 0U, element);
  return true;
}

static bool read_time(UP_ROM up_capture_config_t *config, up_capture_state_t *state, const up_capture_raw_t *raw,
                      uint32_t now_ms, uint8_t type, void *element) {
  const uint32_t captures = (config->mode == UP_CAPTURE_WIDTH) ? raw->widths : raw->periods;

  if (captures == state->captures) {
    return read_silence(config, state, now_ms, type, element);
  }
  state->captures = captures;
  state->reported_ms = now_ms;
  state->is_silent = false;
  store_capture(config, raw, type, element);
  return true;
}
#endif

bool up_capture_read(UP_ROM up_capture_config_t *config, up_capture_state_t *state, const up_capture_raw_t *raw,
                     bool first_edge_seen, uint32_t now_ms, uint8_t type, void *element) {
#if UP_USES_CAPTURE_TIMES
  if (config->mode != UP_CAPTURE_COUNT) {
    return read_time(config, state, raw, now_ms, type, element);
  }
#endif
  (void)config;
  return read_count(state, raw, first_edge_seen, now_ms, type, element);
}
