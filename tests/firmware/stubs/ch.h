/*
 * A stub of ChibiOS/RT's interface, written from our own use of it: see README.md. It compiles but does not run, and it
 * proves nothing about ChibiOS.
 */
#ifndef CH_H
#define CH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "chconf.h"

#if !defined(FALSE)
#define FALSE 0
#define TRUE 1
#endif

#if !defined(CH_CFG_ST_RESOLUTION)
#define CH_CFG_ST_RESOLUTION 32
#endif
#if !defined(CH_CFG_ST_FREQUENCY)
#define CH_CFG_ST_FREQUENCY 10000
#endif
#if !defined(CH_DBG_STACK_FILL_VALUE)
#define CH_DBG_STACK_FILL_VALUE 0x55
#endif
#define CORTEX_MODEL STUB_CORTEX
#if CORTEX_MODEL >= 3
#define PORT_SUPPORTS_RT TRUE
#else
#define PORT_SUPPORTS_RT FALSE
#endif

#if CH_CFG_ST_RESOLUTION == 32
typedef uint32_t systime_t;
#else
typedef uint16_t systime_t;
#endif
typedef uint32_t sysinterval_t;
typedef uint64_t systimestamp_t;
typedef uint32_t rtcnt_t;
typedef uint32_t tprio_t;
typedef int32_t msg_t;
typedef uint32_t eventmask_t;
typedef uint32_t syssts_t;

typedef struct stub_thread {
  const char *name;
} thread_t;
typedef thread_t *thread_reference_t;
typedef struct {
  thread_t *owner;
} mutex_t;
typedef struct {
  int count;
} semaphore_t, binary_semaphore_t;
typedef struct stub_timer {
  void *parameter;
} virtual_timer_t;
typedef void (*vtfunc_t)(virtual_timer_t *timer, void *parameter);
typedef void (*tfunc_t)(void *parameter);

#define MSG_OK ((msg_t)0)
#define MSG_TIMEOUT ((msg_t)-1)
#define MSG_RESET ((msg_t)-2)
#define NORMALPRIO ((tprio_t)128)
#define LOWPRIO ((tprio_t)2)
#define HIGHPRIO ((tprio_t)255)
#define TIME_IMMEDIATE ((sysinterval_t)0)
#define TIME_INFINITE ((sysinterval_t)-1)
#define TIME_MS2I(ms) ((sysinterval_t)((((uint64_t)(ms)) * CH_CFG_ST_FREQUENCY + 999U) / 1000U))
#define TIME_US2I(us) ((sysinterval_t)((((uint64_t)(us)) * CH_CFG_ST_FREQUENCY + 999999U) / 1000000U))
#define TIME_S2I(s) ((sysinterval_t)((s) * CH_CFG_ST_FREQUENCY))
#define TIME_I2MS(i) ((uint32_t)(((uint64_t)(i)) * 1000U / CH_CFG_ST_FREQUENCY))
#define TIME_I2US(i) ((uint32_t)(((uint64_t)(i)) * 1000000U / CH_CFG_ST_FREQUENCY))

#define THD_WORKING_AREA_SIZE(bytes) ((size_t)(bytes) + 256U)
#define THD_WORKING_AREA(name, bytes) uint64_t name[THD_WORKING_AREA_SIZE(bytes) / 8U]
#define THD_FUNCTION(name, parameter) void name(void *parameter)
#define MUTEX_DECL(name) mutex_t name = {NULL}

void chSysInit(void);
void chSysHalt(const char *why);
void chSysLock(void);
void chSysUnlock(void);
void chSysLockFromISR(void);
void chSysUnlockFromISR(void);
syssts_t chSysGetStatusAndLockX(void);
void chSysRestoreStatusX(syssts_t status);
rtcnt_t chSysGetRealtimeCounterX(void);
void chSysPolledDelayX(rtcnt_t cycles);
#define MS2RTC(hz, ms) ((rtcnt_t)((hz) / 1000U * (ms)))
#define US2RTC(hz, us) ((rtcnt_t)((hz) / 1000000U * (us)))
systime_t chVTGetSystemTime(void);
systime_t chVTGetSystemTimeX(void);
systimestamp_t chVTGetTimeStamp(void);
systimestamp_t chVTGetTimeStampI(void);
void chVTObjectInit(virtual_timer_t *timer);
void chVTSet(virtual_timer_t *timer, sysinterval_t delay, vtfunc_t function, void *parameter);
void chVTSetContinuous(virtual_timer_t *timer, sysinterval_t delay, vtfunc_t function, void *parameter);
void chVTReset(virtual_timer_t *timer);
systime_t chTimeAddX(systime_t time, sysinterval_t interval);
sysinterval_t chTimeDiffX(systime_t start, systime_t end);
void chThdSleepMilliseconds(uint32_t ms);
void chThdSleepMicroseconds(uint32_t us);
void chThdSleepUntil(systime_t time);
systime_t chThdSleepUntilWindowed(systime_t previous, systime_t next);
void chThdSleep(sysinterval_t time);
void chThdYield(void);
static inline sysinterval_t chVTTimeElapsedSinceX(systime_t start) {
  return chTimeDiffX(start, chVTGetSystemTimeX());
}
static inline void chBSemObjectInit(binary_semaphore_t *semaphore, bool is_taken) {
  semaphore->count = is_taken ? 0 : 1;
}
static inline void chBSemSignal(binary_semaphore_t *semaphore) {
  semaphore->count = 1;
}
/* Nobody else runs meanwhile. */
static inline msg_t chBSemWaitTimeout(binary_semaphore_t *semaphore, sysinterval_t timeout) {
  if (semaphore->count == 0) {
    chThdSleep(timeout);
    return (msg_t)-1;
  }
  semaphore->count = 0;
  return 0;
}
thread_t *chThdCreateStatic(void *area, size_t bytes, tprio_t prio, tfunc_t function, void *parameter);
thread_t *chThdCreateFromHeap(void *heap, size_t bytes, const char *name, tprio_t prio, tfunc_t function,
                              void *parameter);
thread_t *chThdGetSelfX(void);
bool chThdTerminatedX(thread_t *thread);
msg_t chThdWait(thread_t *thread);
void chThdExit(msg_t result);
msg_t chThdSuspendTimeoutS(thread_reference_t *reference, sysinterval_t timeout);
void chThdResumeI(thread_reference_t *reference, msg_t result);
tprio_t chThdSetPriority(tprio_t prio);
void chRegSetThreadName(const char *name);
void chMtxObjectInit(mutex_t *mutex);
void chMtxLock(mutex_t *mutex);
void chMtxUnlock(mutex_t *mutex);

#endif
