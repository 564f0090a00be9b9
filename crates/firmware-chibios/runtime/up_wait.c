/* Waiting for less than a thread can sleep: by the core's cycle counter, or by instructions where it has none. */
#include "up_wait.h"

#include "ch.h"
#include "hal.h"

#include "up_conf.h"

#if PORT_SUPPORTS_RT == TRUE

void up_wait_us(uint32_t us) {
  chSysPolledDelayX(US2RTC(UP_CORE_HZ, us));
}

#else

/* Clocks per iteration of the loop on the fastest core: a subtraction and a taken branch. */
#define TURN_CLOCKS 3U

void up_wait_us(uint32_t us) {
  /* One more, because the first iteration may be short; no division while it waits. */
  uint32_t turns = us * ((UP_CORE_HZ + 999999U) / 1000000U) / TURN_CLOCKS + 1U;

  __asm volatile(".syntax unified\n"
                 "1: subs %0, %0, #1\n"
                 "   bne 1b"
                 : "+l"(turns)
                 :
                 : "cc");
}

#endif
