/* the board STM32F4DiscoveryBoard of the design miniature_car: its messages. Generated: changes are lost when it is generated again. */
#ifndef MINIATURE_CAR_STM32F4DISCOVERYBOARD_H
#define MINIATURE_CAR_STM32F4DISCOVERYBOARD_H

#include "sensedsl.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    miniature_car_STM32F4DiscoveryBoard_HELD_BYTES = 245,
    miniature_car_STM32F4DiscoveryBoard_VALUE_BYTES = 4,
    /* Of memory for a frame to the board. */
    miniature_car_STM32F4DiscoveryBoard_FRAME_BYTES = SENSEDSL_HEAD_BYTES + 2 + 1
};

/* What is called when something comes that is believed; each may be null. */
typedef struct {
    void *context; /* handed to each of them */
    void (*matched)(void *context); /* the board has the firmware of this design */
    void (*other_firmware)(void *context, uint32_t hash);
    void (*health)(void *context, const sensedsl_event *event); /* `event->health`, and `sensedsl_health_of` */
    /* uint16 */
    void (*on_IRFrontRight)(void *context, uint16_t raw);
    /* uint16 */
    void (*on_IRRearRight)(void *context, uint16_t raw);
    /* uint16 */
    void (*on_IRRear)(void *context, uint16_t raw);
    /* uint16, shown in cm */
    void (*on_USFront)(void *context, uint16_t raw);
    /* uint16, shown in cm */
    void (*on_USFrontRight)(void *context, uint16_t raw);
    /* uint16, shown in cm */
    void (*on_USRear)(void *context, uint16_t raw);
    /* uint32 */
    void (*on_WheelLeftA)(void *context, uint32_t raw);
    /* uint32 */
    void (*on_WheelLeftB)(void *context, uint32_t raw);
    /* uint32 */
    void (*on_WheelRightA)(void *context, uint32_t raw);
    /* uint32 */
    void (*on_WheelRightB)(void *context, uint32_t raw);
    /* uint16, shown in us */
    void (*on_RCSteering)(void *context, uint16_t raw);
    /* uint16, shown in us */
    void (*on_RCThrottle)(void *context, uint16_t raw);
    /* uint16, shown in us */
    void (*on_RCSwitch)(void *context, uint16_t raw);
} miniature_car_STM32F4DiscoveryBoard_handlers;

/* The board at the other end. While a handler runs, `link.event.frame` is the report at hand, with its stamp. */
typedef struct {
    sensedsl_link link;
    miniature_car_STM32F4DiscoveryBoard_handlers handlers;
    uint8_t held[miniature_car_STM32F4DiscoveryBoard_HELD_BYTES];
} miniature_car_STM32F4DiscoveryBoard;

extern const sensedsl_schema miniature_car_STM32F4DiscoveryBoard_schema;

/* A board that has said nothing yet. `sensedsl_to_send(&board->link, ...)` then asks who it is. */
void miniature_car_STM32F4DiscoveryBoard_open(miniature_car_STM32F4DiscoveryBoard *board, const miniature_car_STM32F4DiscoveryBoard_handlers *handlers);

/* Takes the next bytes, however the stream is cut, and calls the handlers. */
void miniature_car_STM32F4DiscoveryBoard_feed(miniature_car_STM32F4DiscoveryBoard *board, const uint8_t *bytes, size_t count);

/* uint16 */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_IRFrontRight(uint16_t raw);

/* uint16 */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_IRRearRight(uint16_t raw);

/* uint16 */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_IRRear(uint16_t raw);

/* uint16, shown in cm */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_USFront(uint16_t raw);

/* uint16, shown in cm */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_USFrontRight(uint16_t raw);

/* uint16, shown in cm */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_USRear(uint16_t raw);

/* uint32 */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_WheelLeftA(uint32_t raw);

/* uint32 */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_WheelLeftB(uint32_t raw);

/* uint32 */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_WheelRightA(uint32_t raw);

/* uint32 */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_WheelRightB(uint32_t raw);

/* uint16, shown in us */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_RCSteering(uint16_t raw);

/* uint16, shown in us */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_RCThrottle(uint16_t raw);

/* uint16, shown in us */
/* The shown value of a code. */
sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_RCSwitch(uint16_t raw);

#ifdef __cplusplus
}
#endif

#endif
