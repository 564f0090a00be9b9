/* the board STM32F4DiscoveryBoard of the design fig2: its messages. Generated: changes are lost when it is generated again. */
#ifndef FIG2_STM32F4DISCOVERYBOARD_H
#define FIG2_STM32F4DISCOVERYBOARD_H

#include "sensedsl.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    fig2_STM32F4DiscoveryBoard_HELD_BYTES = 91,
    fig2_STM32F4DiscoveryBoard_VALUE_BYTES = 4,
    /* Of memory for a frame to the board. */
    fig2_STM32F4DiscoveryBoard_FRAME_BYTES = SENSEDSL_HEAD_BYTES + 2 + 1
};

/* What is called when something comes that is believed; each may be null. */
typedef struct {
    void *context; /* handed to each of them */
    void (*matched)(void *context); /* the board has the firmware of this design */
    void (*other_firmware)(void *context, uint32_t hash);
    void (*health)(void *context, const sensedsl_event *event); /* `event->health`, and `sensedsl_health_of` */
    /* uint16 */
    void (*on_IRFront)(void *context, uint16_t raw);
    /* uint16 */
    void (*on_IRFrontRight)(void *context, uint16_t raw);
    /* uint8, shown in cm */
    void (*on_USRear)(void *context, uint8_t raw);
    /* uint32 */
    void (*on_WheelEncoder)(void *context, uint32_t raw);
} fig2_STM32F4DiscoveryBoard_handlers;

/* The board at the other end. While a handler runs, `link.event.frame` is the report at hand, with its stamp. */
typedef struct {
    sensedsl_link link;
    fig2_STM32F4DiscoveryBoard_handlers handlers;
    uint8_t held[fig2_STM32F4DiscoveryBoard_HELD_BYTES];
} fig2_STM32F4DiscoveryBoard;

extern const sensedsl_schema fig2_STM32F4DiscoveryBoard_schema;

/* A board that has said nothing yet. `sensedsl_to_send(&board->link, ...)` then asks who it is. */
void fig2_STM32F4DiscoveryBoard_open(fig2_STM32F4DiscoveryBoard *board, const fig2_STM32F4DiscoveryBoard_handlers *handlers);

/* Takes the next bytes, however the stream is cut, and calls the handlers. */
void fig2_STM32F4DiscoveryBoard_feed(fig2_STM32F4DiscoveryBoard *board, const uint8_t *bytes, size_t count);

/* uint16 */
/* The shown value of a code. */
sensedsl_real fig2_STM32F4DiscoveryBoard_value_IRFront(uint16_t raw);

/* uint16 */
/* The shown value of a code. */
sensedsl_real fig2_STM32F4DiscoveryBoard_value_IRFrontRight(uint16_t raw);

/* uint8, shown in cm */
/* The shown value of a code. */
sensedsl_real fig2_STM32F4DiscoveryBoard_value_USRear(uint8_t raw);

/* uint32 */
/* The shown value of a code. */
sensedsl_real fig2_STM32F4DiscoveryBoard_value_WheelEncoder(uint32_t raw);

#ifdef __cplusplus
}
#endif

#endif
