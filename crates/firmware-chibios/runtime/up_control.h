/*
 * The user's controllers: code that runs a step in each cycle of a thread of its own, with the newest values, and sets
 * what it decides.
 */
#ifndef UP_CONTROL_H
#define UP_CONTROL_H

#include "up_rt.h"

/* The time of the last step, and how many were late or too long. */
typedef struct {
  systime_t began;
  uint32_t late;
  bool has_begun;
} up_control_state_t;

typedef struct {
  /* Gathers what the code reads, runs its step, and sets what it has set. */
  void (*run)(uint32_t dt_us);
  up_control_state_t *state;
  uint32_t every_ms;
  uint32_t takes_us; /* the longest that a step may take */
  uint16_t field;    /* the value that counts */
} up_control_t;

/* A step: the cycle of a task. */
void up_control_cycle(const void *work);

/* The lock of whoever gathers what interrupts have collected, or sets outputs. */
void up_control_start(void);
void up_control_lock(void);
void up_control_unlock(void);

/* The newest value of a field and its age; tells whether it is a good one. */
bool up_control_get(size_t field, void *value, uint32_t *age_us);

/* Sets an actuator, or a value that is reported. */
void up_control_set(size_t field, const void *value);
void up_control_report(size_t field, void *value);

#endif
