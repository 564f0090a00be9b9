/*
 * The link to the host: a byte channel (USB or serial) and the frames on it.
 */
#ifndef UP_LINK_H
#define UP_LINK_H

#include "up_decode.h"
#include "up_rt.h"

/* What happened on the link since the start. */
typedef struct {
  uint32_t frames_sent;
  uint32_t frames_refused; /* nothing of the frame was taken; its values stay due */
  uint32_t frames_torn;    /* the host went away in the middle of a frame */
} up_link_counters_t;

/* ---- the channel: one of up_link_usb.c and up_link_serial.c ---- */

void up_channel_start(void);
BaseChannel *up_channel(void);

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

const up_link_counters_t *up_link_counters(void);
const up_decoder_t *up_link_decoder(void);

#endif
