/* Written by SenseDSL: the schema of the link of STM32F4DiscoveryBoard. */
#include "sense_model.h"

sense_values_t sense_values;

static UP_ROM char name_0[] = "IRFrontRight";
static UP_ROM char name_1[] = "IRRearRight";
static UP_ROM char name_2[] = "IRRear";
static UP_ROM char name_3[] = "USFront";
static UP_ROM char name_4[] = "USFrontRight";
static UP_ROM char name_5[] = "USRear";
static UP_ROM char name_6[] = "WheelLeftA";
static UP_ROM char name_7[] = "WheelLeftB";
static UP_ROM char name_8[] = "WheelRightA";
static UP_ROM char name_9[] = "WheelRightB";
static UP_ROM char name_10[] = "RCSteering";
static UP_ROM char name_11[] = "RCThrottle";
static UP_ROM char name_12[] = "RCSwitch";

static UP_ROM up_field_t fields[] = {
    {
        .name = name_0,
        .id = 1U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_IRFrontRight),
    },
    {
        .name = name_1,
        .id = 2U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_IRRearRight),
    },
    {
        .name = name_2,
        .id = 3U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_IRRear),
    },
    {
        .name = name_3,
        .id = 4U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_USFront),
    },
    {
        .name = name_4,
        .id = 5U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_USFrontRight),
    },
    {
        .name = name_5,
        .id = 6U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_USRear),
    },
    {
        .name = name_6,
        .id = 7U,
        .type = UP_TYPE_UINT32,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_WheelLeftA),
    },
    {
        .name = name_7,
        .id = 8U,
        .type = UP_TYPE_UINT32,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_WheelLeftB),
    },
    {
        .name = name_8,
        .id = 9U,
        .type = UP_TYPE_UINT32,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_WheelRightA),
    },
    {
        .name = name_9,
        .id = 10U,
        .type = UP_TYPE_UINT32,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_WheelRightB),
    },
    {
        .name = name_10,
        .id = 11U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_RCSteering),
    },
    {
        .name = name_11,
        .id = 12U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_RCThrottle),
    },
    {
        .name = name_12,
        .id = 13U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_RCSwitch),
    },
};

static UP_ROM char checksum[] = "none";

UP_ROM up_schema_t sense_schema = {
    .fields = fields,
    .fields_count = 13U,
    .checksum = checksum,
    .hash = 0x64783683U,
};

/* ---- transforms that the user did not define ---- */

__attribute__((weak)) void sense_transform_IRFrontRight(uint16_t *value) {
  (void)value;
}

static void transform_0(void *value) {
  sense_transform_IRFrontRight(value);
}

__attribute__((weak)) void sense_transform_IRRearRight(uint16_t *value) {
  (void)value;
}

static void transform_1(void *value) {
  sense_transform_IRRearRight(value);
}

__attribute__((weak)) void sense_transform_IRRear(uint16_t *value) {
  (void)value;
}

static void transform_2(void *value) {
  sense_transform_IRRear(value);
}

__attribute__((weak)) void sense_transform_USFront(uint16_t *value) {
  (void)value;
}

static void transform_3(void *value) {
  sense_transform_USFront(value);
}

__attribute__((weak)) void sense_transform_USFrontRight(uint16_t *value) {
  (void)value;
}

static void transform_4(void *value) {
  sense_transform_USFrontRight(value);
}

__attribute__((weak)) void sense_transform_USRear(uint16_t *value) {
  (void)value;
}

static void transform_5(void *value) {
  sense_transform_USRear(value);
}

__attribute__((weak)) void sense_transform_WheelLeftA(uint32_t *value) {
  (void)value;
}

static void transform_6(void *value) {
  sense_transform_WheelLeftA(value);
}

__attribute__((weak)) void sense_transform_WheelLeftB(uint32_t *value) {
  (void)value;
}

static void transform_7(void *value) {
  sense_transform_WheelLeftB(value);
}

__attribute__((weak)) void sense_transform_WheelRightA(uint32_t *value) {
  (void)value;
}

static void transform_8(void *value) {
  sense_transform_WheelRightA(value);
}

__attribute__((weak)) void sense_transform_WheelRightB(uint32_t *value) {
  (void)value;
}

static void transform_9(void *value) {
  sense_transform_WheelRightB(value);
}

__attribute__((weak)) void sense_transform_RCSteering(uint16_t *value) {
  (void)value;
}

static void transform_10(void *value) {
  sense_transform_RCSteering(value);
}

__attribute__((weak)) void sense_transform_RCThrottle(uint16_t *value) {
  (void)value;
}

static void transform_11(void *value) {
  sense_transform_RCThrottle(value);
}

__attribute__((weak)) void sense_transform_RCSwitch(uint16_t *value) {
  (void)value;
}

static void transform_12(void *value) {
  sense_transform_RCSwitch(value);
}

void (*UP_ROM sense_transforms[])(void *value) = {
    transform_0,
    transform_1,
    transform_2,
    transform_3,
    transform_4,
    transform_5,
    transform_6,
    transform_7,
    transform_8,
    transform_9,
    transform_10,
    transform_11,
    transform_12,
};
