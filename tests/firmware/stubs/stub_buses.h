/* A stub: see README.md. I2C, SPI and CAN, by version of the driver. */
#ifndef STUB_BUSES_H
#define STUB_BUSES_H

/* ---- I2C: version 1 has a clock in Hz, the others a timing register ---- */

#if HAL_USE_I2C == TRUE
typedef uint16_t i2caddr_t;
typedef uint32_t i2cflags_t;
#if STUB_I2C == 1
typedef struct {
  volatile uint32_t CR1, CR2, SR1, SR2;
} I2C_TypeDef;
#define I2C_SR2_BUSY 2U
typedef enum { OPMODE_I2C = 1 } i2copmode_t;
typedef enum { STD_DUTY_CYCLE = 1, FAST_DUTY_CYCLE_2 = 2, FAST_DUTY_CYCLE_16_9 = 3 } i2cdutycycle_t;
typedef struct {
  i2copmode_t op_mode;
  uint32_t clock_speed;
  i2cdutycycle_t duty_cycle;
} I2CConfig;
#else
typedef struct {
  volatile uint32_t CR1, CR2, ISR;
} I2C_TypeDef;
#define I2C_ISR_BUSY 0x8000U
typedef struct {
  uint32_t timingr, cr1, cr2;
} I2CConfig;
#define STM32_TIMINGR_PRESC(n) ((uint32_t)(n) << 28)
#define STM32_TIMINGR_SCLDEL(n) ((uint32_t)(n) << 20)
#define STM32_TIMINGR_SDADEL(n) ((uint32_t)(n) << 16)
#define STM32_TIMINGR_SCLH(n) ((uint32_t)(n) << 8)
#define STM32_TIMINGR_SCLL(n) ((uint32_t)(n))
#endif
typedef struct stub_i2c {
  I2C_TypeDef *i2c;
} I2CDriver;
#define I2C_NO_ERROR 0U
#define I2C_BUS_ERROR 1U
#define I2C_ARBITRATION_LOST 2U
#define I2C_ACK_FAILURE 4U
#define I2C_OVERRUN 8U
#define I2C_TIMEOUT 32U
msg_t i2cStart(I2CDriver *driver, const I2CConfig *config);
void i2cStop(I2CDriver *driver);
i2cflags_t i2cGetErrors(I2CDriver *driver);
msg_t i2cMasterTransmitTimeout(I2CDriver *driver, i2caddr_t address, const uint8_t *out, size_t out_bytes,
                               uint8_t *in, size_t in_bytes, sysinterval_t timeout);
msg_t i2cMasterReceiveTimeout(I2CDriver *driver, i2caddr_t address, uint8_t *in, size_t in_bytes,
                              sysinterval_t timeout);
void i2cAcquireBus(I2CDriver *driver);
void i2cReleaseBus(I2CDriver *driver);
#endif

/* ---- SPI: the second driver model, over three versions of the unit ---- */

#if HAL_USE_SPI == TRUE
#define SPI_SELECT_MODE_LINE 1
#if !defined(SPI_SELECT_MODE) || !defined(SPI_USE_WAIT) || !defined(SPI_USE_MUTUAL_EXCLUSION)
#error "halconf.h does not say how SPI is used"
#endif
typedef struct stub_spi SPIDriver;
typedef void (*spicb_t)(SPIDriver *driver);
typedef struct {
  bool circular, slave;
  spicb_t data_cb, error_cb;
#if SPI_SELECT_MODE == SPI_SELECT_MODE_LINE
  ioline_t ssline;
#endif
#if STUB_SPI == 3
  uint32_t cfg1, cfg2;
#else
  uint32_t cr1, cr2;
#endif
} SPIConfig;
struct stub_spi {
  const SPIConfig *config;
};
#if STUB_SPI == 3
#define SPI_CFG1_DSIZE_8BITS 7U
#define SPI_CFG1_MBR_DIV2 0U
#define SPI_CFG1_MBR_DIV4 0x10000000U
#define SPI_CFG1_MBR_DIV8 0x20000000U
#define SPI_CFG1_MBR_DIV16 0x30000000U
#define SPI_CFG1_MBR_DIV32 0x40000000U
#define SPI_CFG1_MBR_DIV64 0x50000000U
#define SPI_CFG1_MBR_DIV128 0x60000000U
#define SPI_CFG1_MBR_DIV256 0x70000000U
#define SPI_CFG2_CPHA 0x1000000U
#define SPI_CFG2_CPOL 0x2000000U
#define SPI_CFG2_AFCNTR 0x80000000U
#else
#define SPI_CR1_CPHA 1U
#define SPI_CR1_CPOL 2U
#define SPI_CR1_BR_0 8U
#define SPI_CR1_BR_1 16U
#define SPI_CR1_BR_2 32U
#if STUB_SPI == 2
#define SPI_CR2_DS_0 0x100U
#define SPI_CR2_DS_1 0x200U
#define SPI_CR2_DS_2 0x400U
#endif
#endif
msg_t spiStart(SPIDriver *driver, const SPIConfig *config);
void spiSelect(SPIDriver *driver);
void spiUnselect(SPIDriver *driver);
msg_t spiStartExchange(SPIDriver *driver, size_t count, const void *out, void *in);
msg_t spiSynchronize(SPIDriver *driver, sysinterval_t timeout);
msg_t spiStopTransfer(SPIDriver *driver, size_t *left);
void spiAcquireBus(SPIDriver *driver);
void spiReleaseBus(SPIDriver *driver);
#endif

/* ---- CAN: bxCAN, or FDCAN ---- */

#if HAL_USE_CAN == TRUE
typedef uint32_t canmbx_t;
typedef struct stub_can CANDriver;
#if defined(STUB_FDCAN)
#define FDCAN_PSR_BO 0x80U
#define FDCAN_CCCR_INIT 1U
typedef struct {
  volatile uint32_t CCCR, PSR;
} FDCAN_GlobalTypeDef;
typedef enum { OPMODE_FDCAN = 1, OPMODE_CAN = 2 } fdcanopmode_t;
typedef struct {
  fdcanopmode_t op_mode;
  uint32_t NBTP, DBTP, TDCR, CCCR, TEST, RXGFC;
} CANConfig;
typedef struct {
  union {
    struct {
      union {
        struct {
          uint32_t EID : 29;
        } ext;
        struct {
          uint32_t stub : 18;
          uint32_t SID : 11;
        } std;
        struct {
          uint32_t stub : 29;
          uint32_t RTR : 1;
          uint32_t XTD : 1;
          uint32_t ESI : 1;
        } common;
      };
      uint32_t stub : 16;
      uint32_t DLC : 4;
      uint32_t BPS : 1;
      uint32_t FDF : 1;
    };
    uint32_t header32[2];
  };
  union {
    uint8_t data8[64];
    uint32_t data32[16];
  };
} CANTxFrame, CANRxFrame;
struct stub_can {
  FDCAN_GlobalTypeDef *fdcan;
};
#else
#define CAN_MCR_TXFP 4U
#define CAN_MCR_AWUM 0x20U
#define CAN_MCR_ABOM 0x40U
#define CAN_BTR_BRP(n) ((uint32_t)(n))
#define CAN_BTR_TS1(n) ((uint32_t)(n) << 16)
#define CAN_BTR_TS2(n) ((uint32_t)(n) << 20)
#define CAN_BTR_SJW(n) ((uint32_t)(n) << 24)
#define CAN_ESR_BOFF 4U
#define CAN_ESR_LEC_Pos 4U
#define CAN_ESR_LEC_Msk 0x70U
#define CAN_TSR_ALST0 4U
#define CAN_TSR_ALST1 0x400U
#define CAN_TSR_ALST2 0x40000U
#define CAN_IDE_STD 0U
#define CAN_IDE_EXT 1U
typedef struct {
  volatile uint32_t MCR, MSR, TSR, ESR, BTR;
} CAN_TypeDef;
typedef struct {
  uint32_t mcr, btr;
} CANConfig;
typedef struct {
  struct {
    uint8_t DLC : 4;
    uint8_t RTR : 1;
    uint8_t IDE : 1;
  };
  union {
    struct {
      uint32_t SID : 11;
    };
    struct {
      uint32_t EID : 29;
    };
  };
  union {
    uint8_t data8[8];
    uint32_t data32[2];
  };
} CANTxFrame, CANRxFrame;
typedef struct {
  uint32_t filter : 16;
  uint32_t mode : 1;
  uint32_t scale : 1;
  uint32_t assignment : 1;
  uint32_t register1, register2;
} CANFilter;
struct stub_can {
  CAN_TypeDef *can;
};
void canSTM32SetFilters(CANDriver *driver, uint32_t second_from, uint32_t count, const CANFilter *filters);
#endif
#define CAN_ANY_MAILBOX 0U
msg_t canStart(CANDriver *driver, const CANConfig *config);
msg_t canTransmitTimeout(CANDriver *driver, canmbx_t mailbox, const CANTxFrame *frame, sysinterval_t timeout);
msg_t canReceiveTimeout(CANDriver *driver, canmbx_t mailbox, CANRxFrame *frame, sysinterval_t timeout);
#endif

#endif
