/*
 * The channel over USB: a CDC ACM device, which hosts show as a serial port (/dev/ttyACM0).
 *
 * It counts as open while the host has configured it and either raises DTR (as every terminal and serial library does
 * when it opens the port) or has sent something.
 */
#include "up_link.h"

#if UP_LINK_USB == TRUE

#include "hal_usb_cdc.h"

/* Vendor and product of the usual virtual serial port of this MCU family; your own go into UDEFS. */
#if !defined(UP_USB_VENDOR)
#define UP_USB_VENDOR 0x0483
#endif
#if !defined(UP_USB_PRODUCT)
#define UP_USB_PRODUCT 0x5740
#endif

#define DATA_ENDPOINT 1
#define NOTIFY_ENDPOINT 2
#define DATA_PACKET_BYTES 64
#define NOTIFY_PACKET_BYTES 8
#define CONFIGURATION_BYTES 67
#define RECONNECT_MS 1200

typedef enum { TEXT_LANGUAGES, TEXT_VENDOR, TEXT_PRODUCT, TEXT_SERIAL } text_t;

static SerialUSBDriver channel;
static volatile bool is_dtr;
static volatile bool was_heard;

/* ---- descriptors ---- */

static const uint8_t device_bytes[] = {
    USB_DESC_DEVICE(0x0200, CDC_COMMUNICATION_INTERFACE_CLASS, 0x00, 0x00, 64, UP_USB_VENDOR, UP_USB_PRODUCT,
                    0x0200, TEXT_VENDOR, TEXT_PRODUCT, TEXT_SERIAL, 1),
};

static const uint8_t configuration_bytes[] = {
    USB_DESC_CONFIGURATION(CONFIGURATION_BYTES, 2, 1, 0, 0xC0, 50),
    /* Control: abstract control model; its functional descriptors name the data interface. */
    USB_DESC_INTERFACE(0, 0, 1, CDC_COMMUNICATION_INTERFACE_CLASS, CDC_ABSTRACT_CONTROL_MODEL, 0x01, 0),
    USB_DESC_BYTE(5), USB_DESC_BYTE(CDC_CS_INTERFACE), USB_DESC_BYTE(CDC_HEADER), USB_DESC_BCD(0x0110),
    USB_DESC_BYTE(5), USB_DESC_BYTE(CDC_CS_INTERFACE), USB_DESC_BYTE(CDC_CALL_MANAGEMENT), USB_DESC_BYTE(0),
    USB_DESC_BYTE(1),
    USB_DESC_BYTE(4), USB_DESC_BYTE(CDC_CS_INTERFACE), USB_DESC_BYTE(CDC_ABSTRACT_CONTROL_MANAGEMENT),
    USB_DESC_BYTE(2),
    USB_DESC_BYTE(5), USB_DESC_BYTE(CDC_CS_INTERFACE), USB_DESC_BYTE(CDC_UNION), USB_DESC_BYTE(0),
    USB_DESC_BYTE(1),
    USB_DESC_ENDPOINT(NOTIFY_ENDPOINT | 0x80, USB_EP_MODE_TYPE_INTR, NOTIFY_PACKET_BYTES, 255),
    /* Data. */
    USB_DESC_INTERFACE(1, 0, 2, CDC_DATA_INTERFACE_CLASS, 0x00, 0x00, 0),
    USB_DESC_ENDPOINT(DATA_ENDPOINT, USB_EP_MODE_TYPE_BULK, DATA_PACKET_BYTES, 0),
    USB_DESC_ENDPOINT(DATA_ENDPOINT | 0x80, USB_EP_MODE_TYPE_BULK, DATA_PACKET_BYTES, 0),
};

_Static_assert(sizeof configuration_bytes == CONFIGURATION_BYTES, "length stated in the USB configuration");

static const USBDescriptor device_descriptor = {sizeof device_bytes, device_bytes};
static const USBDescriptor configuration_descriptor = {sizeof configuration_bytes, configuration_bytes};

/* The serial number distinguishes several boards: it is the MCU's unique number in hexadecimal. */
static void serial_number(char text[25]) {
  static const char digits[] = "0123456789ABCDEF";
  size_t i;

  for (i = 0U; i < 24U; i++) {
#if defined(UID_BASE)
    const uint8_t byte = ((const uint8_t *)UID_BASE)[i / 2U];
#else
    const uint8_t byte = 0U;
#endif
    text[i] = digits[((i % 2U) == 0U) ? (byte >> 4) : (byte & 15U)];
  }
  text[24] = '\0';
}

/* Strings are requested rarely and one at a time, so they are made on demand. */
static const USBDescriptor *text_descriptor(uint8_t index) {
  static uint8_t bytes[2U + 2U * 32U];
  static USBDescriptor descriptor;
  char serial[25];
  const char *text = (index == (uint8_t)TEXT_VENDOR) ? "SenseDSL" : up_config.board;
  size_t i;

  if (index > (uint8_t)TEXT_SERIAL) {
    return NULL;
  }
  if (index == (uint8_t)TEXT_SERIAL) {
    serial_number(serial);
    text = serial;
  }
  for (i = 0U; text[i] != '\0' && i < 32U; i++) {
    bytes[2U + 2U * i] = (uint8_t)text[i];
    bytes[3U + 2U * i] = 0U;
  }
  if (index == (uint8_t)TEXT_LANGUAGES) {
    bytes[2] = 0x09U; /* 0x0409: English */
    bytes[3] = 0x04U;
    i = 1U;
  }
  bytes[0] = (uint8_t)(2U + 2U * i);
  bytes[1] = USB_DESCRIPTOR_STRING;
  descriptor.ud_size = bytes[0];
  descriptor.ud_string = bytes;
  return &descriptor;
}

static const USBDescriptor *get_descriptor(USBDriver *usb, uint8_t type, uint8_t index, uint16_t language) {
  (void)usb;
  (void)language;
  switch (type) {
  case USB_DESCRIPTOR_DEVICE:
    return &device_descriptor;
  case USB_DESCRIPTOR_CONFIGURATION:
    return &configuration_descriptor;
  case USB_DESCRIPTOR_STRING:
    return text_descriptor(index);
  default:
    return NULL;
  }
}

/* ---- endpoints and events ---- */

static USBInEndpointState data_in_state;
static USBOutEndpointState data_out_state;
static USBInEndpointState notify_state;

static const USBEndpointConfig data_endpoint = {
    .ep_mode = USB_EP_MODE_TYPE_BULK,
    .in_cb = sduDataTransmitted,
    .out_cb = sduDataReceived,
    .in_maxsize = DATA_PACKET_BYTES,
    .out_maxsize = DATA_PACKET_BYTES,
    .in_state = &data_in_state,
    .out_state = &data_out_state,
};

static const USBEndpointConfig notify_endpoint = {
    .ep_mode = USB_EP_MODE_TYPE_INTR,
    .in_cb = sduInterruptTransmitted,
    .in_maxsize = NOTIFY_PACKET_BYTES,
    .in_state = &notify_state,
};

static void close_channel(void) {
  is_dtr = false;
  was_heard = false;
  chSysLockFromISR();
  sduSuspendHookI(&channel);
  chSysUnlockFromISR();
}

static void on_event(USBDriver *usb, usbevent_t event) {
  switch (event) {
  case USB_EVENT_CONFIGURED:
    chSysLockFromISR();
    usbInitEndpointI(usb, DATA_ENDPOINT, &data_endpoint);
    usbInitEndpointI(usb, NOTIFY_ENDPOINT, &notify_endpoint);
    sduConfigureHookI(&channel);
    chSysUnlockFromISR();
    break;
  case USB_EVENT_RESET:
  case USB_EVENT_UNCONFIGURED:
  case USB_EVENT_SUSPEND:
    close_channel();
    break;
  case USB_EVENT_WAKEUP:
    chSysLockFromISR();
    sduWakeupHookI(&channel);
    chSysUnlockFromISR();
    break;
  case USB_EVENT_ADDRESS:
  case USB_EVENT_STALLED:
  default:
    break;
  }
}

static bool on_request(USBDriver *usb) {
  const bool is_class = (usb->setup[0] & USB_RTYPE_TYPE_MASK) == USB_RTYPE_TYPE_CLASS;

  if (is_class && usb->setup[1] == CDC_SET_CONTROL_LINE_STATE) {
    is_dtr = (usb->setup[2] & 1U) != 0U;
    was_heard = false;
  }
  return sduRequestsHook(usb);
}

static void on_frame_start(USBDriver *usb) {
  (void)usb;
  chSysLockFromISR();
  sduSOFHookI(&channel);
  chSysUnlockFromISR();
}

/* ---- the channel ---- */

static const USBConfig usb_config = {
    .event_cb = on_event,
    .get_descriptor_cb = get_descriptor,
    .requests_hook_cb = on_request,
    .sof_cb = on_frame_start,
};

static const SerialUSBConfig channel_config = {
    .usbp = &UP_LINK_USB_DRIVER,
    .bulk_in = DATA_ENDPOINT,
    .bulk_out = DATA_ENDPOINT,
    .int_in = NOTIFY_ENDPOINT,
};

/* The 48 MHz oscillator is too inaccurate for USB unless it follows the host's frames, one per millisecond. */
static void follow_host(void) {
#if defined(CRS)
#if defined(RCC_APB1ENR1_CRSEN)
  RCC->APB1ENR1 |= RCC_APB1ENR1_CRSEN;
#elif defined(RCC_APBENR1_CRSEN)
  RCC->APBENR1 |= RCC_APBENR1_CRSEN;
#elif defined(RCC_APB1HENR_CRSEN)
  RCC->APB1HENR |= RCC_APB1HENR_CRSEN;
  (void)RCC->APB1HENR;
  CRS->CFGR |= CRS_CFGR_SYNCSRC; /* the second device, which has the usual pins */
#else
  RCC->APB1ENR |= RCC_APB1ENR_CRSEN;
#endif
  CRS->CR |= CRS_CR_AUTOTRIMEN | CRS_CR_CEN;
#endif
}

void up_channel_start(void) {
  follow_host();
  sduObjectInit(&channel);
  (void)sduStart(&channel, &channel_config);
  /* A pause long enough for a host to notice, so that it also sees a restart of the MCU alone. */
  usbDisconnectBus(channel_config.usbp);
  chThdSleepMilliseconds(RECONNECT_MS);
  (void)usbStart(channel_config.usbp, &usb_config);
  usbConnectBus(channel_config.usbp);
}

BaseChannel *up_channel(void) {
  return (BaseChannel *)&channel;
}

/* Whole buffers only: bytes in a partly filled one leave with the next frame of the bus. */
size_t up_channel_room(void) {
  size_t buffers;

  chSysLock();
  buffers = obqIsEmptyI(&channel.obqueue) ? SERIAL_USB_BUFFERS_NUMBER : bqSpaceI(&channel.obqueue);
  if (buffers > 0U && channel.obqueue.ptr != NULL) {
    buffers--;
  }
  chSysUnlock();
  return buffers * SERIAL_USB_BUFFERS_SIZE;
}

bool up_channel_is_open(void) {
  if (channel_config.usbp->state != USB_ACTIVE) {
    return false;
  }
  if (!is_dtr && !was_heard) {
    bool is_empty;
    chSysLock();
    is_empty = ibqIsEmptyI(&channel.ibqueue);
    chSysUnlock();
    was_heard = !is_empty;
  }
  return is_dtr || was_heard;
}

#endif
