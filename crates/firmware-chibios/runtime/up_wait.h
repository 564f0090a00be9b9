/* Waiting for less than a thread can sleep. */
#ifndef UP_WAIT_H
#define UP_WAIT_H

#include <stdint.h>

/* Keeps the processor for at least so long: up to a second. Being preempted makes it longer, never shorter. */
void up_wait_us(uint32_t us);

#endif
