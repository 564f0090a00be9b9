/* Waiting for less than a thread can sleep. */
#ifndef UP_WAIT_H
#define UP_WAIT_H

#include <stdint.h>

/* Busy-waits for at least this time, up to a second. Preemption makes it longer, never shorter. */
void up_wait_us(uint32_t us);

#endif
