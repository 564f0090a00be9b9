/*
 * The user's controllers: a step in each cycle, with the newest values. What a step sets is set at once.
 *
 * A step that never returns stops the whole sketch: then the watchdog starts the board again, with its outputs at rest.
 */
#ifndef UP_CONTROL_H
#define UP_CONTROL_H

#include "up_rt.h"

/* Whom an actuator obeys. */
typedef enum {
  UP_OWNER_HOST = 0,
  UP_OWNER_CODE = 1,
  UP_OWNER_CODE_OR_HOST = 2 /* the host once it has set it, until it falls silent */
} up_owner_t;

/* All zero at the start. */
typedef struct {
  uint32_t began_us;
  uint32_t told_ms;
  uint32_t late; /* steps that were late or took too long */
  bool has_begun;
} up_control_state_t;

typedef struct {
  /* Gathers what the code reads, runs its step, and sets what it has set. */
  void (*run)(uint32_t dt_us);
  up_control_state_t *state;
  uint32_t every_us;
  uint32_t takes_us; /* the longest that a step may take */
  uint16_t field;    /* the value that counts */
} up_control_t;

/* A step: the cycle of a task. */
uint32_t up_control_cycle(UP_ROM void *work);

/* The newest value of a field that is measured, and its age; tells whether it is a good one. */
bool up_control_get(size_t field, void *value, uint32_t *age_us);

/* The same for one that is set, which is always good once it is there. */
bool up_control_given(size_t field, void *value, uint32_t *age_us);

/* Sets an actuator, or a value that is reported. */
void up_control_set(size_t field, const void *value);
void up_control_report(size_t field, void *value);

/* The host wants to set a field: whether it may. */
bool up_control_yields(size_t field);
void up_control_host_is_silent(void);

/* Generated: first values, and the user's init functions; whom each field obeys. */
void sense_control_start(void);
extern UP_ROM uint8_t sense_owners[];

#endif
