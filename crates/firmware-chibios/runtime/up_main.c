/* The start of the application, its threads, and the reporter. This file calls all other parts, and none calls it. */
#include "up_rt.h"

#include "up_doctor.h"
#include "up_life.h"
#include "up_link.h"
#include "up_shell.h"

/* The common time origin of all threads, so that those of a group keep apart. */
static systime_t start;

__attribute__((weak)) void up_user_init(void) {
}

__attribute__((weak)) void up_user_received(size_t field) {
  (void)field;
}

/* A fixed rate: a late cycle does not shift the following ones, and missed ones are skipped, so that threads that
 * keep apart do so for good. */
static void sleep_cycle(systime_t *previous, sysinterval_t cycle) {
  const systime_t next = chTimeAddX(*previous, cycle);
  sysinterval_t late;

  (void)chThdSleepUntilWindowed(*previous, next);
  late = chTimeDiffX(next, chVTGetSystemTime());
  *previous = chTimeAddX(next, late - late % cycle);
}

static THD_FUNCTION(run_task, argument) {
  const up_task_t *task = argument;
  systime_t previous = start;

  chRegSetThreadName(task->name);
  if (task->start_ms > 0U) {
    const systime_t first = chTimeAddX(start, UP_MS2I(task->start_ms));

    (void)chThdSleepUntilWindowed(start, first);
    previous = first;
  }
  for (;;) {
    task->cycle(task->work);
    up_life_beat((size_t)(task - up_config.tasks));
    sleep_cycle(&previous, UP_MS2I(task->delay_ms));
  }
}

static void start_drivers(void) {
  size_t i;

  up_doctor_look_at_inputs();
  for (i = 0U; i < up_config.pads_count; i++) {
    palWriteLine(up_config.pads[i].line, up_config.pads[i].level);
    palSetLineMode(up_config.pads[i].line, up_config.pads[i].mode);
  }
  sense_start();
}

static void start_tasks(void) {
  size_t i;

  start = chVTGetSystemTime();
  for (i = 0U; i < up_config.tasks_count; i++) {
    const up_task_t *task = &up_config.tasks[i];
    /* The argument is a const table, but the kernel's signature has only void pointers. */
    (void)chThdCreateStatic(task->stack, task->stack_bytes, (tprio_t)((int)NORMALPRIO + task->prio), run_task,
                            (void *)(uintptr_t)task);
  }
}

static void report_cycle(void) {
  up_io_lock();
  sense_poll();
  up_io_unlock();
  if (up_shell_cycle()) {
    up_link_pause();
  } else {
    up_link_cycle();
  }
}

int main(void) {
  systime_t previous;

  halInit();
  chSysInit();
  up_life_init();
  up_store_start();
  up_user_init();
  start_drivers();
  start_tasks();
  up_link_start();
  up_shell_start();
  up_life_start();
  previous = chVTGetSystemTime();
  for (;;) {
    report_cycle();
    up_life_cycle();
    sleep_cycle(&previous, UP_MS2I(up_config.report_ms));
  }
}
