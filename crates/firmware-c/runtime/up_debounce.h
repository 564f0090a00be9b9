/*
 * A wire with a contact: its debounced level, the edges that count, and pulses between two looks.
 *
 * Both interrupts and cyclic polling report what they see; the caller serialises them. Time is a number that wraps at
 * 2^32, in any unit, and levels are those of the wire.
 */
#ifndef UP_DEBOUNCE_H
#define UP_DEBOUNCE_H

#include <stdbool.h>
#include <stdint.h>

#include "up_rom.h"

typedef enum {
  UP_EDGE_RISING,
  UP_EDGE_FALLING,
  UP_EDGE_BOTH
} up_edge_t;

typedef struct {
  uint32_t lasting; /* how long a change must last to count; 0: it counts at once */
  uint8_t edge;     /* up_edge_t: the edges that count */
} up_contact_config_t;

/* All zero at the start. */
typedef struct {
  uint32_t since; /* time of the last change seen */
  uint32_t edges; /* the edges that count; wraps */
  bool has_level;
  bool seen;  /* the level last seen */
  bool level; /* the level after debouncing */
} up_contact_t;

/* An interrupt came and found this level. Without `lasting`, only edges that count may interrupt; with it, both
 * edges must. */
void up_contact_on_edge(UP_ROM up_contact_config_t *config, up_contact_t *contact, bool level, uint32_t now);

/* The wire was polled; this must happen often enough to see a level last. */
void up_contact_look(UP_ROM up_contact_config_t *config, up_contact_t *contact, bool level, uint32_t now);

/* The wire was polled, and there are no interrupts: a level that differs from the last one has not lasted until now. */
void up_contact_sample(UP_ROM up_contact_config_t *config, up_contact_t *contact, bool level, uint32_t now);

/* The last report of a contact. All zero at the start. */
typedef struct {
  uint32_t edges;
  bool level;
  bool has_reported;
} up_contact_report_t;

/* True if there is a level to report, in reported->level: one that differs from the last, or that of a pulse that came
 * and went since the last call; the present level is then reported by the next call. */
bool up_contact_report(UP_ROM up_contact_config_t *config, const up_contact_t *contact, up_contact_report_t *reported);

#endif
