/* A stub: see README.md. */
#ifndef CHPRINTF_H
#define CHPRINTF_H

#include "hal.h"

int chprintf(BaseSequentialStream *stream, const char *format, ...);
int chsnprintf(char *text, size_t bytes, const char *format, ...);

#endif
