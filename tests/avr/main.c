/*
 * Runs a program on an AVR, among what the world's side says is around it.
 *
 *   board MCU HZ IMAGE LINK [UNIT:BAUD:DATA:PARITY:STOP]...
 *
 * LINK is the number of the serial port that the host is at, `usb`, or `none`. What follows is what else is at serial
 * ports, and the host's own setting.
 */
#include "talk.h"

#include <elf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define FLASH_END 0x800000U
#define USAGE "board MCU HZ IMAGE LINK [UNIT:BAUD:DATA:PARITY:STOP]...\n"

static void fail(const char *what, const char *of) {
  fprintf(stderr, "%s: %s\n", of, what);
  exit(EXIT_FAILURE);
}

static uint8_t *read_file(const char *path, size_t *size) {
  FILE *const file = fopen(path, "rb");
  uint8_t *bytes = NULL;
  long end = -1;

  if (file != NULL && fseek(file, 0, SEEK_END) == 0) {
    end = ftell(file);
  }
  if (end < 0 || fseek(file, 0, SEEK_SET) != 0) {
    fail("cannot be read", path);
  }
  *size = (size_t)end;
  bytes = malloc(*size + 1);
  if (bytes == NULL || fread(bytes, 1, *size, file) != *size) {
    fail("cannot be read", path);
  }
  fclose(file);
  return bytes;
}

/* simavr's own reader takes sections by name, and knows not all of them; the segments are what a programmer writes. */
static void load(const char *path) {
  size_t size;
  uint8_t *const bytes = read_file(path, &size);
  Elf32_Ehdr head;

  if (size < sizeof head || memcmp(bytes, ELFMAG, SELFMAG) != 0) {
    fail("is no ELF file", path);
  }
  memcpy(&head, bytes, sizeof head);
  if (head.e_ident[EI_CLASS] != ELFCLASS32 || head.e_machine != EM_AVR) {
    fail("is not for an AVR", path);
  }
  for (unsigned at = 0; at < head.e_phnum; at++) {
    Elf32_Phdr part_of;
    const size_t place = head.e_phoff + (size_t)at * head.e_phentsize;

    if (place + sizeof part_of > size) {
      fail("is damaged", path);
    }
    memcpy(&part_of, bytes + place, sizeof part_of);
    if (part_of.p_type != PT_LOAD || part_of.p_filesz == 0 || part_of.p_paddr >= FLASH_END) {
      continue;
    }
    if ((size_t)part_of.p_offset + part_of.p_filesz > size ||
        (size_t)part_of.p_paddr + part_of.p_filesz > (size_t)avr->flashend + 1) {
      fail("does not fit into the flash", path);
    }
    memcpy(avr->flash + part_of.p_paddr, bytes + part_of.p_offset, part_of.p_filesz);
  }
  free(bytes);
}

static void connect(const char *what, const char *link) {
  unsigned unit = 0;
  unsigned long baud = 0;
  unsigned data_bits = 0;
  unsigned parity = 0;
  unsigned stop_bits = 0;
  char number[12];

  if (sscanf(what, "%u:%lu:%u:%u:%u", &unit, &baud, &data_bits, &parity, &stop_bits) != 5 || unit >= UARTS) {
    fail("is not UNIT:BAUD:DATA:PARITY:STOP", what);
  }
  snprintf(number, sizeof number, "%u", unit);
  uart_connect(unit,
               (serial_t){.is_known = true, .baud = (uint32_t)baud, .data_bits = (uint8_t)data_bits,
                          .parity = (uint8_t)parity, .stop_bits = (uint8_t)stop_bits},
               strcmp(number, link) == 0);
}

static void log_aside(avr_t *of, const int level, const char *format, va_list list) {
  (void)of;
  if (level <= LOG_ERROR) {
    vfprintf(stderr, format, list);
  }
}

int main(int argc, char **argv) {
  int out;

  if (argc < 5) {
    fputs(USAGE, stderr);
    return EXIT_FAILURE;
  }
  /* simavr prints; nothing of that may come between the messages. */
  out = dup(STDOUT_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  talk_on(STDIN_FILENO, out);
  avr_global_logger_set(log_aside);
  part = part_named(argv[1]);
  avr = part == NULL ? NULL : avr_make_mcu_by_name(argv[1]);
  if (avr == NULL) {
    fail("is no MCU that is modelled", argv[1]);
  }
  board_init();
  avr->frequency = (uint32_t)strtoul(argv[2], NULL, 10);
  if (avr->frequency == 0) {
    fail("is no frequency", argv[2]);
  }
  load(argv[3]);
  if (strcmp(argv[4], "usb") == 0) {
    usb_connect();
  }
  for (int at = 5; at < argc; at++) {
    connect(argv[at], argv[4]);
  }
  talk();
  return EXIT_SUCCESS;
}
