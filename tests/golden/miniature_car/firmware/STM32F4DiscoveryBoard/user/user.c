/* Yours: SenseDSL made this file once and never touches it again. */
#include "sense_model.h"
#include "up_rt.h"

/* Called once, after the kernel has started and before any sensor is read. */
void up_user_init(void) {
}
