#include "up_exchange.h"

/* Counts what goes on to the real receiver. */
typedef struct {
  const up_value_sink_t *to;
  bool is_said;
} passed_t;

static void pass(void *context, uint16_t field, up_result_t result, void *value) {
  passed_t *passed = context;

  passed->is_said = true;
  passed->to->on_value(passed->to->context, field, result, value);
}

static void ignore(void *context, uint16_t field, up_result_t result, void *value) {
  (void)context;
  (void)field;
  (void)result;
  (void)value;
}

size_t up_echo_take(up_echo_t *state, const uint8_t *sent, size_t sent_count, const uint8_t *bytes, size_t count) {
  size_t i;

  for (i = 0U; i < count && state->heard < sent_count; i++) {
    state->is_wrong = state->is_wrong || bytes[i] != sent[state->heard];
    state->heard++;
  }
  return i;
}

up_heard_t up_reply_take(size_t *heard, UP_ROM uint8_t *wanted, size_t wanted_count, const uint8_t *bytes,
                         size_t count) {
  size_t i;

  for (i = 0U; i < count; i++) {
    if (*heard >= wanted_count || wanted[*heard] != bytes[i]) {
      return UP_HEARD_REFUSED;
    }
    (*heard)++;
  }
  return (*heard == wanted_count) ? UP_HEARD_ANSWERED : UP_HEARD_WAITING;
}

void up_exchange_begin(UP_ROM up_exchange_t *how, up_message_state_t *state, UP_ROM up_schema_t *schema) {
  const up_value_sink_t nobody = {.on_value = ignore};
  uint8_t i;

  up_message_gap(state);
  for (i = 0U; how->is_primed && i < how->request_count; i++) {
    const uint8_t byte = how->request[i];
    up_message_feed(how->answer, state, schema, &byte, 1U, &nobody);
  }
}

up_heard_t up_exchange_take(UP_ROM up_exchange_t *how, up_message_state_t *state, UP_ROM up_schema_t *schema,
                            const uint8_t *bytes, size_t count, const up_value_sink_t *sink) {
  const up_events_t messages = state->messages;
  const up_events_t wrong_checksum = state->wrong_checksum;
  passed_t passed = {.to = sink, .is_said = false};
  const up_value_sink_t through = {.on_value = pass, .context = &passed};

  up_message_feed(how->answer, state, schema, bytes, count, &through);
  if (state->messages != messages) {
    return UP_HEARD_ANSWERED;
  }
  if (state->wrong_checksum == wrong_checksum) {
    return UP_HEARD_WAITING;
  }
  if (!passed.is_said) {
    up_exchange_fail(how, UP_WRONG_CRC, sink);
  }
  return UP_HEARD_REFUSED;
}

void up_exchange_fail(UP_ROM up_exchange_t *how, up_result_t result, const up_value_sink_t *sink) {
  uint8_t i;

  for (i = 0U; i < how->answer->fields_count; i++) {
    sink->on_value(sink->context, how->answer->fields[i].field, result, NULL);
  }
}
