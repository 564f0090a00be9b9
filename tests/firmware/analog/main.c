/* Threads of analog sensors, and voltages of outputs, on drivers that the test controls. */
#include <stdio.h>
#include <string.h>

#include "up_adc.h"
#include "up_dac.h"
#include "up_rt.h"

#define CHECK(condition) check((condition), #condition, __LINE__)

static unsigned checks, failures;

static void check(bool is_true, const char *text, int line) {
  checks++;
  if (!is_true) {
    failures++;
    printf("line %d: %s\n", line, text);
  }
}

/* ---- the drivers ---- */

typedef enum { ENDS, ENDS_EARLY, FAILS, HANGS } ending_t;

static ADCDriver units[2];
static ending_t endings[2];
static bool is_locked;
static int started, stopped;
static sysinterval_t patience_ms;

static void end(ADCDriver *driver, ending_t ending) {
  if (ending == HANGS) {
    return;
  }
  driver->state = ADC_READY;
  if (ending == FAILS) {
    driver->group->error_cb(driver, 2U);
  }
}

void adcAcquireBus(ADCDriver *driver) {
  driver->locks++;
}

void adcReleaseBus(ADCDriver *driver) {
  driver->locks--;
}

void adcStartConversion(ADCDriver *driver, const ADCConversionGroup *group, adcsample_t *samples, size_t depth) {
  (void)samples;
  (void)depth;
  CHECK(driver->state == ADC_READY);
  CHECK(driver->locks == 1);
  driver->state = ADC_ACTIVE;
  driver->group = group;
  started++;
  if (endings[driver - units] == ENDS_EARLY) {
    end(driver, ENDS_EARLY);
  }
}

void adcStopConversion(ADCDriver *driver) {
  CHECK(!is_locked);
  CHECK(driver->locks == 1);
  driver->state = ADC_READY;
  stopped++;
}

msg_t osalThreadSuspendTimeoutS(thread_reference_t *thread, sysinterval_t timeout) {
  const int unit = thread == &units[0].thread ? 0 : 1;

  /* A thread that waits has started all of its groups. */
  CHECK(is_locked);
  CHECK(started == 2);
  CHECK(endings[unit] != ENDS_EARLY);
  patience_ms = timeout;
  end(&units[unit], endings[unit]);
  return 0;
}

void osalSysLock(void) {
  CHECK(!is_locked);
  is_locked = true;
}

void osalSysUnlock(void) {
  is_locked = false;
}

msg_t dacPutChannelX(DACDriver *driver, uint32_t channel, dacsample_t sample) {
  driver->channel = channel;
  driver->code = sample;
  return 0;
}

/* ---- the application ---- */

enum { FIELD_LINE, FIELD_MEAN, FIELD_WARM, FIELD_LEVEL, FIELD_SIGNED, FIELDS };

static const up_field_t fields[] = {
    {.name = "Line", .id = 1U, .type = UP_TYPE_UINT16, .is_array = true, .count = 3U},
    {.name = "Mean", .id = 2U, .type = UP_TYPE_FLOAT32, .count = 1U},
    {.name = "Warm", .id = 3U, .type = UP_TYPE_INT32, .count = 1U},
    {.name = "Level", .id = 4U, .type = UP_TYPE_FLOAT32, .count = 1U},
    {.name = "Signed", .id = 5U, .type = UP_TYPE_INT16, .is_array = true, .count = 2U},
};
static const up_schema_t schema = {.fields = fields, .fields_count = FIELDS};
const up_config_t up_config = {.schema = &schema};

static up_result_t results[FIELDS];
static int puts_of[FIELDS];
static uint64_t values[FIELDS];

void up_result(size_t field, up_result_t result, void *value) {
  CHECK(units[0].locks == 0 && units[1].locks == 0);
  results[field] = result;
  puts_of[field]++;
  if (result == UP_FRESH) {
    memcpy(&values[field], value, sizeof values[field]);
  }
}

/* The first unit has two rows of two columns with twelve bits, the second two rows of three columns with sixteen
 * bits. */
static adcsample_t narrow[4], wide[6];
static const ADCConversionGroup narrow_group = {.num_channels = 2U, .error_cb = up_adc_on_error};
static const ADCConversionGroup wide_group = {.num_channels = 3U, .error_cb = up_adc_on_error};
static const up_adc_group_t groups[] = {
    {.driver = &units[0], .group = &narrow_group, .samples = narrow, .depth = 2U, .full = 4095U, .timeout_ms = 5U},
    {.driver = &units[1], .group = &wide_group, .samples = wide, .depth = 2U, .full = 65535U, .timeout_ms = 7U},
};
static const int32_t thermistor[] = {3950, 10000, 10000};
static const up_adc_formula_t warm_formula = {.formula = &up_formula_ntc, .parameters = thermistor, .output = 0U};
static const up_adc_input_t inputs[] = {
    {.field = FIELD_LINE, .element = 0U, .samples = 2U, .group = 1U, .column = 2U},
    {.field = FIELD_LINE, .element = 1U, .samples = 2U, .group = 0U, .column = 1U},
    {.field = FIELD_LINE, .element = 2U, .samples = 1U, .group = 1U, .column = 0U},
    {.field = FIELD_MEAN, .element = 0U, .samples = 2U, .group = 0U, .column = 0U},
    {.field = FIELD_WARM, .element = 0U, .samples = 2U, .group = 1U, .column = 1U, .formula = &warm_formula},
};
static uint64_t value[1];
static const up_adc_t adc = {
    .groups = groups,
    .groups_count = 2U,
    .inputs = inputs,
    .inputs_count = 5U,
    .value = value,
};

static void cycle(ending_t first, ending_t second) {
  memset(puts_of, 0, sizeof puts_of);
  endings[0] = first;
  endings[1] = second;
  started = 0;
  up_adc_cycle(&adc);
  CHECK(units[0].locks == 0 && units[1].locks == 0);
  CHECK(units[0].state == ADC_READY && units[1].state == ADC_READY);
  CHECK(puts_of[FIELD_LINE] == 1 && puts_of[FIELD_MEAN] == 1 && puts_of[FIELD_WARM] == 1);
}

static void samples_become_values(void) {
  uint16_t line[3];
  float mean;
  int32_t warm;

  /* Each row has columns 0, 1 (and 2). */
  memcpy(narrow, (const adcsample_t[]){100U, 4095U, 101U, 4095U}, sizeof narrow);
  memcpy(wide, (const adcsample_t[]){65535U, 32768U, 16U, 0U, 32767U, 32U}, sizeof wide);
  cycle(ENDS, ENDS_EARLY);
  CHECK(results[FIELD_LINE] == UP_FRESH);
  memcpy(line, &values[FIELD_LINE], sizeof line);
  CHECK(line[0] == 1U);    /* (16 + 32) / 2 of 65535: 1.4997 of 4095 */
  CHECK(line[1] == 4095U); /* full scale of twelve bits */
  CHECK(line[2] == 4095U); /* only the first row; full scale of sixteen bits is not 4096 */
  memcpy(&mean, &values[FIELD_MEAN], sizeof mean);
  CHECK(mean > 100.49F && mean < 100.51F);
  /* Half of the supply: the thermistor has the same resistance as the resistor, at 25 degrees. */
  memcpy(&warm, &values[FIELD_WARM], sizeof warm);
  CHECK(results[FIELD_WARM] == UP_FRESH && warm >= 2490 && warm <= 2510);
}

static void a_break_is_no_temperature(void) {
  wide[1] = 65535U;
  wide[4] = 65535U;
  cycle(ENDS_EARLY, ENDS_EARLY);
  CHECK(results[FIELD_WARM] == UP_INVALID);
  CHECK(results[FIELD_LINE] == UP_FRESH);
}

static void a_unit_that_fails_tells_of_its_values(void) {
  cycle(FAILS, ENDS);
  CHECK(results[FIELD_MEAN] == UP_BUS_ERROR);
  CHECK(results[FIELD_LINE] == UP_BUS_ERROR); /* one of its elements */
  CHECK(results[FIELD_WARM] == UP_INVALID);
  /* The failure is forgotten. */
  cycle(ENDS, ENDS);
  CHECK(results[FIELD_MEAN] == UP_FRESH && results[FIELD_LINE] == UP_FRESH);
}

static void a_unit_that_hangs_is_stopped(void) {
  stopped = 0;
  cycle(ENDS, HANGS);
  CHECK(stopped == 1);
  CHECK(patience_ms == 7U);
  CHECK(results[FIELD_LINE] == UP_TIMED_OUT);
  CHECK(results[FIELD_WARM] == UP_TIMED_OUT);
  CHECK(results[FIELD_MEAN] == UP_FRESH);
  cycle(HANGS, HANGS);
  CHECK(stopped == 3);
  CHECK(results[FIELD_MEAN] == UP_TIMED_OUT);
}

static void values_become_codes(void) {
  const float levels[] = {-5.0F, 0.4F, 2047.5F, 4095.4F, 1e9F};
  const uint32_t codes[] = {0U, 0U, 2048U, 4095U, 4095U};
  const int16_t pair[] = {-1, 4096};
  DACDriver output = {.channel = 9U};
  size_t i;

  for (i = 0U; i < 5U; i++) {
    up_dac_set(&output, FIELD_LEVEL, &levels[i], 0U);
    CHECK(output.code == codes[i] && output.channel == 0U);
  }
  up_dac_set(&output, FIELD_SIGNED, pair, 0U);
  CHECK(output.code == 0U);
  up_dac_set(&output, FIELD_SIGNED, pair, 1U);
  CHECK(output.code == 4095U);
}

int main(void) {
  samples_become_values();
  a_break_is_no_temperature();
  a_unit_that_fails_tells_of_its_values();
  a_unit_that_hangs_is_stopped();
  values_become_codes();
  printf("%u checks, %u failures\n", checks, failures);
  return failures == 0U ? 0 : 1;
}
