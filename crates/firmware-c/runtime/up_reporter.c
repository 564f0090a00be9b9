#include "up_reporter.h"

/* Reads per cycle: a host that sends without end must not delay reports. */
#define READS_MAX 16U

/* Where a program has one reporter, the compiler may know its configuration. */
#if defined(UP_REPORTER_CONFIG)
extern UP_ROM up_reporter_config_t UP_REPORTER_CONFIG;

static UP_ROM up_reporter_config_t *config_of(const up_reporter_t *reporter) {
  (void)reporter;
  return &UP_REPORTER_CONFIG;
}
#else
static UP_ROM up_reporter_config_t *config_of(const up_reporter_t *reporter) {
  return reporter->config;
}
#endif

static bool has_health(const up_reporter_t *reporter) {
  return UP_USES_HEALTH && config_of(reporter)->health != NULL;
}

/* A valid frame has come from the host. */
static void note_heard(up_reporter_t *reporter) {
  if (config_of(reporter)->silence_ms > 0U) {
    up_silence_heard(&reporter->silence, reporter->now_ms);
  }
}

static void lock(const up_reporter_t *reporter) {
  if (config_of(reporter)->lock != NULL) {
    config_of(reporter)->lock(config_of(reporter)->context);
  }
}

static void unlock(const up_reporter_t *reporter) {
  if (config_of(reporter)->unlock != NULL) {
    config_of(reporter)->unlock(config_of(reporter)->context);
  }
}

/* ---- from the host ---- */

#if UP_USES_COMMANDS
static void on_values(void *context, const up_stamp_t *stamp, const uint8_t *items, size_t size) {
  const up_reporter_t *reporter = context;
  UP_ROM up_reporter_config_t *config = config_of(reporter);
  uint8_t taken[UP_FIELD_BITMAP_BYTES];
  size_t i;

  (void)stamp;
  if (config->received == NULL || config->commands->take == NULL) {
    return;
  }
  memset(taken, 0, sizeof taken);
  config->commands->take(items, &items[size], config->received, taken);
  for (i = 0U; i < config->schema->fields_count; i++) {
    if (up_bit_get(taken, i)) {
      config->apply(config->context, i, (const uint8_t *)config->received + config->schema->fields[i].offset);
    }
  }
}

static void on_hello(void *context, uint32_t hash) {
  up_reporter_t *reporter = context;

  (void)hash;
  reporter->hello_due = true;
}

static void on_health(void *context, const uint8_t *payload, size_t size) {
  up_reporter_t *reporter = context;

  (void)payload;
  (void)size;
  if (has_health(reporter)) {
    reporter->health_due = true;
  }
}

static bool begin(up_reporter_t *reporter) {
  UP_ROM up_reporter_config_t *config = config_of(reporter);

  reporter->sink.on_values = on_values;
  reporter->sink.on_hello = on_hello;
  reporter->sink.on_health = on_health;
  reporter->sink.context = reporter;
  return up_decoder_init(&reporter->decoder, config->commands, config->buffer, config->buffer_bytes, &reporter->sink);
}

static void take(up_reporter_t *reporter, const uint8_t *bytes, size_t size) {
  const up_events_t frames = reporter->decoder.frames;

  up_decoder_feed(&reporter->decoder, bytes, size);
  if (reporter->decoder.frames != frames) {
    note_heard(reporter);
  }
}

static void take_bytes(up_reporter_t *reporter, const uint8_t *bytes, size_t size) {
  UP_ROM up_reporter_config_t *config = config_of(reporter);
  size_t i;

  if (config->intercept == NULL) {
    take(reporter, bytes, size);
    return;
  }
  for (i = 0U; i < size; i++) {
    if (!up_decoder_is_idle(&reporter->decoder) || !config->intercept(config->context, bytes[i])) {
      take(reporter, &bytes[i], 1U);
    }
  }
}

bool up_reporter_peek(up_reporter_t *reporter, uint8_t byte) {
  const up_events_t frames = reporter->decoder.frames;

  take(reporter, &byte, 1U);
  return reporter->decoder.frames != frames && (reporter->hello_due || reporter->health_due);
}
#else
static bool begin(up_reporter_t *reporter) {
  (void)reporter;
  return true;
}

static bool take(up_reporter_t *reporter, uint8_t byte) {
  const up_request_t request = up_request_take(&reporter->requests, config_of(reporter)->commands, byte);

  if (request == UP_REQUEST_NONE) {
    return false;
  }
  if (request == UP_REQUEST_HELLO) {
    reporter->hello_due = true;
  } else if (has_health(reporter)) {
    reporter->health_due = true;
  }
  note_heard(reporter);
  return true;
}

static void take_bytes(up_reporter_t *reporter, const uint8_t *bytes, size_t size) {
  size_t i;

  for (i = 0U; i < size; i++) {
    (void)take(reporter, bytes[i]);
  }
}

bool up_reporter_peek(up_reporter_t *reporter, uint8_t byte) {
  return take(reporter, byte) && (reporter->hello_due || reporter->health_due);
}
#endif

static void receive(up_reporter_t *reporter) {
  UP_ROM up_channel_t *channel = config_of(reporter)->channel;
  uint8_t bytes[UP_REPORTER_READ_BYTES];
  size_t size = sizeof bytes;
  unsigned reads;

  for (reads = 0U; reads < READS_MAX && size == sizeof bytes; reads++) {
    size = channel->read(channel->context, bytes, sizeof bytes);
    take_bytes(reporter, bytes, size);
  }
}

/* ---- to the host ---- */

/* Gives up the frame that is being sent; the values of a report become due again. */
static void give_up(up_reporter_t *reporter) {
  if (reporter->frame_size == 0U) {
    return;
  }
  reporter->counts.frames_torn++;
  reporter->frame_size = 0U;
  if (reporter->is_report) {
    lock(reporter);
    up_report_restore(config_of(reporter)->store, reporter->taken);
    unlock(reporter);
  }
}

/* Sends as much as there is room for; true if nothing is left to send. */
static bool push(up_reporter_t *reporter) {
  UP_ROM up_channel_t *channel = config_of(reporter)->channel;
  const size_t left = reporter->frame_size - reporter->frame_sent;
  size_t size;

  if (reporter->frame_size == 0U) {
    return true;
  }
  size = channel->room(channel->context);
  size = (size < left) ? size : left;
  if (size > 0U) {
    size = channel->write(channel->context, &config_of(reporter)->frame[reporter->frame_sent], size);
    if (size == 0U) {
      give_up(reporter);
      return false;
    }
  }
  reporter->frame_sent += size;
  if (size < left) {
    return false;
  }
  reporter->frame_size = 0U;
  reporter->counts.reports_sent += reporter->is_report ? 1U : 0U;
  return true;
}

static void send(up_reporter_t *reporter, size_t size, bool is_report) {
  reporter->frame_size = size;
  reporter->frame_sent = 0U;
  reporter->is_report = is_report;
  (void)push(reporter);
}

static void send_hello(up_reporter_t *reporter) {
  UP_ROM up_reporter_config_t *config = config_of(reporter);

  reporter->hello_due = false;
  send(reporter, up_encode_hello(config->reports, config->frame, config->frame_bytes), false);
}

static void row_of(void *context, size_t field, up_health_row_t *row) {
  const up_reporter_t *reporter = context;

  up_health_row(config_of(reporter)->health, field, reporter->now_ms, row);
}

static void send_health(up_reporter_t *reporter) {
  UP_ROM up_reporter_config_t *config = config_of(reporter);
  up_health_board_t board;
  size_t size;

  reporter->health_due = false;
  memset(&board, 0, sizeof board);
  board.uptime_ms = reporter->now_ms;
  board.reports_sent = reporter->counts.reports_sent;
  board.reports_refused = reporter->counts.reports_refused;
  board.load_percent = UP_LOAD_UNKNOWN;
  board.stack_left_bytes = UP_STACK_UNKNOWN;
  if (config->describe != NULL) {
    config->describe(config->context, &board);
  }
  lock(reporter);
  size = up_encode_health(config->reports, &board, row_of, reporter, config->frame, config->frame_bytes);
  unlock(reporter);
  send(reporter, size, false);
}

/* Whether a value has waited too long for room in the channel without a newer reading: for more than two of its
 * device's cycles, or of the reporter's. */
static bool is_old(const up_reporter_t *reporter, size_t field) {
  const up_health_t *health = config_of(reporter)->health;
  const uint32_t own_ms = (health->cycles_ms == UP_ROM_NULL) ? 0U : health->cycles_ms[field];
  const uint32_t cycle_ms = (own_ms > config_of(reporter)->cycle_ms) ? own_ms : config_of(reporter)->cycle_ms;
  const uint32_t age_ms = up_health_age(health, field, reporter->now_ms);

  return own_ms != 0U && age_ms != UP_AGE_NEVER && age_ms > cycle_ms && age_ms - cycle_ms > cycle_ms;
}

static void drop_old(up_reporter_t *reporter) {
  up_store_t *store = config_of(reporter)->store;
  size_t i;

  for (i = 0U; i < config_of(reporter)->schema->fields_count; i++) {
    if (up_bit_get(store->due, i) && is_old(reporter, i)) {
      up_report_forget(store, i);
      reporter->counts.values_dropped++;
    }
  }
}

static void send_report(up_reporter_t *reporter, uint32_t now_us) {
  UP_ROM up_reporter_config_t *config = config_of(reporter);
  const up_stamp_t stamp = {now_us, reporter->counter};
  size_t size;

  lock(reporter);
  if (has_health(reporter)) {
    drop_old(reporter);
  }
  size = up_report_take(config->store, config->reports, &stamp, config->frame, config->frame_bytes, reporter->taken);
  unlock(reporter);
  if (size > 0U) {
    reporter->counter++;
    send(reporter, size, true);
  }
}

/* Answers the host's requests; true if an answer is on its way. */
static bool answer(up_reporter_t *reporter) {
  if (reporter->hello_due) {
    send_hello(reporter);
  } else if (UP_USES_HEALTH && reporter->health_due) {
    send_health(reporter);
  } else {
    return false;
  }
  return true;
}

/* Sends one frame at a time, so that none waits for another; answers and reports take turns. */
static void transmit(up_reporter_t *reporter, uint32_t now_us) {
  UP_ROM up_reporter_config_t *config = config_of(reporter);
  UP_ROM up_channel_t *channel = config->channel;

  if (push(reporter) && channel->room(channel->context) >= channel->room_max) {
    reporter->has_answered = !reporter->has_answered && answer(reporter);
    if (!reporter->has_answered) {
      send_report(reporter, now_us);
      return;
    }
  }
  lock(reporter);
  reporter->counts.reports_refused += up_report_is_due(config->store) ? 1U : 0U;
  unlock(reporter);
}

/* ---- the cycle ---- */

bool up_reporter_init(up_reporter_t *reporter, UP_ROM up_reporter_config_t *config, uint32_t now_ms) {
  memset(reporter, 0, sizeof *reporter);
  reporter->config = config;
  reporter->now_ms = now_ms;
  if (config->silence_ms > 0U) {
    up_silence_init(&reporter->silence, config->silence_ms, now_ms);
  }
  return begin(reporter) && config->frame_bytes >= UP_WIRE_FRAME_BYTES(config->reports);
}

/* Updates the state at the start of a cycle, whoever uses the channel; `is_open`: frames may use it. */
static void begin_cycle(up_reporter_t *reporter, uint32_t now_ms, bool is_open) {
  reporter->now_ms = now_ms;
  if (has_health(reporter)) {
    lock(reporter);
    up_health_tick(config_of(reporter)->health, reporter->now_ms);
    unlock(reporter);
  }
  if (!is_open) {
    give_up(reporter);
  }
  reporter->hello_due = reporter->hello_due || (is_open && !reporter->is_open);
  reporter->is_open = is_open;
}

static void fall_back(up_reporter_t *reporter) {
  UP_ROM up_reporter_config_t *config = config_of(reporter);

  if (config->silence_ms > 0U && up_silence_step(&reporter->silence, reporter->now_ms) &&
      config->failsafe != NULL) {
    config->failsafe(config->context);
  }
}

void up_reporter_listen(up_reporter_t *reporter, uint32_t now_ms) {
  reporter->now_ms = now_ms;
  receive(reporter);
  (void)push(reporter);
}

void up_reporter_cycle(up_reporter_t *reporter, uint32_t now_ms, uint32_t now_us) {
  UP_ROM up_channel_t *channel = config_of(reporter)->channel;

  begin_cycle(reporter, now_ms, channel->is_open(channel->context));
  if (reporter->is_open) {
    receive(reporter);
  }
  fall_back(reporter);
  if (reporter->is_open) {
    transmit(reporter, now_us);
  }
}

void up_reporter_pause(up_reporter_t *reporter, uint32_t now_ms) {
  begin_cycle(reporter, now_ms, false);
  fall_back(reporter);
}
