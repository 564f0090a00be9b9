/*
 * What the core makes of constants in program memory. The same program runs on a simulated ATmega328P and on the
 * computer: the texts must be the same.
 */
#include <string.h>

#include "say.h"

#include "up_chip.h"
#include "up_compose.h"
#include "up_convert.h"
#include "up_drive.h"
#include "up_encode.h"
#include "up_exchange.h"
#include "up_filter.h"
#include "up_ppm.h"
#include "up_stepper.h"
#include "up_text.h"

/* ---- the schema ---- */

enum { FIELD_AXES, FIELD_TEMPERATURE, FIELD_PRESSURE, FIELD_SPEED, FIELD_LATITUDE, FIELD_LAMPS, FIELD_TEXT, FIELDS };

static UP_ROM char name_axes[] = "Axes";
static UP_ROM char name_temperature[] = "Temperature";
static UP_ROM char name_pressure[] = "Pressure";
static UP_ROM char name_speed[] = "Speed";
static UP_ROM char name_latitude[] = "Latitude";
static UP_ROM char name_lamps[] = "Lamps";
static UP_ROM char name_text[] = "Text";

static UP_ROM up_field_t fields[FIELDS] = {
    {.name = name_axes, .id = 1U, .type = UP_TYPE_INT16, .count = 3U, .is_array = true},
    {.name = name_temperature, .id = 2U, .type = UP_TYPE_INT32, .count = 1U},
    {.name = name_pressure, .id = 3U, .type = UP_TYPE_UINT64, .count = 1U},
    {.name = name_speed, .id = 4U, .type = UP_TYPE_FLOAT32, .count = 1U},
    {.name = name_latitude, .id = 5U, .type = UP_TYPE_INT32, .count = 1U},
    {.name = name_lamps, .id = 6U, .type = UP_TYPE_UINT32, .direction = UP_TO_BOARD, .count = 2U, .is_array = true},
    {.name = name_text, .id = 7U, .type = UP_TYPE_UINT8, .direction = UP_TO_BOARD, .count = 3U, .is_array = true},
};
static UP_ROM up_schema_t schema = {.fields = fields, .fields_count = FIELDS};

static uint64_t memory[2];

static void on_value(void *context, uint16_t field, up_result_t result, void *value) {
  UP_ROM up_field_t *of = &schema.fields[field];
  char text[UP_TEXT_BYTES];
  size_t i;

  (void)context;
  say_rom(of->name);
  say_byte(' ');
  say_rom(up_type_name(of->type));
  for (i = 0U; result == UP_FRESH && i < of->count; i++) {
    (void)up_text_element(of->type, (uint8_t *)value + i * up_type_bytes(of->type), text);
    say_byte(' ');
    say(text);
  }
  say_byte(' ');
  say_byte((char)('0' + (char)result));
  say_byte('\n');
}

static const up_value_sink_t sink = {.on_value = on_value};

/* ---- a chip on a bus ---- */

static UP_ROM uint8_t setup[] = {0x6BU, 0x00U};
static UP_ROM up_chip_init_t init[] = {{.bytes = setup, .count = sizeof setup}};
static UP_ROM uint8_t who[] = {0x75U}, whose[] = {0x58U}, mask[] = {0xFEU};
static UP_ROM up_chip_identity_t identity = {
    .select = who, .expected = whose, .mask = mask, .select_count = 1U, .count = 1U};
static UP_ROM uint8_t calibration_select[] = {0x88U};
static UP_ROM up_chip_calibration_t calibration[] = {{.select = calibration_select, .select_count = 1U, .count = 24U}};
static UP_ROM uint8_t trigger[] = {0xF4U, 0x25U}, select[] = {0xF7U};
static UP_ROM up_chip_transfer_t transfers[] = {
    {.trigger = trigger, .trigger_count = sizeof trigger, .select = select, .select_count = 1U, .length = 6U}};
static UP_ROM uint8_t order[] = {2U, 0U, 1U};
static UP_ROM up_chip_reading_t readings[] = {
    {.field = FIELD_TEMPERATURE, .computed = true, .output = 0U},
    {.field = FIELD_PRESSURE, .computed = true, .output = 1U},
    {.field = FIELD_AXES, .value = {.elements = order, .words = 3U, .word_bytes = 2U, .is_signed = true}},
};
static UP_ROM uint8_t prefix[] = {0x40U, 0x41U}, colours[] = {1U, 0U, 2U};
static UP_ROM up_chip_command_t commands[] = {
    {.prefix = prefix, .prefix_count = 2U, .field = FIELD_TEXT, .value = {.code = UP_CODE_TEXT, .word_bytes = 1U}},
    {.field = FIELD_LAMPS, .value = {.elements = colours, .words = 3U, .code = UP_CODE_LEDS, .word_bytes = 1U}},
};
static UP_ROM up_chip_t chip = {
    .init = init, .init_count = 1U, .identity = &identity, .calibration = calibration, .calibration_count = 1U,
    .transfers = transfers, .transfers_count = 1U, .readings = readings, .readings_count = 3U,
    .commands = commands, .commands_count = 2U, .formula = &up_formula_bmp280, .cycle_ms = 10U, .address = 0x76U,
};

/* The example of the part's data sheet. */
static UP_ROM uint8_t stored[24] = {0x70U, 0x6BU, 0x43U, 0x67U, 0x18U, 0xFCU, 0x7DU, 0x8EU, 0x43U, 0xD6U, 0xD0U, 0x0BU,
                                    0x27U, 0x0BU, 0x8CU, 0x00U, 0xF9U, 0xFFU, 0x8CU, 0x3CU, 0xF8U, 0xC6U, 0x70U, 0x17U};
static UP_ROM uint8_t measured[6] = {0x65U, 0x5AU, 0xC0U, 0x7EU, 0xEDU, 0x00U};

static up_bus_result_t write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  (void)context;
  (void)address;
  say("write ");
  say_bytes(bytes, count);
  return UP_BUS_DONE;
}

static up_bus_result_t write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count) {
  (void)context;
  (void)address;
  say("select ");
  say_bytes(tx, tx_count);
  memset(rx, 0x59, rx_count);
  if (rx_count == sizeof stored) {
    up_rom_copy(rx, stored, rx_count);
  } else if (rx_count == sizeof measured) {
    up_rom_copy(rx, measured, rx_count);
  }
  return UP_BUS_DONE;
}

static uint32_t now_ms(void) {
  static uint32_t ms;

  ms += 3U;
  return ms;
}

static void run_chip(void) {
  static uint8_t work[64], calibration_bytes[24];
  static up_chip_transfer_state_t states[1];
  static up_chip_state_t state = {
      .transfers = states, .calibration = calibration_bytes, .work = work, .scratch = memory};
  static UP_ROM up_bus_t bus = {.write = write, .write_read = write_read};
  static const uint32_t lamps[2] = {0x123456U, 0x05FF0102U};
  static const uint8_t text[3] = {'A', 'z', '~'};

  say_byte((char)('0' + (char)(up_chip_work_bytes(&chip, &schema) % 10U)));
  say_byte('\n');
  up_chip_step(&chip, &state, &bus, &schema, now_ms, &sink);
  up_chip_step(&chip, &state, &bus, &schema, now_ms, &sink);
  (void)up_chip_write(&chip, &state, &bus, &schema, &commands[0], text);
  (void)up_chip_write(&chip, &state, &bus, &schema, &commands[1], lamps);
}

/* ---- a part on a serial line ---- */

static UP_ROM uint8_t dollar[] = {'$'}, line_end[] = {'\r', '\n'};
static UP_ROM char sentence[] = "RMC";
static UP_ROM up_message_field_t spoken[] = {
    {.field = FIELD_SPEED, .format = UP_FORMAT_DECIMAL, .sentence = sentence, .separator = ',', .index = 6U},
    {.field = FIELD_LATITUDE, .format = UP_FORMAT_DEGREES, .sentence = sentence, .separator = ',', .index = 2U},
};
static UP_ROM up_message_t message = {
    .start = dollar, .start_count = 1U, .end = line_end, .end_count = 2U, .fields = spoken, .fields_count = 2U,
    .bytes_max = 100U, .checksum = UP_CHECKSUM_NMEA,
};
static UP_ROM uint8_t request[] = {0x01U, 0x04U, 0x01U};
static UP_ROM up_message_field_t answered[] = {
    {.field = FIELD_TEMPERATURE, .value = {.word_bytes = 2U, .little_endian = true, .is_signed = true}}};
static UP_ROM up_message_t answer = {
    .start = request, .start_count = 3U, .fields = answered, .fields_count = 1U, .length = 2U, .bytes_max = 7U,
    .checksum = UP_CHECKSUM_CRC16_UMTS,
};
static UP_ROM up_exchange_t exchange = {
    .request = request, .request_count = 3U, .answer = &answer, .is_primed = true};
static UP_ROM up_compose_t composed = {
    .start = dollar, .start_count = 1U, .behind = request, .behind_count = 3U, .end = line_end, .end_count = 2U,
    .format = UP_FORMAT_DECIMAL, .decimals = 3U, .checksum = UP_CHECKSUM_CRC16_XMODEM,
};

static void run_line(void) {
  static const uint8_t heard[] = "x$GPRMC,1,A,4807.038,N,01131.000,E,022.4*04\r\n"
                                 "$GPRMC,1,A,4807.038,N,01131.000,E,,*00\r\n";
  static const uint8_t replied[] = {0xF0U, 0xFFU, 0x62U, 0x72U};
  static const int32_t told = -1234567;
  static uint8_t buffer[100];
  up_message_state_t state = {.buffer = buffer, .scratch = memory};
  uint8_t bytes[40];
  size_t heard_count = 0U;

  up_message_feed(&message, &state, &schema, heard, sizeof heard - 1U, &sink);
  up_exchange_begin(&exchange, &state, &schema);
  say_byte((char)('0' + (char)up_exchange_take(&exchange, &state, &schema, replied, sizeof replied, &sink)));
  say_byte((char)('0' + (char)up_reply_take(&heard_count, line_end, 2U, (const uint8_t *)"\r\n", 2U)));
  say_byte('\n');
  say_bytes(bytes, up_compose(&composed, &schema.fields[FIELD_TEMPERATURE], &told, bytes, sizeof bytes));
}

/* ---- filters, and what else has constants ---- */

static UP_ROM up_range_t invalid[] = {{.low.f = -0.5F, .high.f = 0.0F}};
static UP_ROM up_filter_t filter = {
    .invalid = invalid, .invalid_count = 1U, .median = 3U, .has_change = true, .smooth_ms = 100U, .change.f = 0.01F};
static UP_ROM up_stepper_t motor = {.tick_hz = 1000000U, .speed = 2000U, .acceleration = 5000U};
static UP_ROM up_drive_t bridge = {.mode = UP_DRIVE_DIRECTION_PINS, .full = 10000U};
static UP_ROM up_ppm_config_t train = {.tick_hz = 1000000U, .gap_ticks = 2700U, .min_ticks = 500U};

static void run_filter(void) {
  static uint64_t own[UP_FILTER_WORDS(1U, 4U, 3U, true, true)];
  static up_filter_state_t state = {.memory = own};
  static const float values[] = {1.5F, -0.25F, 80.0F, 2.0F, 2.001F};
  size_t i;

  for (i = 0U; i < sizeof values / sizeof values[0]; i++) {
    float value = values[i];
    const up_result_t result =
        up_filter_apply(&filter, &state, &schema.fields[FIELD_SPEED], (uint32_t)i * 30U, &value);
    on_value(NULL, FIELD_SPEED, result, &value);
  }
}

static void say_number(uint32_t number) {
  char text[UP_TEXT_BYTES];

  (void)up_text_element(UP_TYPE_UINT32, &number, text);
  say(text);
  say_byte('\n');
}

static void run_others(void) {
  static const uint8_t check[] = "123456789";
  static const int16_t strength = -20000;
  static const bool yes = true;
  up_stepper_state_t steps = {.target = 0};
  up_drive_state_t drive = {0};
  up_ppm_raw_t raw = {0U};
  up_drive_write_t writes[UP_DRIVE_WRITES_MAX];
  const int32_t target = 3;
  char text[UP_TEXT_BYTES];
  size_t count, i;

  say_number(~up_crc32(UP_CRC32_INIT, check, 9U));
  say_number(up_filter_decay(70U, 300U));
  up_stepper_command(&motor, &steps, UP_TYPE_INT32, &target);
  for (i = 0U; i < 4U; i++) {
    say_number(up_stepper_advance(&motor, &steps));
  }
  count = up_drive(&bridge, &drive, UP_TYPE_INT16, &strength, writes);
  for (i = 0U; i < count; i++) {
    say_number(writes[i].output * 100000U + writes[i].value);
  }
  up_ppm_on_interval(&train, &raw, 5000U);
  up_ppm_on_interval(&train, &raw, 1500U);
  up_ppm_on_interval(&train, &raw, 5000U);
  say_number(raw.trains * 10000U + raw.channels[0]);
  (void)up_text_element(UP_TYPE_BOOL, &yes, text);
  say(text);
  say_byte('\n');
}

int main(void) {
  begin();
  run_chip();
  run_line();
  run_filter();
  run_others();
  end();
  return 0;
}
