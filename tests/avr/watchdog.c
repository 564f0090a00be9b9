/*
 * The watchdog: what the program writes and feeds in, interrupts and resets out.
 */
#include "board.h"

#define WDTCSR 0x60
#define RESETS 3U   /* WDE */
#define CHANGES_ON 4U /* WDCE */
#define HIGH_TIME 5U  /* WDP3 */
#define INTERRUPTS 6U /* WDIE */
#define FLAG 7U
#define LONGEST 9U
/* WDCE clears itself. */
#define CHANGE_CYCLES 4U
/* 2048 cycles of an oscillator of 128 kHz. */
#define SHORTEST_NS 16000000ULL

static request_t *request;

static uint64_t time_ns(void) {
  const unsigned time = (avr->data[WDTCSR] & 7U) | (is_set(WDTCSR, HIGH_TIME) ? 8U : 0U);

  return SHORTEST_NS << (time < LONGEST ? time : LONGEST);
}

uint64_t watchdog_ns(void) {
  return is_set(WDTCSR, RESETS) ? time_ns() : 0;
}

static avr_cycle_count_t on_time(avr_t *of, avr_cycle_count_t when, void *subject);

void watchdog_fed(void) {
  if (is_set(WDTCSR, RESETS) || is_set(WDTCSR, INTERRUPTS)) {
    alarm_at(avr->cycle + cycle_of(time_ns()), on_time, NULL);
  } else {
    alarm_off(on_time, NULL);
  }
}

static avr_cycle_count_t on_time(avr_t *of, avr_cycle_count_t when, void *subject) {
  (void)of;
  (void)when;
  (void)subject;
  if (!is_set(WDTCSR, INTERRUPTS)) {
    reset_soon(WATCHDOG_CAUSE);
    return 0;
  }
  /* Where it may reset as well, the interrupt is the last warning. */
  request->closes = is_set(WDTCSR, RESETS);
  request_raise(request);
  watchdog_fed();
  return 0;
}

static avr_cycle_count_t on_change_over(avr_t *of, avr_cycle_count_t when, void *subject) {
  (void)of;
  (void)when;
  (void)subject;
  put(WDTCSR, CHANGES_ON, false);
  return 0;
}

static void write_control(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  const bool may_change = is_set(WDTCSR, CHANGES_ON);
  const uint8_t before = of->data[address];
  const uint8_t times = (uint8_t)(bit(HIGH_TIME) | 7U);
  uint8_t after = (uint8_t)(value & (bit(INTERRUPTS) | bit(RESETS) | times));

  (void)subject;
  if (!may_change) {
    after = (uint8_t)((after & ~times) | (before & (times | bit(RESETS))));
  }
  after |= (uint8_t)(before & bit(FLAG) & ~(value & bit(FLAG)));
  /* ATmega328P, 10.9.2: WDE stays while the cause of the last reset is the watchdog. */
  if ((of->data[MCUSR] & WATCHDOG_CAUSE) != 0) {
    after |= bit(RESETS);
  }
  of->data[address] = after;
  if ((value & bit(CHANGES_ON)) != 0 && (value & bit(RESETS)) != 0) {
    put(WDTCSR, CHANGES_ON, true);
    alarm_at(of->cycle + CHANGE_CYCLES + 2, on_change_over, NULL);
  }
  if (((before ^ after) & (bit(RESETS) | bit(INTERRUPTS) | times)) != 0) {
    watchdog_fed();
  }
  requests_look();
}

void watchdog_reset(bool has_bitten) {
  if (has_bitten) {
    put(WDTCSR, RESETS, true);
    watchdog_fed();
  }
}

void watchdog_init(void) {
  request = request_new(part->watchdog_vector, WDTCSR, FLAG, WDTCSR, INTERRUPTS, false);
  avr_register_io_write(avr, WDTCSR, write_control, NULL);
}
