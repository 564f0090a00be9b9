/*
 * Plain pins: outputs, levels that a thread reads, edges that interrupt.
 */
#ifndef UP_DIGITAL_H
#define UP_DIGITAL_H

#include "ch.h"
#include "hal.h"

#include "up_count.h"
#include "up_debounce.h"
#include "up_elements.h"

/* An actuator of plain pins. */
typedef struct {
  const ioline_t *lines; /* one per element */
  uint16_t field;
  uint8_t lines_count;
  bool is_low_active;
} up_digital_output_t;

/* The state of an input; all zero at the start. */
typedef struct {
  up_contact_t contact;
  up_contact_report_t reported;
} up_digital_state_t;

typedef struct {
  ioline_t line;
  const up_contact_config_t *config; /* NULL: its level without debouncing */
  up_digital_state_t *state;         /* NULL likewise */
} up_digital_input_t;

/* A sensor of plain pins. */
typedef struct {
  const up_digital_input_t *inputs; /* one per element */
  uint64_t *value;                  /* as large as the value */
  up_repeat_t *repeat;              /* with edges: reported when something happens, and repeated */
  uint32_t repeat_ms;
  uint16_t field;
  uint8_t inputs_count;
  bool is_low_active;
} up_digital_t;

/* The sensors that one thread reads: the argument of up_digital_cycle(). */
typedef struct {
  const up_digital_t *sensors;
  uint8_t sensors_count;
} up_digital_class_t;

/* `lasting` of a contact in kernel ticks, at least one. */
#define UP_LASTING_US(us) ((uint32_t)(((uint64_t)(us) * CH_CFG_ST_FREQUENCY + 999999U) / 1000000U))

void up_digital_set(const up_digital_output_t *output, const void *value);
void up_digital_cycle(const void *work);

/* Polls contacts that are being debounced: at the start, and in each cycle of the reporter. */
void up_digital_look(const up_digital_t *sensor);

#if PAL_USE_CALLBACKS == TRUE
/* Sensors with edges: starts the interrupts, and reports what they saw. */
void up_digital_start(const up_digital_t *sensor);
void up_digital_poll(const up_digital_t *sensor);
#endif

#endif
