/*
 * The pulse train of a model receiver (PPM sum): one interval between edges for each channel, then a gap.
 *
 * The interrupt side notes intervals; a train counts if it is between two gaps and all its intervals are long enough.
 */
#ifndef UP_PPM_H
#define UP_PPM_H

#include "up_value.h"

/* The most channels of a train; trains with more are ignored. */
#ifndef UP_PPM_CHANNELS_MAX
#define UP_PPM_CHANNELS_MAX 16U
#endif

typedef struct {
  uint32_t tick_hz;   /* clock of the timer, at least 1 */
  uint32_t gap_ticks; /* an interval longer than this starts a train: 2.7 ms */
  uint32_t min_ticks; /* an interval shorter than this is a disturbance and spoils the train: 0.5 ms; 0: none does */
} up_ppm_config_t;

/* Written by the interrupt, copied by the reader with interrupts masked. All zero at the start. */
typedef struct {
  uint32_t last_ticks;                     /* time of the last edge */
  uint32_t building[UP_PPM_CHANNELS_MAX];  /* intervals since the gap */
  uint32_t channels[UP_PPM_CHANNELS_MAX];  /* intervals of the last complete train */
  uint32_t trains;                         /* complete trains */
  uint32_t spoilt;                         /* trains with a disturbance or too many channels */
  uint8_t building_count;
  uint8_t channels_count;
  bool has_edge;  /* last_ticks is valid */
  bool is_inside; /* a gap was seen, and nothing has spoiled the train since */
} up_ppm_raw_t;

/* Interrupt side: the time of an edge (all of the same direction), from a counter that wraps at 2^32; or the
 * interval between two edges, for timers that measure it. */
void up_ppm_on_edge(UP_ROM up_ppm_config_t *config, up_ppm_raw_t *raw, uint32_t time_ticks);
void up_ppm_on_interval(UP_ROM up_ppm_config_t *config, up_ppm_raw_t *raw, uint32_t interval_ticks);

/* Reader side: the channels in us, rounded, if a train has come since the last call (`trains_seen` remembers it):
 * UP_FRESH; UP_INVALID if it has fewer channels than the field has elements. Further channels are ignored. */
up_result_t up_ppm_read(UP_ROM up_ppm_config_t *config, const up_ppm_raw_t *raw, uint32_t *trains_seen,
                        UP_ROM up_field_t *field, void *value);

#endif
