#include "up_message.h"

#include <string.h>

#include "up_checksum.h"
#include "up_parse.h"

#define DVB_S2_POLYNOMIAL 0xD5U
#define LD06_POLYNOMIAL 0x4DU
#define UMTS_POLYNOMIAL 0x8005U
#define XMODEM_POLYNOMIAL 0x1021U
#define IBUS_START 0xFFFFU
#define SLAMTEC_SUM_BYTES 2U

static UP_ROM uint8_t checksum_bytes[] = {
    [UP_CHECKSUM_NONE] = 0U,       [UP_CHECKSUM_SUM8] = 1U,     [UP_CHECKSUM_XOR8] = 1U,
    [UP_CHECKSUM_IBUS] = 2U,       [UP_CHECKSUM_NMEA] = 3U,     [UP_CHECKSUM_CRC8_DVB_S2] = 1U,
    [UP_CHECKSUM_SUM7] = 1U,       [UP_CHECKSUM_NOT_SUM8] = 1U, [UP_CHECKSUM_NEG_SUM8] = 1U,
    [UP_CHECKSUM_NEG_SUM16] = 2U,  [UP_CHECKSUM_CRC16_UMTS] = 2U,
    [UP_CHECKSUM_CRC16_XMODEM] = 2U, [UP_CHECKSUM_CRC8_LD06] = 1U, [UP_CHECKSUM_SUM16] = 2U,
    [UP_CHECKSUM_SLAMTEC] = 0U,
};

size_t up_checksum_bytes(uint8_t checksum) {
  return (checksum < sizeof checksum_bytes) ? checksum_bytes[checksum] : 0U;
}

static uint8_t digit(uint8_t number) {
  return (uint8_t)((number < 10U) ? (48U + number) : (55U + number)); /* '0' and 'A' - 10 */
}

static void put_low_first(uint16_t sum, uint8_t *bytes) {
  bytes[0] = (uint8_t)sum;
  bytes[1] = (uint8_t)(sum >> 8);
}

static void put_high_first(uint16_t sum, uint8_t *bytes) {
  bytes[0] = (uint8_t)(sum >> 8);
  bytes[1] = (uint8_t)sum;
}

/* Sums of one byte. */
static uint8_t short_sum(up_checksum_t checksum, const uint8_t *bytes, size_t count) {
  switch (checksum) {
  case UP_CHECKSUM_SUM7:
    return up_sum8(bytes, count) & 0x7FU;
  case UP_CHECKSUM_NOT_SUM8:
    return (uint8_t)(0xFFU - up_sum8(bytes, count));
  case UP_CHECKSUM_NEG_SUM8:
    return (uint8_t)(0x100U - up_sum8(bytes, count));
  case UP_CHECKSUM_XOR8:
    return up_xor8(bytes, count);
  case UP_CHECKSUM_CRC8_DVB_S2:
    return up_crc8(DVB_S2_POLYNOMIAL, 0U, bytes, count);
  case UP_CHECKSUM_CRC8_LD06:
    return up_crc8(LD06_POLYNOMIAL, 0U, bytes, count);
  case UP_CHECKSUM_NONE:
  case UP_CHECKSUM_SUM8:
  case UP_CHECKSUM_IBUS:
  case UP_CHECKSUM_NMEA:
  case UP_CHECKSUM_NEG_SUM16:
  case UP_CHECKSUM_SUM16:
  case UP_CHECKSUM_CRC16_UMTS:
  case UP_CHECKSUM_CRC16_XMODEM:
  case UP_CHECKSUM_SLAMTEC:
  default:
    return up_sum8(bytes, count);
  }
}

size_t up_checksum_put(uint8_t checksum, uint8_t from, uint8_t start_count, const uint8_t *bytes, size_t at,
                       uint8_t sum[UP_CHECKSUM_BYTES_MAX]) {
  const size_t wanted = (checksum == (uint8_t)UP_CHECKSUM_NMEA) ? start_count : from;
  const size_t first = (wanted < at) ? wanted : at;
  const uint8_t *summed = &bytes[first];
  const size_t count = at - first;
  uint8_t number;

  switch ((up_checksum_t)checksum) {
  case UP_CHECKSUM_NONE:
  case UP_CHECKSUM_SLAMTEC:
    break;
  case UP_CHECKSUM_IBUS:
    put_low_first((uint16_t)(IBUS_START - up_sum16(summed, count)), sum);
    break;
  case UP_CHECKSUM_SUM16:
    put_high_first(up_sum16(summed, count), sum);
    break;
  case UP_CHECKSUM_NEG_SUM16:
    put_high_first((uint16_t)(0x10000U - up_sum16(summed, count)), sum);
    break;
  case UP_CHECKSUM_CRC16_UMTS:
    put_low_first(up_crc16_of(UMTS_POLYNOMIAL, summed, count), sum);
    break;
  case UP_CHECKSUM_CRC16_XMODEM:
    put_high_first(up_crc16_of(XMODEM_POLYNOMIAL, summed, count), sum);
    break;
  case UP_CHECKSUM_NMEA:
    number = up_xor8(summed, count);
    sum[0] = (uint8_t)'*';
    sum[1] = digit((uint8_t)(number >> 4));
    sum[2] = digit((uint8_t)(number & 15U));
    break;
  case UP_CHECKSUM_SUM8:
  case UP_CHECKSUM_SUM7:
  case UP_CHECKSUM_NOT_SUM8:
  case UP_CHECKSUM_NEG_SUM8:
  case UP_CHECKSUM_XOR8:
  case UP_CHECKSUM_CRC8_DVB_S2:
  case UP_CHECKSUM_CRC8_LD06:
  default:
    sum[0] = short_sum((up_checksum_t)checksum, summed, count);
    break;
  }
  return up_checksum_bytes(checksum);
}

static size_t checksum_size(UP_ROM up_message_t *message) {
  return up_checksum_bytes(message->checksum);
}

/* The bytes around a body. */
static size_t frame_bytes(UP_ROM up_message_t *message) {
  return (size_t)message->start_count + checksum_size(message) + message->end_count;
}

/* ---- is it a message? ---- */

typedef enum {
  MORE,    /* it may become a message */
  WHOLE,   /* it is a complete message */
  DAMAGED, /* it is a message except for its checksum */
  BAD      /* it cannot become a message */
} verdict_t;

/* Whether a message of Slamtec's could begin with this byte. */
static bool begins_slamtec(uint8_t byte) {
  return (byte >> 4) == 0xAU;
}

/* Before the messages, the part says once how long they are. This has the marks of a message. */
static bool announces_slamtec(UP_ROM up_message_t *message, const uint8_t *bytes, size_t size) {
  const uint8_t announced[] = {0xA5U, 0x5AU, (uint8_t)message->length, 0U, 0U, 0x40U};

  return size >= sizeof announced && memcmp(bytes, announced, sizeof announced) == 0;
}

static bool starts_slamtec(UP_ROM up_message_t *message, const uint8_t *bytes, size_t size) {
  return (size < 1U || begins_slamtec(bytes[0])) && (size < 2U || (bytes[1] >> 4) == 0x5U) &&
         !announces_slamtec(message, bytes, size);
}

static bool is_slamtec(UP_ROM up_message_t *message) {
  return message->checksum == (uint8_t)UP_CHECKSUM_SLAMTEC;
}

static bool starts_right(UP_ROM up_message_t *message, const uint8_t *bytes, size_t size) {
  const size_t count = (size < message->start_count) ? size : message->start_count;

  if (is_slamtec(message)) {
    return starts_slamtec(message, bytes, size);
  }
  return count == 0U || up_rom_is(bytes, message->start, count);
}

static bool ends_right(UP_ROM up_message_t *message, const uint8_t *bytes, size_t size) {
  return message->end_count == 0U || up_rom_is(&bytes[size - message->end_count], message->end, message->end_count);
}

/* If only `end` bounds a body and no checksum covers it, a second start means that the end was lost. */
static bool begins_anew(UP_ROM up_message_t *message, const uint8_t *bytes, size_t size) {
  return message->length == 0U && message->checksum == UP_CHECKSUM_NONE && message->start_count > 0U &&
         size >= 2U * (size_t)message->start_count &&
         up_rom_is(&bytes[size - message->start_count], message->start, message->start_count);
}

static uint8_t upper(uint8_t letter) {
  return (uint8_t)((letter >= (uint8_t)'a' && letter <= (uint8_t)'z') ? (letter - 32U) : letter);
}

/* Whether the halves in the first two bytes are those of the exclusive or of all others. */
static bool sums_slamtec(const uint8_t *bytes, size_t size) {
  const uint8_t found = (uint8_t)((bytes[0] & 0xFU) | ((uint32_t)bytes[1] << 4));

  return size >= SLAMTEC_SUM_BYTES && up_xor8(&bytes[SLAMTEC_SUM_BYTES], size - SLAMTEC_SUM_BYTES) == found;
}

/* Whether the checksum at `at` is right. Hexadecimal digits may be in lower case. */
static bool sums_right(UP_ROM up_message_t *message, const uint8_t *bytes, size_t at) {
  const bool is_text = message->checksum == (uint8_t)UP_CHECKSUM_NMEA;
  uint8_t sum[UP_CHECKSUM_BYTES_MAX];
  const size_t size =
      up_checksum_put(message->checksum, message->checksum_from, message->start_count, bytes, at, sum);
  size_t i;

  if (is_slamtec(message)) {
    return sums_slamtec(bytes, at);
  }
  for (i = 0U; i < size; i++) {
    if (sum[i] != bytes[at + i] && !(is_text && sum[i] == upper(bytes[at + i]))) {
      return false;
    }
  }
  return true;
}

static verdict_t judge(UP_ROM up_message_t *message, const up_message_state_t *state) {
  const uint8_t *bytes = state->buffer;
  const size_t size = state->size;
  const size_t least = frame_bytes(message) + message->length;

  if (!starts_right(message, bytes, size)) {
    return BAD;
  }
  if (size < least || (message->length == 0U && !ends_right(message, bytes, size))) {
    return (size < message->bytes_max && !begins_anew(message, bytes, size)) ? MORE : BAD;
  }
  if (!ends_right(message, bytes, size)) {
    return BAD;
  }
  if (!sums_right(message, bytes, size - message->end_count - checksum_size(message))) {
    return DAMAGED;
  }
  return WHOLE;
}

/* ---- values ---- */

/* True if the first field of a sentence ends with its type. */
static bool is_sentence(up_piece_t text, UP_ROM char *sentence, char separator) {
  const size_t count = up_rom_length(sentence);
  up_piece_t first;

  return up_parse_field(text, separator, 0U, &first) && first.size >= count &&
         up_rom_is(&first.start[first.size - count], sentence, count);
}

static up_result_t text_element(UP_ROM up_message_field_t *how, uint8_t type, up_piece_t text, size_t at,
                                void *element) {
  up_piece_t piece;

  if (!up_parse_field(text, how->separator, at, &piece)) {
    return UP_NOTHING;
  }
  if (how->format == (uint8_t)UP_FORMAT_HEX) {
    return up_parse_hex(piece, type, element);
  }
#if UP_USES_WIDE
  if (how->format == (uint8_t)UP_FORMAT_DEGREES) {
    up_piece_t next;

    if (!up_parse_field(text, how->separator, at + 1U, &next)) {
      next.start = piece.start;
      next.size = 0U;
    }
    return up_parse_degrees(piece, next, type, element);
  }
  return up_parse_decimal(piece, how->decimals, type, element);
#else
  return UP_INVALID;
#endif
}

/* The index of the first element; with a sentence, its type is before it. */
static size_t first_of(UP_ROM up_message_field_t *how) {
  return (how->sentence == UP_ROM_NULL) ? how->index : (size_t)how->index + 1U;
}

/* One invalid element makes the whole value invalid, an empty one makes it UP_NOTHING. */
static up_result_t text_value(UP_ROM up_message_field_t *how, UP_ROM up_field_t *field, up_piece_t text, void *value) {
  const size_t stride = (how->format == UP_FORMAT_DEGREES) ? 2U : 1U;
  const size_t first = first_of(how);
  const size_t element_bytes = up_type_bytes(field->type);
  up_result_t result = UP_FRESH;
  uint8_t *memory = value;
  size_t i;

  for (i = 0U; i < field->count; i++) {
    const up_result_t one = text_element(how, field->type, text, first + i * stride, &memory[i * element_bytes]);
    if (one == UP_INVALID || result == UP_INVALID) {
      result = UP_INVALID;
    } else if (one == UP_NOTHING) {
      result = UP_NOTHING;
    }
  }
  return result;
}

/* Whether the body is of a kind that contains this value. */
static bool is_of_body(UP_ROM up_message_field_t *how, const uint8_t *body, size_t body_count) {
  const up_piece_t text = {(const char *)body, body_count};

  return how->format == UP_FORMAT_BINARY || how->sentence == UP_ROM_NULL ||
         is_sentence(text, how->sentence, how->separator);
}

bool up_message_value(UP_ROM up_message_field_t *how, UP_ROM up_field_t *field, const uint8_t *body, size_t body_count,
                      void *value, up_result_t *result) {
  up_piece_t text;

  if (how->format == UP_FORMAT_BINARY) {
    if ((size_t)how->byte + up_value_bytes(&how->value, field->count) > body_count) {
      return false;
    }
    *result = up_value_decode(&how->value, field, &body[how->byte], body_count - how->byte, value);
    return true;
  }
  text.start = (const char *)body;
  text.size = body_count;
  if (!is_of_body(how, body, body_count)) {
    return false;
  }
  *result = text_value(how, field, text, value);
  return true;
}

/* A damaged message is reported for all its values. Without a start or an end it cannot be recognised as a message. */
static void say_damaged(UP_ROM up_message_t *message, const up_message_state_t *state, const up_value_sink_t *sink) {
  const uint8_t *body = &state->buffer[message->start_count];
  size_t i;

  if ((size_t)message->start_count + message->end_count == 0U && !is_slamtec(message)) {
    return;
  }
  for (i = 0U; i < message->fields_count; i++) {
    if (is_of_body(&message->fields[i], body, state->size - frame_bytes(message))) {
      sink->on_value(sink->context, message->fields[i].field, UP_WRONG_CRC, NULL);
    }
  }
}

static void say_values(UP_ROM up_message_t *message, up_message_state_t *state, UP_ROM up_schema_t *schema,
                       const up_value_sink_t *sink) {
  const uint8_t *body = &state->buffer[message->start_count];
  const size_t body_count = state->size - frame_bytes(message);
  size_t i;

  for (i = 0U; i < message->fields_count; i++) {
    UP_ROM up_message_field_t *how = &message->fields[i];
    up_result_t result = UP_NOTHING;
    if (!up_message_value(how, &schema->fields[how->field], body, body_count, state->scratch, &result)) {
      continue;
    }
    state->values = (up_events_t)(state->values + ((result == UP_FRESH) ? 1U : 0U));
    state->invalid = (up_events_t)(state->invalid + ((result == UP_INVALID || result == UP_WRONG_CRC) ? 1U : 0U));
    sink->on_value(sink->context, how->field, result, (result == UP_FRESH) ? state->scratch : NULL);
  }
}

/* ---- the stream ---- */

static void drop(up_message_state_t *state, size_t count) {
  state->size = (uint16_t)(state->size - count);
  state->dropped_bytes = (up_events_t)(state->dropped_bytes + count);
  memmove(state->buffer, &state->buffer[count], state->size);
}

/* Drops the first byte and those after it, up to the next at which a message could begin. */
static void drop_candidate(UP_ROM up_message_t *message, up_message_state_t *state) {
  size_t count = 1U;

  if (message->start_count > 0U) {
    const uint8_t *next = (state->size > 1U) ? memchr(&state->buffer[1], message->start[0], state->size - 1U) : NULL;
    count = (next != NULL) ? (size_t)(next - state->buffer) : state->size;
  } else if (is_slamtec(message)) {
    while (count < state->size && !begins_slamtec(state->buffer[count])) {
      count++;
    }
  }
  drop(state, count);
}

/* Whether only its position tells where a message begins. */
static bool needs_alignment(UP_ROM up_message_t *message) {
  const bool is_recognised = message->checksum != UP_CHECKSUM_NONE || message->end_count > 0U;

  return message->start_count == 0U && (message->length == 0U || !is_recognised);
}

/* Before the first end, the start of a message is unknown. True if the byte was consumed. */
static bool align(UP_ROM up_message_t *message, up_message_state_t *state) {
  if (state->is_aligned || !needs_alignment(message)) {
    return false;
  }
  if (message->length == 0U && state->size >= message->end_count && message->end_count > 0U &&
      ends_right(message, state->buffer, state->size)) {
    drop(state, state->size);
    state->is_aligned = true;
  } else if (state->size >= message->end_count) {
    /* Enough remains to recognise the end. */
    drop(state, 1U);
  }
  return true;
}

static void take(UP_ROM up_message_t *message, up_message_state_t *state, UP_ROM up_schema_t *schema,
                 const up_value_sink_t *sink) {
  verdict_t verdict = align(message, state) ? MORE : judge(message, state);

  while ((verdict == BAD || verdict == DAMAGED) && state->size > 0U) {
    if (verdict == DAMAGED) {
      state->wrong_checksum++;
      say_damaged(message, state, sink);
    }
    if (needs_alignment(message)) {
      /* Either it is too long, and its end is still to come, or it is at its end and wrong. */
      state->is_aligned = state->size >= message->end_count && ends_right(message, state->buffer, state->size);
      drop(state, state->size);
    } else {
      drop_candidate(message, state);
    }
    verdict = (state->size > 0U) ? judge(message, state) : MORE;
  }
  if (verdict == WHOLE) {
    state->messages++;
    say_values(message, state, schema, sink);
    state->size = 0U;
  }
}

void up_message_feed(UP_ROM up_message_t *message, up_message_state_t *state, UP_ROM up_schema_t *schema,
                     const uint8_t *bytes, size_t count, const up_value_sink_t *sink) {
  size_t i;

  if (message->bytes_max == 0U || frame_bytes(message) + message->length > message->bytes_max) {
    /* No message fits into the buffer. */
    state->dropped_bytes = (up_events_t)(state->dropped_bytes + count);
    return;
  }
  for (i = 0U; i < count; i++) {
    state->buffer[state->size] = bytes[i];
    state->size++;
    take(message, state, schema, sink);
  }
}

void up_message_gap(up_message_state_t *state) {
  state->dropped_bytes = (up_events_t)(state->dropped_bytes + state->size);
  state->size = 0U;
  state->is_aligned = true;
}

/* ---- setup ---- */

UP_ROM up_message_init_t *up_message_start(UP_ROM up_message_init_t *init, uint8_t count, up_message_start_t *state,
                                           uint32_t now_ms) {
  UP_ROM up_message_init_t *step;

  if (state->is_pausing && (uint32_t)(now_ms - state->pause_until_ms) >= 0x80000000U) {
    return UP_ROM_NULL;
  }
  state->is_pausing = false;
  if (state->at >= count) {
    return UP_ROM_NULL;
  }
  step = &init[state->at];
  state->at++;
  if (step->pause_ms > 0U) {
    /* One more, because the first millisecond is cut short. */
    state->pause_until_ms = now_ms + step->pause_ms + 1U;
    state->is_pausing = true;
  }
  return step;
}
