/*
 * The vector table of the emulated Cortex-M4 that the tests run on: initial stack pointer and entry point. Any fault
 * ends in the trap, which ends the emulator with a failure (semihosting SYS_EXIT_EXTENDED).
 */
#include <stdint.h>

extern void _start(void);

static void trap(void) {
  static const uint32_t status[] = {0x20023U /* run-time error */, 2U};
  __asm volatile("mov r0, #0x20\n mov r1, %0\n bkpt 0xAB" : : "r"(status) : "r0", "r1", "memory");
  for (;;) {
  }
}

__attribute__((section(".isr_vector"), used)) static const uintptr_t vectors[] = {
    0x20400000U,       (uintptr_t)_start, (uintptr_t)trap, (uintptr_t)trap,
    (uintptr_t)trap,   (uintptr_t)trap,   (uintptr_t)trap,
};
