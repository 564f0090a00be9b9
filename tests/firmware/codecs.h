/* The codecs that the generator has printed for the schemas of the vectors. */
#ifndef CODECS_H
#define CODECS_H

#include "up_wire.h"

typedef struct {
  const char *name;
  const up_schema_t *schema;
  const up_wire_t *reports;
  const up_wire_t *commands;
  size_t values_bytes;
} test_codec_t;

extern const test_codec_t test_codecs[];
extern const size_t test_codecs_count;

#endif
