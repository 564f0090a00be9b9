/*
 * The pulse train of a model receiver (PPM sum): one interval between edges for each channel, and a gap.
 *
 * The interrupt side notes intervals; a train counts when it stands between two gaps and each interval is long enough.
 */
#ifndef UP_PPM_H
#define UP_PPM_H

#include "up_value.h"

/* Trains with more channels are not taken. */
#define UP_PPM_CHANNELS_MAX 16U

typedef struct {
  uint32_t tick_hz;   /* of the timer, at least 1 */
  uint32_t gap_ticks; /* a longer interval starts a train: 2.7 ms */
  uint32_t min_ticks; /* a shorter one is a disturbance and spoils the train: 0.5 ms; 0: none is */
} up_ppm_config_t;

/* Written by the interrupt, copied by the reader with interrupts masked. All zero at the start. */
typedef struct {
  uint32_t last_ticks;                     /* time of the last edge */
  uint32_t building[UP_PPM_CHANNELS_MAX];  /* intervals since the gap */
  uint32_t channels[UP_PPM_CHANNELS_MAX];  /* intervals of the last whole train */
  uint32_t trains;                         /* whole ones */
  uint32_t spoilt;                         /* trains with a disturbance or too many channels */
  uint8_t building_count;
  uint8_t channels_count;
  bool has_edge;  /* last_ticks is one */
  bool is_inside; /* a gap was seen, and nothing that spoils the train since */
} up_ppm_raw_t;

/* Interrupt side: the time of an edge (all of one direction), from a counter that wraps at 2^32; or the interval
 * between two edges where the timer measures that itself. */
void up_ppm_on_edge(const up_ppm_config_t *config, up_ppm_raw_t *raw, uint32_t time_ticks);
void up_ppm_on_interval(const up_ppm_config_t *config, up_ppm_raw_t *raw, uint32_t interval_ticks);

/* Reader side: the channels in us, rounded, when a train has come since the last look (`trains_seen` remembers it):
 * UP_FRESH; UP_INVALID when it has fewer channels than the field has elements. Further channels are left out. */
up_result_t up_ppm_read(const up_ppm_config_t *config, const up_ppm_raw_t *raw, uint32_t *trains_seen,
                        const up_field_t *field, void *value);

#endif
