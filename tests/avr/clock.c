/*
 * Time, resets and the loop that runs the processor.
 *
 * simavr's processor and its list of alarms are used as they are. Its own loop sleeps in real time, and gives up where
 * a program sleeps with interrupts off; a board does neither.
 */
#include "board.h"

#include "talk.h"

#include <simavr/avr_watchdog.h>
#include <simavr/sim_core.h>
#include <string.h>

#define SECOND_NS 1000000000ULL
#define SMCR 0x53
#define SLEEP_ENABLE 0U
/* simavr stops running ahead at the next alarm, and there is always one. */
#define AHEAD_CYCLES 1000000000ULL

avr_t *avr;
const part_t *part;

static uint64_t slept;
static bool is_over;
static bool is_off;
static bool is_told;
static uint8_t wanted_reset;

uint64_t ns_of(uint64_t cycle) {
  const uint64_t hz = avr->frequency;

  return cycle / hz * SECOND_NS + cycle % hz * SECOND_NS / hz;
}

uint64_t cycle_of(uint64_t ns) {
  const uint64_t hz = avr->frequency;

  return ns / SECOND_NS * hz + (ns % SECOND_NS * hz + SECOND_NS - 1) / SECOND_NS;
}

void alarm_at(uint64_t cycle, avr_cycle_timer_t alarm, void *subject) {
  avr_cycle_timer_register(avr, cycle > avr->cycle ? cycle - avr->cycle : 0, alarm, subject);
}

void alarm_off(avr_cycle_timer_t alarm, void *subject) {
  avr_cycle_timer_cancel(avr, alarm, subject);
}

uint64_t cycles_asleep(void) {
  return slept;
}

bool has_power(void) {
  return !is_off;
}

static void write_causes(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  /* Causes are only ever cleared. */
  of->data[address] &= value;
}

static int on_control(avr_io_t *io, uint32_t control, void *parameter) {
  (void)io;
  (void)parameter;
  if (control != AVR_IOCTL_WATCHDOG_RESET) {
    return -1;
  }
  watchdog_fed();
  return 0;
}

/* What simavr calls on `wdr`. */
static avr_io_t control = {.kind = "board", .ioctl = on_control};

static void reset(uint8_t cause) {
  const uint8_t before = avr->data[MCUSR];

  avr_reset(avr);
  avr->run_cycle_limit = AHEAD_CYCLES;
  avr->data[MCUSR] = (uint8_t)(cause == POWER_CAUSE ? cause : before | cause);
  watchdog_reset(cause == WATCHDOG_CAUSE);
}

/* simavr calls this as a part of its reset, which has cleared the registers and all alarms. */
static void reset_units(avr_t *of) {
  (void)of;
  pins_reset();
  timers_reset();
  fast_timer_reset();
  adc_reset();
  spi_reset();
  twi_reset();
  uarts_reset();
  usb_reset();
}

static void init_units(avr_t *of) {
  avr = of;
  avr_register_io(avr, &control);
  avr_register_io_write(avr, MCUSR, write_causes, NULL);
  pins_init();
  timers_init();
  fast_timer_init();
  adc_init();
  eeprom_init();
  spi_init();
  twi_init();
  uarts_init();
  usb_init();
  watchdog_init();
}

void board_init(void) {
  avr->init = init_units;
  avr->reset = reset_units;
  avr_init(avr);
  reset(POWER_CAUSE);
}

void reset_soon(uint8_t cause) {
  wanted_reset = cause;
}

void power(bool is_on) {
  if (is_on == !is_off) {
    return;
  }
  is_off = !is_on;
  is_told = false;
  reset(POWER_CAUSE);
  if (is_on) {
    tell_reset(POWER_CAUSE, avr->cycle);
  }
}

static avr_cycle_count_t on_end(avr_t *of, avr_cycle_count_t when, void *subject) {
  (void)of;
  (void)when;
  (void)subject;
  is_over = true;
  return 0;
}

static bool is_broken(void) {
  if (avr->state == cpu_Crashed && !is_told) {
    is_told = true;
    tell_crash(avr->pc);
  }
  return avr->state == cpu_Crashed;
}

/* One turn: as many instructions as fit before the next alarm, or sleep until then. */
static void turn(uint64_t to_alarm) {
  if (avr->state == cpu_Running) {
    avr->pc = avr_run_one(avr);
    if (avr->state == cpu_Sleeping && !is_set(SMCR, SLEEP_ENABLE)) {
      avr->state = cpu_Running;
    }
    if (avr->state == cpu_Sleeping) {
      requests_look();
    }
  } else {
    avr->cycle += to_alarm;
    slept += to_alarm;
  }
}

void run_until_ns(uint64_t until_ns) {
  const uint64_t until = cycle_of(until_ns);

  if (is_off && avr->cycle < until) {
    avr->cycle = until;
  }
  is_over = is_off || avr->cycle >= until;
  if (!is_over) {
    alarm_at(until, on_end, NULL);
  }
  while (!is_over && !is_broken()) {
    const uint64_t to_alarm = avr_cycle_timer_process(avr);

    if (wanted_reset != 0) {
      const uint8_t cause = wanted_reset;

      wanted_reset = 0;
      reset(cause);
      tell_reset(cause, avr->cycle);
      alarm_at(until, on_end, NULL);
      continue;
    }
    if (!is_over) {
      requests_serve();
      turn(to_alarm);
    }
  }
  if (avr->cycle < until) {
    avr->cycle = until;
  }
}
