/*
 * The runtime on ChibiOS: what a generated table says about an application, and what all parts share.
 *
 * The generated folder defines `up_config`; everything else of the application is in these tables. Threads write
 * values through up_put() and up_fail(), the reporter (the main thread) sends what is due.
 */
#ifndef UP_RT_H
#define UP_RT_H

#include "ch.h"
#include "hal.h"
#include "stm32_tim.h"

#include "up_conf.h"
#include "up_dma.h" /* before the core's headers: they take its UP_DMA_BUFFER */

#include "up_adc.h"
#include "up_capture.h"
#include "up_chip.h"
#include "up_count.h"
#include "up_debounce.h"
#include "up_drive.h"
#include "up_elements.h"
#include "up_dac.h"
#include "up_filter.h"
#include "up_health.h"
#include "up_i2c.h"
#include "up_ppm.h"
#include "up_pulse_width.h"
#include "up_chips.h"
#include "up_conf.h"
#include "up_dma.h"
#include "up_filter.h"
#include "up_report.h"

#if HAL_USE_I2C == TRUE
#include "up_i2c_bus.h"
#endif
#if HAL_USE_SPI == TRUE
#include "up_spi_bus.h"
#endif

/* ---- tables ---- */

/* How one pad is set up at the start: its level first, so that an output begins with it. */
typedef struct {
  ioline_t line;
  iomode_t mode;
  uint8_t level; /* PAL_LOW or PAL_HIGH; of no meaning but for an output */
} up_pad_t;

/* A thread that does one cycle every `delay_ms`. */
typedef struct {
  const char *name;
  void (*cycle)(const void *work);
  const void *work;
  void *stack; /* a working area and its bytes */
  size_t stack_bytes;
  uint32_t delay_ms;
  int16_t prio; /* relative to NORMALPRIO */
  uint32_t start_ms; /* the first cycle comes so much later: devices of a group take turns */
  uint8_t device;    /* identifier of the first device that it serves; 0: none */
} up_task_t;

/* What becomes of the values of a field before they are reported; NULL for nothing. */
typedef struct {
  const up_filter_t *filter;
  up_filter_state_t *state;
} up_filtered_t;

/* What a driver counts beside the health of devices. */
typedef struct {
  const char *title; /* "I2C1 was freed" */
  const uint32_t *count;
} up_counter_t;

#if HAL_USE_I2C == TRUE
/* One bus, shared by all that use its driver. */
typedef struct {
  I2CDriver *driver;
  const I2CConfig *config;
  ioline_t scl, sda;
  iomode_t scl_mode, sda_mode; /* set again after a recovery */
  uint32_t timeout_ms;
  uint32_t *recoveries;
} up_i2c_port_t;

typedef struct {
  uint16_t field;
  up_i2c_script_t script;
} up_i2c_device_t;

/* The devices of one bus with one cycle time: what up_i2c_cycle() works on. */
typedef struct {
  const up_i2c_port_t *port;
  const up_i2c_device_t *devices;
  up_i2c_state_t *states; /* one a device */
  uint8_t *work;          /* as large as the largest up_i2c_work_bytes() */
  uint64_t *scratch;      /* as large as the largest value */
  uint8_t devices_count;
} up_i2c_t;

void up_i2c_start(const up_i2c_port_t *port);
void up_i2c_cycle(const void *work);
#if HAL_USE_ADC == TRUE
/* One sensor of a conversion group. */
typedef struct {
  uint16_t field;
  uint16_t samples; /* the mean of so many, at most the group's depth */
  uint8_t column;   /* place in the group's sequence */
} up_analog_t;

/* One conversion group: what up_adc_cycle() works on. */
typedef struct {
  ADCDriver *driver;
  const ADCConversionGroup *group;
  adcsample_t *buffer; /* depth rows of num_channels columns */
  size_t depth;
  const up_analog_t *sensors;
  uint8_t sensors_count;
} up_adc_t;

void up_adc_cycle(const void *work);
#endif

#if HAL_USE_ICU == TRUE
/* One captured wire. */
typedef struct {
  ICUDriver *driver;
  up_capture_raw_t *raw;
} up_icu_input_t;

/* A sensor of captured wires: what up_icu_poll() works on. */
typedef struct {
  const up_icu_input_t *inputs; /* one an element */
  up_capture_config_t capture;
  up_capture_state_t *states; /* one an element */
  uint8_t *flags;             /* of an array: one an element */
  uint64_t *latest;           /* of an array: what each element was last; else NULL */
  uint64_t *value;            /* as large as the value */
  uint16_t field;
  uint8_t inputs_count;
  bool is_complete; /* an array is told when each element is new */
} up_icu_t;

/* The channels of a model receiver: what up_train_poll() works on. */
typedef struct {
  const up_ppm_config_t *config;
  const up_ppm_raw_t *raw;
  uint32_t *trains_seen;
  uint64_t *value; /* as large as the value */
  uint16_t field;
} up_train_t;

void up_icu_start(ICUDriver *driver, const ICUConfig *config);
void up_icu_poll(const up_icu_t *icu);
void up_train_poll(const up_train_t *train);

/* Makes the driver notice that its timer wrapped, so that it leaves out the capture; needs no action here. */
void up_icu_on_overflow(ICUDriver *driver);
#endif

/* What is kept of a timer that counts; all zero at the start. */
typedef struct {
  virtual_timer_t timer; /* of a counter of 16 bits: reads it in time */
  up_count_t count;
  int32_t told;
} up_encoder_state_t;

/* A timer that counts the edges of two tracks. No driver of ChibiOS knows it. */
typedef struct {
  stm32_tim_t *timer;
  up_encoder_state_t *state;
  uint8_t filter; /* of both inputs: IC1F and IC2F */
  bool is_wide;   /* the counter has 32 bits */
} up_encoder_counter_t;

/* A sensor of such timers: what up_encoder_poll() works on. */
typedef struct {
  const up_encoder_counter_t *counters; /* one an element */
  up_repeat_t *repeat;
  uint64_t *value; /* as large as the value */
  uint16_t field;
  uint8_t counters_count;
} up_encoder_t;

void up_encoder_start(const up_encoder_counter_t *counter);
void up_encoder_poll(const up_encoder_t *encoder);

#if HAL_USE_PWM == TRUE
typedef struct {
  PWMDriver *driver;
  pwmchannel_t channel; /* from 0 */
  up_pulse_width_t width;
} up_pwm_output_t;

/* An actuator of such outputs. */
typedef struct {
  const up_pwm_output_t *outputs; /* one an element */
  uint16_t field;
  uint8_t outputs_count;
} up_pwm_t;

/* One input of an H-bridge: an output of a timer, or a pin. */
typedef struct {
  const up_pwm_output_t *pwm; /* NULL for a pin */
  ioline_t line;
  bool is_low_active;
} up_bridge_output_t;

typedef struct {
  const up_drive_t *drive;
  up_drive_state_t *state;
  const up_bridge_output_t *outputs; /* in the order of up_drive_mode_t */
  uint16_t field;
} up_bridge_t;

/* From the next period on: what the host has set, or 0 to 10000 for all outputs. */
void up_pwm_set(const up_pwm_t *pwm, const void *value);
void up_pwm_set_level(const up_pwm_t *pwm, uint32_t level);

/* What the host has set, or -10000 to 10000. */
void up_bridge_set(const up_bridge_t *bridge, const void *value);
void up_bridge_set_level(const up_bridge_t *bridge, int32_t level);
#endif

/* An actuator of plain pins. */
typedef struct {
  const ioline_t *lines; /* one an element */
  uint16_t field;
  uint8_t lines_count;
  bool is_low_active;
} up_digital_output_t;

/* What is kept of an input; all zero at the start. */
typedef struct {
  up_contact_t contact;
  up_contact_told_t told;
} up_digital_state_t;

typedef struct {
  ioline_t line;
  const up_contact_config_t *config; /* NULL: its level as it is */
  up_digital_state_t *state;         /* NULL likewise */
} up_digital_input_t;

/* A sensor of plain pins. */
typedef struct {
  const up_digital_input_t *inputs; /* one an element */
  uint64_t *value;                  /* as large as the value */
  up_repeat_t *repeat;              /* with edges: told when something happens, and then again */
  uint32_t repeat_ms;
  uint16_t field;
  uint8_t inputs_count;
  bool is_low_active;
} up_digital_t;

/* The sensors that one thread reads: what up_digital_cycle() works on. */
typedef struct {
  const up_digital_t *sensors;
  uint8_t sensors_count;
} up_digital_class_t;

/* `lasting` of a contact, in ticks of the kernel, at least one. */
#define UP_LASTING_US(us) ((uint32_t)(((uint64_t)(us) * CH_CFG_ST_FREQUENCY + 999999U) / 1000000U))

void up_digital_set(const up_digital_output_t *output, const void *value);
void up_digital_cycle(const void *work);

/* Looks at contacts that are to be still: at the start, and in each cycle of the reporter. */
void up_digital_look(const up_digital_t *sensor);

#if PAL_USE_CALLBACKS == TRUE
/* Sensors with edges: an interrupt for each, and what came of them. */
void up_digital_start(const up_digital_t *sensor);
void up_digital_poll(const up_digital_t *sensor);
#endif

/* A line that gets a pulse. */
typedef struct {
  ioline_t line;
  uint32_t apart_ms; /* from it to the next line's, which would hear its answer; 0: that follows at once */
} up_pulse_line_t;

/* Lines that get a pulse each cycle: what up_pulse_cycle() works on. */
typedef struct {
  const up_pulse_line_t *lines;
  uint32_t pulse_us;
  uint8_t lines_count;
} up_pulse_t;

void up_pulse_cycle(const void *work);

#if UP_SHELL == TRUE
/* What the self test looks at. */

/* A wire that a device drives, or that a resistor pulls up. */
typedef struct {
  const char *title; /* "IRFront at PB0 (ADC12-IN8)" */
  ioline_t line;
  bool is_bus; /* pulled up, not driven */
} up_input_t;

typedef struct {
  const char *title;
  const up_chip_state_t *state;
} up_chip_check_t;

/* A bus on which each address can be asked. */
typedef struct {
  const char *title;
  bool (*answers)(const void *bus, uint8_t address);
  const void *bus;
  const uint8_t *expected; /* addresses that the design has there */
  size_t expected_count;
} up_probe_t;

/* A sensor that counts. */
typedef struct {
  const char *title;
  uint16_t field;
} up_edges_t;
#endif

/* A whole application. */
typedef struct {
  const char *board;
  const up_schema_t *schema;
  void *values;
  const uint32_t *cycles_ms; /* one a field: see up_health_t */
  void (*const *transforms)(void *value); /* one a field, NULL where there is none */
  const up_pad_t *pads;
  size_t pads_count;
  const up_task_t *tasks;
  size_t tasks_count;
  const up_filtered_t *filters; /* one a field, NULL where no field has one; then `filter` is up_filter_apply */
  up_result_t (*filter)(const up_filter_t *filter, up_filter_state_t *state, const up_field_t *field,
                        uint32_t now_ms, void *value);
  const up_counter_t *counters;
  size_t counters_count;
#if UP_LINK_USB == FALSE
  SerialDriver *link_driver;
  const SerialConfig *link_config;
#endif
#if UP_HAS_BUTTON == TRUE
  ioline_t button;
  uint8_t button_pressed; /* PAL_HIGH or PAL_LOW */
#endif
  uint32_t report_ms; /* the reporter's cycle */
#if UP_SHELL == TRUE
  const up_input_t *inputs;
  size_t inputs_count;
  const up_chip_check_t *chips;
  size_t chips_count;
  const up_probe_t *probes;
  size_t probes_count;
  const up_edges_t *edges;
  size_t edges_count;
#endif
} up_config_t;

extern const up_config_t up_config;

/* ---- what is generated beside the tables ---- */

/* Starts the drivers: once, behind the pads and before any thread. */
void sense_start(void);

/* Looks at what interrupts have gathered and puts it into the store: from the reporter, in each cycle. */
void sense_poll(void);

/* The host has set an actuator: does what is done at once. From the reporter, once for each value of a frame. */
void sense_apply(size_t field, const void *value);

/* The host has been silent for too long: brings the actuators that have a failsafe there. From the reporter. */
void sense_failsafe(void);

/* ---- values ---- */

/* Milliseconds since the start, from a thread; wraps at 2^32. */
uint32_t up_now_ms(void);

/* A sensor was read: `value` (which the user's transform may change) becomes due. From a thread. */
void up_put(size_t field, void *value);

/* A sensor could not be read; its last value stands. */
void up_fail(size_t field);

/* What came of one look at a sensor: a value (UP_FRESH) goes through the field's filter to up_put(), a fault is
 * counted. From a thread. */
void up_result(size_t field, up_result_t result, void *value);

/* The same as a sink for the core's functions; its context is not used. */
extern const up_value_sink_t up_values;

/* Copies the latest value; false while there is none. */
bool up_get(size_t field, void *value);

/* How often a value came in (0: never), how often reading it failed, and how old it is. */
uint32_t up_sequence(size_t field);
uint32_t up_errors(size_t field);
uint32_t up_age_ms(size_t field);

/* For the reporter: the store and the health of devices, which it uses between up_lock() and up_unlock(). */
up_store_t *up_store(void);
up_health_t *up_health(void);
void up_lock(void);
void up_unlock(void);

/* ---- the user's part; empty unless user/ defines it ---- */

/* Called once after the kernel has started and before any sensor thread runs. */
void up_user_init(void);

/* Called after a frame of the host has changed an actuator's value. From the reporter. */
void up_user_received(size_t field);

#endif
