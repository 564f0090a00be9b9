/* The host's end of a link: see sensedsl.h. First: frames that are received. */
#include "sensedsl.h"

#include <string.h>

enum {
    HELLO = 0,
    HEALTH = 255,
    CHECKSUM = 255,
    HEALTH_VERSION = 1,
    STAMP_BYTES = 6,
    HEALTH_HEAD_BYTES = 17, /* behind the version */
    HEALTH_DEVICE_BYTES = 17,
    ASK_EVERY_MS = 250,
    ASK_RARELY_MS = 1000,
    ASK_RARELY_AFTER_MS = 5000
};

typedef enum { INVALID, INCOMPLETE, COMPLETE } verdict;

static uint32_t load32(const uint8_t *bytes) {
    return ((uint32_t)bytes[0] << 24) | ((uint32_t)bytes[1] << 16) | ((uint32_t)bytes[2] << 8) | bytes[3];
}

static uint16_t load16(const uint8_t *bytes) { return (uint16_t)(((unsigned)bytes[0] << 8) | bytes[1]); }

static size_t crc_bytes(sensedsl_checksum checksum) {
    return checksum == SENSEDSL_NONE ? 0 : checksum == SENSEDSL_CRC16 ? 3 : 5;
}

/* Half a byte at a time: a table of 16 entries costs less memory than one of 256. */
static uint32_t sum(sensedsl_checksum checksum, const uint8_t *bytes, size_t count) {
    static const uint16_t table16[16] = {0x0000, 0x1021, 0x2042, 0x3063, 0x4084, 0x50A5, 0x60C6, 0x70E7,
                                         0x8108, 0x9129, 0xA14A, 0xB16B, 0xC18C, 0xD1AD, 0xE1CE, 0xF1EF};
    static const uint32_t table32[16] = {0x00000000, 0x1DB71064, 0x3B6E20C8, 0x26D930AC, 0x76DC4190, 0x6B6B51F4,
                                         0x4DB26158, 0x5005713C, 0xEDB88320, 0xF00F9344, 0xD6D6A3E8, 0xCB61B38C,
                                         0x9B64C2B0, 0x86D3D2D4, 0xA00AE278, 0xBDBDF21C};
    uint32_t crc = checksum == SENSEDSL_CRC16 ? 0xFFFFU : 0xFFFFFFFFU;
    size_t i;
    for (i = 0; i < count; ++i) {
        if (checksum == SENSEDSL_CRC16) {
            crc = ((crc << 4) & 0xFFFFU) ^ table16[(crc >> 12) ^ (uint32_t)(bytes[i] >> 4)];
            crc = ((crc << 4) & 0xFFFFU) ^ table16[(crc >> 12) ^ (uint32_t)(bytes[i] & 15U)];
        } else {
            crc = (crc >> 4) ^ table32[(crc ^ bytes[i]) & 15U];
            crc = (crc >> 4) ^ table32[(crc ^ (uint32_t)(bytes[i] >> 4)) & 15U];
        }
    }
    return checksum == SENSEDSL_CRC16 ? crc : ~crc;
}

/* The checksum with its identifier; returns its bytes. */
static size_t put_sum(sensedsl_checksum checksum, const uint8_t *payload, size_t count, uint8_t *out) {
    const size_t bytes = crc_bytes(checksum);
    uint32_t number;
    size_t i;
    if (bytes == 0) {
        return 0;
    }
    number = sum(checksum, payload, count);
    out[0] = CHECKSUM;
    for (i = bytes - 1; i > 0; --i) {
        out[i] = (uint8_t)(number & 0xFFU);
        number >>= 8;
    }
    return bytes;
}

static bool is_sum(sensedsl_checksum checksum, const uint8_t *payload, size_t count, const uint8_t *behind) {
    uint8_t expected[5];
    const size_t bytes = put_sum(checksum, payload, count, expected);
    return memcmp(expected, behind, bytes) == 0;
}

size_t sensedsl_bytes(const sensedsl_device *device) {
    static const uint8_t bytes[] = {1, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return (size_t)bytes[device->type] * device->count;
}

static const sensedsl_device *sensor(const sensedsl_schema *schema, uint8_t id) {
    size_t i;
    for (i = 0; i < schema->device_count; ++i) {
        if (schema->devices[i].id == id && schema->devices[i].is_sensor) {
            return &schema->devices[i];
        }
    }
    return NULL;
}

/* --- frames -------------------------------------------------------------------------------------------------------- */

void sensedsl_decoder_open(sensedsl_decoder *decoder, const sensedsl_schema *schema, uint8_t *held) {
    memset(decoder, 0, sizeof *decoder);
    decoder->schema = schema;
    decoder->held = held;
}

static void restart(sensedsl_decoder *decoder) {
    decoder->start = 0;
    decoder->at = 0;
    decoder->looked = 0;
    decoder->is_summed = false;
    memset(decoder->seen, 0, sizeof decoder->seen);
}

/* Removes bytes from the front of those that are held. */
static void shift(sensedsl_decoder *decoder, size_t count) {
    decoder->length -= count;
    memmove(decoder->held, decoder->held + count, decoder->length);
    decoder->is_new = decoder->length > 0;
    restart(decoder);
}

/* Of health, without a checksum. */
static size_t health_bytes(const sensedsl_schema *schema) {
    return 2 + HEALTH_HEAD_BYTES + HEALTH_DEVICE_BYTES * (size_t)schema->device_count;
}

static verdict read_length(sensedsl_decoder *decoder) {
    const sensedsl_schema *schema = decoder->schema;
    const size_t crc = crc_bytes(schema->checksum);
    const size_t health = health_bytes(schema);
    const size_t most = (schema->short_bytes > health ? schema->short_bytes : health) + crc;
    size_t size = 0;
    size_t i;
    for (i = 0; i < decoder->length; ++i) {
        const uint8_t byte = decoder->held[i];
        if (byte == ':' && i > 0) {
            if (size <= crc || (size - crc > schema->short_bytes && size - crc != health)) {
                return INVALID;
            }
            decoder->start = i + 1;
            decoder->size = size;
            decoder->at = decoder->start;
            return COMPLETE;
        }
        if (byte < '0' || byte > '9' || (i == 0 && byte == '0')) {
            return INVALID;
        }
        size = size * 10 + (size_t)(byte - '0');
        if (size > most) {
            return INVALID;
        }
    }
    return INCOMPLETE;
}

/* What a payload is follows from its first byte, its length and the schema. `stop` is where its values end. */
static verdict begin_payload(sensedsl_decoder *decoder, size_t stop) {
    const sensedsl_schema *schema = decoder->schema;
    const size_t values = stop - decoder->start;
    const uint8_t first = decoder->held[decoder->start];
    if (first == HELLO && values == 5) {
        decoder->at = stop;
    } else if (first == HELLO) {
        if (!schema->is_stamped || values <= STAMP_BYTES || values > schema->short_bytes) {
            return INVALID;
        }
        decoder->at += STAMP_BYTES;
    } else if (first == HEALTH) {
        if (values != health_bytes(schema)) {
            return INVALID;
        }
        decoder->at = stop;
    } else if (schema->is_stamped || values > schema->short_bytes) {
        return INVALID;
    }
    return COMPLETE;
}

/* Steps over the next value. */
static verdict step(sensedsl_decoder *decoder, size_t stop) {
    const uint8_t id = decoder->held[decoder->at];
    const sensedsl_device *device = sensor(decoder->schema, id);
    const uint8_t bit = (uint8_t)(1U << (id & 7U));
    size_t end;
    if (device == NULL || (decoder->seen[id >> 3] & bit) != 0) {
        return INVALID;
    }
    end = decoder->at + 1 + sensedsl_bytes(device);
    if (end > stop) {
        return INVALID;
    }
    if (device->type == SENSEDSL_BOOL) {
        size_t i = decoder->looked > decoder->at ? decoder->looked : decoder->at + 1;
        for (; i < end && i < decoder->length; ++i) {
            if (decoder->held[i] > 1) {
                return INVALID;
            }
        }
        decoder->looked = i;
        if (i < end) {
            return INCOMPLETE;
        }
    }
    decoder->seen[id >> 3] = (uint8_t)(decoder->seen[id >> 3] | bit);
    decoder->at = end;
    return COMPLETE;
}

/* What the bytes that are held can be. */
static verdict look(sensedsl_decoder *decoder) {
    const sensedsl_schema *schema = decoder->schema;
    size_t comma;
    size_t stop;
    if (decoder->start == 0) {
        const verdict length = read_length(decoder);
        if (length != COMPLETE) {
            return length;
        }
    }
    comma = decoder->start + decoder->size;
    stop = comma - crc_bytes(schema->checksum);
    if (comma < decoder->length && decoder->held[comma] != ',') {
        return INVALID;
    }
    if (stop < comma && stop < decoder->length && decoder->held[stop] != CHECKSUM) {
        return INVALID;
    }
    if (decoder->at == decoder->start) {
        if (decoder->at >= decoder->length) {
            return INCOMPLETE;
        }
        if (begin_payload(decoder, stop) == INVALID) {
            return INVALID;
        }
    }
    while (decoder->at < stop && decoder->at < decoder->length) {
        const verdict value = step(decoder, stop);
        if (value != COMPLETE) {
            return value;
        }
    }
    if (decoder->length < comma) {
        return INCOMPLETE;
    }
    if (!decoder->is_summed) {
        const uint8_t *payload = decoder->held + decoder->start;
        if (!is_sum(schema->checksum, payload, stop - decoder->start, decoder->held + stop)) {
            return INVALID;
        }
        decoder->is_summed = true;
    }
    return comma < decoder->length ? COMPLETE : INCOMPLETE;
}

static void read_frame(sensedsl_decoder *decoder) {
    sensedsl_frame *frame = &decoder->frame;
    const uint8_t *payload = decoder->held + decoder->start;
    size_t count = decoder->size - crc_bytes(decoder->schema->checksum);
    memset(frame, 0, sizeof *frame);
    frame->kind = SENSEDSL_REPORT;
    if (payload[0] == HELLO && count == 5) {
        frame->kind = SENSEDSL_HELLO;
        frame->hash = load32(payload + 1);
        return;
    }
    if (payload[0] == HEALTH) {
        frame->version = payload[1];
        frame->kind = frame->version == HEALTH_VERSION ? SENSEDSL_HEALTH : SENSEDSL_OTHER_HEALTH;
        payload += 2;
        count -= 2;
    } else if (payload[0] == HELLO) {
        frame->is_stamped = true;
        frame->time_us = load32(payload + 1);
        frame->counter = payload[5];
        payload += STAMP_BYTES;
        count -= STAMP_BYTES;
    }
    frame->bytes = payload;
    frame->count = count;
}

/* Drops the first byte, and those after it that no frame begins with. */
static void drop(sensedsl_decoder *decoder) {
    size_t count = 1;
    while (count < decoder->length && (decoder->held[count] < '1' || decoder->held[count] > '9')) {
        ++count;
    }
    decoder->dropped_bytes += (uint32_t)count;
    shift(decoder, count);
}

const sensedsl_frame *sensedsl_decode(sensedsl_decoder *decoder, const uint8_t **bytes, size_t *count) {
    if (decoder->used > 0) {
        shift(decoder, decoder->used);
        decoder->used = 0;
    }
    for (;;) {
        while (decoder->is_new) {
            const verdict found = look(decoder);
            if (found == COMPLETE) {
                ++decoder->frames;
                decoder->used = decoder->start + decoder->size + 1;
                read_frame(decoder);
                return &decoder->frame;
            }
            if (found == INVALID) {
                drop(decoder);
            } else {
                decoder->is_new = false;
            }
        }
        if (*count == 0) {
            return NULL;
        }
        decoder->held[decoder->length] = **bytes;
        ++decoder->length;
        decoder->is_new = true;
        ++*bytes;
        --*count;
    }
}

const sensedsl_device *sensedsl_value(const sensedsl_schema *schema, const sensedsl_frame *frame, size_t *at,
                                      const uint8_t **bytes) {
    const sensedsl_device *device;
    if (frame->kind != SENSEDSL_REPORT || *at >= frame->count) {
        return NULL;
    }
    device = sensor(schema, frame->bytes[*at]);
    if (device != NULL) {
        *bytes = frame->bytes + *at + 1;
        *at += 1 + sensedsl_bytes(device);
    }
    return device;
}

/* Second: raw values, shown values, and how one becomes the other. */

/* Copies between the order of the wire and the processor's own. */
static void turn(uint8_t *to, const uint8_t *from, size_t bytes) {
    const uint16_t probe = 1;
    uint8_t first;
    size_t i;
    memcpy(&first, &probe, 1);
    for (i = 0; i < bytes; ++i) {
        to[i] = from[first == 1 ? bytes - 1 - i : i];
    }
}

static size_t element_bytes(const sensedsl_device *device) { return sensedsl_bytes(device) / device->count; }

/* The fastest types are as wide as those of the wire, so bytes are copied in place; a `bool` may be wider. */
void sensedsl_load(const sensedsl_device *device, const uint8_t *bytes, void *raw) {
    const size_t each = element_bytes(device);
    size_t i;
    for (i = 0; i < device->count; ++i) {
        if (device->type == SENSEDSL_BOOL) {
            ((bool *)raw)[i] = bytes[i] != 0;
        } else {
            turn((uint8_t *)raw + each * i, bytes + each * i, each);
        }
    }
}

/* The elements of a value, as they travel. */
static void put_value(const sensedsl_device *device, const void *raw, uint8_t *out) {
    const size_t each = element_bytes(device);
    size_t i;
    for (i = 0; i < device->count; ++i) {
        if (device->type == SENSEDSL_BOOL) {
            out[i] = ((const bool *)raw)[i] ? 1 : 0;
        } else {
            turn(out + each * i, (const uint8_t *)raw + each * i, each);
        }
    }
}

sensedsl_real sensedsl_number(const sensedsl_device *device, const void *raw, size_t element) {
    switch (device->type) {
    case SENSEDSL_BOOL:
        return (sensedsl_real)(((const bool *)raw)[element] ? 1 : 0);
    case SENSEDSL_UINT8:
        return (sensedsl_real)((const uint8_t *)raw)[element];
    case SENSEDSL_INT8:
        return (sensedsl_real)((const int8_t *)raw)[element];
    case SENSEDSL_UINT16:
        return (sensedsl_real)((const uint16_t *)raw)[element];
    case SENSEDSL_INT16:
        return (sensedsl_real)((const int16_t *)raw)[element];
    case SENSEDSL_UINT32:
        return (sensedsl_real)((const uint32_t *)raw)[element];
    case SENSEDSL_INT32:
        return (sensedsl_real)((const int32_t *)raw)[element];
    case SENSEDSL_UINT64:
        return (sensedsl_real)((const uint64_t *)raw)[element];
    case SENSEDSL_INT64:
        return (sensedsl_real)((const int64_t *)raw)[element];
    case SENSEDSL_FLOAT32:
        return (sensedsl_real)((const float *)raw)[element];
    case SENSEDSL_FLOAT64:
        return (sensedsl_real)((const double *)raw)[element];
    }
    return (sensedsl_real)0;
}

sensedsl_real sensedsl_shown(const sensedsl_device *device, sensedsl_real raw) {
    const sensedsl_point *curve = device->curve;
    const sensedsl_real x = device->scale * raw + device->offset;
    uint16_t i;
    if (!device->is_scaled) {
        return raw;
    }
    if (device->points == 0) {
        return x;
    }
    if (x <= curve[0].x) {
        return curve[0].y;
    }
    for (i = 1; i < device->points; ++i) {
        if (x < curve[i].x) {
            return curve[i - 1].y +
                   (x - curve[i - 1].x) * (curve[i].y - curve[i - 1].y) / (curve[i].x - curve[i - 1].x);
        }
    }
    return x >= curve[0].x ? curve[device->points - 1].y : x; /* not a number stays one */
}

bool sensedsl_is_within(const sensedsl_device *device, sensedsl_real shown) {
    return !(device->has_min && shown < device->min) && !(device->has_max && shown > device->max);
}

/* The raw number of a shown one, before rounding; false if no raw number is shown so. */
static bool unshown(const sensedsl_device *device, sensedsl_real shown, sensedsl_real *raw) {
    const sensedsl_point *curve = device->curve;
    bool is_there = device->points == 0;
    sensedsl_real x = shown;
    uint16_t i;
    if (!device->is_scaled) {
        *raw = shown;
        return true;
    }
    for (i = 1; i < device->points && !is_there; ++i) {
        const sensedsl_real one = curve[i - 1].y;
        const sensedsl_real other = curve[i].y;
        if ((one <= shown && shown <= other) || (other <= shown && shown <= one)) {
            is_there = true;
            x = curve[i - 1].x;
            if (one < other || other < one) {
                x += (shown - one) * (curve[i].x - curve[i - 1].x) / (other - one);
            }
        }
    }
    *raw = (x - device->offset) / device->scale;
    return is_there;
}

/* The least and the greatest code of integer types; those of 64 bits are the nearest numbers within them. */
static bool is_of_type(sensedsl_type type, sensedsl_real raw) {
    static const double least[] = {0, 0, -128, 0, -32768, 0, -2147483648.0, 0, -9223372036854775808.0};
    static const double greatest[] = {
        1, 255, 127, 65535, 32767, 4294967295.0, 2147483647.0, 18446744073709549568.0, 9223372036854774784.0};
    const double number = (double)raw;
    if (type == SENSEDSL_FLOAT32) {
        return number >= -3.4028234663852886e38 && number <= 3.4028234663852886e38;
    }
    if (type == SENSEDSL_FLOAT64) {
        return number - number >= 0; /* finite */
    }
    return number > least[type] - 0.5 && number < greatest[type] + 0.5;
}

/* Half way goes away from zero. */
static uint64_t rounded(sensedsl_real number) {
    const uint64_t whole = (uint64_t)number;
    return number - (sensedsl_real)whole >= (sensedsl_real)0.5 ? whole + 1 : whole;
}

bool sensedsl_code(const sensedsl_device *device, sensedsl_real shown, void *raw, size_t element) {
    const size_t each = element_bytes(device);
    uint8_t *out = (uint8_t *)raw + each * element;
    sensedsl_real number;
    uint64_t code;
    uint8_t bytes[8];
    size_t i;
    if (!sensedsl_is_within(device, shown) || !unshown(device, shown, &number) || !is_of_type(device->type, number)) {
        return false;
    }
    if (device->type == SENSEDSL_BOOL) {
        ((bool *)raw)[element] = number >= (sensedsl_real)0.5;
    } else if (device->type == SENSEDSL_FLOAT32) {
        const float value = (float)number;
        memcpy(out, &value, sizeof value);
    } else if (device->type == SENSEDSL_FLOAT64) {
        const double value = (double)number;
        memcpy(out, &value, sizeof value);
    } else {
        code = number < 0 ? 0U - rounded(-number) : rounded(number);
        for (i = 0; i < 8; ++i) {
            bytes[i] = (uint8_t)((code >> (56 - 8 * i)) & 0xFFU);
        }
        turn(out, bytes + 8 - each, each);
    }
    return true;
}

/* Third: whether the board is the one that is meant, and frames that are sent. */

/* --- a link -------------------------------------------------------------------------------------------------------- */

void sensedsl_open(sensedsl_link *link, const sensedsl_schema *schema, uint8_t *held) {
    memset(link, 0, sizeof *link);
    sensedsl_decoder_open(&link->decoder, schema, held);
    link->state = SENSEDSL_ASKING;
}

void sensedsl_play(sensedsl_link *link) { link->state = SENSEDSL_PLAYING; }

void sensedsl_ask_anew(sensedsl_link *link) {
    if (link->state != SENSEDSL_PLAYING) {
        link->state = SENSEDSL_ASKING;
        link->is_asked = false;
        link->has_counter = false;
    }
}

void sensedsl_ask_health(sensedsl_link *link) { link->is_health_wanted = true; }

static bool is_believed(const sensedsl_link *link) {
    return link->state == SENSEDSL_MATCHED || link->state == SENSEDSL_PLAYING;
}

/* A hello; true if it changes what is known. */
static bool take_hello(sensedsl_link *link, uint32_t hash) {
    const bool is_ours = hash == link->decoder.schema->hash;
    const sensedsl_state state = is_ours ? SENSEDSL_MATCHED : SENSEDSL_OTHER;
    if (link->state == state && (is_ours || link->event.hash == hash)) {
        return false;
    }
    link->state = state;
    link->event.kind = is_ours ? SENSEDSL_EVENT_MATCHED : SENSEDSL_EVENT_OTHER;
    link->event.hash = hash;
    return true;
}

void sensedsl_read_health(const sensedsl_frame *frame, sensedsl_health *health) {
    const uint8_t *bytes = frame->bytes;
    health->uptime_ms = load32(bytes);
    health->reset_cause = bytes[4];
    health->reset_device = bytes[5];
    health->reports_sent = load32(bytes + 6);
    health->reports_refused = load32(bytes + 10);
    health->load_percent = bytes[14];
    health->stack_left_bytes = load16(bytes + 15);
}

/* A report: its values are handed out one by one. */
static void take_report(sensedsl_link *link, const sensedsl_frame *frame) {
    if (!is_believed(link)) {
        ++link->withheld_reports;
        return;
    }
    if (frame->is_stamped) {
        if (link->has_counter) {
            link->lost_reports += (uint8_t)(frame->counter - link->counter - 1);
        }
        link->has_counter = true;
        link->counter = frame->counter;
    }
    link->frame = frame;
    link->at = 0;
}

const sensedsl_event *sensedsl_next(sensedsl_link *link, const uint8_t **bytes, size_t *count) {
    sensedsl_event *event = &link->event;
    for (;;) {
        const sensedsl_frame *frame;
        if (link->frame != NULL) {
            event->device = sensedsl_value(link->decoder.schema, link->frame, &link->at, &event->bytes);
            event->frame = link->frame;
            if (event->device != NULL) {
                event->kind = SENSEDSL_EVENT_VALUE;
                return event;
            }
            link->frame = NULL;
        }
        frame = sensedsl_decode(&link->decoder, bytes, count);
        if (frame == NULL) {
            return NULL;
        }
        event->frame = frame;
        if (frame->kind == SENSEDSL_REPORT) {
            take_report(link, frame);
        } else if (frame->kind == SENSEDSL_HELLO) {
            if (take_hello(link, frame->hash)) {
                return event;
            }
        } else if (is_believed(link)) {
            event->kind = frame->kind == SENSEDSL_HEALTH ? SENSEDSL_EVENT_HEALTH : SENSEDSL_EVENT_OTHER_HEALTH;
            if (frame->kind == SENSEDSL_HEALTH) {
                sensedsl_read_health(frame, &event->health);
            }
            return event;
        }
    }
}

void sensedsl_feed(sensedsl_link *link, const uint8_t *bytes, size_t count, sensedsl_handler on_event, void *context) {
    const sensedsl_event *event = sensedsl_next(link, &bytes, &count);
    while (event != NULL) {
        on_event(event, context);
        event = sensedsl_next(link, &bytes, &count);
    }
}

size_t sensedsl_to_send(sensedsl_link *link, uint32_t now_ms, uint8_t question[SENSEDSL_QUESTION_BYTES]) {
    const sensedsl_schema *schema = link->decoder.schema;
    const uint32_t waited = now_ms - link->asked_ms;
    bool is_health = false;
    if (link->state == SENSEDSL_ASKING) {
        uint32_t every = ASK_EVERY_MS;
        if (!link->is_asked) {
            link->since_ms = now_ms;
        } else if (now_ms - link->since_ms >= ASK_RARELY_AFTER_MS) {
            every = ASK_RARELY_MS;
        }
        if (link->is_asked && waited < every) {
            return 0;
        }
    } else if (link->state == SENSEDSL_MATCHED) {
        const uint32_t hold_ms = schema->silence_ms / 3;
        is_health = link->is_health_wanted && (!link->is_health_asked || waited >= ASK_RARELY_MS);
        if (!is_health && !(link->is_held && schema->silence_ms > 0 && waited >= hold_ms)) {
            return 0;
        }
        link->is_health_wanted = link->is_health_wanted && !is_health;
        link->is_health_asked = link->is_health_asked || is_health;
    } else {
        return 0;
    }
    link->is_asked = true;
    link->asked_ms = now_ms;
    return sensedsl_question(schema->checksum, is_health, question);
}

bool sensedsl_health_of(const sensedsl_schema *schema, const sensedsl_event *event, size_t place,
                        sensedsl_device_health *health) {
    const uint8_t *bytes;
    size_t i;
    if (event->kind != SENSEDSL_EVENT_HEALTH || place >= schema->device_count) {
        return false;
    }
    bytes = event->frame->bytes + HEALTH_HEAD_BYTES + HEALTH_DEVICE_BYTES * place;
    health->device = &schema->devices[place];
    health->status = bytes[0];
    health->age_ms = load32(bytes + 1);
    for (i = 0; i < 6; ++i) {
        health->failures[i] = load16(bytes + 5 + 2 * i);
    }
    return true;
}

/* --- frames that are sent ------------------------------------------------------------------------------------------ */

/* Turns a payload that stands behind `room_before` bytes into a frame; returns its bytes. */
static size_t enclose(sensedsl_checksum checksum, uint8_t *frame, size_t room_before, size_t count) {
    uint8_t head[12];
    size_t head_count = sizeof head;
    size_t size;
    size_t rest;
    count += put_sum(checksum, frame + room_before, count, frame + room_before + count);
    size = count;
    head[--head_count] = ':';
    for (rest = size; rest > 0; rest /= 10) {
        head[--head_count] = (uint8_t)('0' + rest % 10);
    }
    memmove(frame + (sizeof head - head_count), frame + room_before, size);
    memcpy(frame, head + head_count, sizeof head - head_count);
    frame[sizeof head - head_count + size] = ',';
    return sizeof head - head_count + size + 1;
}

size_t sensedsl_question(sensedsl_checksum checksum, bool health, uint8_t question[SENSEDSL_QUESTION_BYTES]) {
    question[2] = HELLO;
    question[3] = 1;
    return enclose(checksum, question, 2, health ? 2 : 1);
}

void sensedsl_begin(sensedsl_writer *writer, const sensedsl_schema *schema, uint8_t *frame, size_t room) {
    memset(writer, 0, sizeof *writer);
    writer->schema = schema;
    writer->frame = frame;
    writer->room = room;
}

size_t sensedsl_end(sensedsl_writer *writer) {
    if (writer->is_refused || writer->length == 0) {
        return 0;
    }
    return enclose(writer->schema->checksum, writer->frame, SENSEDSL_HEAD_BYTES, writer->length);
}

bool sensedsl_add(sensedsl_writer *writer, const sensedsl_device *device, const void *raw) {
    const size_t bytes = sensedsl_bytes(device);
    const uint8_t bit = (uint8_t)(1U << (device->id & 7U));
    uint8_t *out;
    size_t i;
    /* Room for the identifier, the checksum and the comma. */
    bool is_fine = !device->is_sensor && (writer->seen[device->id >> 3] & bit) == 0 &&
                   SENSEDSL_HEAD_BYTES + writer->length + 1 + bytes + crc_bytes(writer->schema->checksum) + 1 <= writer->room;
    for (i = 0; i < device->count && is_fine; ++i) {
        is_fine = device->type == SENSEDSL_BOOL ||
                  sensedsl_is_within(device, sensedsl_shown(device, sensedsl_number(device, raw, i)));
    }
    writer->is_refused = writer->is_refused || !is_fine;
    if (writer->is_refused) {
        return false;
    }
    writer->seen[device->id >> 3] = (uint8_t)(writer->seen[device->id >> 3] | bit);
    out = writer->frame + SENSEDSL_HEAD_BYTES + writer->length;
    out[0] = device->id;
    put_value(device, raw, out + 1);
    writer->length += 1 + bytes;
    return true;
}
