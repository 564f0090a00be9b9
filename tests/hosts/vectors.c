/*
 * Runs wire vectors through the decoder and encoder of the C host: what `vectors.cpp` does for C++.
 *
 * Argument: the number of the board, whose schema is in `boards.h`, which the test writes. A stream is decoded at once,
 * byte by byte, as given and cut at each place; `differs` says that two did not agree.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "boards.h"

enum { LINE_BYTES = 1 << 20 };

typedef struct {
    char *text;
    size_t length;
    size_t room;
} log_text;

static void put(log_text *log, const char *text) {
    const size_t count = strlen(text);
    if (log->length + count + 1 > log->room) {
        log->room = 2 * (log->length + count + 1);
        log->text = (char *)realloc(log->text, log->room);
    }
    memcpy(log->text + log->length, text, count + 1);
    log->length += count;
}

static void put_number(log_text *log, const char *before, uint64_t number) {
    char digits[64];
    (void)snprintf(digits, sizeof digits, "%s%" PRIu64, before, number);
    put(log, digits);
}

static void put_elements(log_text *log, const sensedsl_device *device, const uint8_t *bytes) {
    uint64_t raw[1024];
    size_t i;
    sensedsl_load(device, bytes, raw);
    for (i = 0; i < device->count; ++i) {
        char digits[64];
        const char *before = i == 0 ? "=" : ",";
        switch (device->type) {
        case SENSEDSL_BOOL:
            (void)snprintf(digits, sizeof digits, "%s%s", before, ((const bool *)raw)[i] ? "true" : "false");
            break;
        case SENSEDSL_UINT64:
            (void)snprintf(digits, sizeof digits, "%s%" PRIu64, before, ((const uint64_t *)raw)[i]);
            break;
        case SENSEDSL_INT64:
            (void)snprintf(digits, sizeof digits, "%s%" PRId64, before, ((const int64_t *)raw)[i]);
            break;
        case SENSEDSL_FLOAT32:
            (void)snprintf(digits, sizeof digits, "%s%.9g", before, (double)((const float *)raw)[i]);
            break;
        default:
            (void)snprintf(digits, sizeof digits, "%s%.17g", before, (double)sensedsl_number(device, raw, i));
        }
        put(log, digits);
    }
}

static void put_health(log_text *log, const sensedsl_schema *schema, const sensedsl_frame *frame) {
    sensedsl_event event;
    sensedsl_device_health device;
    size_t place;
    memset(&event, 0, sizeof event);
    event.kind = SENSEDSL_EVENT_HEALTH;
    event.frame = frame;
    sensedsl_read_health(frame, &event.health);
    put_number(log, "got health ", event.health.uptime_ms);
    put_number(log, " ", event.health.reset_cause);
    put_number(log, " ", event.health.reset_device);
    put_number(log, " ", event.health.reports_sent);
    put_number(log, " ", event.health.reports_refused);
    put_number(log, " ", event.health.load_percent);
    put_number(log, " ", event.health.stack_left_bytes);
    for (place = 0; sensedsl_health_of(schema, &event, place, &device); ++place) {
        size_t cause;
        put_number(log, " ", device.device->id);
        put_number(log, "=", device.status);
        put_number(log, "/", device.age_ms);
        for (cause = 0; cause < 6; ++cause) {
            put_number(log, "/", device.failures[cause]);
        }
    }
    put(log, "\n");
}

static void put_frame(log_text *log, const sensedsl_schema *schema, const sensedsl_frame *frame) {
    char digits[64];
    if (frame->kind == SENSEDSL_HELLO) {
        (void)snprintf(digits, sizeof digits, "got hello 0x%08" PRIx32 "\n", frame->hash);
        put(log, digits);
    } else if (frame->kind == SENSEDSL_HEALTH) {
        put_health(log, schema, frame);
    } else if (frame->kind == SENSEDSL_OTHER_HEALTH) {
        put_number(log, "got health-version ", frame->version);
        put(log, "\n");
    } else {
        const sensedsl_device *device;
        const uint8_t *bytes;
        size_t at = 0;
        put(log, "got");
        if (frame->is_stamped) {
            put_number(log, " stamp=", frame->time_us);
            put_number(log, "/", frame->counter);
        }
        while ((device = sensedsl_value(schema, frame, &at, &bytes)) != NULL) {
            put_number(log, " ", device->id);
            put_elements(log, device, bytes);
        }
        put(log, "\n");
    }
}

/* Decodes the stream in pieces that end at the cuts; each has memory of its own, so that a sanitizer sees what is read
 * too far. */
static log_text decode(const sensedsl_schema *schema, const uint8_t *stream, const size_t *cuts, size_t cut_count) {
    log_text log = {NULL, 0, 0};
    uint8_t *held = (uint8_t *)malloc(schema->frame_bytes);
    sensedsl_decoder decoder;
    size_t start = 0;
    size_t i;
    sensedsl_decoder_open(&decoder, schema, held);
    for (i = 0; i < cut_count; ++i) {
        const size_t size = cuts[i] - start;
        uint8_t *piece = (uint8_t *)malloc(size + 1);
        uint8_t *end = (uint8_t *)realloc(piece, size > 0 ? size : 1);
        const uint8_t *bytes = end;
        size_t count = size;
        const sensedsl_frame *frame;
        memcpy(end, stream + start, size);
        while ((frame = sensedsl_decode(&decoder, &bytes, &count)) != NULL) {
            put_frame(&log, schema, frame);
        }
        start = cuts[i];
        free(end);
    }
    put_number(&log, "dropped ", decoder.dropped_bytes);
    put(&log, "\n");
    free(held);
    return log;
}

static void agree(const char *text, log_text other, const char *how) {
    if (strcmp(text, other.text) != 0) {
        printf("differs %s\n", how);
    }
    free(other.text);
}

static void decode_every_way(const sensedsl_schema *schema, char *words) {
    uint8_t *stream = (uint8_t *)malloc(LINE_BYTES);
    size_t *cuts = (size_t *)malloc(LINE_BYTES * sizeof *cuts);
    size_t length = 0;
    size_t pieces = 0;
    size_t i;
    log_text log;
    char *word;
    for (word = strtok(words, " \n"); word != NULL; word = strtok(NULL, " \n")) {
        for (i = 0; word[i] != '\0'; i += 2) {
            char digits[3] = {word[i], word[i + 1], '\0'};
            stream[length++] = (uint8_t)strtoul(digits, NULL, 16);
        }
        cuts[pieces++] = length;
    }
    log = decode(schema, stream, cuts, pieces);
    for (i = 0; i < length; ++i) {
        cuts[i] = i + 1;
    }
    agree(log.text, decode(schema, stream, cuts, length), "byte by byte");
    cuts[0] = length;
    agree(log.text, decode(schema, stream, cuts, 1), "at once");
    for (i = 0; i <= length; ++i) {
        cuts[0] = i;
        cuts[1] = length;
        agree(log.text, decode(schema, stream, cuts, 2), "when cut");
    }
    printf("%s", log.text);
    free(log.text);
    free(cuts);
    free(stream);
}

static const sensedsl_device *device_of(const sensedsl_schema *schema, unsigned long id) {
    size_t i;
    for (i = 0; i < schema->device_count; ++i) {
        if (schema->devices[i].id == id && !schema->devices[i].is_sensor) {
            return &schema->devices[i];
        }
    }
    printf("no actuator %lu\n", id);
    exit(1);
}

static void put_element(const sensedsl_device *device, void *raw, size_t i, const char *text) {
    switch (device->type) {
    case SENSEDSL_BOOL:
        ((bool *)raw)[i] = text[0] == 't' || text[0] == '1';
        break;
    case SENSEDSL_UINT8:
        ((uint8_t *)raw)[i] = (uint8_t)strtoul(text, NULL, 10);
        break;
    case SENSEDSL_INT8:
        ((int8_t *)raw)[i] = (int8_t)strtol(text, NULL, 10);
        break;
    case SENSEDSL_UINT16:
        ((uint16_t *)raw)[i] = (uint16_t)strtoul(text, NULL, 10);
        break;
    case SENSEDSL_INT16:
        ((int16_t *)raw)[i] = (int16_t)strtol(text, NULL, 10);
        break;
    case SENSEDSL_UINT32:
        ((uint32_t *)raw)[i] = (uint32_t)strtoul(text, NULL, 10);
        break;
    case SENSEDSL_INT32:
        ((int32_t *)raw)[i] = (int32_t)strtol(text, NULL, 10);
        break;
    case SENSEDSL_UINT64:
        ((uint64_t *)raw)[i] = strtoull(text, NULL, 10);
        break;
    case SENSEDSL_INT64:
        ((int64_t *)raw)[i] = strtoll(text, NULL, 10);
        break;
    case SENSEDSL_FLOAT32:
        ((float *)raw)[i] = strtof(text, NULL);
        break;
    case SENSEDSL_FLOAT64:
        ((double *)raw)[i] = strtod(text, NULL);
        break;
    }
}

static void print_hex(const char *before, const uint8_t *bytes, size_t count) {
    size_t i;
    printf("%s", before);
    for (i = 0; i < count; ++i) {
        printf("%02x", (unsigned)bytes[i]);
    }
    printf("\n");
}

static void encode(const sensedsl_schema *schema, char *words) {
    uint8_t frame[8192];
    sensedsl_writer writer;
    char *word;
    sensedsl_begin(&writer, schema, frame, sizeof frame);
    for (word = strtok(words, " \n"); word != NULL; word = strtok(NULL, " \n")) {
        uint64_t raw[1024];
        char *text;
        const sensedsl_device *device = device_of(schema, strtoul(word, &text, 10));
        size_t i;
        for (i = 0; i < device->count; ++i) {
            ++text; /* over `=` or `,` */
            put_element(device, raw, i, text);
            text += strcspn(text, ",");
        }
        if (!sensedsl_add(&writer, device, raw)) {
            printf("not added: %d\n", device->id);
        }
    }
    print_hex("frame ", frame, sensedsl_end(&writer));
}

int main(int count, char **arguments) {
    const sensedsl_schema *schema = boards[strtoul(arguments[count - 1], NULL, 10)];
    char *line = (char *)malloc(LINE_BYTES);
    while (fgets(line, LINE_BYTES, stdin) != NULL) {
        uint8_t question[SENSEDSL_QUESTION_BYTES];
        if (strncmp(line, "decode sensors", 14) == 0) {
            decode_every_way(schema, line + 14);
        } else if (strncmp(line, "encode actuators", 16) == 0) {
            encode(schema, line + 16);
        } else if (strncmp(line, "hash", 4) == 0) {
            print_hex("hello-request ", question, sensedsl_question(schema->checksum, false, question));
            print_hex("health-request ", question, sensedsl_question(schema->checksum, true, question));
        } else {
            printf("what is %s", line);
        }
        printf("end\n");
    }
    free(line);
    return 0;
}
