/* the board STM32F4DiscoveryBoard of the design fig2: see its header. Generated: changes are lost when it is generated again. */
#include "fig2_STM32F4DiscoveryBoard.h"

static const sensedsl_device fig2_STM32F4DiscoveryBoard_devices[] = {
    {17, true, false, SENSEDSL_UINT16, 1, 0, NULL, "IRFront", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 1000},
    {18, true, false, SENSEDSL_UINT16, 1, 0, NULL, "IRFrontRight", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 60},
    {19, true, false, SENSEDSL_UINT8, 1, 0, NULL, "USRear", "cm", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 80},
    {20, true, false, SENSEDSL_UINT32, 1, 0, NULL, "WheelEncoder", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 0},
};
#define DEVICES fig2_STM32F4DiscoveryBoard_devices

const sensedsl_schema fig2_STM32F4DiscoveryBoard_schema = {
    "STM32F4DiscoveryBoard",
    0xb2d2a70b,
    115200,
    0,
    SENSEDSL_NONE,
    false,
    4,
    DEVICES,
    13,
    fig2_STM32F4DiscoveryBoard_HELD_BYTES,
};

void fig2_STM32F4DiscoveryBoard_open(fig2_STM32F4DiscoveryBoard *board, const fig2_STM32F4DiscoveryBoard_handlers *handlers) {
    sensedsl_open(&board->link, &fig2_STM32F4DiscoveryBoard_schema, board->held);
    board->handlers = *handlers;
}

static void value(const fig2_STM32F4DiscoveryBoard_handlers *handlers, const sensedsl_event *event) {
    if (event->device == &DEVICES[0] && handlers->on_IRFront != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_IRFront(handlers->context, raw);
    }
    if (event->device == &DEVICES[1] && handlers->on_IRFrontRight != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_IRFrontRight(handlers->context, raw);
    }
    if (event->device == &DEVICES[2] && handlers->on_USRear != NULL) {
        uint8_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_USRear(handlers->context, raw);
    }
    if (event->device == &DEVICES[3] && handlers->on_WheelEncoder != NULL) {
        uint32_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_WheelEncoder(handlers->context, raw);
    }
    (void)handlers;
    (void)event;
}

static void handle(const sensedsl_event *event, void *context) {
    const fig2_STM32F4DiscoveryBoard_handlers *handlers = (const fig2_STM32F4DiscoveryBoard_handlers *)context;
    if (event->kind == SENSEDSL_EVENT_VALUE) {
        value(handlers, event);
    } else if (event->kind == SENSEDSL_EVENT_MATCHED && handlers->matched != NULL) {
        handlers->matched(handlers->context);
    } else if (event->kind == SENSEDSL_EVENT_OTHER && handlers->other_firmware != NULL) {
        handlers->other_firmware(handlers->context, event->hash);
    } else if (event->kind == SENSEDSL_EVENT_HEALTH && handlers->health != NULL) {
        handlers->health(handlers->context, event);
    }
}

void fig2_STM32F4DiscoveryBoard_feed(fig2_STM32F4DiscoveryBoard *board, const uint8_t *bytes, size_t count) {
    sensedsl_feed(&board->link, bytes, count, handle, &board->handlers);
}

sensedsl_real fig2_STM32F4DiscoveryBoard_value_IRFront(uint16_t raw) {
    return sensedsl_shown(&DEVICES[0], (sensedsl_real)raw);
}

sensedsl_real fig2_STM32F4DiscoveryBoard_value_IRFrontRight(uint16_t raw) {
    return sensedsl_shown(&DEVICES[1], (sensedsl_real)raw);
}

sensedsl_real fig2_STM32F4DiscoveryBoard_value_USRear(uint8_t raw) {
    return sensedsl_shown(&DEVICES[2], (sensedsl_real)raw);
}

sensedsl_real fig2_STM32F4DiscoveryBoard_value_WheelEncoder(uint32_t raw) {
    return sensedsl_shown(&DEVICES[3], (sensedsl_real)raw);
}
