/*
 * Plain pins: outputs, levels that are read in cycles, edges that interrupt.
 */
#ifndef UP_DIGITAL_H
#define UP_DIGITAL_H

#include "up_count.h"
#include "up_debounce.h"
#include "up_rt.h"

/* An actuator. */
typedef struct {
  UP_ROM uint8_t *pins; /* one for each element */
  uint16_t field;
  uint8_t pins_count;
  bool is_low_active;
} up_digital_output_t;

/* The state of an input; all zero at the start. */
typedef struct {
  up_contact_t contact;
  up_contact_report_t reported;
} up_digital_state_t;

/* A sensor. */
typedef struct {
  UP_ROM uint8_t *pins; /* one for each element */
  UP_ROM up_contact_config_t *contact; /* times in microseconds; NULL: levels as they are */
  up_digital_state_t *states;          /* one for each element; NULL likewise */
  up_repeat_t *repeat;                 /* with edges alone */
  uint32_t repeat_ms;
  uint16_t field;
  uint8_t pins_count;
  bool is_low_active;
} up_digital_t;

/* The sensors of one cycle. */
typedef struct {
  UP_ROM up_digital_t *sensors;
  uint8_t sensors_count;
} up_digital_class_t;

void up_digital_set(UP_ROM up_digital_output_t *output, const void *value);

uint32_t up_digital_cycle(UP_ROM void *work);

/* Debounces the levels of a sensor that is read in cycles: in each turn of the loop. */
void up_digital_look(UP_ROM up_digital_t *sensor);

/* An input has changed. From an interrupt. */
void up_digital_on_change(UP_ROM up_digital_t *sensor, uint8_t element, bool level);

/* Tells what interrupts have seen: in each turn of the loop. */
void up_digital_poll(UP_ROM up_digital_t *sensor);

#endif
