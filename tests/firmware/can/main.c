/*
 * Bit times of CAN buses, as the runtime computes them. Input is a line "clock bitrate"; output is "prescaler before
 * behind jump", with the values in the register, or "halt" if the rate is refused.
 */
#include <setjmp.h>
#include <stdio.h>

#include "up_can.h"

static jmp_buf halted;
static CANDriver bus_driver;
static up_can_state_t state;

void chSysHalt(const char *why) {
  (void)why;
  longjmp(halted, 1);
}

msg_t canStart(CANDriver *driver, const CANConfig *config) {
  (void)driver;
#if defined(STUB_FDCAN)
  const uint32_t time = config->NBTP;

  printf("%u %u %u %u\n", ((time >> 16) & 0x1FFU) + 1U, ((time >> 8) & 0xFFU) + 1U, (time & 0x7FU) + 1U,
         (time >> 25) + 1U);
#else
  const uint32_t time = config->btr;

  printf("%u %u %u %u\n", (time & 0x3FFU) + 1U, ((time >> 16) & 15U) + 1U, ((time >> 20) & 7U) + 1U,
         ((time >> 24) & 3U) + 1U);
#endif
  return MSG_OK;
}

int main(void) {
  unsigned clock_hz, bitrate_hz;

  while (scanf("%u %u", &clock_hz, &bitrate_hz) == 2) {
    const up_can_t bus = {
        .driver = &bus_driver, .clock_hz = clock_hz, .bitrate_hz = bitrate_hz, .state = &state};

    if (setjmp(halted) == 0) {
      up_can_start(&bus);
    } else {
      printf("halt\n");
    }
  }
  return 0;
}
