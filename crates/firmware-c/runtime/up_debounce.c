#include "up_debounce.h"

static bool counts(UP_ROM up_contact_config_t *config, bool level) {
  return config->edge == UP_EDGE_BOTH || (config->edge == UP_EDGE_RISING) == level;
}

/* The level seen before has lasted until now. */
static void settle(UP_ROM up_contact_config_t *config, up_contact_t *contact, uint32_t now) {
  if (contact->seen != contact->level && (uint32_t)(now - contact->since) >= config->lasting) {
    contact->level = contact->seen;
    if (counts(config, contact->level)) {
      contact->edges++;
    }
  }
}

static void begin(up_contact_t *contact, bool level, uint32_t now) {
  contact->has_level = true;
  contact->seen = level;
  contact->level = level;
  contact->since = now;
}

void up_contact_on_edge(UP_ROM up_contact_config_t *config, up_contact_t *contact, bool level, uint32_t now) {
  if (config->lasting == 0U) {
    begin(contact, level, now);
    contact->edges++;
    return;
  }
  if (!contact->has_level) {
    begin(contact, level, now);
  }
  settle(config, contact, now);
  /* The level may have changed back already; it has changed all the same. */
  contact->seen = level;
  contact->since = now;
}

void up_contact_look(UP_ROM up_contact_config_t *config, up_contact_t *contact, bool level, uint32_t now) {
  if (!contact->has_level || config->lasting == 0U) {
    begin(contact, level, now);
    return;
  }
  settle(config, contact, now);
  if (level != contact->seen) {
    contact->seen = level;
    contact->since = now;
  }
}

void up_contact_sample(UP_ROM up_contact_config_t *config, up_contact_t *contact, bool level, uint32_t now) {
  if (contact->has_level && config->lasting > 0U && level != contact->seen) {
    contact->seen = level;
    contact->since = now;
    return;
  }
  up_contact_look(config, contact, level, now);
}

bool up_contact_report(UP_ROM up_contact_config_t *config, const up_contact_t *contact, up_contact_report_t *reported) {
  const bool has_edge = contact->edges != reported->edges;

  reported->edges = contact->edges;
  if (!reported->has_reported || contact->level != reported->level) {
    reported->has_reported = true;
    reported->level = contact->level;
    return true;
  }
  if (has_edge && counts(config, !reported->level)) {
    reported->level = !reported->level;
    return true;
  }
  return false;
}
