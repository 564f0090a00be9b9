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

/* Bytes that it takes now without waiting; UP_CHANNEL_ROOM_MAX when all that it took has left. */
#if UP_LINK_USB == TRUE
#define UP_CHANNEL_ROOM_MAX ((size_t)SERIAL_USB_BUFFERS_NUMBER * SERIAL_USB_BUFFERS_SIZE)
#else
#define UP_CHANNEL_ROOM_MAX ((size_t)SERIAL_BUFFERS_SIZE)
#endif
size_t up_channel_room(void);

/* True while somebody listens at the other end, as far as the channel can tell. */
bool up_channel_is_open(void);

/* ---- the frames ---- */

void up_link_start(void);

/* Receives, answers and sends what is due; called by the reporter while frames are on. */
void up_link_cycle(void);

/* Called instead while the shell has the channel: frames begin with a hello when their turn comes. */
void up_link_pause(void);

/* Looks for the host's request for a hello in what the shell reads; true when it has just ended. */
bool up_link_peek(uint8_t byte);

/* For people: what it counted. */
const up_reporter_t *up_link_reporter(void);

#endif
