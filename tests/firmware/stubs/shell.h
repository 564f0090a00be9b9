/* A stub: see README.md. */
#ifndef SHELL_H
#define SHELL_H

#include "hal.h"

#define SHELL_NEWLINE_STR "\r\n"
typedef void (*shellcmd_t)(BaseSequentialStream *stream, int count, char *arguments[]);
typedef struct {
  const char *sc_name;
  shellcmd_t sc_function;
} ShellCommand;
typedef struct {
  BaseSequentialStream *sc_channel;
  const ShellCommand *sc_commands;
} ShellConfig;
void shellInit(void);
void shellExit(msg_t result);
void shellUsage(BaseSequentialStream *stream, const char *text);
void shellThread(void *parameter);

#endif
