/* Written by SenseDSL: sizes and choices the runtime is compiled with. */
#ifndef UP_CONF_H
#define UP_CONF_H

/* The link is a USB device (CDC ACM). */
#define UP_LINK_USB TRUE
#define UP_LINK_USB_DRIVER USBD1

/* The shell; the Makefile's UP_MODE decides. */
#if !defined(UP_SHELL)
#define UP_SHELL TRUE
#endif

/* The board's button, held at the start, asks for frames instead of the shell. */
#define UP_HAS_BUTTON TRUE

/* The user has no code that runs in cycles. */
#define UP_HAS_CONTROL FALSE

/* Clock of the core's cycle counter, in Hz. */
#define UP_CORE_HZ STM32_HCLK

/* Converters with more than 12 bits. */
#define UP_ADC_WIDE FALSE

/* The shortest read the I2C driver accepts. */
#define UP_I2C_READ_BYTES_MIN 1

/* The longest message that a serial device is sent. */
#define UP_UART_SEND_BYTES_MAX 1U

/* The longest one on a line with answers. */
#define UP_LINE_SEND_BYTES_MAX 1U

/* CAN buses. */
#define UP_CAN_BUSES 1U

/* After so long without a frame of the host actuators fall back; 0: never. */
#define UP_SILENCE_MS 0U

/* What each thread's stack has for the transforms of user/: enough for one that calls a mathematical function of float.
 * -DUP_TRANSFORM_BYTES=512 in user/user.mk makes it more. */
#if !defined(UP_TRANSFORM_BYTES)
#define UP_TRANSFORM_BYTES 128U
#endif

#define UP_INPUTS_COUNT 5U
#define UP_TASKS_COUNT 3U
#define UP_FIELDS_COUNT 4U
#define UP_VALUE_BYTES_MAX 4U

#endif
