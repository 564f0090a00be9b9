#include "up_health.h"

#include "up_wire.h"

/* Half of the clock's range. */
#define ANCIENT_MS 0x80000000U
/* A value whose time is ahead of the caller's by at most this much came meanwhile, from another thread. */
#define AHEAD_MS 0x10000U

/* The fault that a result stands for. As a table, because compilers may make one in RAM of a `switch`. */
static UP_ROM uint8_t faults[UP_RESULTS] = {
    [UP_NOTHING] = UP_FAULTS,
    [UP_FRESH] = UP_FAULTS,
    [UP_INVALID] = UP_FAULT_INVALID,
    [UP_WRONG_CRC] = UP_FAULT_CRC,
    [UP_NOT_ACKNOWLEDGED] = UP_FAULT_NOT_ACKNOWLEDGED,
    [UP_BUS_ERROR] = UP_FAULT_BUS,
    [UP_ARBITRATION_LOST] = UP_FAULT_ARBITRATION,
    [UP_TIMED_OUT] = UP_FAULT_TIME_OUT,
    [UP_WRONG_IDENTITY] = UP_FAULT_INVALID,
};

void up_health_note(up_health_t *health, size_t field, up_result_t result, uint32_t now_ms) {
  up_health_device_t *device = &health->devices[field];
  const size_t fault = ((size_t)result < UP_RESULTS) ? faults[result] : UP_FAULTS;

  if (result == UP_NOTHING) {
    return;
  }
  device->last = (uint8_t)result;
  if (fault < UP_FAULTS) {
    device->counts[fault] = (up_fault_count_t)(device->counts[fault] + (device->counts[fault] < UP_FAULT_COUNT_MAX));
  } else {
    device->good_ms = now_ms;
    device->has_value = true;
    device->is_ancient = false;
  }
}

uint32_t up_health_age(const up_health_t *health, size_t field, uint32_t now_ms) {
  const up_health_device_t *device = &health->devices[field];
  const uint32_t age = now_ms - device->good_ms;

  if (!device->has_value) {
    return UP_AGE_NEVER;
  }
  if (device->is_ancient) {
    return UP_AGE_LONG;
  }
  if (age >= 0U - AHEAD_MS) {
    return 0U;
  }
  return (age >= ANCIENT_MS) ? UP_AGE_LONG : age;
}

void up_health_tick(up_health_t *health, uint32_t now_ms) {
  up_health_device_t *device;

  if (health->looked_at >= health->devices_count) {
    health->looked_at = 0U;
    return;
  }
  device = &health->devices[health->looked_at];
  device->is_ancient = up_health_age(health, health->looked_at, now_ms) == UP_AGE_LONG;
  health->looked_at++;
}

static up_status_t status(const up_health_device_t *device, uint32_t age, uint32_t cycle_ms) {
  switch ((up_result_t)device->last) {
  case UP_NOTHING:
    return UP_STATUS_NEVER;
  case UP_FRESH:
    return (cycle_ms != 0U && age / UP_STALE_CYCLES >= cycle_ms) ? UP_STATUS_STALE : UP_STATUS_GOOD;
  case UP_INVALID:
    return UP_STATUS_INVALID;
  case UP_WRONG_CRC:
  case UP_NOT_ACKNOWLEDGED:
  case UP_BUS_ERROR:
  case UP_ARBITRATION_LOST:
  case UP_TIMED_OUT:
  case UP_WRONG_IDENTITY:
  default:
    return UP_STATUS_FAILED;
  }
}

void up_health_row(const up_health_t *health, size_t field, uint32_t now_ms, up_health_row_t *row) {
  const up_health_device_t *device = &health->devices[field];
  const uint32_t cycle_ms = (health->cycles_ms == UP_ROM_NULL) ? 0U : health->cycles_ms[field];
  size_t i;

  row->age_ms = up_health_age(health, field, now_ms);
  row->status = (uint8_t)status(device, row->age_ms, cycle_ms);
  for (i = 0U; i < UP_FAULTS; i++) {
    row->counts[i] = device->counts[i];
  }
}

/* ---- the host's side ---- */

bool up_health_read_board(const uint8_t *payload, size_t size, up_health_board_t *board) {
  if (size < UP_HEALTH_BOARD_BYTES || payload[1] != UP_HEALTH_VERSION) {
    return false;
  }
  board->uptime_ms = up_get_32(&payload[2]);
  board->reset_cause = payload[6];
  board->reset_device = payload[7];
  board->reports_sent = up_get_32(&payload[8]);
  board->reports_refused = up_get_32(&payload[12]);
  board->load_percent = payload[16];
  board->stack_left_bytes = up_get_16(&payload[17]);
  return true;
}

bool up_health_read_row(const uint8_t *payload, size_t size, size_t index, up_health_row_t *row) {
  const size_t at = UP_HEALTH_BOARD_BYTES + index * UP_HEALTH_DEVICE_BYTES;

  if (at + UP_HEALTH_DEVICE_BYTES > size || payload[1] != UP_HEALTH_VERSION) {
    return false;
  }
  row->status = payload[at];
  row->age_ms = up_get_32(&payload[at + 1U]);
  up_get_array(&payload[at + 5U], row->counts, sizeof row->counts[0], UP_FAULTS);
  return true;
}
