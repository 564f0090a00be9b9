#include "board.h"
void fast_timer_init(void) {}
void fast_timer_reset(void) {}
void fast_timer_direction(void) {}
