/*
 * The user's controllers: code that runs a step in each cycle of a thread of its own, with the newest values, and sets
 * what it decides.
 *
 * A guard above all of them looks whether they still run: what a controller sets falls back within three of its cycles
 * after its last step, long before the watchdog acts.
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

/* The beginning of the last step, its end, and how many were late or too long. */
typedef struct {
  systime_t began;
  uint32_t ended_ms;
  uint32_t told_ms;
  uint32_t late;
  bool has_begun;
  bool has_hung; /* what it sets has fallen back */
} up_control_state_t;

typedef struct {
  void (*init)(void); /* the user's */
  /* Gathers what the code reads, runs its step, and sets what it has set. */
  void (*run)(uint32_t dt_us);
  void (*fall_back)(void); /* sets the failsafe values of what it sets; NULL if it has none */
  up_control_state_t *state;
  uint32_t every_ms;
  uint32_t takes_us; /* the longest that a step may take */
  uint16_t field;    /* the value that counts */
} up_control_t;

/* A value that survives a reset: where it is kept. */
typedef struct {
  uint16_t field;
  uint16_t offset;
} up_kept_t;

/* All controllers of a board. */
typedef struct {
  void (*begin)(void); /* gives values their first ones: calls up_control_begin() for each */
  const up_control_t *const *all;
  size_t count;
  const uint8_t *owners; /* one per field */
  const up_kept_t *kept;
  size_t kept_count;
  uint32_t *record; /* two words, then the kept values */
  size_t record_bytes;
  void *stack; /* of the guard */
  size_t stack_bytes;
  int16_t prio; /* of the guard, relative to NORMALPRIO */
} up_controls_t;

#if UP_HAS_CONTROL == TRUE
/* Calls the user's init functions and starts the guard: before the threads. */
void up_control_start(const up_controls_t *controls);

/* A step: the cycle of a task. */
void up_control_cycle(const void *work);

/* The newest value of a field that is measured, and its age; tells whether it is a good one. */
bool up_control_get(size_t field, void *value, uint32_t *age_us);

/* The same for one that is set, which is always good once it is there. */
bool up_control_given(size_t field, void *value, uint32_t *age_us);

/* Sets an actuator, or a value that is reported. */
void up_control_set(size_t field, const void *value);
void up_control_report(size_t field, void *value);

/* The value of a field at the start: the one that was kept, or the given one. */
void up_control_begin(size_t field, const void *value);

/* The host wants to set a field: whether it may. From the reporter. */
bool up_control_yields(size_t field, const void *value);
void up_control_host_is_silent(void);
#endif

#endif
