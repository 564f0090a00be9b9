/*
 * The development shell or frames: who uses the channel.
 *
 * A development build starts with the shell. Frames are turned on when the user's button is held at the start, by the
 * command `stream`, or when a host requests a hello, so that the generated host application works without a hand on the
 * board. While frames are on, a `q` between two frames brings the shell back. A production build (UP_SHELL FALSE) has
 * only frames.
 */
#ifndef UP_SHELL_H
#define UP_SHELL_H

#include "up_rt.h"

void up_shell_start(void);

/* Called by the reporter in each cycle; true while the shell uses the channel. */
bool up_shell_cycle(void);

/* The host has gone while frames were on: the next one gets the mode that the start selected. */
void up_shell_channel_closed(void);

/* Checks a byte that the host sent between two frames; true if it was meant for the shell. */
bool up_shell_wants(uint8_t byte);

#endif
