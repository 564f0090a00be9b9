/*
 * Serial lines on which the board speaks with one part after the other: it asks in each cycle, and says what the host
 * has set. Requests, commands and answers of all parts of a line are in one thread, so they never meet.
 */
#ifndef UP_LINE_H
#define UP_LINE_H

#include "up_rt.h"

#if HAL_USE_SERIAL == TRUE

#include "up_compose.h"
#include "up_exchange.h"

/* All zero at the start. */
typedef struct {
  uint32_t sent_ms;
  bool is_owed;     /* the part has not taken the value yet */
  bool has_failed;  /* it did not take it the last time: it is told again in its next cycle */
  bool is_set;      /* there is a value */
  bool is_repeated; /* it is sent again and again */
} up_line_order_state_t;

/* A value that a part is told. */
typedef struct {
  const up_compose_t *compose;
  const uint8_t *answer; /* what the part says when it has taken it; NULL for nothing */
  uint64_t *value;       /* as large as the value */
  up_line_order_state_t *state;
  uint32_t resend_ms; /* 0: it is sent once */
  uint16_t field;
  uint16_t wait_ms;
  uint8_t answer_count;
} up_line_order_t;

/* All zero at the start. */
typedef struct {
  up_message_start_t start;
  uint32_t due_ms;
  bool has_begun;
  bool is_lost; /* it did not answer the last time */
} up_line_part_state_t;

/* A part on a line. */
typedef struct {
  const up_message_init_t *init;
  const up_exchange_t *exchanges;
  const up_line_order_t *orders;
  up_line_part_state_t *state;
  uint32_t cycle_ms;
  uint8_t init_count;
  uint8_t exchanges_count;
  uint8_t orders_count;
} up_line_part_t;

/* A port with its line: the argument of up_line_cycle(). */
typedef struct {
  SerialDriver *driver;
  const SerialConfig *config;
  binary_semaphore_t *told;   /* an order has come */
  up_message_state_t *answer; /* the answer that is being put together */
  uint8_t *sent; /* the message that is put together: UP_LINE_SEND_BYTES_MAX */
  const up_line_part_t *parts;
  ioline_t direction;    /* high while the board sends */
  uint32_t cycle_ms;     /* of its fastest part */
  uint32_t character_us; /* rounded up */
  uint8_t parts_count;
  bool has_echo; /* the board hears what it sends */
  bool has_direction;
} up_line_t;

void up_line_start(const up_line_t *line);

/* Asks the parts that are due, and tells them what they are owed, until the next cycle. */
void up_line_cycle(const void *work);

/* The host has set a value. From the reporter. */
void up_line_tell(const up_line_t *line, const up_line_order_t *order, const void *value);

/* The host is silent: nothing is repeated until it is set again. From the reporter. */
void up_line_hush(const up_line_t *line);

#endif
#endif
