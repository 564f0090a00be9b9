#include "up_life.h"

#include <Arduino.h>
#include <avr/wdt.h>

#include "up_rt.h"
#include "sense_model.h"


/* What is written over the free memory at the start. */
#define UNUSED 0xC5U
/* Where the field of a task stands when no task runs. */
#define NO_FIELD 0xFFFFU
#define LOAD_CYCLE_MS 1000U

extern uint8_t __heap_start;

/* Neither cleared nor set when the program starts: the flags of the last reset, those that the boot loader has taken
 * away and handed over in r2, and what ran before it. */
static uint8_t flags __attribute__((section(".noinit")));
static uint8_t handed_over __attribute__((section(".noinit")));
static uint16_t running __attribute__((section(".noinit")));

static uint16_t ran; /* what ran before the reset */
static uint32_t worked_us;
static uint32_t entered_us;
static uint32_t load_from_ms;
static uint8_t load_percent;

/* Before the C library starts: a watchdog that goes on after its reset would bite again. */
__attribute__((naked, used, section(".init0"))) static void keep_r2(void) {
  __asm__ volatile("sts %0, r2" : "=m"(handed_over));
}

__attribute__((naked, used, section(".init3"))) static void keep_flags(void) {
  uint8_t *at;

  flags = MCUSR;
  MCUSR = 0U;
  wdt_disable();
  for (at = &__heap_start; at < (uint8_t *)SP; at++) {
    *at = UNUSED;
  }
}

static up_cause_t cause(void) {
  const uint8_t all = (flags != 0U) ? flags : handed_over;

  if ((all & _BV(WDRF)) != 0U) {
    return UP_CAUSE_WATCHDOG;
  }
  if ((all & (_BV(PORF) | _BV(BORF))) != 0U) {
    return UP_CAUSE_POWER;
  }
  return ((all & _BV(EXTRF)) != 0U) ? UP_CAUSE_PIN : UP_CAUSE_UNKNOWN;
}

void up_life_start(void) {
  ran = (cause() == UP_CAUSE_WATCHDOG) ? running : NO_FIELD;
  running = NO_FIELD;
#if UP_WATCHDOG
  wdt_enable(WDTO_2S);
#endif
}

void up_life_enter(uint16_t field) {
  running = field;
  entered_us = micros();
}

void up_life_leave(void) {
  worked_us += micros() - entered_us;
  running = NO_FIELD;
}

void up_life_turn(void) {
  const uint32_t now_ms = up_now_ms();

#if UP_WATCHDOG
  wdt_reset();
#endif
  if (now_ms - load_from_ms >= LOAD_CYCLE_MS) {
    const uint32_t percent = worked_us / (10U * (now_ms - load_from_ms));

    load_percent = (percent > load_percent) ? (uint8_t)((percent > 100U) ? 100U : percent) : load_percent;
    load_from_ms = now_ms;
    worked_us = 0U;
  }
}

static uint16_t stack_left(void) {
  const uint8_t *at = &__heap_start;

  while (at < (const uint8_t *)SP && *at == UNUSED) {
    at++;
  }
  return (uint16_t)(at - &__heap_start);
}

void up_life_describe(up_health_board_t *board) {
  board->reset_cause = (uint8_t)cause();
  board->reset_device = (ran < UP_FIELDS_COUNT) ? sense_schema.fields[ran].id : 0U;
  board->load_percent = load_percent;
  board->stack_left_bytes = stack_left();
}
