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
