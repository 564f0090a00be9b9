/* Reports on devices and on a silent host: rules of the status, saturation, the clock's wrap. */
#include <string.h>

#include "check.h"
#include "up_health.h"
#include "up_silence.h"

#define NEVER 0xFFFFFFFFU

static const uint32_t cycles_ms[] = {60U, 0U, 1000U};

typedef struct {
  up_health_device_t devices[3];
  up_health_t health;
} board_t;

static void set_up(board_t *board) {
  memset(board, 0, sizeof *board);
  board->health.devices = board->devices;
  board->health.cycles_ms = cycles_ms;
  board->health.devices_count = 3U;
}

static bool is(const board_t *board, size_t field, uint32_t now_ms, up_status_t status, uint32_t age_ms) {
  up_health_row_t row;

  memset(&row, 0xAA, sizeof row);
  up_health_row(&board->health, field, now_ms, &row);
  return row.status == (uint8_t)status && row.age_ms == age_ms;
}

static void test_status(void) {
  static const up_result_t failures[] = {UP_WRONG_CRC,        UP_NOT_ACKNOWLEDGED, UP_BUS_ERROR,
                                         UP_ARBITRATION_LOST, UP_TIMED_OUT,        UP_WRONG_IDENTITY};
  board_t board;
  size_t i;

  set_up(&board);
  CHECK(is(&board, 0U, 0U, UP_STATUS_NEVER, NEVER) && is(&board, 0U, 100000U, UP_STATUS_NEVER, NEVER));
  up_health_note(&board.health, 0U, UP_NOTHING, 5U);
  CHECK(is(&board, 0U, 5U, UP_STATUS_NEVER, NEVER));
  up_health_note(&board.health, 0U, UP_FRESH, 1000U);
  up_health_note(&board.health, 1U, UP_FRESH, 1000U);
  CHECK(is(&board, 0U, 1000U, UP_STATUS_GOOD, 0U) && is(&board, 0U, 1179U, UP_STATUS_GOOD, 179U));
  CHECK(is(&board, 0U, 1180U, UP_STATUS_STALE, 180U));
  up_health_note(&board.health, 0U, UP_NOTHING, 1180U);
  CHECK(is(&board, 0U, 1180U, UP_STATUS_STALE, 180U));
  /* A device that is read only on events is never stale. */
  CHECK(is(&board, 1U, 1000000U, UP_STATUS_GOOD, 999000U));
  for (i = 0U; i < sizeof failures / sizeof failures[0]; i++) {
    const uint32_t now_ms = 1100U + 100U * (uint32_t)i;
    up_health_note(&board.health, 0U, failures[i], now_ms);
    CHECK(is(&board, 0U, now_ms + 10U, UP_STATUS_FAILED, 110U));
    up_health_note(&board.health, 0U, UP_FRESH, now_ms);
    CHECK(is(&board, 0U, now_ms + 10U, UP_STATUS_GOOD, 10U));
  }
  up_health_note(&board.health, 0U, UP_INVALID, 1700U);
  CHECK(is(&board, 0U, 1710U, UP_STATUS_INVALID, 110U));
  up_health_note(&board.health, 2U, UP_TIMED_OUT, 1U);
  CHECK(is(&board, 2U, 2U, UP_STATUS_FAILED, NEVER));
  board.health.cycles_ms = NULL;
  up_health_note(&board.health, 0U, UP_FRESH, 2000U);
  CHECK(is(&board, 0U, 1000000U, UP_STATUS_GOOD, 998000U));
}

static void test_counts(void) {
  static const struct {
    up_result_t result;
    up_fault_t fault;
  } cases[] = {
      {UP_NOT_ACKNOWLEDGED, UP_FAULT_NOT_ACKNOWLEDGED}, {UP_BUS_ERROR, UP_FAULT_BUS},
      {UP_ARBITRATION_LOST, UP_FAULT_ARBITRATION},      {UP_TIMED_OUT, UP_FAULT_TIME_OUT},
      {UP_WRONG_CRC, UP_FAULT_CRC},                     {UP_INVALID, UP_FAULT_INVALID},
      {UP_WRONG_IDENTITY, UP_FAULT_INVALID},
  };
  board_t board;
  up_health_row_t row;
  size_t i, fault;
  uint32_t n;

  for (i = 0U; i < sizeof cases / sizeof cases[0]; i++) {
    set_up(&board);
    up_health_note(&board.health, 1U, cases[i].result, 0U);
    up_health_row(&board.health, 1U, 0U, &row);
    for (fault = 0U; fault < UP_FAULTS; fault++) {
      CHECK(row.counts[fault] == ((fault == (size_t)cases[i].fault) ? 1U : 0U));
    }
    for (n = 1U; n < 70000U; n++) {
      up_health_note(&board.health, 1U, cases[i].result, n);
      CHECK(board.devices[1].counts[cases[i].fault] == ((n < 65535U) ? n + 1U : 65535U));
    }
    up_health_note(&board.health, 1U, UP_FRESH, n);
    up_health_row(&board.health, 1U, n, &row);
    CHECK(row.counts[cases[i].fault] == 65535U && row.status == UP_STATUS_GOOD);
    /* The neighbours are not affected. */
    CHECK(is(&board, 0U, n, UP_STATUS_NEVER, NEVER) && is(&board, 2U, n, UP_STATUS_NEVER, NEVER));
  }
}

static void test_wrap(void) {
  board_t board;
  uint32_t n, now_ms;

  set_up(&board);
  up_health_note(&board.health, 0U, UP_FRESH, 0xFFFFFFF0U);
  CHECK(is(&board, 0U, 0x10U, UP_STATUS_GOOD, 0x20U) && is(&board, 0U, 0x100U, UP_STATUS_STALE, 0x110U));
  /* Another clock was read a little later. */
  up_health_tick(&board.health, 0xFFFFFFEFU);
  board.health.looked_at = 0U;
  CHECK(is(&board, 0U, 0xFFFFFFEFU, UP_STATUS_GOOD, 0U) && is(&board, 0U, 0x10U, UP_STATUS_GOOD, 0x20U));
  /* A device that stays silent does not appear recent again after 49 days. */
  for (n = 0U, now_ms = 0x100U; n < 100U; n++, now_ms += 0x06000000U) {
    up_health_tick(&board.health, now_ms);
    up_health_row_t row;
    up_health_row(&board.health, 0U, now_ms, &row);
    CHECK(row.status == UP_STATUS_STALE && row.age_ms >= 0x110U && row.age_ms != NEVER);
  }
  CHECK(is(&board, 0U, 0xFFFFFFF1U, UP_STATUS_STALE, 0xFFFFFFFEU) && is(&board, 1U, 1U, UP_STATUS_NEVER, NEVER));
  up_health_note(&board.health, 0U, UP_FRESH, now_ms);
  CHECK(is(&board, 0U, now_ms + 1U, UP_STATUS_GOOD, 1U));
}

static void test_silence(void) {
  up_silence_t silence;
  uint32_t now_ms, reported = 0U;

  up_silence_init(&silence, 500U, 0xFFFFFF00U);
  CHECK(!up_silence_step(&silence, 0xFFFFFF00U) && !up_silence_step(&silence, 0xF3U));
  CHECK(up_silence_step(&silence, 0xF4U) && !up_silence_step(&silence, 0xF5U) && silence.is_silent);
  up_silence_heard(&silence, 0x100U);
  CHECK(!silence.is_silent && !up_silence_step(&silence, 0x2F3U) && up_silence_step(&silence, 0x2F4U));
  /* Reported once for each silence, also when the clock wraps. */
  for (now_ms = 0x300U; now_ms < 0xFF000000U; now_ms += 0x00100000U) {
    reported += up_silence_step(&silence, now_ms) ? 1U : 0U;
  }
  CHECK(reported == 0U && !up_silence_step(&silence, 0x100U));
  for (now_ms = 0U; now_ms < 10000U; now_ms += 10U) {
    if (now_ms % 490U == 0U) {
      up_silence_heard(&silence, now_ms);
    }
    CHECK(!up_silence_step(&silence, now_ms));
  }
  up_silence_init(&silence, 0U, 0U);
  CHECK(!up_silence_step(&silence, 0x7FFFFFFFU) && !silence.is_silent);
}

void test_health(void) {
  test_status();
  test_counts();
  test_wrap();
  test_silence();
}
