/*
 * What a board sends and receives: its fields, their types, their places in the value buffer.
 *
 * A schema is a constant table that a generator prints; nothing here allocates or depends on an operating system.
 * Values are kept in machine representation (so that C code reads them as plain struct members) and are converted to
 * network byte order only when a frame is packed.
 */
#ifndef UP_SCHEMA_H
#define UP_SCHEMA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "up_rom.h"
#include "up_uses.h"

/* Identifiers that belong to the link itself. */
#define UP_ID_HELLO 0U
#define UP_ID_HEALTH 255U /* as the first byte of a payload */
#define UP_ID_CHECKSUM 255U

/* A schema has at most one field for each identifier 1..254. */
#define UP_FIELDS_MAX 254U

/* The size of a bitmap with a bit for each field, by its index. A program may have as many as its schema needs: an
 * eighth of its fields, rounded up. */
#ifndef UP_FIELD_BITMAP_BYTES
#define UP_FIELD_BITMAP_BYTES 32U
#endif

/* The size of the longest payload: its length has at most four digits. */
#define UP_PAYLOAD_BYTES_LIMIT 9999U

typedef enum {
  UP_TYPE_BOOL,
  UP_TYPE_UINT8,
  UP_TYPE_INT8,
  UP_TYPE_UINT16,
  UP_TYPE_INT16,
  UP_TYPE_UINT32,
  UP_TYPE_INT32,
  UP_TYPE_UINT64,
  UP_TYPE_INT64,
  UP_TYPE_FLOAT32,
  UP_TYPE_FLOAT64
} up_type_t;

/* The widest integers that fields of the program have. */
#if UP_USES_WIDE
typedef uint64_t up_unsigned_t;
typedef int64_t up_signed_t;
#define UP_UNSIGNED_MAX UINT64_MAX
#define UP_SIGNED_MAX INT64_MAX
#else
typedef uint32_t up_unsigned_t;
typedef int32_t up_signed_t;
#define UP_UNSIGNED_MAX UINT32_MAX
#define UP_SIGNED_MAX INT32_MAX
#endif
#define UP_UNSIGNED_BITS (8U * sizeof(up_unsigned_t))

/* The direction in which a field or a frame travels. */
typedef enum {
  UP_TO_HOST, /* from sensors: board to host */
  UP_TO_BOARD /* to actuators: host to board */
} up_direction_t;

/* One field: an identifier and the place of its value. */
typedef struct {
  UP_ROM char *name; /* as written by the user; only for people */
  uint8_t id;        /* 1..254 */
  uint8_t type;      /* up_type_t */
  uint8_t direction; /* up_direction_t */
  bool is_array;     /* an array of one element is not a scalar: the schema's text distinguishes them */
  uint16_t count;    /* number of elements; 1 for a scalar */
  uint16_t offset;   /* bytes from the start of the value buffer */
} up_field_t;

/* All fields of a board in the order of the user's file, and the properties of the link. */
typedef struct {
  UP_ROM up_field_t *fields;
  uint8_t fields_count;
  UP_ROM char *checksum; /* `none`, or the checksum at the end of payloads */
  uint32_t hash;         /* the hash that the hello carries */
} up_schema_t;

/* The size of one element, on the wire and in memory. */
size_t up_type_bytes(uint8_t type);

/* The type's name in the language and in the schema's text. */
UP_ROM char *up_type_name(uint8_t type);

/* The bits of one element in memory (which need not be aligned), as an unsigned number of its size. */
up_unsigned_t up_element_load(uint8_t type, const void *element);
void up_element_store(uint8_t type, up_unsigned_t bits, void *element);

/* The size of a whole value. */
size_t up_field_bytes(UP_ROM up_field_t *field);

/* The field with this identifier in this direction, or NULL. */
UP_ROM up_field_t *up_schema_find(UP_ROM up_schema_t *schema, uint8_t id, up_direction_t direction);

#endif
