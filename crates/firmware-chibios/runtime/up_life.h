/*
 * Whether the board lives: why it started, whether each thread makes its cycles, how busy it is, how much of the stacks
 * was ever used.
 *
 * The watchdog resets the MCU when the reporter, or any thread, has made no cycle for too long. Whose fault it was is
 * kept over the reset, in memory that the start does not clear.
 */
#ifndef UP_LIFE_H
#define UP_LIFE_H

#include <stddef.h>
#include <stdint.h>

#include "up_health.h"

/* Looks at why the board started; first of all. */
void up_life_init(void);

/* Starts the watchdog. From then on up_life_cycle() is called at least once a second. */
void up_life_start(void);

/* A thread has made a cycle: `task` counts the tasks of the application. */
void up_life_beat(size_t task);

/* From the reporter, in each of its cycles: feeds the watchdog while all threads live. */
void up_life_cycle(void);

uint8_t up_reset_cause(void);

/* The identifier of the first device of the thread that hung; 0 for none. */
uint8_t up_reset_device(void);

/* What the kernel said when it stopped itself; NULL for nothing. Valid until the next reset. */
const char *up_reset_reason(void);

/* Most that threads had of the processor in any second, in percent; 255 where that is not known. Interrupts that came
 * while nothing ran are not in it. */
uint8_t up_load_percent(void);

/* Bytes that no thread of the application has ever used of its stack, the least of all. */
uint16_t up_stack_left(void);

/* The same of one stack, whose lowest byte is at `base`. */
size_t up_stack_left_of(const void *base, size_t bytes);

/* Hooks of the kernel. */
void up_on_halt(const char *why);
void up_on_idle_enter(void);
void up_on_idle_leave(void);
void up_on_switch(const void *next);

#endif
