/*
 * How the MCU fares: why it started, whether the loop turns, how busy it is, how much of the stack was never used.
 */
#ifndef UP_LIFE_H
#define UP_LIFE_H

#include "up_health.h"

/* Starts the watchdog. */
void up_life_start(void);

/* Around the work of a task, so that a reset by the watchdog tells whose it was. */
void up_life_enter(uint16_t field);
void up_life_leave(void);

/* The loop has turned: resets the watchdog. */
void up_life_turn(void);

/* What the health frame says of the board, besides its uptime. */
void up_life_describe(up_health_board_t *board);

#endif
