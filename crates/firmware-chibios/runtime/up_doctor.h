/*
 * The power-on self test and the output of `doctor`: undriven inputs, chips with a wrong identity, addresses that
 * answer but should not, counters without an edge.
 */
#ifndef UP_DOCTOR_H
#define UP_DOCTOR_H

#include "up_rt.h"

/* Checks which inputs follow the pad's own resistors both ways, which means that nothing drives them. Called before
 * the pads are set up; takes a fifth of a millisecond for each. */
void up_doctor_look_at_inputs(void);

/* Reports one line for each problem; `say` gets them without a line end. Returns their number. Uses the buses for a
 * moment. From the shell's thread. */
size_t up_doctor_run(void (*say)(void *context, const char *subject, const char *verdict), void *context);

#endif
