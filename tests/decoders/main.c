/*
 * The decoders as a program: requests on stdin, answers on stdout.
 *
 * A request is a line of text, `WHO HOW REPEATS SCHEMA_BYTES PIECES STREAM_BYTES`, then the schema, the pieces
 * (four bytes each, of the machine) and the stream. WHO is `c`, `cpp` or `memcpy`. HOW is `say` (the answer is
 * its length in four bytes of the machine and what decoders.h describes) or `time` (the answer is a line with
 * the nanoseconds of all repeats).
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "decoders.h"

typedef struct {
  uint8_t *bytes;
  size_t size;
  size_t room;
} answer_t;

static void *must(void *memory) {
  if (memory == NULL) {
    abort();
  }
  return memory;
}

static void append(void *context, const uint8_t *bytes, size_t size) {
  answer_t *answer = context;

  if (answer->size + size > answer->room) {
    answer->room = 2U * (answer->size + size);
    answer->bytes = must(realloc(answer->bytes, answer->room));
  }
  memcpy(&answer->bytes[answer->size], bytes, size);
  answer->size += size;
}

/* The bytes as they come, without a look at them: what no decoder can be faster than by much. */
static void copy(const decoders_input_t *input, decoders_out_t out, void *context) {
  static uint8_t to[1U << 16];
  size_t at;

  (void)out;
  (void)context;
  for (at = 0U; at < input->stream_bytes; at += sizeof to) {
    const size_t rest = input->stream_bytes - at;
    memcpy(to, &input->stream[at], (rest < sizeof to) ? rest : sizeof to);
    __asm__ volatile("" : : "r"(to) : "memory");
  }
}

static void *read_block(size_t size) {
  /* Of the exact size, so that a sanitizer sees each byte read too far. */
  void *block = must(malloc((size == 0U) ? 1U : size));

  if (fread(block, 1U, size, stdin) != size) {
    abort();
  }
  return block;
}

int main(void) {
  char who[8], how[8];
  unsigned long repeats, schema_bytes, pieces, stream_bytes, i;
  answer_t answer = {NULL, 0U, 0U};

  while (scanf("%7s %7s %lu %lu %lu %lu", who, how, &repeats, &schema_bytes, &pieces, &stream_bytes) == 6) {
    decoders_input_t input;
    void (*decode)(const decoders_input_t *, decoders_out_t, void *) = decoders_c;
    struct timespec from, to;
    uint32_t size;

    (void)getchar(); /* the end of the line */
    input.schema = read_block(schema_bytes);
    input.schema_bytes = schema_bytes;
    input.pieces = read_block(4U * pieces);
    input.pieces_count = pieces;
    input.stream = read_block(stream_bytes);
    input.stream_bytes = stream_bytes;
    if (strcmp(who, "cpp") == 0) {
      decode = decoders_cpp;
    } else if (strcmp(who, "memcpy") == 0) {
      decode = copy;
    }
    if (strcmp(how, "say") == 0) {
      answer.size = 0U;
      decode(&input, append, &answer);
      size = (uint32_t)answer.size;
      fwrite(&size, sizeof size, 1U, stdout);
      fwrite(answer.bytes, 1U, answer.size, stdout);
    } else {
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &from);
      for (i = 0U; i < repeats; i++) {
        decode(&input, NULL, NULL);
      }
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &to);
      printf("%lld\n", (long long)(to.tv_sec - from.tv_sec) * 1000000000LL + (to.tv_nsec - from.tv_nsec));
    }
    fflush(stdout);
    free((void *)input.schema);
    free((void *)input.pieces);
    free((void *)input.stream);
  }
  free(answer.bytes);
  return 0;
}
