/*
 * Whether the board is alive: why it started, whether each thread keeps its cycles, how busy it is, how much of the
 * stacks was ever used.
 *
 * The watchdog resets the MCU if the reporter, or any thread, has completed no cycle for too long. Which one it was is
 * kept across the reset, in memory that the start does not clear.
 */
#ifndef UP_LIFE_H
#define UP_LIFE_H

#include <stddef.h>
#include <stdint.h>

#include "up_health.h"

/* Determines why the board started; must be called first. */
void up_life_init(void);

/* Starts the watchdog. From then on up_life_cycle() must be called at least once a second. */
void up_life_start(void);

/* A thread has completed a cycle; `task` is its index among the tasks of the application. */
void up_life_beat(size_t task);

/* From the reporter, in each of its cycles: feeds the watchdog while all threads are alive. */
void up_life_cycle(void);

uint8_t up_reset_cause(void);

/* The identifier of the first device of the thread that hung; 0 for none. */
uint8_t up_reset_device(void);

/* The kernel's reason for stopping itself; NULL for none. Valid until the next reset. */
const char *up_reset_reason(void);

/* The most of the processor that threads used in any second, in percent; 255 if unknown. Interrupts that came while
 * no thread ran are not included. */
uint8_t up_load_percent(void);

/* The least number of bytes that any thread of the application has never used of its stack. */
uint16_t up_stack_left(void);

/* The same for one stack, whose lowest byte is at `base`. */
size_t up_stack_left_of(const void *base, size_t bytes);

/* Hooks of the kernel. */
void up_on_halt(const char *why);
void up_on_idle_enter(void);
void up_on_idle_leave(void);
void up_on_switch(const void *next);

#endif
