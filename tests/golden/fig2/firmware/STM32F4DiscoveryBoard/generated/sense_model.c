/* Written by SenseDSL: the schema of the link of STM32F4DiscoveryBoard. */
#include "sense_model.h"

sense_values_t sense_values;

static UP_ROM char name_0[] = "IRFront";
static UP_ROM char name_1[] = "IRFrontRight";
static UP_ROM char name_2[] = "USRear";
static UP_ROM char name_3[] = "WheelEncoder";

static UP_ROM up_field_t fields[] = {
    {
        .name = name_0,
        .id = 17U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_IRFront),
    },
    {
        .name = name_1,
        .id = 18U,
        .type = UP_TYPE_UINT16,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_IRFrontRight),
    },
    {
        .name = name_2,
        .id = 19U,
        .type = UP_TYPE_UINT8,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_USRear),
    },
    {
        .name = name_3,
        .id = 20U,
        .type = UP_TYPE_UINT32,
        .direction = UP_TO_HOST,
        .count = 1U,
        .offset = (uint16_t)offsetof(sense_values_t, SENSE_WheelEncoder),
    },
};

static UP_ROM char checksum[] = "none";

UP_ROM up_schema_t sense_schema = {
    .fields = fields,
    .fields_count = 4U,
    .checksum = checksum,
    .hash = 0xb2d2a70bU,
};

/* ---- transforms that the user did not define ---- */

__attribute__((weak)) void sense_transform_IRFront(uint16_t *value) {
  (void)value;
}

static void transform_0(void *value) {
  sense_transform_IRFront(value);
}

__attribute__((weak)) void sense_transform_IRFrontRight(uint16_t *value) {
  (void)value;
}

static void transform_1(void *value) {
  sense_transform_IRFrontRight(value);
}

__attribute__((weak)) void sense_transform_USRear(uint8_t *value) {
  (void)value;
}

static void transform_2(void *value) {
  sense_transform_USRear(value);
}

__attribute__((weak)) void sense_transform_WheelEncoder(uint32_t *value) {
  (void)value;
}

static void transform_3(void *value) {
  sense_transform_WheelEncoder(value);
}

void (*UP_ROM sense_transforms[])(void *value) = {
    transform_0,
    transform_1,
    transform_2,
    transform_3,
};
