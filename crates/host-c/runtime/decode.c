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
