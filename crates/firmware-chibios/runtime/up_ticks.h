/*
 * A counter of the core's clocks: the cycle counter, or the system timer on a core that has none (Cortex-M0).
 */
#ifndef UP_TICKS_H
#define UP_TICKS_H

#include "ch.h"
#include "hal.h"

#include "up_conf.h"

/* Ticks of whole microseconds. */
#define UP_TICKS_OF_US(us) ((us) * (UP_CORE_HZ / 1000000U))

#if PORT_SUPPORTS_RT == TRUE && !defined(UP_TICKS_OF_SYSTEM_TIMER)

/* Whether also a time in which other threads ran is right: it lasts for seconds. */
static inline bool up_ticks_are_long(void) {
  return true;
}

static inline void up_ticks_start(void) {
}

static inline uint32_t up_ticks(void) {
  return (uint32_t)chSysGetRealtimeCounterX();
}

static inline uint32_t up_ticks_between(uint32_t begin, uint32_t end) {
  return end - begin;
}

#else

/* Where it is the kernel's own it wraps each millisecond. */
static inline bool up_ticks_are_long(void) {
  return SysTick->LOAD == SysTick_LOAD_RELOAD_Msk;
}

/* Unless the kernel uses it already, it counts 24 bits without interrupting. */
static inline void up_ticks_start(void) {
  if ((SysTick->CTRL & SysTick_CTRL_ENABLE_Msk) == 0U) {
    SysTick->LOAD = SysTick_LOAD_RELOAD_Msk;
    SysTick->VAL = 0U;
    SysTick->CTRL = SysTick_CTRL_CLKSOURCE_Msk | SysTick_CTRL_ENABLE_Msk;
  }
}

/* It counts down. */
static inline uint32_t up_ticks(void) {
  return SysTick->LOAD - SysTick->VAL;
}

static inline uint32_t up_ticks_between(uint32_t begin, uint32_t end) {
  return (end >= begin) ? end - begin : end + SysTick->LOAD + 1U - begin;
}

#endif

static inline uint32_t up_ticks_since(uint32_t begin) {
  return up_ticks_between(begin, up_ticks());
}

#endif
