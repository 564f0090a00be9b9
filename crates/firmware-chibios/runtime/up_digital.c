/* Levels of pins: outputs, inputs that a thread reads each cycle, and inputs whose edges interrupt. */
#include "up_digital.h"
#include "up_rt.h"

static uint32_t ticks_now(void) {
  return (uint32_t)chVTGetTimeStampI();
}

static bool level_of(const up_digital_input_t *input) {
  return palReadLine(input->line) == PAL_HIGH;
}

/* ---- outputs ---- */

void up_digital_set(const up_digital_output_t *output, const void *value) {
  const uint8_t type = up_config.schema->fields[output->field].type;
  const size_t element_bytes = up_type_bytes(type);
  const uint8_t *elements = value;
  uint8_t i;

  chSysLock();
  for (i = 0U; i < output->lines_count; i++) {
    const bool is_on = up_element_load(type, &elements[i * element_bytes]) != 0U;

    palWriteLine(output->lines[i], (is_on != output->is_low_active) ? PAL_HIGH : PAL_LOW);
  }
  chSysUnlock();
}

/* ---- inputs ---- */

void up_digital_look(const up_digital_t *sensor) {
  uint8_t i;

  chSysLock();
  for (i = 0U; i < sensor->inputs_count; i++) {
    const up_digital_input_t *input = &sensor->inputs[i];

    up_contact_sample(input->config, &input->state->contact, level_of(input), ticks_now());
  }
  chSysUnlock();
}

static void read_levels(const up_digital_t *sensor, uint8_t type) {
  const size_t element_bytes = up_type_bytes(type);
  uint8_t *value = (uint8_t *)sensor->value;
  uint8_t i;

  chSysLock();
  for (i = 0U; i < sensor->inputs_count; i++) {
    const up_digital_input_t *input = &sensor->inputs[i];
    const bool is_high = (input->state != NULL) ? input->state->contact.level : level_of(input);

    up_element_store(type, (is_high != sensor->is_low_active) ? 1U : 0U, &value[i * element_bytes]);
  }
  chSysUnlock();
}

void up_digital_cycle(const void *work) {
  const up_digital_class_t *own = work;
  uint8_t i;

  for (i = 0U; i < own->sensors_count; i++) {
    const up_digital_t *sensor = &own->sensors[i];

    read_levels(sensor, up_config.schema->fields[sensor->field].type);
    up_result(sensor->field, UP_FRESH, sensor->value);
  }
}

#if PAL_USE_CALLBACKS == TRUE

static void on_edge(void *argument) {
  const up_digital_input_t *input = argument;

  chSysLockFromISR();
  up_contact_on_edge(input->config, &input->state->contact, level_of(input), ticks_now());
  chSysUnlockFromISR();
}

static ioeventmode_t edges_of(const up_contact_config_t *config) {
  if (config->lasting > 0U || config->edge == UP_EDGE_BOTH) {
    return PAL_EVENT_MODE_BOTH_EDGES;
  }
  return (config->edge == UP_EDGE_RISING) ? PAL_EVENT_MODE_RISING_EDGE : PAL_EVENT_MODE_FALLING_EDGE;
}

void up_digital_start(const up_digital_t *sensor) {
  uint8_t i;

  up_digital_look(sensor);
  for (i = 0U; i < sensor->inputs_count; i++) {
    const up_digital_input_t *input = &sensor->inputs[i];

    /* The argument is a const table, but the driver's signature has only void pointers. */
    palSetLineCallback(input->line, on_edge, (void *)(uintptr_t)input);
    palEnableLineEvent(input->line, edges_of(input->config));
  }
}

/* Takes a level or a count; true if it is new. */
static bool take(const up_digital_t *sensor, const up_digital_input_t *input, uint8_t type, void *element) {
  up_contact_report_t *reported = &input->state->reported;
  up_contact_t contact;
  bool is_news;

  chSysLock();
  up_contact_look(input->config, &input->state->contact, level_of(input), ticks_now());
  contact = input->state->contact;
  chSysUnlock();
  if (type == UP_TYPE_BOOL) {
    is_news = up_contact_report(input->config, &contact, reported);
    up_element_store(type, (reported->level != sensor->is_low_active) ? 1U : 0U, element);
  } else {
    is_news = contact.edges != reported->edges;
    reported->edges = contact.edges;
    up_count_store(type, (up_signed_t)contact.edges, element);
  }
  return is_news;
}

void up_digital_poll(const up_digital_t *sensor) {
  const uint8_t type = up_config.schema->fields[sensor->field].type;
  const size_t element_bytes = up_type_bytes(type);
  uint8_t *value = (uint8_t *)sensor->value;
  bool is_news = false;
  uint8_t i;

  for (i = 0U; i < sensor->inputs_count; i++) {
    is_news = take(sensor, &sensor->inputs[i], type, &value[i * element_bytes]) || is_news;
  }
  if (up_repeat_is_due(sensor->repeat, is_news, sensor->repeat_ms, up_now_ms())) {
    up_result(sensor->field, UP_FRESH, value);
  }
}

#endif
