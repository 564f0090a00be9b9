/*
 * Input capture: interrupts collect, the reporter polls.
 */
#ifndef UP_ICU_H
#define UP_ICU_H

#include "ch.h"
#include "hal.h"

#include "up_capture.h"
#include "up_elements.h"
#include "up_ppm.h"

#if HAL_USE_ICU == TRUE
/* One captured wire. */
typedef struct {
  ICUDriver *driver;
  up_capture_raw_t *raw;
} up_icu_input_t;

/* A sensor of captured wires: the argument of up_icu_poll(). */
typedef struct {
  const up_icu_input_t *inputs; /* one per element */
  up_capture_config_t capture;
  up_capture_state_t *states; /* one per element */
  uint8_t *flags;             /* of an array: one per element */
  uint64_t *latest;           /* of an array: the last value of each element; otherwise NULL */
  uint64_t *value;            /* as large as the value */
  uint16_t field;
  uint8_t inputs_count;
  bool is_complete; /* an array is reported when each element is new */
} up_icu_t;

/* The channels of a model receiver: the argument of up_train_poll(). */
typedef struct {
  const up_ppm_config_t *config;
  const up_ppm_raw_t *raw;
  uint32_t *trains_seen;
  uint64_t *value; /* as large as the value */
  uint16_t field;
} up_train_t;

void up_icu_start(ICUDriver *driver, const ICUConfig *config);
void up_icu_poll(const up_icu_t *icu);
void up_train_poll(const up_train_t *train);

/* Lets the driver notice that its timer wrapped, so that it skips the capture; needs no action here. */
void up_icu_on_overflow(ICUDriver *driver);
#endif

#endif
