/* Written by SenseDSL: the wiring of STM32F4DiscoveryBoard as tables for the runtime. */
#include "sense_model.h"
#include "up_rt.h"
#include "up_adc.h"
#include "up_i2c_bus.h"
#include "up_icu.h"

/* ---- pads ---- */

static const up_pad_t pads[] = {
    /* PA1 */ {PAL_LINE(GPIOA, 1U), PAL_MODE_ALTERNATE(1), PAL_LOW},
    /* PA8 */ {PAL_LINE(GPIOA, 8U), PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN | PAL_STM32_PUPDR_PULLUP, PAL_LOW},
    /* PA11 */ {PAL_LINE(GPIOA, 11U), PAL_MODE_ALTERNATE(10) | PAL_STM32_OSPEED_HIGHEST, PAL_LOW},
    /* PA12 */ {PAL_LINE(GPIOA, 12U), PAL_MODE_ALTERNATE(10) | PAL_STM32_OSPEED_HIGHEST, PAL_LOW},
    /* PB0 */ {PAL_LINE(GPIOB, 0U), PAL_MODE_INPUT_ANALOG, PAL_LOW},
    /* PB1 */ {PAL_LINE(GPIOB, 1U), PAL_MODE_INPUT_ANALOG, PAL_LOW},
    /* PB4 */ {PAL_LINE(GPIOB, 4U), PAL_MODE_ALTERNATE(2), PAL_LOW},
    /* PB7 */ {PAL_LINE(GPIOB, 7U), PAL_MODE_ALTERNATE(2), PAL_LOW},
    /* PB14 */ {PAL_LINE(GPIOB, 14U), PAL_MODE_ALTERNATE(9), PAL_LOW},
    /* PC1 */ {PAL_LINE(GPIOC, 1U), PAL_MODE_INPUT_ANALOG, PAL_LOW},
    /* PC6 */ {PAL_LINE(GPIOC, 6U), PAL_MODE_ALTERNATE(3), PAL_LOW},
    /* PC9 */ {PAL_LINE(GPIOC, 9U), PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN | PAL_STM32_PUPDR_PULLUP, PAL_LOW},
    /* PE5 */ {PAL_LINE(GPIOE, 5U), PAL_MODE_ALTERNATE(3), PAL_LOW},
    /* PE9 */ {PAL_LINE(GPIOE, 9U), PAL_MODE_ALTERNATE(1), PAL_LOW},
};

/* ---- USFront: srf08 ---- */

static UP_ROM uint8_t us_front_trigger_0[] = {0x00U, 0x51U};
static UP_ROM uint8_t us_front_select_0[] = {0x02U};
static UP_ROM up_chip_transfer_t us_front_transfers[] = {
    {
        .trigger = us_front_trigger_0,
        .trigger_count = 2U,
        .select = us_front_select_0,
        .select_count = 1U,
        .cycle_ms = 70U,
        .wait_ms = 65U,
        .length = 2U,
    },
};
static up_chip_transfer_state_t us_front_transfer_states[1];

static UP_ROM up_chip_reading_t us_front_readings[] = {
    {
        .field = SENSE_FIELD_USFront,
        .offset = 0U,
        .transfer = 0U,
        .value =
            {
                .code = UP_CODE_INTEGER,
                .word_bytes = 2U,
            },
    },
};

static UP_ROM up_chip_t us_front_chip = {
    .transfers = us_front_transfers,
    .transfers_count = 1U,
    .readings = us_front_readings,
    .readings_count = 1U,
    .cycle_ms = 70U,
    .address = 0x71U,
};
static UP_DMA_BUFFER uint8_t us_front_work[3];
static uint64_t us_front_scratch[1];
static up_chip_state_t us_front_chip_state = {
    .transfers = us_front_transfer_states,
    .work = us_front_work,
    .scratch = us_front_scratch,
};

static UP_ROM up_range_t us_front_invalid[] = {
    {.low.u = UINT64_C(0), .high.u = UINT64_C(0)},
};
static UP_ROM up_filter_t us_front_filter = {
    .invalid = us_front_invalid,
    .invalid_count = 1U,
    .median = 0U,
    .smooth_ms = 0U,
};
static up_filter_state_t us_front_filter_state = {
    .memory = NULL,
};

/* ---- USFrontRight: srf08 ---- */

static UP_ROM uint8_t us_front_right_trigger_0[] = {0x00U, 0x51U};
static UP_ROM uint8_t us_front_right_select_0[] = {0x02U};
static UP_ROM up_chip_transfer_t us_front_right_transfers[] = {
    {
        .trigger = us_front_right_trigger_0,
        .trigger_count = 2U,
        .select = us_front_right_select_0,
        .select_count = 1U,
        .cycle_ms = 70U,
        .wait_ms = 65U,
        .length = 2U,
    },
};
static up_chip_transfer_state_t us_front_right_transfer_states[1];

static UP_ROM up_chip_reading_t us_front_right_readings[] = {
    {
        .field = SENSE_FIELD_USFrontRight,
        .offset = 0U,
        .transfer = 0U,
        .value =
            {
                .code = UP_CODE_INTEGER,
                .word_bytes = 2U,
            },
    },
};

static UP_ROM up_chip_t us_front_right_chip = {
    .transfers = us_front_right_transfers,
    .transfers_count = 1U,
    .readings = us_front_right_readings,
    .readings_count = 1U,
    .cycle_ms = 70U,
    .address = 0x72U,
};
static UP_DMA_BUFFER uint8_t us_front_right_work[3];
static uint64_t us_front_right_scratch[1];
static up_chip_state_t us_front_right_chip_state = {
    .transfers = us_front_right_transfer_states,
    .work = us_front_right_work,
    .scratch = us_front_right_scratch,
};

static UP_ROM up_range_t us_front_right_invalid[] = {
    {.low.u = UINT64_C(0), .high.u = UINT64_C(0)},
};
static UP_ROM up_filter_t us_front_right_filter = {
    .invalid = us_front_right_invalid,
    .invalid_count = 1U,
    .median = 0U,
    .smooth_ms = 0U,
};
static up_filter_state_t us_front_right_filter_state = {
    .memory = NULL,
};

/* ---- USRear: srf08 ---- */

static UP_ROM uint8_t us_rear_trigger_0[] = {0x00U, 0x51U};
static UP_ROM uint8_t us_rear_select_0[] = {0x02U};
static UP_ROM up_chip_transfer_t us_rear_transfers[] = {
    {
        .trigger = us_rear_trigger_0,
        .trigger_count = 2U,
        .select = us_rear_select_0,
        .select_count = 1U,
        .cycle_ms = 70U,
        .wait_ms = 65U,
        .length = 2U,
    },
};
static up_chip_transfer_state_t us_rear_transfer_states[1];

static UP_ROM up_chip_reading_t us_rear_readings[] = {
    {
        .field = SENSE_FIELD_USRear,
        .offset = 0U,
        .transfer = 0U,
        .value =
            {
                .code = UP_CODE_INTEGER,
                .word_bytes = 2U,
            },
    },
};

static UP_ROM up_chip_t us_rear_chip = {
    .transfers = us_rear_transfers,
    .transfers_count = 1U,
    .readings = us_rear_readings,
    .readings_count = 1U,
    .cycle_ms = 70U,
    .address = 0x73U,
};
static UP_DMA_BUFFER uint8_t us_rear_work[3];
static uint64_t us_rear_scratch[1];
static up_chip_state_t us_rear_chip_state = {
    .transfers = us_rear_transfer_states,
    .work = us_rear_work,
    .scratch = us_rear_scratch,
};

static UP_ROM up_range_t us_rear_invalid[] = {
    {.low.u = UINT64_C(0), .high.u = UINT64_C(0)},
};
static UP_ROM up_filter_t us_rear_filter = {
    .invalid = us_rear_invalid,
    .invalid_count = 1U,
    .median = 0U,
    .smooth_ms = 0U,
};
static up_filter_state_t us_rear_filter_state = {
    .memory = NULL,
};

/* ---- what becomes of values before they are reported ---- */

static const up_filtered_t filters[] = {
    {NULL, NULL},
    {NULL, NULL},
    {NULL, NULL},
    {&us_front_filter, &us_front_filter_state},
    {&us_front_right_filter, &us_front_right_filter_state},
    {&us_rear_filter, &us_rear_filter_state},
    {NULL, NULL},
    {NULL, NULL},
    {NULL, NULL},
    {NULL, NULL},
    {NULL, NULL},
    {NULL, NULL},
    {NULL, NULL},
};

/* ---- analog sensors ---- */

/* ADC1 60 ms +12:
 * IRFrontRight at PB0 (ADC12-IN8),
 * IRRearRight at PB1 (ADC12-IN9),
 * IRRear at PC1 (ADC123-IN11) */
static UP_DMA_BUFFER adcsample_t adc1_60ms_prio_12_samples[32U * 3U];
static const ADCConversionGroup adc1_60ms_prio_12_group = {
    .circular = FALSE,
    .num_channels = 3U,
    .error_cb = up_adc_on_error,
    .cr2 = ADC_CR2_SWSTART,
    .smpr1 = ADC_SMPR1_SMP_AN11(ADC_SAMPLE_84),
    .smpr2 = ADC_SMPR2_SMP_AN8(ADC_SAMPLE_84) |
             ADC_SMPR2_SMP_AN9(ADC_SAMPLE_84),
    .sqr1 = ADC_SQR1_NUM_CH(3U),
    .sqr2 = 0U,
    .sqr3 = ADC_SQR3_SQ1_N(ADC_CHANNEL_IN8) |
             ADC_SQR3_SQ2_N(ADC_CHANNEL_IN9) |
             ADC_SQR3_SQ3_N(ADC_CHANNEL_IN11),
};

/* ADC1 60 ms +12 */
static const up_adc_group_t adc1_60ms_prio_12_groups[] = {
    {
        .driver = &ADCD1,
        .group = &adc1_60ms_prio_12_group,
        .samples = adc1_60ms_prio_12_samples,
        .depth = 32U,
        .full = 4095U,
        .timeout_ms = 3U,
    },
};
static const up_adc_input_t adc1_60ms_prio_12_inputs[] = {
    /* IRFrontRight at PB0 (ADC12-IN8) */
    {.field = SENSE_FIELD_IRFrontRight, .element = 0U, .samples = 32U, .group = 0U, .column = 0U},
    /* IRRearRight at PB1 (ADC12-IN9) */
    {.field = SENSE_FIELD_IRRearRight, .element = 0U, .samples = 32U, .group = 0U, .column = 1U},
    /* IRRear at PC1 (ADC123-IN11) */
    {.field = SENSE_FIELD_IRRear, .element = 0U, .samples = 32U, .group = 0U, .column = 2U},
};
static uint64_t adc1_60ms_prio_12_value[1];
static const up_adc_t adc1_60ms_prio_12 = {
    .groups = adc1_60ms_prio_12_groups,
    .groups_count = 1U,
    .inputs = adc1_60ms_prio_12_inputs,
    .inputs_count = 3U,
    .value = adc1_60ms_prio_12_value,
};

/* ---- I2C3: SCL PA8, SDA PC9 ---- */

static const I2CConfig i2c3_config = {
    .op_mode = OPMODE_I2C,
    .clock_speed = 400000U,
    .duty_cycle = FAST_DUTY_CYCLE_2,
};
static up_i2c_state_t i2c3_state;
static const up_i2c_port_t i2c3_port = {
    .driver = &I2CD3,
    .config = &i2c3_config,
    .state = &i2c3_state,
    .scl = PAL_LINE(GPIOA, 8U),
    .sda = PAL_LINE(GPIOC, 9U),
    .scl_mode = PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN | PAL_STM32_PUPDR_PULLUP,
    .sda_mode = PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN | PAL_STM32_PUPDR_PULLUP,
    .timeout_ms = 11U,
};
static const up_bus_t i2c3_bus = {
    .write = up_i2c_write,
    .write_read = up_i2c_write_read,
    .context = (void *)&i2c3_port,
};

/* I2C3 70 ms +10: USFront, USFrontRight, USRear */
static const up_served_t i2c3_70ms_prio_10_chips[] = {
    {&us_front_chip, &us_front_chip_state, NULL},
    {&us_front_right_chip, &us_front_right_chip_state, NULL},
    {&us_rear_chip, &us_rear_chip_state, NULL},
};
static const up_chips_t i2c3_70ms_prio_10 = {
    .bus = &i2c3_bus,
    .chips = i2c3_70ms_prio_10_chips,
    .cycle_ms = 70U,
    .chips_count = 3U,
};

/* ---- input capture ---- */

/* WheelLeftA at PA1 (TIM2_CH2): rising edges are counted */
static up_capture_raw_t wheel_left_a_raw;
static void wheel_left_a_on_period(ICUDriver *driver) {
  up_capture_on_period(&wheel_left_a_raw, (uint32_t)icuGetPeriodX(driver));
}
static const ICUConfig wheel_left_a_icu_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 10000U,
    .period_cb = wheel_left_a_on_period,
    .channel = ICU_CHANNEL_2,
};

/* WheelLeftB at PB4 (TIM3_CH1): rising edges are counted */
static up_capture_raw_t wheel_left_b_raw;
static void wheel_left_b_on_period(ICUDriver *driver) {
  up_capture_on_period(&wheel_left_b_raw, (uint32_t)icuGetPeriodX(driver));
}
static const ICUConfig wheel_left_b_icu_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 10000U,
    .period_cb = wheel_left_b_on_period,
    .channel = ICU_CHANNEL_1,
};

/* WheelRightA at PB7 (TIM4_CH2): rising edges are counted */
static up_capture_raw_t wheel_right_a_raw;
static void wheel_right_a_on_period(ICUDriver *driver) {
  up_capture_on_period(&wheel_right_a_raw, (uint32_t)icuGetPeriodX(driver));
}
static const ICUConfig wheel_right_a_icu_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 10000U,
    .period_cb = wheel_right_a_on_period,
    .channel = ICU_CHANNEL_2,
};

/* WheelRightB at PB14 (TIM12_CH1): rising edges are counted */
static up_capture_raw_t wheel_right_b_raw;
static void wheel_right_b_on_period(ICUDriver *driver) {
  up_capture_on_period(&wheel_right_b_raw, (uint32_t)icuGetPeriodX(driver));
}
static const ICUConfig wheel_right_b_icu_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 10000U,
    .period_cb = wheel_right_b_on_period,
    .channel = ICU_CHANNEL_1,
};

/* RCSteering at PC6 (TIM8_CH1): the width of high pulses */
static up_capture_raw_t rc_steering_raw;
static void rc_steering_on_width(ICUDriver *driver) {
  up_capture_on_width(&rc_steering_raw, (uint32_t)icuGetWidthX(driver), false);
}
static const ICUConfig rc_steering_icu_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 1000000U,
    .width_cb = rc_steering_on_width,
    .overflow_cb = up_icu_on_overflow,
    .channel = ICU_CHANNEL_1,
};

/* RCThrottle at PE5 (TIM9_CH1): the width of high pulses */
static up_capture_raw_t rc_throttle_raw;
static void rc_throttle_on_width(ICUDriver *driver) {
  up_capture_on_width(&rc_throttle_raw, (uint32_t)icuGetWidthX(driver), false);
}
static const ICUConfig rc_throttle_icu_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 1000000U,
    .width_cb = rc_throttle_on_width,
    .overflow_cb = up_icu_on_overflow,
    .channel = ICU_CHANNEL_1,
};

/* RCSwitch at PE9 (TIM1_CH1): the width of high pulses */
static up_capture_raw_t rc_switch_raw;
static void rc_switch_on_width(ICUDriver *driver) {
  up_capture_on_width(&rc_switch_raw, (uint32_t)icuGetWidthX(driver), false);
}
static const ICUConfig rc_switch_icu_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 1000000U,
    .width_cb = rc_switch_on_width,
    .overflow_cb = up_icu_on_overflow,
    .channel = ICU_CHANNEL_1,
};

static const up_icu_input_t wheel_left_a_inputs[] = {
    {.driver = &ICUD2, .raw = &wheel_left_a_raw},
};
static up_capture_state_t wheel_left_a_states[1];
static uint64_t wheel_left_a_value[1];
static const up_icu_t wheel_left_a_icu = {
    .inputs = wheel_left_a_inputs,
    .capture =
        {
            .mode = UP_CAPTURE_COUNT,
            .both_edges = false,
            .tick_hz = 10000U,
            .silent_ms = 1000U,
        },
    .states = wheel_left_a_states,
    .value = wheel_left_a_value,
    .field = SENSE_FIELD_WheelLeftA,
    .inputs_count = 1U,
};

static const up_icu_input_t wheel_left_b_inputs[] = {
    {.driver = &ICUD3, .raw = &wheel_left_b_raw},
};
static up_capture_state_t wheel_left_b_states[1];
static uint64_t wheel_left_b_value[1];
static const up_icu_t wheel_left_b_icu = {
    .inputs = wheel_left_b_inputs,
    .capture =
        {
            .mode = UP_CAPTURE_COUNT,
            .both_edges = false,
            .tick_hz = 10000U,
            .silent_ms = 1000U,
        },
    .states = wheel_left_b_states,
    .value = wheel_left_b_value,
    .field = SENSE_FIELD_WheelLeftB,
    .inputs_count = 1U,
};

static const up_icu_input_t wheel_right_a_inputs[] = {
    {.driver = &ICUD4, .raw = &wheel_right_a_raw},
};
static up_capture_state_t wheel_right_a_states[1];
static uint64_t wheel_right_a_value[1];
static const up_icu_t wheel_right_a_icu = {
    .inputs = wheel_right_a_inputs,
    .capture =
        {
            .mode = UP_CAPTURE_COUNT,
            .both_edges = false,
            .tick_hz = 10000U,
            .silent_ms = 1000U,
        },
    .states = wheel_right_a_states,
    .value = wheel_right_a_value,
    .field = SENSE_FIELD_WheelRightA,
    .inputs_count = 1U,
};

static const up_icu_input_t wheel_right_b_inputs[] = {
    {.driver = &ICUD12, .raw = &wheel_right_b_raw},
};
static up_capture_state_t wheel_right_b_states[1];
static uint64_t wheel_right_b_value[1];
static const up_icu_t wheel_right_b_icu = {
    .inputs = wheel_right_b_inputs,
    .capture =
        {
            .mode = UP_CAPTURE_COUNT,
            .both_edges = false,
            .tick_hz = 10000U,
            .silent_ms = 1000U,
        },
    .states = wheel_right_b_states,
    .value = wheel_right_b_value,
    .field = SENSE_FIELD_WheelRightB,
    .inputs_count = 1U,
};

static const up_icu_input_t rc_steering_inputs[] = {
    {.driver = &ICUD8, .raw = &rc_steering_raw},
};
static up_capture_state_t rc_steering_states[1];
static uint64_t rc_steering_value[1];
static const up_icu_t rc_steering_icu = {
    .inputs = rc_steering_inputs,
    .capture =
        {
            .mode = UP_CAPTURE_WIDTH,
            .both_edges = false,
            .tick_hz = 1000000U,
            .silent_ms = 1000U,
        },
    .states = rc_steering_states,
    .value = rc_steering_value,
    .field = SENSE_FIELD_RCSteering,
    .inputs_count = 1U,
};

static const up_icu_input_t rc_throttle_inputs[] = {
    {.driver = &ICUD9, .raw = &rc_throttle_raw},
};
static up_capture_state_t rc_throttle_states[1];
static uint64_t rc_throttle_value[1];
static const up_icu_t rc_throttle_icu = {
    .inputs = rc_throttle_inputs,
    .capture =
        {
            .mode = UP_CAPTURE_WIDTH,
            .both_edges = false,
            .tick_hz = 1000000U,
            .silent_ms = 1000U,
        },
    .states = rc_throttle_states,
    .value = rc_throttle_value,
    .field = SENSE_FIELD_RCThrottle,
    .inputs_count = 1U,
};

static const up_icu_input_t rc_switch_inputs[] = {
    {.driver = &ICUD1, .raw = &rc_switch_raw},
};
static up_capture_state_t rc_switch_states[1];
static uint64_t rc_switch_value[1];
static const up_icu_t rc_switch_icu = {
    .inputs = rc_switch_inputs,
    .capture =
        {
            .mode = UP_CAPTURE_WIDTH,
            .both_edges = false,
            .tick_hz = 1000000U,
            .silent_ms = 1000U,
        },
    .states = rc_switch_states,
    .value = rc_switch_value,
    .field = SENSE_FIELD_RCSwitch,
    .inputs_count = 1U,
};

/* ---- what the runtime calls ---- */

/* Starts the drivers: once, behind the pads and before any thread. */
void sense_start(void) {
  (void)adcStart(&ADCD1, NULL);
  up_i2c_start(&i2c3_port);
  up_icu_start(&ICUD2, &wheel_left_a_icu_config);
  up_icu_start(&ICUD3, &wheel_left_b_icu_config);
  up_icu_start(&ICUD4, &wheel_right_a_icu_config);
  up_icu_start(&ICUD12, &wheel_right_b_icu_config);
  up_icu_start(&ICUD8, &rc_steering_icu_config);
  up_icu_start(&ICUD9, &rc_throttle_icu_config);
  up_icu_start(&ICUD1, &rc_switch_icu_config);
}

/* Looks at what interrupts have gathered: the reporter, in each cycle. */
void sense_poll(void) {
  up_icu_poll(&wheel_left_a_icu);
  up_icu_poll(&wheel_left_b_icu);
  up_icu_poll(&wheel_right_a_icu);
  up_icu_poll(&wheel_right_b_icu);
  up_icu_poll(&rc_steering_icu);
  up_icu_poll(&rc_throttle_icu);
  up_icu_poll(&rc_switch_icu);
}

/* The host has set an actuator; those that threads serve see it by themselves. */
void sense_apply(size_t field, const void *value) {
  (void)field;
  (void)value;
}

/* The host is silent. */
void sense_failsafe(void) {
}

/* ---- threads ---- */

static THD_WORKING_AREA(adc1_60ms_prio_12_stack, 400U + UP_TRANSFORM_BYTES);
static THD_WORKING_AREA(i2c3_70ms_prio_10_stack, 560U + UP_TRANSFORM_BYTES);
static const up_task_t tasks[] = {
    {
        .name = "ADC1 60 ms +12",
        .cycle = up_adc_cycle,
        .work = &adc1_60ms_prio_12,
        .stack = adc1_60ms_prio_12_stack,
        .stack_bytes = sizeof adc1_60ms_prio_12_stack,
        .delay_ms = 60U,
        .prio = 12,
        .device = 1U,
    },
    {
        .name = "I2C3 70 ms +10",
        .cycle = up_chips_cycle,
        .work = &i2c3_70ms_prio_10,
        .stack = i2c3_70ms_prio_10_stack,
        .stack_bytes = sizeof i2c3_70ms_prio_10_stack,
        .delay_ms = 70U,
        .prio = 10,
        .device = 4U,
    },
};

/* ---- what the self test looks at ---- */

#if UP_SHELL == TRUE
static const up_input_t inputs[] = {
    {"WheelLeftA at PA1 (TIM2_CH2)", PAL_LINE(GPIOA, 1U), false},
    {"I2C3 at PA8 (I2C3-SCL)", PAL_LINE(GPIOA, 8U), true},
    {"IRFrontRight at PB0 (ADC12-IN8)", PAL_LINE(GPIOB, 0U), false},
    {"WheelRightB at PB14 (TIM12_CH1)", PAL_LINE(GPIOB, 14U), false},
    {"IRRearRight at PB1 (ADC12-IN9)", PAL_LINE(GPIOB, 1U), false},
    {"WheelLeftB at PB4 (TIM3_CH1)", PAL_LINE(GPIOB, 4U), false},
    {"WheelRightA at PB7 (TIM4_CH2)", PAL_LINE(GPIOB, 7U), false},
    {"IRRear at PC1 (ADC123-IN11)", PAL_LINE(GPIOC, 1U), false},
    {"RCSteering at PC6 (TIM8_CH1)", PAL_LINE(GPIOC, 6U), false},
    {"I2C3 at PC9 (I2C3-SDA)", PAL_LINE(GPIOC, 9U), true},
    {"RCThrottle at PE5 (TIM9_CH1)", PAL_LINE(GPIOE, 5U), false},
    {"RCSwitch at PE9 (TIM1_CH1)", PAL_LINE(GPIOE, 9U), false},
};
static const uint8_t expected_0[] = {0x71U, 0x72U, 0x73U};
static const up_probe_t probes[] = {
    {"I2C3", up_i2c_answers, &i2c3_port, expected_0, sizeof expected_0},
};
static const up_edges_t edges[] = {
    {"WheelLeftA at PA1 (TIM2_CH2)", SENSE_FIELD_WheelLeftA},
    {"WheelLeftB at PB4 (TIM3_CH1)", SENSE_FIELD_WheelLeftB},
    {"WheelRightA at PB7 (TIM4_CH2)", SENSE_FIELD_WheelRightA},
    {"WheelRightB at PB14 (TIM12_CH1)", SENSE_FIELD_WheelRightB},
    {"RCSteering at PC6 (TIM8_CH1)", SENSE_FIELD_RCSteering},
    {"RCThrottle at PE5 (TIM9_CH1)", SENSE_FIELD_RCThrottle},
    {"RCSwitch at PE9 (TIM1_CH1)", SENSE_FIELD_RCSwitch},
};
#endif

static const up_counter_t counters[] = {
    {"I2C3 was freed", &i2c3_state.freed},
    {"I2C3 stayed stuck", &i2c3_state.kept},
};

/* ---- how often each value comes; 0: when something happens ---- */

static const uint32_t cycles_ms[] = {
    60U,
    60U,
    60U,
    70U,
    70U,
    70U,
    0U,
    0U,
    0U,
    0U,
    0U,
    0U,
    0U,
};

/* ---- the application ---- */

const up_config_t up_config = {
    .board = "STM32F4DiscoveryBoard",
    .schema = &sense_schema,
    .values = &sense_values,
    .cycles_ms = cycles_ms,
    .transforms = sense_transforms,
    .pads = pads,
    .pads_count = sizeof pads / sizeof pads[0],
    .tasks = tasks,
    .tasks_count = sizeof tasks / sizeof tasks[0],
    .filters = filters,
    .filter = up_filter_apply,
    .counters = counters,
    .counters_count = sizeof counters / sizeof counters[0],
    .button = PAL_LINE(GPIOA, 0U),
    .button_pressed = PAL_HIGH,
    .report_ms = 10U,
#if UP_SHELL == TRUE
    .inputs = inputs,
    .inputs_count = sizeof inputs / sizeof inputs[0],
    .probes = probes,
    .probes_count = sizeof probes / sizeof probes[0],
    .edges = edges,
    .edges_count = sizeof edges / sizeof edges[0],
#endif
};

/* ---- what the compiler alone would not notice ---- */

_Static_assert(STM32_ADC_ADC1_DMA_STREAM !=
               STM32_I2C_I2C3_RX_DMA_STREAM,
               "two drivers have one DMA stream");
_Static_assert(STM32_ADC_ADC1_DMA_STREAM !=
               STM32_I2C_I2C3_TX_DMA_STREAM,
               "two drivers have one DMA stream");
_Static_assert(STM32_I2C_I2C3_RX_DMA_STREAM !=
               STM32_I2C_I2C3_TX_DMA_STREAM,
               "two drivers have one DMA stream");
_Static_assert(STM32_PCLK1 % (3U * 400000U) == 0U && STM32_PCLK1 / (3U * 400000U) >= 4U &&
                   STM32_PCLK1 / (3U * 400000U) <= 4095U,
               "the clock of I2C3 does not divide to 400000 Hz");
_Static_assert(STM32_TIMCLK1 % 10000U == 0U && STM32_TIMCLK1 / 10000U <= 65536U,
               "the clock of TIM2 does not divide to 10000 Hz");
_Static_assert(STM32_TIM2_CHANNELS >= 2,
               "TIM2 has no channel 2");
_Static_assert(STM32_TIMCLK1 % 10000U == 0U && STM32_TIMCLK1 / 10000U <= 65536U,
               "the clock of TIM3 does not divide to 10000 Hz");
_Static_assert(STM32_TIM3_CHANNELS >= 2,
               "TIM3 has no channel 2");
_Static_assert(STM32_TIMCLK1 % 10000U == 0U && STM32_TIMCLK1 / 10000U <= 65536U,
               "the clock of TIM4 does not divide to 10000 Hz");
_Static_assert(STM32_TIM4_CHANNELS >= 2,
               "TIM4 has no channel 2");
_Static_assert(STM32_TIMCLK1 % 10000U == 0U && STM32_TIMCLK1 / 10000U <= 65536U,
               "the clock of TIM12 does not divide to 10000 Hz");
_Static_assert(STM32_TIM12_CHANNELS >= 2,
               "TIM12 has no channel 2");
_Static_assert(STM32_TIMCLK2 % 1000000U == 0U && STM32_TIMCLK2 / 1000000U <= 65536U,
               "the clock of TIM8 does not divide to 1000000 Hz");
_Static_assert(STM32_TIM8_CHANNELS >= 2,
               "TIM8 has no channel 2");
_Static_assert(STM32_TIMCLK2 % 1000000U == 0U && STM32_TIMCLK2 / 1000000U <= 65536U,
               "the clock of TIM9 does not divide to 1000000 Hz");
_Static_assert(STM32_TIM9_CHANNELS >= 2,
               "TIM9 has no channel 2");
_Static_assert(STM32_TIMCLK2 % 1000000U == 0U && STM32_TIMCLK2 / 1000000U <= 65536U,
               "the clock of TIM1 does not divide to 1000000 Hz");
_Static_assert(STM32_TIM1_CHANNELS >= 2,
               "TIM1 has no channel 2");
_Static_assert(STM32_HCLK == 168000000U,
               "STM32_HCLK is not what this wiring was made for");
_Static_assert(STM32_PCLK1 == 42000000U,
               "STM32_PCLK1 is not what this wiring was made for");
_Static_assert(STM32_PCLK2 == 84000000U,
               "STM32_PCLK2 is not what this wiring was made for");
_Static_assert(STM32_TIMCLK1 == 84000000U,
               "STM32_TIMCLK1 is not what this wiring was made for");
_Static_assert(STM32_TIMCLK2 == 168000000U,
               "STM32_TIMCLK2 is not what this wiring was made for");
