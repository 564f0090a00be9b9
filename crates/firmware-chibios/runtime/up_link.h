/*
 * The link to the host: a byte channel (USB or serial) and the frames on it.
 */
#ifndef UP_LINK_H
#define UP_LINK_H

#include "up_reporter.h"
#include "up_rt.h"

/* ---- the channel: one of up_link_usb.c and up_link_serial.c ---- */

void up_channel_start(void);
BaseChannel *up_channel(void);

/* The number of bytes that it accepts now without waiting; UP_CHANNEL_ROOM_MAX if all bytes that it accepted have
 * left. */
#if UP_LINK_USB == TRUE
#define UP_CHANNEL_ROOM_MAX ((size_t)SERIAL_USB_BUFFERS_NUMBER * SERIAL_USB_BUFFERS_SIZE)
#else
#define UP_CHANNEL_ROOM_MAX ((size_t)SERIAL_BUFFERS_SIZE)
#endif
size_t up_channel_room(void);

/* Whether the other end listens, as far as the channel can tell. */
bool up_channel_is_open(void);

/* ---- the frames ---- */

void up_link_start(void);

/* Receives, answers and sends what is due; called by the reporter while frames are on. */
void up_link_cycle(void);

/* Replaces a cycle while the shell uses the channel: when it is free again, frames begin with a hello. */
void up_link_pause(void);

/* Looks for the host's request for a hello in the shell's input; true when it has just ended. */
bool up_link_peek(uint8_t byte);

/* The reporter with its counts, to show to people. */
const up_reporter_t *up_link_reporter(void);

#endif
