/* the board Rover of the design curves: see its header. Generated: changes are lost when it is generated again. */
#include "curves_Rover.h"

static const sensedsl_point curves_Rover_curve_Ranger[] = {
    {(sensedsl_real)0.4, (sensedsl_real)80.0},
    {(sensedsl_real)0.5, (sensedsl_real)60.0},
    {(sensedsl_real)0.75, (sensedsl_real)40.0},
    {(sensedsl_real)1.3, (sensedsl_real)20.0},
    {(sensedsl_real)2.3, (sensedsl_real)10.0},
    {(sensedsl_real)3.1, (sensedsl_real)6.0},
};

static const sensedsl_point curves_Rover_curve_Line[] = {
    {(sensedsl_real)200.0, (sensedsl_real)0.0},
    {(sensedsl_real)3800.0, (sensedsl_real)100.0},
};

static const sensedsl_point curves_Rover_curve_Bent[] = {
    {(sensedsl_real)80.0, (sensedsl_real)8.0},
    {(sensedsl_real)250.0, (sensedsl_real)3.0},
};

static const sensedsl_point curves_Rover_curve_Escs[] = {
    {(sensedsl_real)1000.0, (sensedsl_real)0.0},
    {(sensedsl_real)2000.0, (sensedsl_real)100.0},
};

static const sensedsl_point curves_Rover_curve_Winch[] = {
    {(sensedsl_real)0.0, (sensedsl_real)-50.0},
    {(sensedsl_real)1000.0, (sensedsl_real)0.0},
    {(sensedsl_real)2000.0, (sensedsl_real)200.0},
};

static const sensedsl_device curves_Rover_devices[] = {
    {1, true, false, SENSEDSL_UINT16, 1, 6, curves_Rover_curve_Ranger, "Ranger", "cm", true, true, true, (sensedsl_real)0.0008056640625, (sensedsl_real)0.0, (sensedsl_real)8.0, (sensedsl_real)70.0, 1000},
    {10, true, true, SENSEDSL_UINT16, 8, 2, curves_Rover_curve_Line, "Line", "percent", true, true, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)1.0, (sensedsl_real)0.0, 1000},
    {12, true, true, SENSEDSL_BOOL, 3, 0, NULL, "Bumper", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 1000},
    {13, true, true, SENSEDSL_INT32, 2, 0, NULL, "Wheels", "", true, false, false, (sensedsl_real)0.25, (sensedsl_real)-90.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 0},
    {14, true, false, SENSEDSL_UINT16, 1, 2, curves_Rover_curve_Bent, "Bent", "", true, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 1000},
    {20, false, true, SENSEDSL_UINT16, 4, 2, curves_Rover_curve_Escs, "Escs", "percent", true, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 0},
    {21, false, true, SENSEDSL_BOOL, 3, 0, NULL, "Lamps", "", false, false, false, (sensedsl_real)1.0, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 0},
    {22, false, false, SENSEDSL_UINT16, 1, 3, curves_Rover_curve_Winch, "Winch", "N", true, true, true, (sensedsl_real)0.5, (sensedsl_real)0.0, (sensedsl_real)-25.0, (sensedsl_real)100.0, 0},
    {30, true, true, SENSEDSL_INT16, 3, 0, NULL, "Acceleration", "g", true, false, false, (sensedsl_real)6.103515625e-5, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 10},
    {31, true, true, SENSEDSL_INT16, 3, 0, NULL, "Rate", "deg/s", true, false, false, (sensedsl_real)0.007633587786259542, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 10},
    {40, false, false, SENSEDSL_INT16, 1, 0, NULL, "Speed", "%", true, true, true, (sensedsl_real)0.01, (sensedsl_real)0.0, (sensedsl_real)-100.0, (sensedsl_real)100.0, 0},
    {41, true, false, SENSEDSL_INT32, 1, 0, NULL, "Position", "deg", true, false, false, (sensedsl_real)0.2571428571428571, (sensedsl_real)0.0, (sensedsl_real)0.0, (sensedsl_real)0.0, 0},
};
#define DEVICES curves_Rover_devices

const sensedsl_schema curves_Rover_schema = {
    "Rover",
    0x0ca56b7c,
    115200,
    500,
    SENSEDSL_NONE,
    false,
    12,
    DEVICES,
    55,
    curves_Rover_HELD_BYTES,
};

void curves_Rover_open(curves_Rover *board, const curves_Rover_handlers *handlers) {
    sensedsl_open(&board->link, &curves_Rover_schema, board->held);
    board->handlers = *handlers;
}

static void value(const curves_Rover_handlers *handlers, const sensedsl_event *event) {
    if (event->device == &DEVICES[0] && handlers->on_Ranger != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_Ranger(handlers->context, raw);
    }
    if (event->device == &DEVICES[1] && handlers->on_Line != NULL) {
        uint16_t raw[8];
        sensedsl_load(event->device, event->bytes, raw);
        handlers->on_Line(handlers->context, raw);
    }
    if (event->device == &DEVICES[2] && handlers->on_Bumper != NULL) {
        bool raw[3];
        sensedsl_load(event->device, event->bytes, raw);
        handlers->on_Bumper(handlers->context, raw);
    }
    if (event->device == &DEVICES[3] && handlers->on_Wheels != NULL) {
        int32_t raw[2];
        sensedsl_load(event->device, event->bytes, raw);
        handlers->on_Wheels(handlers->context, raw);
    }
    if (event->device == &DEVICES[4] && handlers->on_Bent != NULL) {
        uint16_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_Bent(handlers->context, raw);
    }
    if (event->device == &DEVICES[8] && handlers->on_Acceleration != NULL) {
        int16_t raw[3];
        sensedsl_load(event->device, event->bytes, raw);
        handlers->on_Acceleration(handlers->context, raw);
    }
    if (event->device == &DEVICES[9] && handlers->on_Rate != NULL) {
        int16_t raw[3];
        sensedsl_load(event->device, event->bytes, raw);
        handlers->on_Rate(handlers->context, raw);
    }
    if (event->device == &DEVICES[11] && handlers->on_Position != NULL) {
        int32_t raw;
        sensedsl_load(event->device, event->bytes, &raw);
        handlers->on_Position(handlers->context, raw);
    }
    (void)handlers;
    (void)event;
}

static void handle(const sensedsl_event *event, void *context) {
    const curves_Rover_handlers *handlers = (const curves_Rover_handlers *)context;
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

void curves_Rover_feed(curves_Rover *board, const uint8_t *bytes, size_t count) {
    sensedsl_feed(&board->link, bytes, count, handle, &board->handlers);
}

sensedsl_real curves_Rover_value_Ranger(uint16_t raw) {
    return sensedsl_shown(&DEVICES[0], (sensedsl_real)raw);
}

sensedsl_real curves_Rover_value_Line(uint16_t raw) {
    return sensedsl_shown(&DEVICES[1], (sensedsl_real)raw);
}

sensedsl_real curves_Rover_value_Bumper(bool raw) {
    return sensedsl_shown(&DEVICES[2], (sensedsl_real)raw);
}

sensedsl_real curves_Rover_value_Wheels(int32_t raw) {
    return sensedsl_shown(&DEVICES[3], (sensedsl_real)raw);
}

sensedsl_real curves_Rover_value_Bent(uint16_t raw) {
    return sensedsl_shown(&DEVICES[4], (sensedsl_real)raw);
}

bool curves_Rover_add_Escs(sensedsl_writer *writer, const uint16_t raw[4]) {
    return sensedsl_add(writer, &DEVICES[5], raw);
}

size_t curves_Rover_set_Escs(uint8_t frame[curves_Rover_FRAME_BYTES], const uint16_t raw[4]) {
    sensedsl_writer writer;
    sensedsl_begin(&writer, &curves_Rover_schema, frame, curves_Rover_FRAME_BYTES);
    (void)curves_Rover_add_Escs(&writer, raw);
    return sensedsl_end(&writer);
}

bool curves_Rover_code_Escs(sensedsl_real shown, uint16_t *raw) {
    return sensedsl_code(&DEVICES[5], shown, raw, 0);
}

sensedsl_real curves_Rover_value_Escs(uint16_t raw) {
    return sensedsl_shown(&DEVICES[5], (sensedsl_real)raw);
}

bool curves_Rover_add_Lamps(sensedsl_writer *writer, const bool raw[3]) {
    return sensedsl_add(writer, &DEVICES[6], raw);
}

size_t curves_Rover_set_Lamps(uint8_t frame[curves_Rover_FRAME_BYTES], const bool raw[3]) {
    sensedsl_writer writer;
    sensedsl_begin(&writer, &curves_Rover_schema, frame, curves_Rover_FRAME_BYTES);
    (void)curves_Rover_add_Lamps(&writer, raw);
    return sensedsl_end(&writer);
}

bool curves_Rover_code_Lamps(sensedsl_real shown, bool *raw) {
    return sensedsl_code(&DEVICES[6], shown, raw, 0);
}

sensedsl_real curves_Rover_value_Lamps(bool raw) {
    return sensedsl_shown(&DEVICES[6], (sensedsl_real)raw);
}

bool curves_Rover_add_Winch(sensedsl_writer *writer, uint16_t raw) {
    return sensedsl_add(writer, &DEVICES[7], &raw);
}

size_t curves_Rover_set_Winch(uint8_t frame[curves_Rover_FRAME_BYTES], uint16_t raw) {
    sensedsl_writer writer;
    sensedsl_begin(&writer, &curves_Rover_schema, frame, curves_Rover_FRAME_BYTES);
    (void)curves_Rover_add_Winch(&writer, raw);
    return sensedsl_end(&writer);
}

bool curves_Rover_code_Winch(sensedsl_real shown, uint16_t *raw) {
    return sensedsl_code(&DEVICES[7], shown, raw, 0);
}

sensedsl_real curves_Rover_value_Winch(uint16_t raw) {
    return sensedsl_shown(&DEVICES[7], (sensedsl_real)raw);
}

sensedsl_real curves_Rover_value_Acceleration(int16_t raw) {
    return sensedsl_shown(&DEVICES[8], (sensedsl_real)raw);
}

sensedsl_real curves_Rover_value_Rate(int16_t raw) {
    return sensedsl_shown(&DEVICES[9], (sensedsl_real)raw);
}

bool curves_Rover_add_Speed(sensedsl_writer *writer, int16_t raw) {
    return sensedsl_add(writer, &DEVICES[10], &raw);
}

size_t curves_Rover_set_Speed(uint8_t frame[curves_Rover_FRAME_BYTES], int16_t raw) {
    sensedsl_writer writer;
    sensedsl_begin(&writer, &curves_Rover_schema, frame, curves_Rover_FRAME_BYTES);
    (void)curves_Rover_add_Speed(&writer, raw);
    return sensedsl_end(&writer);
}

bool curves_Rover_code_Speed(sensedsl_real shown, int16_t *raw) {
    return sensedsl_code(&DEVICES[10], shown, raw, 0);
}

sensedsl_real curves_Rover_value_Speed(int16_t raw) {
    return sensedsl_shown(&DEVICES[10], (sensedsl_real)raw);
}

sensedsl_real curves_Rover_value_Position(int32_t raw) {
    return sensedsl_shown(&DEVICES[11], (sensedsl_real)raw);
}
