#include "up_silence.h"

void up_silence_init(up_silence_t *silence, uint32_t limit_ms, uint32_t now_ms) {
  silence->limit_ms = limit_ms;
  silence->heard_ms = now_ms;
  silence->is_silent = false;
}

void up_silence_heard(up_silence_t *silence, uint32_t now_ms) {
  silence->heard_ms = now_ms;
  silence->is_silent = false;
}

bool up_silence_step(up_silence_t *silence, uint32_t now_ms) {
  /* Once silent, it remains so, even when the clock wraps. */
  if (silence->limit_ms == 0U || silence->is_silent || (uint32_t)(now_ms - silence->heard_ms) < silence->limit_ms) {
    return false;
  }
  silence->is_silent = true;
  return true;
}
