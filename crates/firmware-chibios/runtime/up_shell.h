/*
 * The shell for development, or frames: who has the channel.
 *
 * A development build starts with the shell; frames come when the user's button is held at the start, by the
 * command `stream`, or when a host asks for a hello: so the generated host application works without a hand on
 * the board. While frames are on, a `q` between two frames brings the shell back. A production build
 * (UP_SHELL FALSE) knows frames only.
 */
#ifndef UP_SHELL_H
#define UP_SHELL_H

#include "up_rt.h"

void up_shell_start(void);

/* Called by the reporter each cycle; true while the shell has the channel. */
bool up_shell_cycle(void);

/* The host has gone while frames were on: the next one finds what the start decided. */
void up_shell_channel_closed(void);

/* Looks at a byte that the host sent between two frames; true when it was the shell's. */
bool up_shell_wants(uint8_t byte);

#endif
