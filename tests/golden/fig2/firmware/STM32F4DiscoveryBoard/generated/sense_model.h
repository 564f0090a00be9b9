/* Written by SenseDSL: the devices of STM32F4DiscoveryBoard and their values. */
#ifndef SENSE_MODEL_H
#define SENSE_MODEL_H

#include <stdbool.h>
#include <stdint.h>

#include "up_decode.h"
#include "up_schema.h"
#include "up_wire.h"

/* Latest values, in the order of the file; take them with up_get(), which does not mix two readings. */
typedef struct {
  uint16_t SENSE_IRFront;
  uint16_t SENSE_IRFrontRight;
  uint8_t SENSE_USRear;
  uint32_t SENSE_WheelEncoder;
} sense_values_t;

/* Places in the schema, for up_get() and up_user_received(). */
enum {
  SENSE_FIELD_IRFront = 0,
  SENSE_FIELD_IRFrontRight = 1,
  SENSE_FIELD_USRear = 2,
  SENSE_FIELD_WheelEncoder = 3
};

extern sense_values_t sense_values;
extern UP_ROM up_schema_t sense_schema;

/* The wire, and the bytes of its longest frames and of the buffers of decoders. */
extern UP_ROM up_wire_t sense_reports;
#define SENSE_REPORT_FRAME_BYTES 91U
extern UP_ROM up_wire_t sense_commands;
#define SENSE_COMMAND_FRAME_BYTES 5U
#define SENSE_COMMAND_BUFFER_BYTES (2U * 5U)

extern void (*UP_ROM sense_transforms[])(void *value);

/* Your own arithmetic on a value before it is stored and reported: define any of these in user/ and change
 * `*value`. They run in the thread that read the value. */
void sense_transform_IRFront(uint16_t *value);
void sense_transform_IRFrontRight(uint16_t *value);
void sense_transform_USRear(uint8_t *value);
void sense_transform_WheelEncoder(uint32_t *value);

#endif
