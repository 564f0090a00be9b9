/*
 * The latest value of every field, and which of them must still be reported to the host.
 *
 * A field becomes due each time it is read (or received), and is reported once; so a payload contains exactly what is
 * due, in the order of the table, and never a zero that nobody measured. None of these functions locks: the caller
 * serialises them if several threads share a store.
 */
#ifndef UP_REPORT_H
#define UP_REPORT_H

#include "up_encode.h"

typedef struct {
  UP_ROM up_schema_t *schema;
  void *values;                         /* the value buffer of the schema's offsets */
  uint8_t due[UP_FIELD_BITMAP_BYTES];   /* read since the last report */
  uint8_t known[UP_FIELD_BITMAP_BYTES]; /* read at least once */
} up_store_t;

void up_store_init(up_store_t *store, UP_ROM up_schema_t *schema, void *values);

/* Stores the value of fields[index] and makes it due. */
void up_store_put(up_store_t *store, size_t index, const void *value);

/* The value of fields[index]; NULL until it was first read. */
const void *up_store_get(const up_store_t *store, size_t index);

/* Whether anything is due for the host. */
bool up_report_is_due(const up_store_t *store);

/* Makes fields[index] no longer due. */
void up_report_forget(up_store_t *store, size_t index);

/* Packs what is due for the host and makes it no longer due; `taken` (UP_FIELD_BITMAP_BYTES) gets the fields.
 * Returns the size of the frame, 0 if nothing is due. */
size_t up_report_take(up_store_t *store, UP_ROM up_wire_t *wire, const up_stamp_t *stamp, uint8_t *frame,
                      size_t frame_bytes, uint8_t *taken);

/* Makes fields due again after their frame could not be sent. */
void up_report_restore(up_store_t *store, const uint8_t *taken);

#endif
