/* the board Rover of the design curves: its messages. Generated: changes are lost when it is generated again. */
#ifndef CURVES_ROVER_H
#define CURVES_ROVER_H

#include "sensedsl.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    curves_Rover_HELD_BYTES = 228,
    curves_Rover_VALUE_BYTES = 16,
    /* Of memory for a frame to the board. */
    curves_Rover_FRAME_BYTES = SENSEDSL_HEAD_BYTES + 19 + 1
};

/* What is called when something comes that is believed; each may be null. */
typedef struct {
    void *context; /* handed to each of them */
    void (*matched)(void *context); /* the board has the firmware of this design */
    void (*other_firmware)(void *context, uint32_t hash);
    void (*health)(void *context, const sensedsl_event *event); /* `event->health`, and `sensedsl_health_of` */
    /* a GP2Y0A21 behind the bumper; uint16, shown in cm */
    void (*on_Ranger)(void *context, uint16_t raw);
    /* uint16[8], shown in percent */
    void (*on_Line)(void *context, const uint16_t raw[8]);
    /* bool[3] */
    void (*on_Bumper)(void *context, const bool raw[3]);
    /* int32[2] */
    void (*on_Wheels)(void *context, const int32_t raw[2]);
    /* uint16 */
    void (*on_Bent)(void *context, uint16_t raw);
    /* int16[3], shown in g */
    void (*on_Acceleration)(void *context, const int16_t raw[3]);
    /* int16[3], shown in deg/s */
    void (*on_Rate)(void *context, const int16_t raw[3]);
    /* int32, shown in deg */
    void (*on_Position)(void *context, int32_t raw);
} curves_Rover_handlers;

/* The board at the other end. While a handler runs, `link.event.frame` is the report at hand, with its stamp. */
typedef struct {
    sensedsl_link link;
    curves_Rover_handlers handlers;
    uint8_t held[curves_Rover_HELD_BYTES];
} curves_Rover;

extern const sensedsl_schema curves_Rover_schema;

/* A board that has said nothing yet. `sensedsl_to_send(&board->link, ...)` then asks who it is. */
void curves_Rover_open(curves_Rover *board, const curves_Rover_handlers *handlers);

/* Takes the next bytes, however the stream is cut, and calls the handlers. */
void curves_Rover_feed(curves_Rover *board, const uint8_t *bytes, size_t count);

/* a GP2Y0A21 behind the bumper; uint16, shown in cm */
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Ranger(uint16_t raw);

/* uint16[8], shown in percent */
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Line(uint16_t raw);

/* bool[3] */
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Bumper(bool raw);

/* int32[2] */
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Wheels(int32_t raw);

/* uint16 */
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Bent(uint16_t raw);

/* uint16[4], shown in percent */
/* Makes the frame that sets it, and returns its bytes; 0 if a value is beyond the design's limits. */
size_t curves_Rover_set_Escs(uint8_t frame[curves_Rover_FRAME_BYTES], const uint16_t raw[4]);
/* Adds it to a frame that `sensedsl_begin` has begun, for several actuators at once. */
bool curves_Rover_add_Escs(sensedsl_writer *writer, const uint16_t raw[4]);
/* The nearest code of a shown value; false if it is beyond the design's limits or its type. */
bool curves_Rover_code_Escs(sensedsl_real shown, uint16_t *raw);
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Escs(uint16_t raw);

/* bool[3] */
/* Makes the frame that sets it, and returns its bytes; 0 if a value is beyond the design's limits. */
size_t curves_Rover_set_Lamps(uint8_t frame[curves_Rover_FRAME_BYTES], const bool raw[3]);
/* Adds it to a frame that `sensedsl_begin` has begun, for several actuators at once. */
bool curves_Rover_add_Lamps(sensedsl_writer *writer, const bool raw[3]);
/* The nearest code of a shown value; false if it is beyond the design's limits or its type. */
bool curves_Rover_code_Lamps(sensedsl_real shown, bool *raw);
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Lamps(bool raw);

/* uint16, shown in N */
/* Makes the frame that sets it, and returns its bytes; 0 if a value is beyond the design's limits. */
size_t curves_Rover_set_Winch(uint8_t frame[curves_Rover_FRAME_BYTES], uint16_t raw);
/* Adds it to a frame that `sensedsl_begin` has begun, for several actuators at once. */
bool curves_Rover_add_Winch(sensedsl_writer *writer, uint16_t raw);
/* The nearest code of a shown value; false if it is beyond the design's limits or its type. */
bool curves_Rover_code_Winch(sensedsl_real shown, uint16_t *raw);
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Winch(uint16_t raw);

/* int16[3], shown in g */
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Acceleration(int16_t raw);

/* int16[3], shown in deg/s */
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Rate(int16_t raw);

/* int16, shown in % */
/* Makes the frame that sets it, and returns its bytes; 0 if a value is beyond the design's limits. */
size_t curves_Rover_set_Speed(uint8_t frame[curves_Rover_FRAME_BYTES], int16_t raw);
/* Adds it to a frame that `sensedsl_begin` has begun, for several actuators at once. */
bool curves_Rover_add_Speed(sensedsl_writer *writer, int16_t raw);
/* The nearest code of a shown value; false if it is beyond the design's limits or its type. */
bool curves_Rover_code_Speed(sensedsl_real shown, int16_t *raw);
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Speed(int16_t raw);

/* int32, shown in deg */
/* The shown value of a code. */
sensedsl_real curves_Rover_value_Position(int32_t raw);

#ifdef __cplusplus
}
#endif

#endif
