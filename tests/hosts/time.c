/*
 * Times the decoder of a generated host for `benches/hosts.py`, on a stream of Fig. 2's frames.
 *
 * Arguments: the stream's file, and bytes a piece. Prints the nanoseconds of processor time, the messages and a sum of
 * their values, which the script compares.
 */
#define _POSIX_C_SOURCE 199309L
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "fig2_STM32F4DiscoveryBoard.h"

static unsigned long long messages, total;

static void on_16(void *context, uint16_t raw) {
    (void)context;
    ++messages;
    total += raw;
}

static void on_8(void *context, uint8_t raw) {
    (void)context;
    ++messages;
    total += raw;
}

static void on_32(void *context, uint32_t raw) {
    (void)context;
    ++messages;
    total += raw;
}

static long long cpu_ns(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec * 1000000000LL + now.tv_nsec;
}

int main(int count, char **arguments) {
    static const fig2_STM32F4DiscoveryBoard_handlers handlers = {NULL, NULL, NULL, NULL, on_16, on_16, on_8, on_32};
    static fig2_STM32F4DiscoveryBoard board;
    FILE *file = fopen(arguments[1], "rb");
    const size_t piece = strtoul(arguments[count - 1], NULL, 10), room = 1 << 26;
    uint8_t *stream = malloc(room);
    const size_t size = fread(stream, 1, room, file);
    size_t at;
    const long long start = cpu_ns();
    fig2_STM32F4DiscoveryBoard_open(&board, &handlers);
    sensedsl_play(&board.link);
    for (at = 0; at < size; at += piece) {
        fig2_STM32F4DiscoveryBoard_feed(&board, stream + at, size - at < piece ? size - at : piece);
    }
    printf("%lld %llu %llu\n", cpu_ns() - start, messages, total);
    return 0;
}
