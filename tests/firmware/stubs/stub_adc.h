/* A stub: see README.md. Names in the converters' registers, by version of the driver. */
#ifndef STUB_ADC_H
#define STUB_ADC_H

#define ADC_CHANNEL_IN(n) (n)
#define ADC_CHANNEL_IN0 0U
#define ADC_CHANNEL_IN1 1U
#define ADC_CHANNEL_IN2 2U
#define ADC_CHANNEL_IN3 3U
#define ADC_CHANNEL_IN4 4U
#define ADC_CHANNEL_IN5 5U
#define ADC_CHANNEL_IN6 6U
#define ADC_CHANNEL_IN7 7U
#define ADC_CHANNEL_IN8 8U
#define ADC_CHANNEL_IN9 9U
#define ADC_CHANNEL_IN10 10U
#define ADC_CHANNEL_IN11 11U
#define ADC_CHANNEL_IN12 12U
#define ADC_CHANNEL_IN13 13U
#define ADC_CHANNEL_IN14 14U
#define ADC_CHANNEL_IN15 15U
#define ADC_CHANNEL_IN16 16U
#define ADC_CHANNEL_IN17 17U
#define ADC_CHANNEL_IN18 18U
#define ADC_CHANNEL_IN19 19U

#if STUB_ADC == 2 /* and STM32F1's own */
#define ADC_CR2_SWSTART 0x40000000U
#define ADC_CR2_EXTSEL_SWSTART 0xE0000U
#define ADC_SQR1_NUM_CH(n) (((n) - 1U) << 20)
#define ADC_SAMPLE_3 0U
#define ADC_SAMPLE_15 1U
#define ADC_SAMPLE_28 2U
#define ADC_SAMPLE_56 3U
#define ADC_SAMPLE_84 4U
#define ADC_SAMPLE_112 5U
#define ADC_SAMPLE_144 6U
#define ADC_SAMPLE_480 7U
#define ADC_SAMPLE_1P5 0U
#define ADC_SAMPLE_7P5 1U
#define ADC_SAMPLE_13P5 2U
#define ADC_SAMPLE_28P5 3U
#define ADC_SAMPLE_41P5 4U
#define ADC_SAMPLE_55P5 5U
#define ADC_SAMPLE_71P5 6U
#define ADC_SAMPLE_239P5 7U
#define ADC_SMPR2_SMP_AN0(n) ((uint32_t)(n) << 0)
#define ADC_SMPR2_SMP_AN1(n) ((uint32_t)(n) << 3)
#define ADC_SMPR2_SMP_AN2(n) ((uint32_t)(n) << 6)
#define ADC_SMPR2_SMP_AN3(n) ((uint32_t)(n) << 9)
#define ADC_SMPR2_SMP_AN4(n) ((uint32_t)(n) << 12)
#define ADC_SMPR2_SMP_AN5(n) ((uint32_t)(n) << 15)
#define ADC_SMPR2_SMP_AN6(n) ((uint32_t)(n) << 18)
#define ADC_SMPR2_SMP_AN7(n) ((uint32_t)(n) << 21)
#define ADC_SMPR2_SMP_AN8(n) ((uint32_t)(n) << 24)
#define ADC_SMPR2_SMP_AN9(n) ((uint32_t)(n) << 27)
#define ADC_SMPR1_SMP_AN10(n) ((uint32_t)(n) << 0)
#define ADC_SMPR1_SMP_AN11(n) ((uint32_t)(n) << 3)
#define ADC_SMPR1_SMP_AN12(n) ((uint32_t)(n) << 6)
#define ADC_SMPR1_SMP_AN13(n) ((uint32_t)(n) << 9)
#define ADC_SMPR1_SMP_AN14(n) ((uint32_t)(n) << 12)
#define ADC_SMPR1_SMP_AN15(n) ((uint32_t)(n) << 15)
#define ADC_SMPR1_SMP_AN16(n) ((uint32_t)(n) << 18)
#define ADC_SMPR1_SMP_AN17(n) ((uint32_t)(n) << 21)
#define ADC_SMPR1_SMP_AN18(n) ((uint32_t)(n) << 24)
#define ADC_SQR3_SQ1_N(n) ((uint32_t)(n) << 0)
#define ADC_SQR3_SQ2_N(n) ((uint32_t)(n) << 5)
#define ADC_SQR3_SQ3_N(n) ((uint32_t)(n) << 10)
#define ADC_SQR3_SQ4_N(n) ((uint32_t)(n) << 15)
#define ADC_SQR3_SQ5_N(n) ((uint32_t)(n) << 20)
#define ADC_SQR3_SQ6_N(n) ((uint32_t)(n) << 25)
#define ADC_SQR2_SQ7_N(n) ((uint32_t)(n) << 0)
#define ADC_SQR2_SQ8_N(n) ((uint32_t)(n) << 5)
#define ADC_SQR2_SQ9_N(n) ((uint32_t)(n) << 10)
#define ADC_SQR2_SQ10_N(n) ((uint32_t)(n) << 15)
#define ADC_SQR2_SQ11_N(n) ((uint32_t)(n) << 20)
#define ADC_SQR2_SQ12_N(n) ((uint32_t)(n) << 25)
#define ADC_SQR1_SQ13_N(n) ((uint32_t)(n) << 0)
#define ADC_SQR1_SQ14_N(n) ((uint32_t)(n) << 5)
#define ADC_SQR1_SQ15_N(n) ((uint32_t)(n) << 10)
#define ADC_SQR1_SQ16_N(n) ((uint32_t)(n) << 15)
#elif STUB_ADC == 3 || STUB_ADC == 4
#define ADC_CFGR_CONT 0x2000U
#define ADC_CFGR_CONT_ENABLED 0x2000U
#define ADC_CFGR_CONT_DISABLED 0U
#define ADC_CFGR_RES_12BITS 0U
#define ADC_CFGR_RES_16BITS 0U
#define ADC_TR_DISABLED 0U
#define ADC_TR(low, high) (((uint32_t)(high) << 16) | (uint32_t)(low))
#define ADC_SMPR_SMP_1P5 0U
#define ADC_SMPR_SMP_2P5 1U
#define ADC_SMPR_SMP_4P5 2U
#define ADC_SMPR_SMP_7P5 3U
#define ADC_SMPR_SMP_19P5 4U
#define ADC_SMPR_SMP_61P5 5U
#define ADC_SMPR_SMP_181P5 6U
#define ADC_SMPR_SMP_601P5 7U
#define ADC_SMPR_SMP_6P5 0U
#define ADC_SMPR_SMP_12P5 1U
#define ADC_SMPR_SMP_24P5 2U
#define ADC_SMPR_SMP_47P5 3U
#define ADC_SMPR_SMP_92P5 4U
#define ADC_SMPR_SMP_247P5 5U
#define ADC_SMPR_SMP_640P5 6U
#define ADC_SMPR_SMP_8P5 7U
#define ADC_SMPR_SMP_16P5 0U
#define ADC_SMPR_SMP_32P5 1U
#define ADC_SMPR_SMP_64P5 2U
#define ADC_SMPR_SMP_387P5 3U
#define ADC_SMPR_SMP_810P5 4U
#define ADC_SMPR1_SMP_AN0(n) ((uint32_t)(n) << 0)
#define ADC_SMPR1_SMP_AN1(n) ((uint32_t)(n) << 3)
#define ADC_SMPR1_SMP_AN2(n) ((uint32_t)(n) << 6)
#define ADC_SMPR1_SMP_AN3(n) ((uint32_t)(n) << 9)
#define ADC_SMPR1_SMP_AN4(n) ((uint32_t)(n) << 12)
#define ADC_SMPR1_SMP_AN5(n) ((uint32_t)(n) << 15)
#define ADC_SMPR1_SMP_AN6(n) ((uint32_t)(n) << 18)
#define ADC_SMPR1_SMP_AN7(n) ((uint32_t)(n) << 21)
#define ADC_SMPR1_SMP_AN8(n) ((uint32_t)(n) << 24)
#define ADC_SMPR1_SMP_AN9(n) ((uint32_t)(n) << 27)
#define ADC_SMPR2_SMP_AN10(n) ((uint32_t)(n) << 0)
#define ADC_SMPR2_SMP_AN11(n) ((uint32_t)(n) << 3)
#define ADC_SMPR2_SMP_AN12(n) ((uint32_t)(n) << 6)
#define ADC_SMPR2_SMP_AN13(n) ((uint32_t)(n) << 9)
#define ADC_SMPR2_SMP_AN14(n) ((uint32_t)(n) << 12)
#define ADC_SMPR2_SMP_AN15(n) ((uint32_t)(n) << 15)
#define ADC_SMPR2_SMP_AN16(n) ((uint32_t)(n) << 18)
#define ADC_SMPR2_SMP_AN17(n) ((uint32_t)(n) << 21)
#define ADC_SMPR2_SMP_AN18(n) ((uint32_t)(n) << 24)
#define ADC_SMPR2_SMP_AN19(n) ((uint32_t)(n) << 27)
#define ADC_SELMASK_IN0 1U
#define ADC_SELMASK_IN1 2U
#define ADC_SELMASK_IN2 4U
#define ADC_SELMASK_IN3 8U
#define ADC_SELMASK_IN4 16U
#define ADC_SELMASK_IN5 32U
#define ADC_SELMASK_IN6 64U
#define ADC_SELMASK_IN7 128U
#define ADC_SELMASK_IN8 256U
#define ADC_SELMASK_IN9 512U
#define ADC_SELMASK_IN10 1024U
#define ADC_SELMASK_IN11 2048U
#define ADC_SELMASK_IN12 4096U
#define ADC_SELMASK_IN13 8192U
#define ADC_SELMASK_IN14 16384U
#define ADC_SELMASK_IN15 32768U
#define ADC_SELMASK_IN16 65536U
#define ADC_SELMASK_IN17 131072U
#define ADC_SELMASK_IN18 262144U
#define ADC_SELMASK_IN19 524288U
#define ADC_SQR1_SQ1_N(n) ((uint32_t)(n) << 6)
#define ADC_SQR1_SQ2_N(n) ((uint32_t)(n) << 12)
#define ADC_SQR1_SQ3_N(n) ((uint32_t)(n) << 18)
#define ADC_SQR1_SQ4_N(n) ((uint32_t)(n) << 24)
#define ADC_SQR2_SQ5_N(n) ((uint32_t)(n) << 0)
#define ADC_SQR2_SQ6_N(n) ((uint32_t)(n) << 6)
#define ADC_SQR2_SQ7_N(n) ((uint32_t)(n) << 12)
#define ADC_SQR2_SQ8_N(n) ((uint32_t)(n) << 18)
#define ADC_SQR2_SQ9_N(n) ((uint32_t)(n) << 24)
#define ADC_SQR3_SQ10_N(n) ((uint32_t)(n) << 0)
#define ADC_SQR3_SQ11_N(n) ((uint32_t)(n) << 6)
#define ADC_SQR3_SQ12_N(n) ((uint32_t)(n) << 12)
#define ADC_SQR3_SQ13_N(n) ((uint32_t)(n) << 18)
#define ADC_SQR3_SQ14_N(n) ((uint32_t)(n) << 24)
#define ADC_SQR4_SQ15_N(n) ((uint32_t)(n) << 0)
#define ADC_SQR4_SQ16_N(n) ((uint32_t)(n) << 6)
#else
#define ADC_CFGR1_CONT 0x2000U
#define ADC_CFGR1_RES_12BIT 0U
#define ADC_TR(low, high) (((uint32_t)(high) << 16) | (uint32_t)(low))
#define ADC_TR_DISABLED 0U
#define ADC_TR1_DISABLED 0U
#define ADC_SMPR_SMP_1P5 0U
#define ADC_SMPR_SMP1_1P5 0U
#define ADC_SMPR_SMP2_1P5 (0U << 4)
#define ADC_SMPR_SMP_7P5 1U
#define ADC_SMPR_SMP1_7P5 1U
#define ADC_SMPR_SMP2_7P5 (1U << 4)
#define ADC_SMPR_SMP_13P5 2U
#define ADC_SMPR_SMP1_13P5 2U
#define ADC_SMPR_SMP2_13P5 (2U << 4)
#define ADC_SMPR_SMP_28P5 3U
#define ADC_SMPR_SMP1_28P5 3U
#define ADC_SMPR_SMP2_28P5 (3U << 4)
#define ADC_SMPR_SMP_41P5 4U
#define ADC_SMPR_SMP1_41P5 4U
#define ADC_SMPR_SMP2_41P5 (4U << 4)
#define ADC_SMPR_SMP_55P5 5U
#define ADC_SMPR_SMP1_55P5 5U
#define ADC_SMPR_SMP2_55P5 (5U << 4)
#define ADC_SMPR_SMP_71P5 6U
#define ADC_SMPR_SMP1_71P5 6U
#define ADC_SMPR_SMP2_71P5 (6U << 4)
#define ADC_SMPR_SMP_239P5 7U
#define ADC_SMPR_SMP1_239P5 7U
#define ADC_SMPR_SMP2_239P5 (7U << 4)
#define ADC_SMPR_SMP_3P5 0U
#define ADC_SMPR_SMP1_3P5 0U
#define ADC_SMPR_SMP2_3P5 (0U << 4)
#define ADC_SMPR_SMP_12P5 1U
#define ADC_SMPR_SMP1_12P5 1U
#define ADC_SMPR_SMP2_12P5 (1U << 4)
#define ADC_SMPR_SMP_19P5 2U
#define ADC_SMPR_SMP1_19P5 2U
#define ADC_SMPR_SMP2_19P5 (2U << 4)
#define ADC_SMPR_SMP_39P5 3U
#define ADC_SMPR_SMP1_39P5 3U
#define ADC_SMPR_SMP2_39P5 (3U << 4)
#define ADC_SMPR_SMP_79P5 4U
#define ADC_SMPR_SMP1_79P5 4U
#define ADC_SMPR_SMP2_79P5 (4U << 4)
#define ADC_SMPR_SMP_160P5 5U
#define ADC_SMPR_SMP1_160P5 5U
#define ADC_SMPR_SMP2_160P5 (5U << 4)
#define ADC_SMPR_SMPSEL0 (1U << 8)
#define ADC_CHSELR_CHSEL0 1U
#define ADC_SMPR_SMPSEL1 (2U << 8)
#define ADC_CHSELR_CHSEL1 2U
#define ADC_SMPR_SMPSEL2 (4U << 8)
#define ADC_CHSELR_CHSEL2 4U
#define ADC_SMPR_SMPSEL3 (8U << 8)
#define ADC_CHSELR_CHSEL3 8U
#define ADC_SMPR_SMPSEL4 (16U << 8)
#define ADC_CHSELR_CHSEL4 16U
#define ADC_SMPR_SMPSEL5 (32U << 8)
#define ADC_CHSELR_CHSEL5 32U
#define ADC_SMPR_SMPSEL6 (64U << 8)
#define ADC_CHSELR_CHSEL6 64U
#define ADC_SMPR_SMPSEL7 (128U << 8)
#define ADC_CHSELR_CHSEL7 128U
#define ADC_SMPR_SMPSEL8 (256U << 8)
#define ADC_CHSELR_CHSEL8 256U
#define ADC_SMPR_SMPSEL9 (512U << 8)
#define ADC_CHSELR_CHSEL9 512U
#define ADC_SMPR_SMPSEL10 (1024U << 8)
#define ADC_CHSELR_CHSEL10 1024U
#define ADC_SMPR_SMPSEL11 (2048U << 8)
#define ADC_CHSELR_CHSEL11 2048U
#define ADC_SMPR_SMPSEL12 (4096U << 8)
#define ADC_CHSELR_CHSEL12 4096U
#define ADC_SMPR_SMPSEL13 (8192U << 8)
#define ADC_CHSELR_CHSEL13 8192U
#define ADC_SMPR_SMPSEL14 (16384U << 8)
#define ADC_CHSELR_CHSEL14 16384U
#define ADC_SMPR_SMPSEL15 (32768U << 8)
#define ADC_CHSELR_CHSEL15 32768U
#define ADC_SMPR_SMPSEL16 (65536U << 8)
#define ADC_CHSELR_CHSEL16 65536U
#define ADC_SMPR_SMPSEL17 (131072U << 8)
#define ADC_CHSELR_CHSEL17 131072U
#define ADC_SMPR_SMPSEL18 (262144U << 8)
#define ADC_CHSELR_CHSEL18 262144U
#define ADC_SMPR_SMPSEL19 (524288U << 8)
#define ADC_CHSELR_CHSEL19 524288U
#define ADC_CHSELR_CHSEL_N(n) (1U << (n))
#endif

#endif
