/* Commands for people, over the same channel as the frames. */
#include "up_shell.h"

#if UP_SHELL == TRUE

#include <string.h>

#include "chprintf.h"
#include "shell.h"
#include "up_doctor.h"
#include "up_life.h"
#include "sense_model.h"
#include "up_link.h"
#include "up_text.h"

#define WRITE_MS 500U
#define READ_MS 100U
#define PRINT_MS 100U
#define STACK_BYTES 1024U
/* The most elements of an array that are shown. */
#define ELEMENTS_SHOWN 16U

static THD_WORKING_AREA(shell_stack, STACK_BYTES);
static thread_t *shell_thread;
static volatile bool is_streaming;
static bool starts_streaming;

/* ---- the stream that the shell reads and writes ---- */

/* Never blocks for good: a host that has gone must not hang the shell. */
static size_t stream_write(void *instance, const uint8_t *bytes, size_t size) {
  (void)instance;
  return chnWriteTimeout(up_channel(), bytes, size, TIME_MS2I(WRITE_MS));
}

static msg_t stream_put(void *instance, uint8_t byte) {
  return (stream_write(instance, &byte, 1U) == 1U) ? MSG_OK : MSG_RESET;
}

/* Ends with MSG_RESET when the host has gone or asks for frames. */
static msg_t stream_get(void *instance) {
  uint8_t byte;

  (void)instance;
  while (up_channel_is_open() && !is_streaming) {
    if (chnReadTimeout(up_channel(), &byte, 1U, TIME_MS2I(READ_MS)) == 1U) {
      if (up_link_peek(byte)) {
        is_streaming = true;
        return MSG_RESET;
      }
      return (msg_t)byte;
    }
  }
  return MSG_RESET;
}

static size_t stream_read(void *instance, uint8_t *bytes, size_t size) {
  size_t i;

  for (i = 0U; i < size; i++) {
    const msg_t byte = stream_get(instance);
    if (byte < 0) {
      break;
    }
    bytes[i] = (uint8_t)byte;
  }
  return i;
}

static const struct BaseSequentialStreamVMT stream_methods = {
    .instance_offset = 0U,
    .write = stream_write,
    .read = stream_read,
    .put = stream_put,
    .get = stream_get,
};
static BaseSequentialStream stream = {.vmt = &stream_methods};

/* ---- commands ---- */

static void print_value(BaseSequentialStream *out, size_t index) {
  static uint64_t value[(UP_VALUE_BYTES_MAX + 7U) / 8U];
  const up_field_t *field = &up_config.schema->fields[index];
  const size_t element_bytes = up_type_bytes(field->type);
  char text[UP_TEXT_BYTES];
  size_t i;

  if (!up_get(index, value)) {
    chprintf(out, "-");
    return;
  }
  for (i = 0U; i < field->count && i < ELEMENTS_SHOWN; i++) {
    (void)up_text_element(field->type, (const uint8_t *)value + i * element_bytes, text);
    chprintf(out, "%s%s", (i == 0U) ? "" : " ", text);
  }
  if (field->count > ELEMENTS_SHOWN) {
    chprintf(out, " ...");
  }
}

static void print_field(BaseSequentialStream *out, size_t index) {
  const up_field_t *field = &up_config.schema->fields[index];

  chprintf(out, "%3u %-24s ", (unsigned)field->id, field->name);
  print_value(out, index);
  if (up_sequence(index) > 0U) {
    chprintf(out, " (%lu ms old)", (unsigned long)up_age_ms(index));
  }
  if (up_errors(index) > 0U) {
    chprintf(out, " %lu errors", (unsigned long)up_errors(index));
  }
  chprintf(out, SHELL_NEWLINE_STR);
}

static void command_sensors(BaseSequentialStream *out, int argc, char *argv[]) {
  size_t i;

  (void)argc;
  (void)argv;
  for (i = 0U; i < up_config.schema->fields_count; i++) {
    print_field(out, i);
  }
}

static void print_health(BaseSequentialStream *out, size_t index) {
  static const char *const statuses[] = {"never read", "good", "stale", "failed", "invalid"};
  static const char *const causes[] = {"not acknowledged", "bus errors", "arbitrations lost", "timed out",
                                       "wrong checksums", "invalid"};
  const up_field_t *field = &up_config.schema->fields[index];
  up_health_row_t row;
  size_t i;

  up_lock();
  up_health_row(up_health(), index, up_now_ms(), &row);
  up_unlock();
  chprintf(out, "%3u %-24s %s", (unsigned)field->id, field->name, statuses[row.status]);
  if (row.age_ms < UP_AGE_LONG) {
    chprintf(out, ", last value %lu ms ago", (unsigned long)row.age_ms);
  }
  for (i = 0U; i < UP_FAULTS; i++) {
    if (row.counts[i] > 0U) {
      chprintf(out, ", %u %s", (unsigned)row.counts[i], causes[i]);
    }
  }
  chprintf(out, SHELL_NEWLINE_STR);
}

static void command_health(BaseSequentialStream *out, int argc, char *argv[]) {
  size_t i;

  (void)argc;
  (void)argv;
  for (i = 0U; i < up_config.schema->fields_count; i++) {
    print_health(out, i);
  }
}

static bool find_field(const char *name, size_t *index) {
  size_t i;

  for (i = 0U; i < up_config.schema->fields_count; i++) {
    if (strcmp(up_config.schema->fields[i].name, name) == 0) {
      *index = i;
      return true;
    }
  }
  return false;
}

static unsigned parse_times(const char *text) {
  unsigned times = 0U;

  for (; *text >= '0' && *text <= '9' && times < 10000U; text++) {
    times = times * 10U + (unsigned)(*text - '0');
  }
  return times;
}

static void command_print(BaseSequentialStream *out, int argc, char *argv[]) {
  unsigned times = (argc == 2) ? parse_times(argv[1]) : 1U;
  size_t index;

  if (argc < 1 || argc > 2) {
    shellUsage(out, "print NAME [TIMES]");
    return;
  }
  if (!find_field(argv[0], &index)) {
    chprintf(out, "no such sensor: %s" SHELL_NEWLINE_STR, argv[0]);
    return;
  }
  for (; times > 0U && up_channel_is_open(); times--) {
    print_field(out, index);
    if (times > 1U) {
      chThdSleepMilliseconds(PRINT_MS);
    }
  }
}

static void command_stream(BaseSequentialStream *out, int argc, char *argv[]) {
  (void)argc;
  (void)argv;
  chprintf(out, "frames follow; q brings the shell back" SHELL_NEWLINE_STR);
  is_streaming = true;
  shellExit(MSG_OK);
}

static void command_link(BaseSequentialStream *out, int argc, char *argv[]) {
  const up_reporter_t *reporter = up_link_reporter();

  (void)argc;
  (void)argv;
  chprintf(out, "schema 0x%08lx, checksum %s" SHELL_NEWLINE_STR, (unsigned long)up_config.schema->hash,
           up_config.schema->checksum);
  chprintf(out, "sent %lu reports, kept back %lu, torn %lu frames, too old %lu values" SHELL_NEWLINE_STR,
           (unsigned long)reporter->counts.reports_sent, (unsigned long)reporter->counts.reports_refused,
           (unsigned long)reporter->counts.frames_torn, (unsigned long)reporter->counts.values_dropped);
  chprintf(out, "received %lu frames, dropped %lu bytes" SHELL_NEWLINE_STR, (unsigned long)reporter->decoder.frames,
           (unsigned long)reporter->decoder.dropped_bytes);
  for (size_t i = 0U; i < up_config.counters_count; i++) {
    chprintf(out, "%s %lu times" SHELL_NEWLINE_STR, up_config.counters[i].title,
             (unsigned long)*up_config.counters[i].count);
  }
}

static void print_thread(BaseSequentialStream *out, const char *name, const void *stack, size_t bytes) {
  chprintf(out, "%-24s %5lu of %5lu bytes of stack never used" SHELL_NEWLINE_STR, name,
           (unsigned long)up_stack_left_of(stack, bytes), (unsigned long)bytes);
}

static void command_threads(BaseSequentialStream *out, int argc, char *argv[]) {
  static const char *const causes[] = {"unknown", "power", "reset pin", "software", "watchdog", "window watchdog",
                                       "low power", "kernel halt"};
  size_t i;

  (void)argc;
  (void)argv;
  for (i = 0U; i < up_config.tasks_count; i++) {
    print_thread(out, up_config.tasks[i].name, up_config.tasks[i].stack, up_config.tasks[i].stack_bytes);
  }
  print_thread(out, "shell", shell_stack, sizeof shell_stack);
  chprintf(out, "least of the application %u bytes, ", (unsigned)up_stack_left());
  if (up_load_percent() == UP_LOAD_UNKNOWN) {
    chprintf(out, "load not measured yet" SHELL_NEWLINE_STR);
  } else {
    chprintf(out, "load at most %u %%" SHELL_NEWLINE_STR, (unsigned)up_load_percent());
  }
  chprintf(out, "started by: %s", causes[up_reset_cause()]);
  if (up_reset_device() != 0U) {
    chprintf(out, " (thread of device %u)", (unsigned)up_reset_device());
  }
  if (up_reset_reason() != NULL) {
    chprintf(out, " (%s)", up_reset_reason());
  }
  chprintf(out, SHELL_NEWLINE_STR);
}

static void say_finding(void *context, const char *subject, const char *verdict) {
  chprintf(context, "%s: %s" SHELL_NEWLINE_STR, subject, verdict);
}

static void command_doctor(BaseSequentialStream *out, int argc, char *argv[]) {
  size_t found;

  (void)argc;
  (void)argv;
  found = up_doctor_run(say_finding, out);
  if (found == 0U) {
    chprintf(out, "nothing is wrong that the board can see" SHELL_NEWLINE_STR);
  }
}

/* The text that the schema hash is computed from: a host that expects another schema names the devices that differ. */
static void command_schema(BaseSequentialStream *out, int argc, char *argv[]) {
  const up_schema_t *schema = up_config.schema;
  size_t i;

  (void)argc;
  (void)argv;
  chprintf(out, "checksum %s" SHELL_NEWLINE_STR, schema->checksum);
  if (sense_reports.has_stamp) {
    chprintf(out, "stamp" SHELL_NEWLINE_STR);
  }
  for (i = 0U; i < schema->fields_count; i++) {
    const up_field_t *field = &schema->fields[i];

    chprintf(out, "%u %s %s %s", (unsigned)field->id,
             (field->direction == (uint8_t)UP_TO_HOST) ? "sensor" : "actuator", field->name,
             up_type_name(field->type));
    if (field->is_array) {
      chprintf(out, "[%u]", (unsigned)field->count);
    }
    chprintf(out, SHELL_NEWLINE_STR);
  }
}

static const ShellCommand commands[] = {
    {"sensors", command_sensors}, {"print", command_print},   {"stream", command_stream},
    {"link", command_link},       {"schema", command_schema}, {"threads", command_threads},
    {"health", command_health},   {"doctor", command_doctor},
    {NULL, NULL},
};

/* ---- the owner of the channel ---- */

static void run_shell(void) {
  static const ShellConfig config = {.sc_channel = &stream, .sc_commands = commands};

  shell_thread = chThdCreateStatic(shell_stack, sizeof shell_stack, NORMALPRIO, shellThread,
                                   (void *)(uintptr_t)&config);
}

void up_shell_start(void) {
  shellInit();
#if UP_HAS_BUTTON == TRUE
  starts_streaming = palReadLine(up_config.button) == up_config.button_pressed;
#endif
  is_streaming = starts_streaming;
}

void up_shell_channel_closed(void) {
  is_streaming = starts_streaming;
}

bool up_shell_cycle(void) {
  if (shell_thread != NULL) {
    if (!chThdTerminatedX(shell_thread)) {
      return true;
    }
    (void)chThdWait(shell_thread);
    shell_thread = NULL;
  }
  if (!is_streaming && up_channel_is_open()) {
    run_shell();
    return true;
  }
  return !is_streaming;
}

bool up_shell_wants(uint8_t byte) {
  /* A frame starts with a digit, so between two frames the letter can mean nothing else. */
  if (byte != (uint8_t)'q') {
    return false;
  }
  is_streaming = false;
  return true;
}

#else

void up_shell_start(void) {
}

void up_shell_channel_closed(void) {
}

bool up_shell_cycle(void) {
  return false;
}

#endif
