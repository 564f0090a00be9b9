/*
 * A wire with a contact behind it: its level once that has lasted, edges that count, and pulses that nobody saw.
 *
 * Interrupts and the look of a cycle both tell what they see; whoever calls serialises them. Time is a number that
 * wraps at 2^32, in any unit, and levels are those of the wire.
 */
#ifndef UP_DEBOUNCE_H
#define UP_DEBOUNCE_H

#include <stdbool.h>
#include <stdint.h>

typedef enum {
  UP_EDGE_RISING,
  UP_EDGE_FALLING,
  UP_EDGE_BOTH
} up_edge_t;

typedef struct {
  uint32_t lasting; /* a change counts when it has lasted that long; 0: at once */
  uint8_t edge;     /* up_edge_t: the edges that count */
} up_contact_config_t;

/* All zero at the start. */
typedef struct {
  uint32_t since; /* when the wire was last seen to change */
  uint32_t edges; /* those that count; wraps */
  bool has_level;
  bool seen;  /* the level last seen */
  bool level; /* the one that has lasted */
} up_contact_t;

/* An interrupt came and this level was found. Without `lasting` only edges that count may interrupt, with it both. */
void up_contact_on_edge(const up_contact_config_t *config, up_contact_t *contact, bool level, uint32_t now);

/* The wire was looked at: often enough that what is to last is seen to last. */
void up_contact_look(const up_contact_config_t *config, up_contact_t *contact, bool level, uint32_t now);

/* The same where nothing interrupts: a level that is another one now has not lasted until now. */
void up_contact_sample(const up_contact_config_t *config, up_contact_t *contact, bool level, uint32_t now);

/* What was told of a contact. All zero at the start. */
typedef struct {
  uint32_t edges;
  bool level;
  bool has_told;
} up_contact_told_t;

/* True when there is a level to tell, in told->level: another than before; or that of a pulse which came and went since
 * the last look, and then the level that is comes with the next. */
bool up_contact_tell(const up_contact_config_t *config, const up_contact_t *contact, up_contact_told_t *told);

#endif
