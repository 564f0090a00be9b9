/* Written by SenseDSL: the wiring of STM32F4DiscoveryBoard as tables for the runtime. */
#include "sense_model.h"
#include "up_rt.h"

/* ---- pads ---- */

static const up_pad_t pads[] = {
    /* PA1 */ {PAL_LINE(GPIOA, 1U), PAL_MODE_ALTERNATE(1), PAL_LOW},
    /* PA8 */ {PAL_LINE(GPIOA, 8U), PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN, PAL_LOW},
    /* PA11 */ {PAL_LINE(GPIOA, 11U), PAL_MODE_ALTERNATE(10) | PAL_STM32_OSPEED_HIGHEST, PAL_LOW},
    /* PA12 */ {PAL_LINE(GPIOA, 12U), PAL_MODE_ALTERNATE(10) | PAL_STM32_OSPEED_HIGHEST, PAL_LOW},
    /* PB0 */ {PAL_LINE(GPIOB, 0U), PAL_MODE_INPUT_ANALOG, PAL_LOW},
    /* PB1 */ {PAL_LINE(GPIOB, 1U), PAL_MODE_INPUT_ANALOG, PAL_LOW},
    /* PB4 */ {PAL_LINE(GPIOB, 4U), PAL_MODE_ALTERNATE(2), PAL_LOW},
    /* PB7 */ {PAL_LINE(GPIOB, 7U), PAL_MODE_ALTERNATE(2), PAL_LOW},
    /* PB14 */ {PAL_LINE(GPIOB, 14U), PAL_MODE_ALTERNATE(9), PAL_LOW},
    /* PC1 */ {PAL_LINE(GPIOC, 1U), PAL_MODE_INPUT_ANALOG, PAL_LOW},
    /* PC6 */ {PAL_LINE(GPIOC, 6U), PAL_MODE_ALTERNATE(3), PAL_LOW},
    /* PC9 */ {PAL_LINE(GPIOC, 9U), PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN, PAL_LOW},
    /* PE5 */ {PAL_LINE(GPIOE, 5U), PAL_MODE_ALTERNATE(3), PAL_LOW},
    /* PE9 */ {PAL_LINE(GPIOE, 9U), PAL_MODE_ALTERNATE(1), PAL_LOW},
};

/* ---- USFront: srf08 ---- */

static const up_range_t invalid_USFront[] = {
    {.low.u = UINT64_C(0), .high.u = UINT64_C(0)},
};
static const up_filter_t filter_USFront = {
    .invalid = invalid_USFront,
    .invalid_count = 1U,
    .median = 0U,
    .smooth_ms = 0U,
};
static up_filter_state_t filter_state_USFront = {
    .memory = NULL,
};

/* ---- USFrontRight: srf08 ---- */

static const up_range_t invalid_USFrontRight[] = {
    {.low.u = UINT64_C(0), .high.u = UINT64_C(0)},
};
static const up_filter_t filter_USFrontRight = {
    .invalid = invalid_USFrontRight,
    .invalid_count = 1U,
    .median = 0U,
    .smooth_ms = 0U,
};
static up_filter_state_t filter_state_USFrontRight = {
    .memory = NULL,
};

/* ---- USRear: srf08 ---- */

static const up_range_t invalid_USRear[] = {
    {.low.u = UINT64_C(0), .high.u = UINT64_C(0)},
};
static const up_filter_t filter_USRear = {
    .invalid = invalid_USRear,
    .invalid_count = 1U,
    .median = 0U,
    .smooth_ms = 0U,
};
static up_filter_state_t filter_state_USRear = {
    .memory = NULL,
};

/* ---- what becomes of values before they are reported ---- */

static const up_filtered_t filters[] = {
    {NULL, NULL},
    {NULL, NULL},
    {NULL, NULL},
    {&filter_USFront, &filter_state_USFront},
    {&filter_USFrontRight, &filter_state_USFrontRight},
    {&filter_USRear, &filter_state_USRear},
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

/* ---- I2C buses ---- */

static uint32_t i2c_recoveries[1];

static const I2CConfig i2c_port_0_config = {
    .op_mode = OPMODE_I2C,
    .clock_speed = 400000U,
    .duty_cycle = FAST_DUTY_CYCLE_2,
};

static const up_i2c_port_t ports[] = {
    /* I2C3: SCL PA8, SDA PC9 */
    {
        .driver = &I2CD3,
        .config = &i2c_port_0_config,
        .scl = PAL_LINE(GPIOA, 8U),
        .sda = PAL_LINE(GPIOC, 9U),
        .scl_mode = PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN,
        .sda_mode = PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN,
        .timeout_ms = 11U,
        .recoveries = &i2c_recoveries[0],
    },
};

/* I2C3 70 ms +10: USFront, USFrontRight, USRear */
static uint8_t i2c_0_trigger_0[] = {0x00U, 0x51U};
static uint8_t i2c_0_trigger_1[] = {0x00U, 0x51U};
static uint8_t i2c_0_trigger_2[] = {0x00U, 0x51U};
static const up_i2c_device_t i2c_0_devices[] = {
    {
        .field = SENSE_FIELD_USFront,
        .script =
            {
                .trigger = i2c_0_trigger_0,
                .trigger_count = 2U,
                .wait_ms = 65U,
                .address = 0x71U,
                .reg = 0x02U,
                .has_register = true,
                .little_endian = false,
                .length = 2U,
            },
    },
    {
        .field = SENSE_FIELD_USFrontRight,
        .script =
            {
                .trigger = i2c_0_trigger_1,
                .trigger_count = 2U,
                .wait_ms = 65U,
                .address = 0x72U,
                .reg = 0x02U,
                .has_register = true,
                .little_endian = false,
                .length = 2U,
            },
    },
    {
        .field = SENSE_FIELD_USRear,
        .script =
            {
                .trigger = i2c_0_trigger_2,
                .trigger_count = 2U,
                .wait_ms = 65U,
                .address = 0x73U,
                .reg = 0x02U,
                .has_register = true,
                .little_endian = false,
                .length = 2U,
            },
    },
};
static up_i2c_state_t i2c_0_states[3];
static uint8_t i2c_0_work[3];
static uint64_t i2c_0_scratch[1];
static const up_i2c_t i2c_0 = {
    .port = &ports[0],
    .devices = i2c_0_devices,
    .states = i2c_0_states,
    .work = i2c_0_work,
    .scratch = i2c_0_scratch,
    .devices_count = 3U,
};

/* ---- input capture ---- */

static up_capture_raw_t icu_raw[7];
static up_capture_state_t icu_states[7];

/* TIM2: WheelLeftA */
UP_ICU_PERIOD_CALLBACK(icu_0_period, icu_raw[0])
static const ICUConfig icu_0_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 10000U,
    .period_cb = icu_0_period,
    .channel = ICU_CHANNEL_2,
};

/* TIM3: WheelLeftB */
UP_ICU_PERIOD_CALLBACK(icu_1_period, icu_raw[1])
static const ICUConfig icu_1_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 10000U,
    .period_cb = icu_1_period,
    .channel = ICU_CHANNEL_1,
};

/* TIM4: WheelRightA */
UP_ICU_PERIOD_CALLBACK(icu_2_period, icu_raw[2])
static const ICUConfig icu_2_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 10000U,
    .period_cb = icu_2_period,
    .channel = ICU_CHANNEL_2,
};

/* TIM12: WheelRightB */
UP_ICU_PERIOD_CALLBACK(icu_3_period, icu_raw[3])
static const ICUConfig icu_3_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 10000U,
    .period_cb = icu_3_period,
    .channel = ICU_CHANNEL_1,
};

/* TIM8: RCSteering */
UP_ICU_WIDTH_CALLBACK(icu_4_width, icu_raw[4], false)
static const ICUConfig icu_4_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 1000000U,
    .width_cb = icu_4_width,
    .overflow_cb = up_icu_on_overflow,
    .channel = ICU_CHANNEL_1,
};

/* TIM9: RCThrottle */
UP_ICU_WIDTH_CALLBACK(icu_5_width, icu_raw[5], false)
static const ICUConfig icu_5_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 1000000U,
    .width_cb = icu_5_width,
    .overflow_cb = up_icu_on_overflow,
    .channel = ICU_CHANNEL_1,
};

/* TIM1: RCSwitch */
UP_ICU_WIDTH_CALLBACK(icu_6_width, icu_raw[6], false)
static const ICUConfig icu_6_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 1000000U,
    .width_cb = icu_6_width,
    .overflow_cb = up_icu_on_overflow,
    .channel = ICU_CHANNEL_1,
};

static const up_icu_t icus[] = {
    {
        .driver = &ICUD2,
        .config = &icu_0_config,
        .capture =
            {
                .mode = UP_CAPTURE_COUNT,
                .both_edges = false,
                .tick_hz = 10000U,
                .silent_ms = 1000U,
            },
        .raw = &icu_raw[0],
        .state = &icu_states[0],
        .field = SENSE_FIELD_WheelLeftA,
    },
    {
        .driver = &ICUD3,
        .config = &icu_1_config,
        .capture =
            {
                .mode = UP_CAPTURE_COUNT,
                .both_edges = false,
                .tick_hz = 10000U,
                .silent_ms = 1000U,
            },
        .raw = &icu_raw[1],
        .state = &icu_states[1],
        .field = SENSE_FIELD_WheelLeftB,
    },
    {
        .driver = &ICUD4,
        .config = &icu_2_config,
        .capture =
            {
                .mode = UP_CAPTURE_COUNT,
                .both_edges = false,
                .tick_hz = 10000U,
                .silent_ms = 1000U,
            },
        .raw = &icu_raw[2],
        .state = &icu_states[2],
        .field = SENSE_FIELD_WheelRightA,
    },
    {
        .driver = &ICUD12,
        .config = &icu_3_config,
        .capture =
            {
                .mode = UP_CAPTURE_COUNT,
                .both_edges = false,
                .tick_hz = 10000U,
                .silent_ms = 1000U,
            },
        .raw = &icu_raw[3],
        .state = &icu_states[3],
        .field = SENSE_FIELD_WheelRightB,
    },
    {
        .driver = &ICUD8,
        .config = &icu_4_config,
        .capture =
            {
                .mode = UP_CAPTURE_WIDTH,
                .both_edges = false,
                .tick_hz = 1000000U,
                .silent_ms = 1000U,
            },
        .raw = &icu_raw[4],
        .state = &icu_states[4],
        .field = SENSE_FIELD_RCSteering,
    },
    {
        .driver = &ICUD9,
        .config = &icu_5_config,
        .capture =
            {
                .mode = UP_CAPTURE_WIDTH,
                .both_edges = false,
                .tick_hz = 1000000U,
                .silent_ms = 1000U,
            },
        .raw = &icu_raw[5],
        .state = &icu_states[5],
        .field = SENSE_FIELD_RCThrottle,
    },
    {
        .driver = &ICUD1,
        .config = &icu_6_config,
        .capture =
            {
                .mode = UP_CAPTURE_WIDTH,
                .both_edges = false,
                .tick_hz = 1000000U,
                .silent_ms = 1000U,
            },
        .raw = &icu_raw[6],
        .state = &icu_states[6],
        .field = SENSE_FIELD_RCSwitch,
    },
};

/* ---- what the runtime calls ---- */

/* Starts the drivers: once, behind the pads and before any thread. */
void sense_start(void) {
  (void)adcStart(&ADCD1, NULL);
  up_i2c_start(&ports[0]);
  up_icu_start(&icus[0]);
  up_icu_start(&icus[1]);
  up_icu_start(&icus[2]);
  up_icu_start(&icus[3]);
  up_icu_start(&icus[4]);
  up_icu_start(&icus[5]);
  up_icu_start(&icus[6]);
}

/* Looks at what interrupts have gathered: the reporter, in each cycle. */
void sense_poll(void) {
  up_icu_poll(&icus[0]);
  up_icu_poll(&icus[1]);
  up_icu_poll(&icus[2]);
  up_icu_poll(&icus[3]);
  up_icu_poll(&icus[4]);
  up_icu_poll(&icus[5]);
  up_icu_poll(&icus[6]);
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

static THD_WORKING_AREA(adc1_60ms_prio_12_stack, 768);
static THD_WORKING_AREA(i2c_0_stack, 768);
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
        .cycle = up_i2c_cycle,
        .work = &i2c_0,
        .stack = i2c_0_stack,
        .stack_bytes = sizeof i2c_0_stack,
        .delay_ms = 70U,
        .prio = 10,
        .device = 4U,
    },
};

static const up_counter_t counters[] = {
    {"I2C3 was freed", &i2c_recoveries[0]},
};

/* ---- the application ---- */

const up_config_t up_config = {
    .board = "STM32F4DiscoveryBoard",
    .schema = &sense_schema,
    .values = &sense_values,
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
               "TIM2 cannot measure with channel 2");
_Static_assert(STM32_TIMCLK1 % 10000U == 0U && STM32_TIMCLK1 / 10000U <= 65536U,
               "the clock of TIM3 does not divide to 10000 Hz");
_Static_assert(STM32_TIM3_CHANNELS >= 2,
               "TIM3 cannot measure with channel 1");
_Static_assert(STM32_TIMCLK1 % 10000U == 0U && STM32_TIMCLK1 / 10000U <= 65536U,
               "the clock of TIM4 does not divide to 10000 Hz");
_Static_assert(STM32_TIM4_CHANNELS >= 2,
               "TIM4 cannot measure with channel 2");
_Static_assert(STM32_TIMCLK1 % 10000U == 0U && STM32_TIMCLK1 / 10000U <= 65536U,
               "the clock of TIM12 does not divide to 10000 Hz");
_Static_assert(STM32_TIM12_CHANNELS >= 2,
               "TIM12 cannot measure with channel 1");
_Static_assert(STM32_TIMCLK2 % 1000000U == 0U && STM32_TIMCLK2 / 1000000U <= 65536U,
               "the clock of TIM8 does not divide to 1000000 Hz");
_Static_assert(STM32_TIM8_CHANNELS >= 2,
               "TIM8 cannot measure with channel 1");
_Static_assert(STM32_TIMCLK2 % 1000000U == 0U && STM32_TIMCLK2 / 1000000U <= 65536U,
               "the clock of TIM9 does not divide to 1000000 Hz");
_Static_assert(STM32_TIM9_CHANNELS >= 2,
               "TIM9 cannot measure with channel 1");
_Static_assert(STM32_TIMCLK2 % 1000000U == 0U && STM32_TIMCLK2 / 1000000U <= 65536U,
               "the clock of TIM1 does not divide to 1000000 Hz");
_Static_assert(STM32_TIM1_CHANNELS >= 2,
               "TIM1 cannot measure with channel 1");
_Static_assert(STM32_HCLK == 168000000U,
               "STM32_HCLK is not what this wiring was made for");
_Static_assert(STM32_PCLK2 == 84000000U,
               "STM32_PCLK2 is not what this wiring was made for");
_Static_assert(STM32_TIMCLK1 == 84000000U,
               "STM32_TIMCLK1 is not what this wiring was made for");
_Static_assert(STM32_TIMCLK2 == 168000000U,
               "STM32_TIMCLK2 is not what this wiring was made for");
