/*
 * Quadrature encoders: interrupts at both edges of both wires count, four counts a line.
 */
#ifndef UP_ENCODER_H
#define UP_ENCODER_H

#include "up_count.h"
#include "up_rt.h"

/* All zero at the start. */
typedef struct {
  int32_t count;
  uint8_t place; /* within a line: 0 to 3 */
  bool has_place;
} up_quadrature_t;

typedef struct {
  up_quadrature_t *wheels; /* one for each element */
  int32_t *reported;       /* likewise */
  up_repeat_t *repeat;
  uint16_t field;
  uint8_t wheels_count;
} up_encoder_t;

/* A wire has changed. From an interrupt. */
void up_quadrature_on_change(up_quadrature_t *wheel, bool a, bool b);

/* Tells the counts when they have changed, or not for a second. */
void up_encoder_poll(UP_ROM up_encoder_t *encoder);

#endif
