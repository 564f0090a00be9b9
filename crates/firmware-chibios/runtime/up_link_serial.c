/* The channel over a serial port. It cannot detect whether the wire is connected, so it always counts as open. */
#include "up_link.h"

#if UP_LINK_USB == FALSE

void up_channel_start(void) {
  (void)sdStart(up_config.link_driver, up_config.link_config);
}

BaseChannel *up_channel(void) {
  return (BaseChannel *)up_config.link_driver;
}

size_t up_channel_room(void) {
  size_t bytes;

  chSysLock();
  bytes = oqGetEmptyI(&up_config.link_driver->oqueue);
  chSysUnlock();
  return bytes;
}

bool up_channel_is_open(void) {
  return true;
}

#endif
