/*
 * Runs the controllers of Follower on a computer, a step for each request.
 * Generated; changes here are lost.
 */
#define _POSIX_C_SOURCE 200809L

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "follow.h"

static FILE *answers;

static void get(void *to, size_t bytes) {
  if (bytes > 0 && fread(to, bytes, 1, stdin) != 1) {
    _exit(0);
  }
}

static void put(const void *from, size_t bytes) {
  if (bytes > 0 && fwrite(from, bytes, 1, answers) != 1) {
    _exit(1);
  }
}

/* Numbers travel in network byte order; `bytes` is the size of one of `count`. */
static void turn(void *numbers, size_t bytes, size_t count) {
  const uint16_t one = 1;
  uint8_t *at = numbers;
  uint8_t first = 0;
  memcpy(&first, &one, 1);
  for (; first != 0 && count > 0; count--, at += bytes) {
    for (size_t low = 0, high = bytes - 1; low < high; low++, high--) {
      const uint8_t kept = at[low];
      at[low] = at[high];
      at[high] = kept;
    }
  }
}

static void get_numbers(void *to, size_t bytes, size_t count) {
  get(to, bytes * count);
  turn(to, bytes, count);
}

static void put_numbers(void *from, size_t bytes, size_t count) {
  turn(from, bytes, count);
  put(from, bytes * count);
}

static void put_flag(bool is_set) {
  const uint8_t byte = is_set ? 1 : 0;
  put(&byte, 1);
}

static bool get_flag(void) {
  uint8_t byte = 0;
  get(&byte, 1);
  return byte != 0;
}

static void run_follow(uint32_t dt_us) {
  struct follow_in in;
  struct follow_out out;
  memset(&in, 0, sizeof in);
  memset(&out, 0, sizeof out);
  in.line.is_valid = get_flag();
  get_numbers(&in.line.age_us, 4, 1);
  get_numbers(&in.line.value, 2, 8);
  in.cruise.is_valid = get_flag();
  get_numbers(&in.cruise.age_us, 4, 1);
  get_numbers(&in.cruise.value, 2, 1);
  follow_step(&in, &out, dt_us);
  put_flag(out.left.is_set);
  put_numbers(&out.left.value, 2, 1);
  put_flag(out.right.is_set);
  put_numbers(&out.right.value, 2, 1);
  put_flag(out.offset.is_set);
  put_numbers(&out.offset.value, 4, 1);
}

int main(void) {
  /* What the code prints must not stand between the answers. */
  const int kept = dup(STDOUT_FILENO);
  answers = kept < 0 ? NULL : fdopen(kept, "wb");
  if (answers == NULL || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
    return 1;
  }
  follow_init();
  for (;;) {
    uint8_t which = 0;
    uint32_t dt_us = 0;
    get(&which, 1);
    get_numbers(&dt_us, 4, 1);
    switch (which) {
    case 0:
      run_follow(dt_us);
      break;
    default:
      return 1;
    }
    fflush(answers);
  }
}
