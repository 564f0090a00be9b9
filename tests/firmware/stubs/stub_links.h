/* A stub: see README.md. Serial ports, channels in general, USB. */
#ifndef STUB_LINKS_H
#define STUB_LINKS_H

/* ---- serial ports, and channels in general ---- */

struct BaseSequentialStreamVMT {
  size_t instance_offset;
  size_t (*write)(void *instance, const uint8_t *bytes, size_t count);
  size_t (*read)(void *instance, uint8_t *bytes, size_t count);
  msg_t (*put)(void *instance, uint8_t byte);
  msg_t (*get)(void *instance);
};
typedef struct {
  const struct BaseSequentialStreamVMT *vmt;
} BaseSequentialStream, BaseChannel, BaseAsynchronousChannel;
size_t chnReadTimeout(void *channel, uint8_t *bytes, size_t count, sysinterval_t timeout);
size_t chnWriteTimeout(void *channel, const uint8_t *bytes, size_t count, sysinterval_t timeout);
typedef struct {
  size_t stub;
} input_queue_t;
typedef struct {
  size_t stub;
} output_queue_t;
typedef struct {
  size_t bcounter;
  uint8_t *ptr;
} io_buffers_queue_t, input_buffers_queue_t, output_buffers_queue_t;
bool ibqIsEmptyI(const input_buffers_queue_t *queue);
bool obqIsEmptyI(const output_buffers_queue_t *queue);
size_t bqSpaceI(const io_buffers_queue_t *queue);
size_t oqGetEmptyI(const output_queue_t *queue);
size_t oqGetFullI(const output_queue_t *queue);
#if HAL_USE_SERIAL == TRUE
typedef struct {
  uint32_t speed;
  uint32_t cr1, cr2, cr3;
} SerialConfig;
typedef struct {
#if STUB_USART > 1
  volatile uint32_t ISR;
#define USART_ISR_TC 0x40U
#else
  volatile uint32_t SR;
#define USART_SR_TC 0x40U
#endif
} USART_TypeDef;
typedef struct {
  const void *methods;
  input_queue_t iqueue;
  output_queue_t oqueue;
  USART_TypeDef *usart;
} SerialDriver;
msg_t sdStart(SerialDriver *driver, const SerialConfig *config);
size_t sdWrite(SerialDriver *driver, const uint8_t *bytes, size_t count);
size_t sdWriteTimeout(SerialDriver *driver, const uint8_t *bytes, size_t count, sysinterval_t timeout);
size_t sdReadTimeout(SerialDriver *driver, uint8_t *bytes, size_t count, sysinterval_t timeout);
#define USART_CR1_PS 0x200U
#define USART_CR1_PCE 0x400U
#define USART_CR2_STOP_1 0x2000U
#define USART_CR3_HDSEL 0x8U
#if STUB_USART > 1
#define USART_CR2_RXINV 0x10000U
#define USART_CR2_TXINV 0x20000U
#endif
#endif

/* ---- events of a channel ---- */

typedef uint32_t eventmask_t, eventflags_t;
typedef struct {
  int stub;
} event_source_t;
typedef struct {
  eventflags_t flags;
} event_listener_t;
#define EVENT_MASK(n) ((eventmask_t)1U << (n))
#define SD_PARITY_ERROR 1U
#define SD_FRAMING_ERROR 2U
#define SD_OVERRUN_ERROR 4U
#define SD_QUEUE_FULL_ERROR 8U
event_source_t *chnGetEventSource(void *channel);
void chEvtRegisterMaskWithFlags(event_source_t *source, event_listener_t *listener, eventmask_t mask,
                                eventflags_t flags);
eventflags_t chEvtGetAndClearFlags(event_listener_t *listener);

/* ---- USB ---- */

#if HAL_USE_USB == TRUE
#if !defined(SERIAL_USB_BUFFERS_SIZE)
#define SERIAL_USB_BUFFERS_SIZE 256U
#endif
#if !defined(SERIAL_USB_BUFFERS_NUMBER)
#define SERIAL_USB_BUFFERS_NUMBER 2U
#endif

typedef struct stub_usb USBDriver;
typedef enum { USB_UNINIT, USB_STOP, USB_READY, USB_SELECTED, USB_ACTIVE, USB_SUSPENDED } usbstate_t;
typedef enum {
  USB_EVENT_RESET, USB_EVENT_ADDRESS, USB_EVENT_CONFIGURED, USB_EVENT_UNCONFIGURED, USB_EVENT_SUSPEND,
  USB_EVENT_WAKEUP, USB_EVENT_STALLED
} usbevent_t;
typedef uint8_t usbep_t;
typedef struct {
  size_t ud_size;
  const uint8_t *ud_string;
} USBDescriptor;
typedef struct {
  size_t count;
} USBInEndpointState, USBOutEndpointState;
typedef void (*usbepcallback_t)(USBDriver *usb, usbep_t endpoint);
typedef struct {
  uint32_t ep_mode;
  usbepcallback_t setup_cb, in_cb, out_cb;
  uint16_t in_maxsize, out_maxsize;
  USBInEndpointState *in_state;
  USBOutEndpointState *out_state;
} USBEndpointConfig;
typedef struct {
  void (*event_cb)(USBDriver *usb, usbevent_t event);
  const USBDescriptor *(*get_descriptor_cb)(USBDriver *usb, uint8_t type, uint8_t index, uint16_t language);
  bool (*requests_hook_cb)(USBDriver *usb);
  void (*sof_cb)(USBDriver *usb);
} USBConfig;
struct stub_usb {
  usbstate_t state;
  uint8_t setup[8];
};
typedef struct {
  USBDriver *usbp;
  usbep_t bulk_in, bulk_out, int_in;
} SerialUSBConfig;
typedef struct {
  const void *methods;
  input_buffers_queue_t ibqueue;
  output_buffers_queue_t obqueue;
} SerialUSBDriver;
#define USB_DESC_BYTE(b) ((uint8_t)(b))
#define USB_DESC_WORD(w) ((uint8_t)((w) & 255)), ((uint8_t)(((w) >> 8) & 255))
#define USB_DESC_BCD(w) USB_DESC_WORD(w)
#define USB_DESC_DEVICE(usb, class, sub, protocol, packet, vendor, product, release, maker, name, serial,      \
                        configurations)                                                                      \
  18, 1, USB_DESC_BCD(usb), (class), (sub), (protocol), (packet), USB_DESC_WORD(vendor),                     \
      USB_DESC_WORD(product), USB_DESC_BCD(release), (maker), (name), (serial), (configurations)
#define USB_DESC_CONFIGURATION(bytes, interfaces, value, name, attributes, power)                            \
  9, 2, USB_DESC_WORD(bytes), (interfaces), (value), (name), (attributes), (power)
#define USB_DESC_INTERFACE(number, setting, endpoints, class, sub, protocol, name)                           \
  9, 4, (number), (setting), (endpoints), (class), (sub), (protocol), (name)
#define USB_DESC_ENDPOINT(address, attributes, bytes, interval)                                              \
  7, 5, (uint8_t)(address), (attributes), USB_DESC_WORD(bytes), (interval)
#define USB_DESCRIPTOR_DEVICE 1U
#define USB_DESCRIPTOR_CONFIGURATION 2U
#define USB_DESCRIPTOR_STRING 3U
#define USB_EP_MODE_TYPE_BULK 2U
#define USB_EP_MODE_TYPE_INTR 3U
#define USB_RTYPE_TYPE_MASK 0x60U
#define USB_RTYPE_TYPE_CLASS 0x20U
msg_t usbStart(USBDriver *usb, const USBConfig *config);
void usbConnectBus(USBDriver *usb);
void usbDisconnectBus(USBDriver *usb);
void usbInitEndpointI(USBDriver *usb, usbep_t endpoint, const USBEndpointConfig *config);
void sduObjectInit(SerialUSBDriver *driver);
msg_t sduStart(SerialUSBDriver *driver, const SerialUSBConfig *config);
void sduSuspendHookI(SerialUSBDriver *driver);
void sduWakeupHookI(SerialUSBDriver *driver);
void sduConfigureHookI(SerialUSBDriver *driver);
void sduSOFHookI(SerialUSBDriver *driver);
bool sduRequestsHook(USBDriver *usb);
void sduDataTransmitted(USBDriver *usb, usbep_t endpoint);
void sduDataReceived(USBDriver *usb, usbep_t endpoint);
void sduInterruptTransmitted(USBDriver *usb, usbep_t endpoint);
#endif

#endif
