//! The conversion group of each version of the driver.

use sensedsl_board::profile::Cycles;
use sensedsl_board::signal::UnitName;

use super::group::{Group, Input};
use super::{f1, v1, v2, v3, v4, v5};
use sensedsl_firmware_c::DmaBuffer;
use sensedsl_job::Cycle;

/// Channels with sampling times, as a group converts them.
fn group(inputs: &[(u8, u32)]) -> Group {
    let input = |&(channel, cycles): &(u8, u32)| Input {
        place: format!("IN{channel}"),
        fields: vec![0],
        element: 0,
        samples: 3,
        channel,
        cycles: Cycles::new(cycles),
    };
    Group {
        unit: UnitName::new("ADC1"),
        driver: "ADCD1".to_owned(),
        cycle: Cycle { delay_ms: 60, prio: 0, start_ms: 0 },
        buffer: DmaBuffer::Main,
        inputs: inputs.iter().map(input).collect(),
        timeout_ms: 3,
    }
}

fn assert_all(text: &str, expected: &[&str]) {
    assert!(text.starts_with("static const ADCConversionGroup adc1_60ms_group = {\n"), "{text}");
    assert!(text.contains("    .circular = FALSE,\n"), "{text}");
    assert!(text.contains("    .error_cb = up_adc_on_error,\n"), "{text}");
    for one in expected {
        assert!(text.contains(one), "{one} is missing in\n{text}");
    }
}

#[test]
fn a_group_has_an_even_number_of_rows() {
    assert_eq!(group(&[(1, 3)]).depth(), 4);
}

/// Seven inputs need two registers, and the sampling times from channel 10 on are in the other one.
const SEVEN: &[(u8, u32)] = &[(0, 84), (1, 84), (2, 84), (3, 84), (4, 84), (5, 84), (11, 480)];

#[test]
fn the_sequence_of_f4_and_f1() {
    let common = [
        "    .num_channels = 7U,\n",
        "    .smpr1 = ADC_SMPR1_SMP_AN11(ADC_SAMPLE_480),\n",
        "    .smpr2 = ADC_SMPR2_SMP_AN0(ADC_SAMPLE_84) |\n             ADC_SMPR2_SMP_AN1(",
        "    .sqr1 = ADC_SQR1_NUM_CH(7U),\n",
        "    .sqr2 = ADC_SQR2_SQ7_N(ADC_CHANNEL_IN11),\n",
        "    .sqr3 = ADC_SQR3_SQ1_N(ADC_CHANNEL_IN0) |\n             ADC_SQR3_SQ2_N(",
        "ADC_SQR3_SQ6_N(ADC_CHANNEL_IN5),\n",
    ];
    let (f4, f1) = (v2::text(&group(SEVEN)), f1::text(&group(SEVEN)));
    assert_all(&f4, &common);
    assert_all(&f1, &common);
    assert!(f4.contains("    .cr2 = ADC_CR2_SWSTART,\n"), "{f4}");
    assert!(f1.contains("    .cr2 = ADC_CR2_EXTSEL_SWSTART,\n"), "{f1}");
}

#[test]
fn sixteen_inputs_fill_all_registers() {
    let all: Vec<(u8, u32)> = (0..16).map(|channel| (channel, 3)).collect();
    let text = v2::text(&group(&all));
    for place in 1..=16 {
        assert_eq!(text.matches(&format!("_SQ{place}_N(ADC_CHANNEL_IN{})", place - 1)).count(), 1);
    }
    let text = v3::text(&group(&all));
    for (register, place) in [(1, 4), (2, 5), (2, 9), (3, 10), (3, 14), (4, 15), (4, 16)] {
        let term = format!("ADC_SQR{register}_SQ{place}_N(ADC_CHANNEL_IN{})", place - 1);
        assert!(text.contains(&term), "{term} is missing in\n{text}");
    }
}

#[test]
fn the_sequence_of_l4() {
    let text = v3::text(&group(&[(9, 92), (10, 92)]));
    let smpr = "    .smpr = {\n        ADC_SMPR1_SMP_AN9(ADC_SMPR_SMP_92),\n        \
                ADC_SMPR2_SMP_AN10(ADC_SMPR_SMP_92),\n    },\n";
    let sqr = "    .sqr = {\n        ADC_SQR1_SQ1_N(ADC_CHANNEL_IN9) |\n            \
               ADC_SQR1_SQ2_N(ADC_CHANNEL_IN10),\n        0U,\n        0U,\n        0U,\n    },\n";
    assert_all(&text, &["    .cfgr = ADC_CFGR_CONT,\n", smpr, sqr]);
}

/// An input that is not preselected measures nothing.
#[test]
fn h7_selects_its_inputs() {
    let text = v4::text(&group(&[(2, 64), (19, 64)]));
    let select = "    .pcsel = ADC_SELMASK_IN2 |\n             ADC_SELMASK_IN19,\n";
    let smpr = "ADC_SMPR2_SMP_AN19(ADC_SMPR_SMP_64)";
    assert_all(&text, &[select, smpr, "ADC_CFGR_CONT_ENABLED | ADC_CFGR_RES_16BITS"]);
}

/// One sampling time for all: the longest requested one.
#[test]
fn f0_has_one_sampling_time() {
    let text = v1::text(&group(&[(1, 7), (8, 71)]));
    let select = "    .chselr = ADC_CHSELR_CHSEL1 |\n             ADC_CHSELR_CHSEL8,\n";
    assert_all(&text, &["    .smpr = ADC_SMPR_SMP_71,\n", select, "ADC_CFGR1_CONT"]);
}

/// Two sampling times: none is shorter than requested.
#[test]
fn g0_has_two_sampling_times() {
    let text = v5::text(&group(&[(1, 7), (8, 39), (17, 79)]));
    let smpr = "    .smpr = ADC_SMPR_SMP1_7 |\n             ADC_SMPR_SMP2_79 |\n             \
                ADC_SMPR_SMPSEL8 |\n             ADC_SMPR_SMPSEL17,\n";
    assert_all(&text, &[smpr, "ADC_CHSELR_CHSEL_N(17U)"]);
    let alike = v5::text(&group(&[(1, 39), (2, 39)]));
    assert!(alike.contains("    .smpr = ADC_SMPR_SMP1_39,\n"), "{alike}");
}
