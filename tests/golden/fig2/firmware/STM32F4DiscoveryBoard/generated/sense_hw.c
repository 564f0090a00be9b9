/* Written by SenseDSL: the wiring of STM32F4DiscoveryBoard as tables for the runtime. */
#include "sense_model.h"
#include "up_rt.h"
#include "up_adc.h"
#include "up_i2c_bus.h"
#include "up_icu.h"

/* ---- pads ---- */

static const up_pad_t pads[] = {
    /* PA8 */ {PAL_LINE(GPIOA, 8U), PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN | PAL_STM32_PUPDR_PULLUP, PAL_LOW},
    /* PA11 */ {PAL_LINE(GPIOA, 11U), PAL_MODE_ALTERNATE(10) | PAL_STM32_OSPEED_HIGHEST, PAL_LOW},
    /* PA12 */ {PAL_LINE(GPIOA, 12U), PAL_MODE_ALTERNATE(10) | PAL_STM32_OSPEED_HIGHEST, PAL_LOW},
    /* PB0 */ {PAL_LINE(GPIOB, 0U), PAL_MODE_INPUT_ANALOG, PAL_LOW},
    /* PB1 */ {PAL_LINE(GPIOB, 1U), PAL_MODE_INPUT_ANALOG, PAL_LOW},
    /* PB4 */ {PAL_LINE(GPIOB, 4U), PAL_MODE_ALTERNATE(2), PAL_LOW},
    /* PC9 */ {PAL_LINE(GPIOC, 9U), PAL_MODE_ALTERNATE(4) | PAL_STM32_OTYPE_OPENDRAIN | PAL_STM32_PUPDR_PULLUP, PAL_LOW},
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
        .cycle_ms = 40U,
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
    .cycle_ms = 40U,
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
    {&us_rear_filter, &us_rear_filter_state},
    {NULL, NULL},
};

/* ---- analog sensors ---- */

/* ADC1 60 ms:
 * IRFrontRight at PB1 (ADC12-IN9) */
static UP_DMA_BUFFER adcsample_t adc1_60ms_samples[32U * 1U];
static const ADCConversionGroup adc1_60ms_group = {
    .circular = FALSE,
    .num_channels = 1U,
    .error_cb = up_adc_on_error,
    .cr2 = ADC_CR2_SWSTART,
    .smpr1 = 0U,
    .smpr2 = ADC_SMPR2_SMP_AN9(ADC_SAMPLE_84),
    .sqr1 = ADC_SQR1_NUM_CH(1U),
    .sqr2 = 0U,
    .sqr3 = ADC_SQR3_SQ1_N(ADC_CHANNEL_IN9),
};

/* ADC1 60 ms */
static const up_adc_group_t adc1_60ms_groups[] = {
    {
        .driver = &ADCD1,
        .group = &adc1_60ms_group,
        .samples = adc1_60ms_samples,
        .depth = 32U,
        .full = 4095U,
        .timeout_ms = 3U,
    },
};
static const up_adc_input_t adc1_60ms_inputs[] = {
    /* IRFrontRight at PB1 (ADC12-IN9) */
    {.field = SENSE_FIELD_IRFrontRight, .element = 0U, .samples = 32U, .group = 0U, .column = 0U},
};
static uint64_t adc1_60ms_value[1];
static const up_adc_t adc1_60ms = {
    .groups = adc1_60ms_groups,
    .groups_count = 1U,
    .inputs = adc1_60ms_inputs,
    .inputs_count = 1U,
    .value = adc1_60ms_value,
};

/* ADC1 1000 ms:
 * IRFront at PB0 (ADC12-IN8) */
static UP_DMA_BUFFER adcsample_t adc1_1000ms_samples[32U * 1U];
static const ADCConversionGroup adc1_1000ms_group = {
    .circular = FALSE,
    .num_channels = 1U,
    .error_cb = up_adc_on_error,
    .cr2 = ADC_CR2_SWSTART,
    .smpr1 = 0U,
    .smpr2 = ADC_SMPR2_SMP_AN8(ADC_SAMPLE_84),
    .sqr1 = ADC_SQR1_NUM_CH(1U),
    .sqr2 = 0U,
    .sqr3 = ADC_SQR3_SQ1_N(ADC_CHANNEL_IN8),
};

/* ADC1 1000 ms */
static const up_adc_group_t adc1_1000ms_groups[] = {
    {
        .driver = &ADCD1,
        .group = &adc1_1000ms_group,
        .samples = adc1_1000ms_samples,
        .depth = 32U,
        .full = 4095U,
        .timeout_ms = 3U,
    },
};
static const up_adc_input_t adc1_1000ms_inputs[] = {
    /* IRFront at PB0 (ADC12-IN8) */
    {.field = SENSE_FIELD_IRFront, .element = 0U, .samples = 32U, .group = 0U, .column = 0U},
};
static uint64_t adc1_1000ms_value[1];
static const up_adc_t adc1_1000ms = {
    .groups = adc1_1000ms_groups,
    .groups_count = 1U,
    .inputs = adc1_1000ms_inputs,
    .inputs_count = 1U,
    .value = adc1_1000ms_value,
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

/* I2C3 40 ms +2: USRear */
static const up_served_t i2c3_40ms_prio_2_chips[] = {
    {&us_rear_chip, &us_rear_chip_state, NULL},
};
static const up_chips_t i2c3_40ms_prio_2 = {
    .bus = &i2c3_bus,
    .chips = i2c3_40ms_prio_2_chips,
    .cycle_ms = 40U,
    .chips_count = 1U,
};

/* ---- input capture ---- */

/* WheelEncoder at PB4 (TIM3_CH1): rising edges are counted */
static up_capture_raw_t wheel_encoder_raw;
static void wheel_encoder_on_period(ICUDriver *driver) {
  up_capture_on_period(&wheel_encoder_raw, (uint32_t)icuGetPeriodX(driver));
}
static const ICUConfig wheel_encoder_icu_config = {
    .mode = ICU_INPUT_ACTIVE_HIGH,
    .frequency = 10000U,
    .period_cb = wheel_encoder_on_period,
    .channel = ICU_CHANNEL_1,
};

static const up_icu_input_t wheel_encoder_inputs[] = {
    {.driver = &ICUD3, .raw = &wheel_encoder_raw},
};
static up_capture_state_t wheel_encoder_states[1];
static uint64_t wheel_encoder_value[1];
static const up_icu_t wheel_encoder_icu = {
    .inputs = wheel_encoder_inputs,
    .capture =
        {
            .mode = UP_CAPTURE_COUNT,
            .both_edges = false,
            .tick_hz = 10000U,
            .silent_ms = 1000U,
        },
    .states = wheel_encoder_states,
    .value = wheel_encoder_value,
    .field = SENSE_FIELD_WheelEncoder,
    .inputs_count = 1U,
};

/* ---- what the runtime calls ---- */

/* Starts the drivers: once, behind the pads and before any thread. */
void sense_start(void) {
  (void)adcStart(&ADCD1, NULL);
  up_i2c_start(&i2c3_port);
  up_icu_start(&ICUD3, &wheel_encoder_icu_config);
}

/* Looks at what interrupts have gathered: the reporter, in each cycle. */
void sense_poll(void) {
  up_icu_poll(&wheel_encoder_icu);
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

static THD_WORKING_AREA(adc1_60ms_stack, 400U + UP_TRANSFORM_BYTES);
static THD_WORKING_AREA(adc1_1000ms_stack, 400U + UP_TRANSFORM_BYTES);
static THD_WORKING_AREA(i2c3_40ms_prio_2_stack, 560U + UP_TRANSFORM_BYTES);
static const up_task_t tasks[] = {
    {
        .name = "ADC1 60 ms",
        .cycle = up_adc_cycle,
        .work = &adc1_60ms,
        .stack = adc1_60ms_stack,
        .stack_bytes = sizeof adc1_60ms_stack,
        .delay_ms = 60U,
        .prio = 0,
        .device = 18U,
    },
    {
        .name = "ADC1 1000 ms",
        .cycle = up_adc_cycle,
        .work = &adc1_1000ms,
        .stack = adc1_1000ms_stack,
        .stack_bytes = sizeof adc1_1000ms_stack,
        .delay_ms = 1000U,
        .prio = 0,
        .device = 17U,
    },
    {
        .name = "I2C3 40 ms +2",
        .cycle = up_chips_cycle,
        .work = &i2c3_40ms_prio_2,
        .stack = i2c3_40ms_prio_2_stack,
        .stack_bytes = sizeof i2c3_40ms_prio_2_stack,
        .delay_ms = 40U,
        .prio = 2,
        .device = 19U,
    },
};

/* ---- what the self test looks at ---- */

#if UP_SHELL == TRUE
static const up_input_t inputs[] = {
    {"I2C3 at PA8 (I2C3-SCL)", PAL_LINE(GPIOA, 8U), true},
    {"IRFront at PB0 (ADC12-IN8)", PAL_LINE(GPIOB, 0U), false},
    {"IRFrontRight at PB1 (ADC12-IN9)", PAL_LINE(GPIOB, 1U), false},
    {"WheelEncoder at PB4 (TIM3_CH1)", PAL_LINE(GPIOB, 4U), false},
    {"I2C3 at PC9 (I2C3-SDA)", PAL_LINE(GPIOC, 9U), true},
};
static const uint8_t expected_0[] = {0x73U};
static const up_probe_t probes[] = {
    {"I2C3", up_i2c_answers, &i2c3_port, expected_0, sizeof expected_0},
};
static const up_edges_t edges[] = {
    {"WheelEncoder at PB4 (TIM3_CH1)", SENSE_FIELD_WheelEncoder},
};
#endif

static const up_counter_t counters[] = {
    {"I2C3 was freed", &i2c3_state.freed},
    {"I2C3 stayed stuck", &i2c3_state.kept},
};

/* ---- how often each value comes; 0: when something happens ---- */

static const uint32_t cycles_ms[] = {
    1000U,
    60U,
    80U,
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
               "the clock of TIM3 does not divide to 10000 Hz");
_Static_assert(STM32_TIM3_CHANNELS >= 2,
               "TIM3 has no channel 2");
_Static_assert(STM32_HCLK == 168000000U,
               "STM32_HCLK is not what this wiring was made for");
_Static_assert(STM32_PCLK1 == 42000000U,
               "STM32_PCLK1 is not what this wiring was made for");
_Static_assert(STM32_PCLK2 == 84000000U,
               "STM32_PCLK2 is not what this wiring was made for");
_Static_assert(STM32_TIMCLK1 == 84000000U,
               "STM32_TIMCLK1 is not what this wiring was made for");
