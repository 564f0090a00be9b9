/*
 * Prints what the board STM32F4DiscoveryBoard of the design fig2 says: monitor DEVICE, or a recording. For systems with POSIX. Generated: copy it to start a
 * program of your own.
 */
#define _DEFAULT_SOURCE /* rates beyond 38400 */
#define _DARWIN_C_SOURCE

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include "fig2_STM32F4DiscoveryBoard.h"

static int is_other;

static void print_element(const sensedsl_device *device, const void *raw, size_t i) {
    switch (device->type) {
    case SENSEDSL_BOOL:
        printf("%s", ((const bool *)raw)[i] ? "true" : "false");
        break;
    case SENSEDSL_UINT64:
        printf("%" PRIu64, ((const uint64_t *)raw)[i]);
        break;
    case SENSEDSL_INT64:
        printf("%" PRId64, ((const int64_t *)raw)[i]);
        break;
    default:
        printf("%.*g", device->type == SENSEDSL_FLOAT64 ? 17 : 10, (double)sensedsl_number(device, raw, i));
    }
}

static void print_value(const sensedsl_device *device, const uint8_t *bytes) {
    uint64_t raw[(fig2_STM32F4DiscoveryBoard_VALUE_BYTES + 7) / 8];
    size_t i;
    sensedsl_load(device, bytes, raw);
    printf("%s = %s", device->name, device->is_array ? "[" : "");
    for (i = 0; i < device->count; ++i) {
        printf("%s", i > 0 ? ", " : "");
        print_element(device, raw, i);
    }
    printf("%s", device->is_array ? "]" : "");
    if (device->is_scaled || device->unit[0] != '\0') {
        printf(device->is_array ? " ([" : " (");
        for (i = 0; i < device->count; ++i) {
            const sensedsl_real shown = sensedsl_shown(device, sensedsl_number(device, raw, i));
            printf("%s%.9g", i > 0 ? ", " : "", (double)shown);
        }
        printf("%s%s%s)", device->is_array ? "]" : "", device->unit[0] != '\0' ? " " : "", device->unit);
    }
    printf("\n");
}

static void print_event(const sensedsl_event *event, void *context) {
    (void)context;
    if (event->kind == SENSEDSL_EVENT_VALUE) {
        print_value(event->device, event->bytes);
    } else if (event->kind == SENSEDSL_EVENT_MATCHED) {
        fprintf(stderr, "firmware and design agree\n");
    } else if (event->kind == SENSEDSL_EVENT_OTHER) {
        fprintf(stderr, "the board runs other firmware (schema 0x%08" PRIx32 ")\n", event->hash);
        is_other = 1;
    }
}

static speed_t speed(uint32_t baud) {
    switch (baud) {
    case 9600:
        return B9600;
    case 19200:
        return B19200;
    case 38400:
        return B38400;
    case 57600:
        return B57600;
    case 230400:
        return B230400;
    default:
        return B115200;
    }
}

static void make_raw(int device, uint32_t baud) {
    struct termios line;
    if (tcgetattr(device, &line) == 0) {
        line.c_iflag = 0;
        line.c_oflag = 0;
        line.c_lflag = 0;
        line.c_cflag = CS8 | CREAD | CLOCAL;
        line.c_cc[VMIN] = 1;
        line.c_cc[VTIME] = 0;
        (void)cfsetispeed(&line, speed(baud));
        (void)cfsetospeed(&line, speed(baud));
        (void)tcsetattr(device, TCSANOW, &line);
    }
}

static uint32_t now_ms(void) {
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint32_t)now.tv_sec * 1000U + (uint32_t)(now.tv_nsec / 1000000);
}

int main(int count, char **arguments) {
    uint8_t held[fig2_STM32F4DiscoveryBoard_HELD_BYTES];
    uint8_t bytes[512];
    sensedsl_link link;
    int device;
    int is_device;
    if (count != 2) {
        fprintf(stderr, "usage: monitor DEVICE|RECORDING\n");
        return 2;
    }
    device = open(arguments[1], O_RDWR | O_NOCTTY);
    if (device < 0) {
        device = open(arguments[1], O_RDONLY | O_NOCTTY);
    }
    if (device < 0) {
        fprintf(stderr, "%s cannot be opened: %s\n", arguments[1], strerror(errno));
        return 2;
    }
    sensedsl_open(&link, &fig2_STM32F4DiscoveryBoard_schema, held);
    is_device = isatty(device) != 0;
    if (is_device) {
        make_raw(device, fig2_STM32F4DiscoveryBoard_schema.baud);
    } else {
        sensedsl_play(&link);
    }
    while (!is_other) {
        struct pollfd wait = {device, POLLIN, 0};
        uint8_t question[SENSEDSL_QUESTION_BYTES];
        const size_t asked = sensedsl_to_send(&link, now_ms(), question);
        ssize_t got;
        if (asked > 0 && write(device, question, asked) < 0) {
            break;
        }
        if (poll(&wait, 1, 50) == 0) {
            continue;
        }
        got = read(device, bytes, sizeof bytes);
        if (got <= 0) {
            break;
        }
        sensedsl_feed(&link, bytes, (size_t)got, print_event, NULL);
        (void)fflush(stdout);
    }
    if (is_device && !is_other) {
        fprintf(stderr, "%s is gone\n", arguments[1]);
    }
    fprintf(stderr, "%" PRIu32 " frames, %" PRIu32 " bytes dropped\n", link.decoder.frames, link.decoder.dropped_bytes);
    return is_other || is_device;
}
