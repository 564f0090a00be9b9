/* The smallest application. */
#ifndef UP_CONF_H
#define UP_CONF_H

#define UP_SHELL FALSE

#define UP_LINK_USB TRUE
#define UP_HAS_BUTTON FALSE
#define UP_HAS_CONTROL FALSE

#define UP_ADC_WIDE 1

#endif
