/*
 * Serial devices that are asked: a request, the echo of it where both directions share a wire, and the answer.
 *
 * Bytes of the line in, values or the reason why there are none out. Who sends and who waits is up to the caller.
 */
#ifndef UP_EXCHANGE_H
#define UP_EXCHANGE_H

#include "up_message.h"

/* A request, and the message that answers it. */
typedef struct {
  UP_ROM uint8_t *request;
  UP_ROM up_message_t *answer; /* with its values */
  uint8_t request_count;       /* 1 to 255 */
  bool is_primed;              /* the answer's checksum begins with the request, which is its `start` */
  uint16_t wait_ms;            /* the time that the device has for the answer */
} up_exchange_t;

typedef enum {
  UP_HEARD_WAITING,  /* it is not there yet */
  UP_HEARD_ANSWERED, /* it is there, and right */
  UP_HEARD_REFUSED   /* something else is there */
} up_heard_t;

/* The board's own bytes, which it hears where both directions share a wire. All zero at the start. */
typedef struct {
  size_t heard;
  bool is_wrong; /* another byte than the sent one was heard: two sent at once */
} up_echo_t;

/* The number of `bytes` that belong to the echo of `sent`; what is behind them is the answer. */
size_t up_echo_take(up_echo_t *state, const uint8_t *sent, size_t sent_count, const uint8_t *bytes, size_t count);

/* The bytes that a device says when it has taken a command. `heard` is 0 at the start. */
up_heard_t up_reply_take(size_t *heard, UP_ROM uint8_t *wanted, size_t wanted_count, const uint8_t *bytes,
                         size_t count);

/* The request is being sent: what comes from now on is the answer. */
void up_exchange_begin(UP_ROM up_exchange_t *how, up_message_state_t *state, UP_ROM up_schema_t *schema);

/* Takes the next bytes of the answer, and reports the values or that they were damaged. */
up_heard_t up_exchange_take(UP_ROM up_exchange_t *how, up_message_state_t *state, UP_ROM up_schema_t *schema,
                            const uint8_t *bytes, size_t count, const up_value_sink_t *sink);

/* Reports that there is no answer, for all its values. */
void up_exchange_fail(UP_ROM up_exchange_t *how, up_result_t result, const up_value_sink_t *sink);

#endif
