/* Serial lines: requests, commands and their answers, one after the other. */
#include "up_line.h"

#if HAL_USE_SERIAL == TRUE

#include <string.h>

/* The number of bytes that are taken out of the queue at a time. */
#define CHUNK_BYTES 16U

/* What a part says to a step of its start is taken off the line for so long. */
#define DRAIN_MS 5U

/* The receiver of what follows the echo of what was sent. */
typedef struct {
  up_heard_t (*take)(void *context, const uint8_t *bytes, size_t count);
  void *context;
} listener_t;

void up_line_start(const up_line_t *line) {
  chBSemObjectInit(line->told, true);
  if (line->has_direction) {
    palClearLine(line->direction);
  }
  (void)sdStart(line->driver, line->config);
}

/* ---- the wire ---- */

/* Whether the last bit has left the port. */
static bool is_sent(const up_line_t *line) {
#if defined(USART_ISR_TC)
  return (line->driver->usart->ISR & USART_ISR_TC) != 0U;
#else
  return (line->driver->usart->SR & USART_SR_TC) != 0U;
#endif
}

static uint32_t ticks(uint32_t us) {
  return us / UP_STEP_US;
}

/* Waits until the last bit is out, so that the direction changes before the answer begins. */
static void await_sent(const up_line_t *line, size_t count) {
  const uint32_t line_us = (uint32_t)count * line->character_us;
  const systime_t begin = chVTGetSystemTimeX();

  if (ticks(line_us) > 1U) {
    chThdSleep((sysinterval_t)(ticks(line_us) - 1U));
  }
  while (!is_sent(line) && chVTTimeElapsedSinceX(begin) < (sysinterval_t)(ticks(2U * line_us) + 2U)) {
    /* Less than two characters are left. */
  }
}

/* Sends bytes; what came before them belongs to nothing. */
static void say(const up_line_t *line, const uint8_t *bytes, size_t count) {
  uint8_t old[CHUNK_BYTES];

  while (sdReadTimeout(line->driver, old, sizeof old, TIME_IMMEDIATE) > 0U) {
    /* An answer that came too late. */
  }
  if (line->has_direction) {
    palSetLine(line->direction);
  }
  (void)sdWrite(line->driver, bytes, count);
  if (line->has_direction) {
    await_sent(line, count);
    palClearLine(line->direction);
  }
}

/* Takes what comes in the time that the bytes take on the line and `wait_ms`, without their echo, until the listener
 * has heard enough. Without a listener, until the echo is over. */
static up_heard_t hear(const up_line_t *line, const uint8_t *sent, size_t sent_count, uint32_t wait_ms,
                       const listener_t *listener) {
  const uint32_t line_us = (uint32_t)sent_count * line->character_us;
  const sysinterval_t most = UP_MS2I(wait_ms) + (sysinterval_t)(ticks(line_us) + 1U);
  const systime_t begin = chVTGetSystemTimeX();
  sysinterval_t passed = 0;
  up_echo_t echo = {.heard = 0U};
  up_heard_t heard = UP_HEARD_WAITING;

  while (heard == UP_HEARD_WAITING && passed < most && !echo.is_wrong) {
    uint8_t bytes[CHUNK_BYTES];
    size_t count = sdReadTimeout(line->driver, bytes, 1U, most - passed);
    size_t own = 0U;

    if (count > 0U) {
      count += sdReadTimeout(line->driver, &bytes[1], sizeof bytes - 1U, TIME_IMMEDIATE);
    }
    if (line->has_echo) {
      own = up_echo_take(&echo, sent, sent_count, bytes, count);
    }
    if (listener == NULL) {
      heard = (echo.heard == sent_count) ? UP_HEARD_ANSWERED : UP_HEARD_WAITING;
    } else if (count > own) {
      heard = listener->take(listener->context, &bytes[own], count - own);
    }
    passed = chVTTimeElapsedSinceX(begin);
  }
  return heard;
}

/* ---- requests ---- */

typedef struct {
  const up_line_t *line;
  const up_exchange_t *how;
} asking_t;

static up_heard_t take_answer(void *context, const uint8_t *bytes, size_t count) {
  const asking_t *asking = context;

  return up_exchange_take(asking->how, asking->line->answer, up_config.schema, bytes, count, &up_values);
}

/* Asks for values. Returns false if the part is silent. */
static bool ask(const up_line_t *line, const up_exchange_t *how) {
  asking_t asking = {.line = line, .how = how};
  const listener_t listener = {.take = take_answer, .context = &asking};

  up_exchange_begin(how, line->answer, up_config.schema);
  say(line, how->request, how->request_count);
  if (hear(line, how->request, how->request_count, how->wait_ms, &listener) == UP_HEARD_WAITING) {
    up_exchange_fail(how, UP_TIMED_OUT, &up_values);
    return false;
  }
  return true;
}

/* Asks for all values. A part that does not answer the first question is not asked another one. */
static void ask_all(const up_line_t *line, const up_line_part_t *part) {
  bool is_silent = false;
  uint8_t i;

  for (i = 0U; i < part->exchanges_count; i++) {
    if (is_silent) {
      up_exchange_fail(&part->exchanges[i], UP_TIMED_OUT, &up_values);
    } else {
      is_silent = !ask(line, &part->exchanges[i]);
    }
  }
  if (part->exchanges_count > 0U) {
    if (part->state->is_lost && !is_silent) {
      /* It had no supply, perhaps: it is set up, and told everything, again. */
      part->state->start = (up_message_start_t){.at = 0U};
      for (i = 0U; i < part->orders_count; i++) {
        part->orders[i].state->is_owed = part->orders[i].state->is_set;
      }
    }
    part->state->is_lost = is_silent;
  }
}

/* ---- commands ---- */

typedef struct {
  const up_line_order_t *order;
  size_t heard;
} telling_t;

static up_heard_t take_reply(void *context, const uint8_t *bytes, size_t count) {
  telling_t *telling = context;

  return up_reply_take(&telling->heard, telling->order->answer, telling->order->answer_count, bytes, count);
}

static up_heard_t ignore(void *context, const uint8_t *bytes, size_t count) {
  (void)context;
  (void)bytes;
  (void)count;
  return UP_HEARD_WAITING;
}

/* Writes the message for a value that the reporter may be changing. */
static size_t compose(const up_line_t *line, const up_line_order_t *order) {
  const up_field_t *field = &up_config.schema->fields[order->field];
  size_t count;

  up_lock();
  order->state->is_owed = false;
  order->state->has_failed = false;
  order->state->is_repeated = order->resend_ms > 0U;
  count = up_compose(order->compose, field, order->value, line->sent, UP_LINE_SEND_BYTES_MAX);
  up_unlock();
  return count;
}

static void tell(const up_line_t *line, const up_line_order_t *order) {
  telling_t telling = {.order = order, .heard = 0U};
  const listener_t listener = {.take = take_reply, .context = &telling};
  const size_t count = compose(line, order);
  up_heard_t heard = UP_HEARD_ANSWERED;

  if (count == 0U) {
    up_result(order->field, UP_BUS_ERROR, NULL);
    return;
  }
  order->state->sent_ms = up_now_ms();
  say(line, line->sent, count);
  if (order->answer_count > 0U) {
    heard = hear(line, line->sent, count, order->wait_ms, &listener);
  } else if (line->has_echo) {
    heard = hear(line, line->sent, count, order->wait_ms, NULL);
  }
  if (heard == UP_HEARD_ANSWERED) {
    up_result(order->field, UP_NOTHING, NULL);
  } else {
    order->state->is_owed = true;
    order->state->has_failed = true;
    up_result(order->field, (heard == UP_HEARD_WAITING) ? UP_TIMED_OUT : UP_NOT_ACKNOWLEDGED, NULL);
  }
}

/* Tells a part what is due: what is new, what has to be repeated, and in its own cycle what it has not taken. */
static void tell_all(const up_line_t *line, const up_line_part_t *part, bool is_due) {
  uint8_t i;

  for (i = 0U; i < part->orders_count; i++) {
    const up_line_order_t *order = &part->orders[i];
    const up_line_order_state_t *state = order->state;
    const bool is_repeated = state->is_repeated && up_now_ms() - state->sent_ms >= order->resend_ms;

    if (is_repeated || (state->is_owed && (is_due || !state->has_failed))) {
      tell(line, order);
    }
  }
}

void up_line_tell(const up_line_t *line, const up_line_order_t *order, const void *value) {
  const up_field_t *field = &up_config.schema->fields[order->field];

  up_lock();
  memcpy(order->value, value, up_field_bytes(field));
  order->state->is_set = true;
  order->state->is_owed = true;
  order->state->has_failed = false;
  up_unlock();
  chBSemSignal(line->told);
}

void up_line_hush(const up_line_t *line) {
  uint8_t part, i;

  up_lock();
  for (part = 0U; part < line->parts_count; part++) {
    for (i = 0U; i < line->parts[part].orders_count; i++) {
      line->parts[part].orders[i].state->is_repeated = false;
    }
  }
  up_unlock();
}

/* ---- the thread ---- */

/* Sends the bytes that are due from the steps that start a part, and drops what it says to them. */
static void set_up(const up_line_t *line, const up_line_part_t *part) {
  const listener_t nobody = {.take = ignore, .context = NULL};
  const up_message_init_t *step;

  while ((step = up_message_start(part->init, part->init_count, &part->state->start, up_now_ms())) != NULL) {
    if (step->count > 0U) {
      say(line, step->bytes, step->count);
      (void)hear(line, step->bytes, step->count, DRAIN_MS, &nobody);
    }
  }
}

/* Whether the turn of a part is nearer to this cycle of its line than to the next one. */
static bool is_due(const up_line_part_t *part, uint32_t now_ms) {
  up_line_part_state_t *state = part->state;

  if (state->has_begun && now_ms - state->due_ms >= 0x80000000U) {
    return false;
  }
  if (!state->has_begun || now_ms - state->due_ms >= part->cycle_ms) {
    /* Cycles that were missed are left out. */
    state->due_ms = now_ms;
    state->has_begun = true;
  }
  state->due_ms += part->cycle_ms;
  return true;
}

/* The time until something has to be repeated, or `most_ms`. */
static uint32_t until_repeated_ms(const up_line_t *line, uint32_t most_ms) {
  uint8_t part, i;

  for (part = 0U; part < line->parts_count; part++) {
    for (i = 0U; i < line->parts[part].orders_count; i++) {
      const up_line_order_t *order = &line->parts[part].orders[i];
      const uint32_t passed_ms = up_now_ms() - order->state->sent_ms;
      const uint32_t left_ms = (passed_ms < order->resend_ms) ? order->resend_ms - passed_ms : 0U;

      if (order->state->is_repeated && left_ms < most_ms) {
        most_ms = left_ms;
      }
    }
  }
  return most_ms;
}

void up_line_cycle(const void *work) {
  const up_line_t *line = work;
  const uint32_t begin_ms = up_now_ms();
  uint32_t passed_ms;
  uint8_t i;

  for (i = 0U; i < line->parts_count; i++) {
    const up_line_part_t *part = &line->parts[i];
    const bool is_its_turn = is_due(part, begin_ms + line->cycle_ms / 2U);

    if (is_its_turn) {
      set_up(line, part);
      ask_all(line, part);
    }
    tell_all(line, part, is_its_turn);
  }
  /* The last millisecond is left for the code that keeps the cycles apart. */
  while ((passed_ms = up_now_ms() - begin_ms) + 1U < line->cycle_ms) {
    const uint32_t wait_ms = until_repeated_ms(line, line->cycle_ms - 1U - passed_ms);

    if (wait_ms > 0U) {
      (void)chBSemWaitTimeout(line->told, UP_MS2I(wait_ms));
    }
    for (i = 0U; i < line->parts_count; i++) {
      tell_all(line, &line->parts[i], false);
    }
  }
}

#endif
