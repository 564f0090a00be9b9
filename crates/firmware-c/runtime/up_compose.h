/*
 * A message that is sent: a value with what surrounds it, the reverse of up_message.h.
 */
#ifndef UP_COMPOSE_H
#define UP_COMPOSE_H

#include "up_message.h"

/* A message: start, value, checksum, end. */
typedef struct {
  const uint8_t *start;
  const uint8_t *end;
  up_value_t value;
  uint8_t start_count;   /* 0 to 255 */
  uint8_t end_count;     /* 0 to 255 */
  uint8_t checksum;      /* up_checksum_t */
  uint8_t checksum_from; /* first byte that the checksum covers, counted from the first byte of `start`; not for NMEA */
} up_compose_t;

/* Writes the message with the value of `field`. Returns its size in bytes, 0 if it does not fit. */
size_t up_compose(const up_compose_t *how, const up_field_t *field, const void *value, uint8_t *bytes, size_t room);

#endif
