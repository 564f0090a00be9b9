/* the board STM32F4DiscoveryBoard of the design miniature_car: see its header. Generated: changes are lost when it is generated again. */
#include "miniature_car_STM32F4DiscoveryBoard.h"

static const sensedsl_device miniature_car_STM32F4DiscoveryBoard_devices[] = {
    {1, true, false, SENSEDSL_UINT16, 1, 0, NULL, "IRFrontRight", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 60},
    {2, true, false, SENSEDSL_UINT16, 1, 0, NULL, "IRRearRight", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 60},
    {3, true, false, SENSEDSL_UINT16, 1, 0, NULL, "IRRear", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 60},
    {4, true, false, SENSEDSL_UINT16, 1, 0, NULL, "USFront", "cm", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 70},
    {5, true, false, SENSEDSL_UINT16, 1, 0, NULL, "USFrontRight", "cm", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 70},
    {6, true, false, SENSEDSL_UINT16, 1, 0, NULL, "USRear", "cm", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 70},
    {7, true, false, SENSEDSL_UINT32, 1, 0, NULL, "WheelLeftA", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 0},
    {8, true, false, SENSEDSL_UINT32, 1, 0, NULL, "WheelLeftB", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 0},
    {9, true, false, SENSEDSL_UINT32, 1, 0, NULL, "WheelRightA", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 0},
    {10, true, false, SENSEDSL_UINT32, 1, 0, NULL, "WheelRightB", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 0},
    {11, true, false, SENSEDSL_UINT16, 1, 0, NULL, "RCSteering", "us", false, true, true, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)1000.0, (sensedsl_real)2000.0, 0},
    {12, true, false, SENSEDSL_UINT16, 1, 0, NULL, "RCThrottle", "us", false, true, true, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)1000.0, (sensedsl_real)2000.0, 0},
    {13, true, false, SENSEDSL_UINT16, 1, 0, NULL, "RCSwitch", "us", false, true, true, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)1000.0, (sensedsl_real)2000.0, 0},
};
#define DEVICES miniature_car_STM32F4DiscoveryBoard_devices

const sensedsl_schema miniature_car_STM32F4DiscoveryBoard_schema = {
    "STM32F4DiscoveryBoard",
    0x64783683,
    115200,
    0,
    SENSEDSL_NONE,
    false,
    13,
    DEVICES,
    47,
    miniature_car_STM32F4DiscoveryBoard_HELD_BYTES,
};

void miniature_car_STM32F4DiscoveryBoard_open(miniature_car_STM32F4DiscoveryBoard *board, const miniature_car_STM32F4DiscoveryBoard_handlers *handlers) {
    sensedsl_open(&board->link, &miniature_car_STM32F4DiscoveryBoard_schema, board->held);
    board->handlers = *handlers;
}

static void value(const miniature_car_STM32F4DiscoveryBoard_handlers *handlers, const sensedsl_event *event) {
    if (event->device == &DEVICES[0] && handlers->on_IRFrontRight != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_IRFrontRight(handlers->context, raw);
    }
    if (event->device == &DEVICES[1] && handlers->on_IRRearRight != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_IRRearRight(handlers->context, raw);
    }
    if (event->device == &DEVICES[2] && handlers->on_IRRear != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_IRRear(handlers->context, raw);
    }
    if (event->device == &DEVICES[3] && handlers->on_USFront != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_USFront(handlers->context, raw);
    }
    if (event->device == &DEVICES[4] && handlers->on_USFrontRight != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_USFrontRight(handlers->context, raw);
    }
    if (event->device == &DEVICES[5] && handlers->on_USRear != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_USRear(handlers->context, raw);
    }
    if (event->device == &DEVICES[6] && handlers->on_WheelLeftA != NULL) {
        uint32_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_WheelLeftA(handlers->context, raw);
    }
    if (event->device == &DEVICES[7] && handlers->on_WheelLeftB != NULL) {
        uint32_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_WheelLeftB(handlers->context, raw);
    }
    if (event->device == &DEVICES[8] && handlers->on_WheelRightA != NULL) {
        uint32_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_WheelRightA(handlers->context, raw);
    }
    if (event->device == &DEVICES[9] && handlers->on_WheelRightB != NULL) {
        uint32_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_WheelRightB(handlers->context, raw);
    }
    if (event->device == &DEVICES[10] && handlers->on_RCSteering != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_RCSteering(handlers->context, raw);
    }
    if (event->device == &DEVICES[11] && handlers->on_RCThrottle != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_RCThrottle(handlers->context, raw);
    }
    if (event->device == &DEVICES[12] && handlers->on_RCSwitch != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_RCSwitch(handlers->context, raw);
    }
    (void)handlers;
    (void)event;
}

static void handle(const sensedsl_event *event, void *context) {
    const miniature_car_STM32F4DiscoveryBoard_handlers *handlers = (const miniature_car_STM32F4DiscoveryBoard_handlers *)context;
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

void miniature_car_STM32F4DiscoveryBoard_feed(miniature_car_STM32F4DiscoveryBoard *board, const uint8_t *bytes, size_t count) {
    sensedsl_feed(&board->link, bytes, count, handle, &board->handlers);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_IRFrontRight(uint16_t raw) {
    return sensedsl_shown(&DEVICES[0], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_IRRearRight(uint16_t raw) {
    return sensedsl_shown(&DEVICES[1], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_IRRear(uint16_t raw) {
    return sensedsl_shown(&DEVICES[2], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_USFront(uint16_t raw) {
    return sensedsl_shown(&DEVICES[3], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_USFrontRight(uint16_t raw) {
    return sensedsl_shown(&DEVICES[4], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_USRear(uint16_t raw) {
    return sensedsl_shown(&DEVICES[5], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_WheelLeftA(uint32_t raw) {
    return sensedsl_shown(&DEVICES[6], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_WheelLeftB(uint32_t raw) {
    return sensedsl_shown(&DEVICES[7], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_WheelRightA(uint32_t raw) {
    return sensedsl_shown(&DEVICES[8], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_WheelRightB(uint32_t raw) {
    return sensedsl_shown(&DEVICES[9], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_RCSteering(uint16_t raw) {
    return sensedsl_shown(&DEVICES[10], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_RCThrottle(uint16_t raw) {
    return sensedsl_shown(&DEVICES[11], (sensedsl_real)raw);
}

sensedsl_real miniature_car_STM32F4DiscoveryBoard_value_RCSwitch(uint16_t raw) {
    return sensedsl_shown(&DEVICES[12], (sensedsl_real)raw);
}
