/*
 * The power-on self test and what `doctor` prints: inputs that nobody drives, chips that are not the ones they should
 * be, addresses that answer and should not, counters without an edge.
 */
#ifndef UP_DOCTOR_H
#define UP_DOCTOR_H

#include "up_rt.h"

/* Looks which inputs follow the pad's own resistors both ways, so that nobody drives them. Before the pads are set up;
 * takes a fifth of a millisecond for each. */
void up_doctor_look_at_inputs(void);

/* One line for each thing that is wrong; `say` gets them without a line end. Returns how many there are. Takes the
 * buses for a moment. From the shell's thread. */
size_t up_doctor_run(void (*say)(void *context, const char *subject, const char *verdict), void *context);

#endif
