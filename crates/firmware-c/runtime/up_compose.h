/*
 * A message that is sent: a value with what surrounds it, the reverse of up_message.h.
 */
#ifndef UP_COMPOSE_H
#define UP_COMPOSE_H

#include "up_message.h"

/* A message: start, value, what is behind it, checksum, end. */
typedef struct {
  UP_ROM uint8_t *start;
  UP_ROM uint8_t *behind; /* between the value and the checksum */
  UP_ROM uint8_t *end;
  up_value_t value;       /* UP_FORMAT_BINARY: the coding */
  uint8_t format;         /* up_format_t: bytes, or a decimal or hexadecimal text */
  char separator;         /* text: between elements; 0 for none */
  uint8_t decimals;       /* decimal: the number is the value divided by 10^decimals, 0 to 18 */
  uint8_t start_count;    /* 0 to 255 */
  uint8_t behind_count;   /* 0 to 255 */
  uint8_t end_count;      /* 0 to 255 */
  uint8_t checksum;       /* up_checksum_t */
  uint8_t checksum_from;  /* first byte that the checksum covers, counted from the first byte of `start`; not for
                           * NMEA */
} up_compose_t;

/* Writes the message with the value of `field`. Returns its size in bytes, 0 if it does not fit. */
size_t up_compose(UP_ROM up_compose_t *how, UP_ROM up_field_t *field, const void *value, uint8_t *bytes, size_t room);

#endif
