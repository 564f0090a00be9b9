/* Reset cause, watchdog, load, stacks. */
#include "up_life.h"

#include <string.h>

#include "up_mcu.h"
#include "up_rt.h"

/* How late a thread may be, beyond one more cycle. */
#define LATE_MS 1000U
/* 4 s at the nominal 32 kHz of the watchdog's oscillator; it may be off by half on some MCUs. */
#define WATCHDOG_PRESCALER 4U /* 64 */
#define WATCHDOG_RELOAD 2000U
#define LOAD_WINDOW_MS 1000U
#define RECORD_MAGIC 0x53454E53U
#define REASON_BYTES 32U

/* Processor clocks if the core counts them, otherwise kernel ticks. */
#if PORT_SUPPORTS_RT == TRUE
#define UP_LOAD_CLOCK() ((uint32_t)chSysGetRealtimeCounterX())
#elif CH_CFG_ST_RESOLUTION == 32
#define UP_LOAD_CLOCK() ((uint32_t)chVTGetSystemTimeX())
#else
#define UP_LOAD_CLOCK() 0U
#endif
#define LOAD_UNKNOWN 255U

/* The record for the next start; the start-up code leaves it unchanged. */
typedef struct {
  uint32_t magic;
  uint32_t device;
  const void *thread; /* the running thread */
  char reason[REASON_BYTES];
} record_t;

static record_t record __attribute__((section(".ram0.sense_record"), aligned(32)));
static uint8_t cause;
static uint8_t device;
static bool has_halted;
static char reason[REASON_BYTES];
static uint32_t beats_ms[UP_TASKS_COUNT + 1U];
static uint32_t window_ms;
static uint32_t idle_before;
static uint32_t window_start;
static uint8_t load_percent = LOAD_UNKNOWN;
static volatile uint32_t idle_ticks;
static uint32_t idle_since;
static volatile bool is_idle;
static uint32_t interrupted_at;
extern uint8_t __main_thread_stack_base__[];
extern uint8_t __main_thread_stack_end__[];

/* ---- the record ---- */

/* Caches may hold the written data until a reset discards them. */
static void keep(void) {
  record.magic = RECORD_MAGIC;
  cacheBufferFlush(&record, sizeof record);
}

/* The kernel has found itself damaged: it is safer to restart, with all pads as after a reset, than to stop with
 * motors on. Under a debugger it stops, as usual. */
void up_on_halt(const char *why) {
  record.device = 0U;
  strncpy(record.reason, why, sizeof record.reason - 1U);
  record.reason[sizeof record.reason - 1U] = '\0';
  keep();
#if defined(CoreDebug_DHCSR_C_DEBUGEN_Msk) && (CORTEX_MODEL >= 3)
  if ((CoreDebug->DHCSR & CoreDebug_DHCSR_C_DEBUGEN_Msk) != 0U) {
    return;
  }
#endif
  NVIC_SystemReset();
}

/* The first device of a task, given the thread, which is in its working area; 0 for threads of the kernel. */
static uint8_t device_of(const void *thread) {
  size_t i;

  for (i = 0U; i < up_config.tasks_count; i++) {
    if ((uintptr_t)thread - (uintptr_t)up_config.tasks[i].stack < up_config.tasks[i].stack_bytes) {
      return up_config.tasks[i].device;
    }
  }
  return 0U;
}

static uint8_t cause_of(uint32_t flags) {
  if ((flags & UP_RESET_WATCHDOG) != 0U) {
    return UP_CAUSE_WATCHDOG;
  }
  if ((flags & UP_RESET_WINDOW_WATCHDOG) != 0U) {
    return UP_CAUSE_WINDOW_WATCHDOG;
  }
  if ((flags & UP_RESET_LOW_POWER) != 0U) {
    return UP_CAUSE_LOW_POWER;
  }
  if ((flags & UP_RESET_POWER) != 0U) {
    return UP_CAUSE_POWER;
  }
  if ((flags & UP_RESET_SOFTWARE) != 0U) {
    return (reason[0] != '\0') ? (uint8_t)UP_CAUSE_HALT : (uint8_t)UP_CAUSE_SOFTWARE;
  }
  return ((flags & UP_RESET_PIN) != 0U) ? (uint8_t)UP_CAUSE_PIN : (uint8_t)UP_CAUSE_UNKNOWN;
}

void up_life_init(void) {
  const uint32_t flags = UP_RESET_REGISTER;

  UP_RESET_REGISTER |= UP_RESET_CLEAR;
  if (record.magic == RECORD_MAGIC) {
    record.reason[sizeof record.reason - 1U] = '\0';
    memcpy(reason, record.reason, sizeof reason);
    device = (uint8_t)record.device;
  } else {
    /* The reporter could not note the device: a thread that never waits kept the processor. */
    device = device_of(record.thread);
  }
  cause = cause_of(flags);
  if (cause != (uint8_t)UP_CAUSE_WATCHDOG) {
    device = 0U;
  }
  has_halted = cause == (uint8_t)UP_CAUSE_HALT;
  memset(&record, 0, sizeof record);
  cacheBufferFlush(&record, sizeof record);
}

uint8_t up_reset_cause(void) {
  return cause;
}

uint8_t up_reset_device(void) {
  return device;
}

const char *up_reset_reason(void) {
  return has_halted ? reason : NULL;
}

/* ---- the watchdog ---- */

void up_life_start(void) {
  static const WDGConfig config = {
      .pr = WATCHDOG_PRESCALER,
      .rlr = WATCHDOG_RELOAD,
#if STM32_IWDG_IS_WINDOWED
      .winr = STM32_IWDG_WIN_DISABLED,
#endif
  };
  const uint32_t now_ms = up_now_ms();
  size_t i;

  for (i = 0U; i < up_config.tasks_count; i++) {
    beats_ms[i] = now_ms + up_config.tasks[i].start_ms;
  }
  window_ms = now_ms;
  window_start = UP_LOAD_CLOCK();
  UP_FREEZE_WATCHDOG();
  (void)wdgStart(&WDGD1, &config);
}

void up_life_beat(size_t task) {
  beats_ms[task] = up_now_ms();
}

/* The first task that has completed no cycle for too long; the number of tasks if all are alive. */
static size_t hanging(uint32_t now_ms) {
  size_t i;

  for (i = 0U; i < up_config.tasks_count; i++) {
    const int32_t age_ms = (int32_t)(now_ms - beats_ms[i]);

    if (age_ms > (int32_t)(2U * up_config.tasks[i].delay_ms + LATE_MS)) {
      break;
    }
  }
  return i;
}

static void measure_load(uint32_t now_ms) {
  const uint32_t clock = UP_LOAD_CLOCK();
  const uint32_t all = clock - window_start;
  const uint32_t idle = idle_ticks - idle_before;
  uint32_t percent;

  if (now_ms - window_ms < LOAD_WINDOW_MS || all < 100U) {
    return;
  }
  percent = (idle >= all) ? 0U : (all - idle) / (all / 100U);
  percent = (percent > 100U) ? 100U : percent;
  if (load_percent == LOAD_UNKNOWN || percent > load_percent) {
    load_percent = (uint8_t)percent;
  }
  window_ms = now_ms;
  window_start = clock;
  idle_before = idle_ticks;
}

void up_life_cycle(void) {
  const uint32_t now_ms = up_now_ms();
  const size_t task = hanging(now_ms);

  measure_load(now_ms);
  if (task == up_config.tasks_count) {
    wdgReset(&WDGD1);
  } else if (record.magic != RECORD_MAGIC) {
    record.device = up_config.tasks[task].device;
    keep();
  }
}

/* The kernel calls this with the thread that runs next. */
void up_on_switch(const void *next) {
  record.thread = next;
  cacheBufferFlush(&record.thread, sizeof record.thread);
}

/* ---- load: the kernel reports when no thread runs ---- */

void up_on_idle_enter(void) {
  idle_since = UP_LOAD_CLOCK();
  is_idle = true;
}

void up_on_idle_leave(void) {
  is_idle = false;
  idle_ticks += UP_LOAD_CLOCK() - idle_since;
}

/* What interrupts do while no thread runs is work, too. The sum is a little wrong where one interrupts another. */
void up_on_interrupt_enter(void) {
  if (is_idle) {
    interrupted_at = UP_LOAD_CLOCK();
  }
}

void up_on_interrupt_leave(void) {
  if (is_idle) {
    idle_since += UP_LOAD_CLOCK() - interrupted_at;
  }
}

uint8_t up_load_percent(void) {
  return load_percent;
}

/* ---- stacks: bytes that the kernel filled at the start and nothing has overwritten since ---- */

size_t up_stack_left_of(const void *base, size_t bytes) {
  const uint8_t *at = base;
  size_t left = 0U;

  while (left < bytes && at[left] == (uint8_t)CH_DBG_STACK_FILL_VALUE) {
    left++;
  }
  return left;
}

uint16_t up_stack_left(void) {
  const size_t main_bytes = (size_t)(__main_thread_stack_end__ - __main_thread_stack_base__);
  size_t least = up_stack_left_of(__main_thread_stack_base__, main_bytes);
  size_t i;

  for (i = 0U; i < up_config.tasks_count; i++) {
    const size_t left = up_stack_left_of(up_config.tasks[i].stack, up_config.tasks[i].stack_bytes);

    least = (left < least) ? left : least;
  }
  return (least > 65534U) ? 65534U : (uint16_t)least;
}
