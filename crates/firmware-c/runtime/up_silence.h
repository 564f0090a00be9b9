/*
 * When actuators fall back: the host has sent no valid frame for too long.
 */
#ifndef UP_SILENCE_H
#define UP_SILENCE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
  uint32_t limit_ms; /* 10 to 3600000; 0: never */
  uint32_t heard_ms; /* when the last valid frame came; the clock may wrap */
  bool is_silent;    /* they have fallen back, and no frame has come since */
} up_silence_t;

/* The start counts as a frame from the host. */
void up_silence_init(up_silence_t *silence, uint32_t limit_ms, uint32_t now_ms);

/* A valid frame from the host has arrived. */
void up_silence_heard(up_silence_t *silence, uint32_t now_ms);

/* Must be called in each cycle: true if the actuators must fall back now, once for each silence. */
bool up_silence_step(up_silence_t *silence, uint32_t now_ms);

#endif
