/* Written by SenseDSL: the kernel's settings, as changes to the demo's file in your ChibiOS tree. */
#ifndef SENSE_CHCONF_H
#define SENSE_CHCONF_H

#include UP_BASE_CHCONF

#endif
