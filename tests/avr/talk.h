/*
 * What is said between the board and what is around it. README.md has the messages.
 */
#ifndef TALK_H
#define TALK_H

#include "board.h"

typedef enum { I2C_START, I2C_WRITE, I2C_READ, I2C_STOP } i2c_event_t;
typedef enum { I2C_ACK, I2C_NACK, I2C_BYTE, I2C_STUCK, I2C_SILENT } i2c_reply_t;

/* Takes orders until there are no more. */
void talk(void);

/* Questions, which wait for the answer. */
uint32_t ask_microvolts(pad_t pad, unsigned input, uint64_t cycle);
void ask_edge(pad_t pad, uint64_t after_ns);
i2c_reply_t ask_i2c(i2c_event_t event, uint8_t value, bool flag, uint64_t cycle, uint8_t *byte);
uint8_t ask_spi(uint8_t out, uint64_t cycle);
bool ask_uart(unsigned unit, uint64_t cycle, uint8_t *byte);
void ask_driven(pad_t pad, level_t level, uint64_t cycle);

/* News, which nobody answers. */
void tell_uart(unsigned unit, uint8_t byte, uint64_t cycle);
void tell_link(uint8_t byte, uint64_t cycle);
void tell_levels(uint8_t byte, uint64_t from, uint32_t bit_cycles);
void tell_wave(unsigned timer, unsigned channel, bool is_complement, uint64_t period, uint64_t width, uint64_t cycle);
void tell_reset(uint8_t cause, uint64_t cycle);
void tell_crash(uint32_t pc);
/* How a port is set up: a serial one ('u'), SPI ('s'), I2C ('i'). */
void tell_setting(char kind, unsigned unit, uint32_t hz, uint8_t data_bits, uint8_t parity, uint8_t stop_bits);

void talk_on(int in, int out);

#endif
