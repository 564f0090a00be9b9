/* Pulses on separate lines that make a device measure (the trigger of an ultrasonic ranger). */
#include "up_pulse.h"
#include "up_rt.h"
#include "up_wait.h"

/* From this length on, the thread sleeps during a pulse instead of busy-waiting. */
#define SLEEP_US 1000U

static void wait_us(uint32_t pulse_us) {
  if (pulse_us >= SLEEP_US) {
    chThdSleep((pulse_us + UP_STEP_US - 1U) / UP_STEP_US);
  } else {
    up_wait_us(pulse_us);
  }
}

void up_pulse_cycle(const void *work) {
  const up_pulse_t *pulse = work;
  uint8_t i;

  for (i = 0U; i < pulse->lines_count; i++) {
    palSetLine(pulse->lines[i].line);
    wait_us(pulse->pulse_us);
    palClearLine(pulse->lines[i].line);
    if (pulse->lines[i].apart_ms > 0U) {
      chThdSleep(UP_MS2I(pulse->lines[i].apart_ms));
    }
  }
}
