/*
 * From one signed value to the two or three outputs of an H-bridge.
 *
 * The sign is the direction, the magnitude the strength; it saturates at the outputs' full scale. The outputs are
 * written one after the other in the order that up_drive() gives: the two inputs of the bridge are then never driven at
 * the same time, and no direction is driven with the strength meant for the other.
 */
#ifndef UP_DRIVE_H
#define UP_DRIVE_H

#include "up_schema.h"

typedef enum {
  UP_DRIVE_DIRECTION_PINS, /* outputs: 0 magnitude (PWM), 1 in1 (high: forward), 2 in2 (high: backward) */
  UP_DRIVE_TWO_PWM,        /* outputs: 0 forward (PWM), 1 backward (PWM) */
  UP_DRIVE_DIRECTION_PIN   /* outputs: 0 magnitude (PWM), 1 direction (high: backward) */
} up_drive_mode_t;

/* The most writes for one value. */
#define UP_DRIVE_WRITES_MAX 4U

typedef struct {
  uint8_t mode;      /* up_drive_mode_t */
  uint32_t full;     /* the greatest magnitude, in the unit of the PWM outputs (that of their fields) */
} up_drive_t;

/* All zero at the start, so that the first value writes every output. */
typedef struct {
  int8_t direction; /* -1, 0 or 1 */
  bool has_written;
} up_drive_state_t;

typedef struct {
  uint8_t output; /* the output's number, as in up_drive_mode_t */
  uint32_t value; /* a magnitude, 0 to `full`, or the level of a pin, 0 or 1 */
} up_drive_write_t;

/* Gives the writes for an element of this type (integers, bool or float32; NaN is 0), in order. With direction pins,
 * a new direction first writes the magnitude 0, then the pin that goes low, then the one that goes high, then the
 * magnitude; both pins are low at 0. With one pin, the magnitude is 0 while the pin changes; the pin is low at 0. With
 * two PWM outputs, the one that goes to 0 is written first. Returns their
 * number. */
size_t up_drive(UP_ROM up_drive_t *drive, up_drive_state_t *state, uint8_t type, const void *element,
                up_drive_write_t writes[UP_DRIVE_WRITES_MAX]);

#endif
