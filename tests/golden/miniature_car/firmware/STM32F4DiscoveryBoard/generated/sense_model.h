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
  uint16_t SENSE_IRFrontRight;
  uint16_t SENSE_IRRearRight;
  uint16_t SENSE_IRRear;
  uint16_t SENSE_USFront;
  uint16_t SENSE_USFrontRight;
  uint16_t SENSE_USRear;
  uint32_t SENSE_WheelLeftA;
  uint32_t SENSE_WheelLeftB;
  uint32_t SENSE_WheelRightA;
  uint32_t SENSE_WheelRightB;
  uint16_t SENSE_RCSteering;
  uint16_t SENSE_RCThrottle;
  uint16_t SENSE_RCSwitch;
} sense_values_t;

/* Places in the schema, for up_get() and up_user_received(). */
enum {
  SENSE_FIELD_IRFrontRight = 0,
  SENSE_FIELD_IRRearRight = 1,
  SENSE_FIELD_IRRear = 2,
  SENSE_FIELD_USFront = 3,
  SENSE_FIELD_USFrontRight = 4,
  SENSE_FIELD_USRear = 5,
  SENSE_FIELD_WheelLeftA = 6,
  SENSE_FIELD_WheelLeftB = 7,
  SENSE_FIELD_WheelRightA = 8,
  SENSE_FIELD_WheelRightB = 9,
  SENSE_FIELD_RCSteering = 10,
  SENSE_FIELD_RCThrottle = 11,
  SENSE_FIELD_RCSwitch = 12
};

extern sense_values_t sense_values;
extern UP_ROM up_schema_t sense_schema;

/* The wire, and the bytes of its longest frames and of the buffers of decoders. */
extern UP_ROM up_wire_t sense_reports;
#define SENSE_REPORT_FRAME_BYTES 245U
extern UP_ROM up_wire_t sense_commands;
#define SENSE_COMMAND_FRAME_BYTES 5U
#define SENSE_COMMAND_BUFFER_BYTES (2U * 5U)

extern void (*UP_ROM sense_transforms[])(void *value);

/* Your own arithmetic on a value before it is stored and reported: define any of these in user/ and change
 * `*value`. They run in the thread that read the value. */
void sense_transform_IRFrontRight(uint16_t *value);
void sense_transform_IRRearRight(uint16_t *value);
void sense_transform_IRRear(uint16_t *value);
void sense_transform_USFront(uint16_t *value);
void sense_transform_USFrontRight(uint16_t *value);
void sense_transform_USRear(uint16_t *value);
void sense_transform_WheelLeftA(uint32_t *value);
void sense_transform_WheelLeftB(uint32_t *value);
void sense_transform_WheelRightA(uint32_t *value);
void sense_transform_WheelRightB(uint32_t *value);
void sense_transform_RCSteering(uint16_t *value);
void sense_transform_RCThrottle(uint16_t *value);
void sense_transform_RCSwitch(uint16_t *value);

#endif
