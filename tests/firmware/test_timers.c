/* Counts beyond 16 bits, arrays measured element by element, contacts that bounce, pulse widths. */
#include <string.h>

#include "check.h"
#include "up_count.h"
#include "up_debounce.h"
#include "up_elements.h"
#include "up_pulse_width.h"

/* ---- counts ---- */

static void test_wraps(void) {
  up_count_t count = {0U, 0U};
  uint16_t hardware = 0U;
  int32_t truth = 0;
  uint32_t i;

  up_count_step(&count, 32767U);
  CHECK(up_count_total(&count) == 32767);
  up_count_step(&count, 65534U);
  CHECK(up_count_total(&count) == 65534);
  up_count_step(&count, 10U);
  CHECK(up_count_total(&count) == 65546);
  up_count_step(&count, 65535U);
  CHECK(up_count_total(&count) == 65535);
  memset(&count, 0, sizeof count);
  up_count_step(&count, 65535U);
  CHECK(up_count_total(&count) == -1);
  /* In both directions and at any speed that 16 bits allow, compared with a count that never wraps. */
  memset(&count, 0, sizeof count);
  for (i = 0U; i < 20000U; i++) {
    const int32_t moved = (int32_t)((i * 2654435761U) >> 16U) % 65536 - 32768;

    truth += moved;
    hardware = (uint16_t)(hardware + (uint32_t)moved);
    up_count_step(&count, hardware);
    CHECK(up_count_total(&count) == truth);
  }
  /* At the end of 32 bits it continues at the other end. */
  count.total = 0x7FFFFFFFU;
  up_count_step(&count, (uint16_t)(hardware + 1U));
  CHECK(up_count_total(&count) == INT32_MIN);
}

static uint64_t counted(uint8_t type, int64_t count) {
  uint64_t element = 0U;

  up_count_store(type, count, &element);
  return up_element_load(type, &element);
}

static void test_types(void) {
  float real = 0.0F;
  double wide = 0.0;

  CHECK(counted(UP_TYPE_UINT8, 256) == 0U && counted(UP_TYPE_UINT8, -1) == 255U);
  CHECK(counted(UP_TYPE_INT16, 32768) == 0x8000U && counted(UP_TYPE_UINT16, 65537) == 1U);
  CHECK(counted(UP_TYPE_UINT32, -2) == 0xFFFFFFFEU && counted(UP_TYPE_INT64, -2) == 0xFFFFFFFFFFFFFFFEU);
  CHECK(counted(UP_TYPE_BOOL, 256) == 1U && counted(UP_TYPE_BOOL, 0) == 0U);
  up_count_store(UP_TYPE_FLOAT32, -70000, &real);
  up_count_store(UP_TYPE_FLOAT64, 70000, &wide);
  CHECK(real == -70000.0F && wide == 70000.0);
}

static void test_repeats(void) {
  up_repeat_t repeat = {0U, false};

  CHECK(up_repeat_is_due(&repeat, false, 1000U, 4294967000U));
  CHECK(!up_repeat_is_due(&repeat, false, 1000U, 4294967200U));
  CHECK(up_repeat_is_due(&repeat, true, 1000U, 4294967200U));
  CHECK(!up_repeat_is_due(&repeat, false, 1000U, 903U));
  CHECK(up_repeat_is_due(&repeat, false, 1000U, 904U));
}

/* Who sends as often as the cycle, or more often, is heard once in each; after a silence not twice. */
static void test_turns(void) {
  up_turn_t turn = {0U, false};
  uint32_t now_ms, taken = 0U;

  for (now_ms = 0xFFFFFF00U; now_ms != 0x00000300U; now_ms++) {
    if (now_ms % 4U == 0U && up_turn_is_next(&turn, 16U, now_ms)) {
      taken++;
    }
  }
  /* The last one is that of the turn which begins with the end. */
  CHECK(taken == 65U);
  CHECK(up_turn_is_next(&turn, 100U, 10000U));
  CHECK(!up_turn_is_next(&turn, 100U, 10074U));
  CHECK(up_turn_is_next(&turn, 100U, 10075U));
  CHECK(!up_turn_is_next(&turn, 100U, 10174U));
  CHECK(up_turn_is_next(&turn, 100U, 20000U) && !up_turn_is_next(&turn, 100U, 20040U));
  CHECK(up_turn_is_next(&turn, 0U, 20040U) && up_turn_is_next(&turn, 0U, 20040U));
}

/* ---- arrays ---- */

static void test_elements(void) {
  uint8_t flags[3] = {0U, 0U, 0U};

  up_elements_note(flags, 0U);
  up_elements_note(flags, 2U);
  CHECK(!up_elements_are_due(flags, 3U, false) && !up_elements_are_due(flags, 3U, true));
  up_elements_note(flags, 1U);
  CHECK(up_elements_are_due(flags, 3U, true));
  CHECK(!up_elements_are_due(flags, 3U, false));
  up_elements_note(flags, 1U);
  CHECK(!up_elements_are_due(flags, 3U, true));
  CHECK(up_elements_are_due(flags, 3U, false));
  CHECK(!up_elements_are_due(flags, 3U, false));
}

/* ---- contacts ---- */

static void test_bounces(void) {
  const up_contact_config_t config = {20U, UP_EDGE_RISING};
  up_contact_t contact;
  uint32_t now = 4294967290U; /* time wraps meanwhile */
  uint32_t i;

  memset(&contact, 0, sizeof contact);
  up_contact_look(&config, &contact, false, now);
  for (i = 0U; i < 7U; i++) {
    now += 3U;
    up_contact_on_edge(&config, &contact, i % 2U == 0U, now);
    up_contact_look(&config, &contact, i % 2U == 0U, now + 1U);
    CHECK(contact.edges == 0U && !contact.level);
  }
  up_contact_look(&config, &contact, true, now + 19U);
  CHECK(contact.edges == 0U && !contact.level);
  up_contact_look(&config, &contact, true, now + 20U);
  CHECK(contact.edges == 1U && contact.level);
  /* Falling edges do not count, but the level follows. */
  up_contact_on_edge(&config, &contact, false, now + 30U);
  up_contact_look(&config, &contact, false, now + 50U);
  CHECK(contact.edges == 1U && !contact.level);
}

/* A pulse that lasted long enough counts even if nothing read the contact meanwhile; a shorter one does not. */
static void test_unseen_pulses(void) {
  const up_contact_config_t config = {20U, UP_EDGE_BOTH};
  up_contact_t contact;

  memset(&contact, 0, sizeof contact);
  up_contact_look(&config, &contact, false, 0U);
  up_contact_on_edge(&config, &contact, true, 100U);
  up_contact_on_edge(&config, &contact, false, 130U);
  up_contact_look(&config, &contact, false, 160U);
  CHECK(contact.edges == 2U && !contact.level);
  up_contact_on_edge(&config, &contact, true, 200U);
  up_contact_on_edge(&config, &contact, false, 219U);
  up_contact_look(&config, &contact, false, 260U);
  CHECK(contact.edges == 2U);
  /* Without an interrupt, reading the contact starts the time. */
  up_contact_look(&config, &contact, true, 300U);
  up_contact_look(&config, &contact, true, 319U);
  CHECK(contact.edges == 2U);
  up_contact_look(&config, &contact, true, 320U);
  CHECK(contact.edges == 3U && contact.level);
  /* A glitch too short to be read still interrupts, and the time starts again. */
  up_contact_look(&config, &contact, false, 400U);
  up_contact_on_edge(&config, &contact, false, 410U);
  up_contact_look(&config, &contact, false, 425U);
  CHECK(contact.level);
  up_contact_look(&config, &contact, false, 430U);
  CHECK(!contact.level && contact.edges == 4U);
}

static void test_telling(void) {
  const up_contact_config_t config = {0U, UP_EDGE_RISING};
  up_contact_report_t reported;
  up_contact_t contact;

  memset(&reported, 0, sizeof reported);
  memset(&contact, 0, sizeof contact);
  up_contact_look(&config, &contact, false, 0U);
  CHECK(up_contact_report(&config, &contact, &reported) && !reported.level);
  CHECK(!up_contact_report(&config, &contact, &reported));
  /* A pulse between two readings: first its level is reported, then the current one. */
  up_contact_on_edge(&config, &contact, true, 1U);
  up_contact_look(&config, &contact, false, 2U);
  CHECK(contact.edges == 1U);
  CHECK(up_contact_report(&config, &contact, &reported) && reported.level);
  CHECK(up_contact_report(&config, &contact, &reported) && !reported.level);
  CHECK(!up_contact_report(&config, &contact, &reported));
  /* A rise that stays is reported once. */
  up_contact_on_edge(&config, &contact, true, 3U);
  CHECK(up_contact_report(&config, &contact, &reported) && reported.level);
  CHECK(!up_contact_report(&config, &contact, &reported));
  /* A dip ends at the level where it was: for rising edges, nothing has happened. */
  up_contact_on_edge(&config, &contact, true, 4U);
  CHECK(!up_contact_report(&config, &contact, &reported) && reported.level);
}

/* ---- pulses ---- */

static void test_widths(void) {
  const up_pulse_width_t servo = {3000U, 6000U};
  const up_pulse_width_t duty = {0U, 65535U};
  const up_pulse_width_t down = {6000U, 3000U};
  uint32_t level;
  uint32_t last = 0U;

  CHECK(up_pulse_ticks(&servo, 0U) == 3000U && up_pulse_ticks(&servo, 5000U) == 4500U);
  CHECK(up_pulse_ticks(&servo, 10000U) == 6000U && up_pulse_ticks(&servo, 10001U) == 6000U);
  CHECK(up_pulse_ticks(&duty, 10000U) == 65535U && up_pulse_ticks(&duty, 0U) == 0U);
  CHECK(up_pulse_ticks(&duty, 1U) == 7U);
  CHECK(up_pulse_ticks(&down, 0U) == 6000U && up_pulse_ticks(&down, 2500U) == 5250U);
  for (level = 0U; level <= UP_LEVEL_FULL; level++) {
    const uint32_t ticks = up_pulse_ticks(&duty, level);

    CHECK(ticks >= last && ticks - last <= 7U);
    last = ticks;
  }
}

static void test_levels(void) {
  const int16_t negative = -1;
  const int16_t half = 5000;
  const uint32_t much = 4000000000U;
  const float real = 2500.5F;
  const uint8_t small = 255U;

  CHECK(up_pulse_level(UP_TYPE_INT16, &negative) == 0U && up_pulse_level(UP_TYPE_INT16, &half) == 5000U);
  CHECK(up_pulse_level(UP_TYPE_UINT32, &much) == UP_LEVEL_FULL && up_pulse_level(UP_TYPE_UINT8, &small) == 255U);
  CHECK(up_pulse_level(UP_TYPE_FLOAT32, &real) == 2501U);
}

void test_timers(void) {
  test_wraps();
  test_types();
  test_repeats();
  test_turns();
  test_elements();
  test_bounces();
  test_unseen_pulses();
  test_telling();
  test_widths();
  test_levels();
}
