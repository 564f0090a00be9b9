//! The registry: one file per code, one line here.
//!
//! A code is never used for something else, even after its diagnostic has been removed.

use std::fmt;

use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Span;

macro_rules! codes {
    ($($module:ident,)*) => {
        $(pub mod $module;)*
        /// All codes in order.
        pub const ALL: &[Code] = &[$($module::CODE),*];
    };
}

codes! {
    e0101_unexpected_token,
    e0102_unknown_character,
    e0103_unterminated,
    e0104_missing_semicolon,
    e0105_missing_closing,
    e0106_bad_number,
    e0107_misspelled_keyword,
    e0108_nested_too_deep,
    e0109_bad_string,
    e0110_misplaced_item,
    e0111_file_unreadable,
    e0112_file_too_large,
    e0116_too_many_tokens,
    e0117_more_mistakes,
    e0118_not_a_file,
    e0201_unknown_property,
    e0202_property_twice,
    e0203_duplicate_identifier,
    e0204_duplicate_name,
    e0205_clashing_names,
    e0206_missing_property,
    e0207_unknown_kind,
    e0208_unknown_type,
    e0209_wrong_value,
    e0210_wrong_unit,
    e0211_out_of_range,
    e0212_unknown_word,
    e0213_property_of_other_kind,
    e0214_wrong_direction,
    e0215_bad_address,
    e0216_unknown_driver,
    e0217_driver_of_other_kind,
    e0218_used_file_missing,
    e0219_use_cycle,
    e0220_impossible_type,
    e0221_identifier_reserved,
    e0222_contradiction,
    e0223_outside_folder,
    e0224_too_many_used,
    e0225_too_many_items,
    e0226_not_an_answer,
    e0227_cannot_compute,
    e0228_constants_in_a_circle,
    e0229_wrong_driver,
    e0230_unknown_reading,
    e0231_no_identifier_left,
    e0232_address_of_part,
    e0233_clock_over_part,
    e0234_value_does_not_fit,
    e0235_analog_over_supply,
    e0236_bound_out_of_reach,
    e0237_overlap_in_frame,
    e0238_frame_clash,
    e0239_outside_frame,
    e0240_overlap_in_register,
    e0241_asked_too_often,
    e0242_same_rom,
    e0243_one_address,
    e0244_asked_and_listened,
    e0245_other_encoding,
    e0250_not_of_controller,
    e0251_two_owners,
    e0252_unknown_in_test,
    e0253_not_comparable,
    e0254_time_of_test,
    e0255_test_without_rules,
    e0256_not_a_condition,
    e0257_not_set_by_host,
    e0258_fault_of_test,
    e0301_unknown_board,
    e0302_table_unreadable,
    e0303_table_empty,
    e0304_table_pin_twice,
    e0305_table_pin_name,
    e0306_table_signal,
    e0307_table_ragged_row,
    e0308_table_column_twice,
    e0309_table_usage_twice,
    e0310_unknown_pin,
    e0311_unknown_unit,
    e0312_unknown_place,
    e0313_unknown_target,
    e0314_pin_cannot_serve,
    e0315_no_board,
    e0316_pin_not_available,
    e0317_table_too_large,
    e0318_several_pins,
    e0320_silicon_cannot,
    e0321_too_much_voltage,
    e0322_array_too_long,
    e0401_no_wiring,
    e0402_solver_disagrees,
    e0403_no_certificate,
    e0404_out_of_time,
    e0405_too_many_moves,
    e0501_no_generator,
    e0502_foreign_files,
    e0503_out_of_date,
    e0504_no_firmware_target,
    e0505_unknown_host,
    e0506_hardware_limit,
    e0507_folder_busy,
    e0508_file_exists,
    e0509_not_written,
    e0510_unfinished,
    e0511_unknown_port,
    e0512_no_tree,
    e0513_not_a_tree,
    e0514_other_tree,
    e0515_tree_incomplete,
    e0516_tool_missing,
    e0517_compiler_too_old,
    e0518_no_probe,
    e0519_which_board,
    e0520_no_firmware_here,
    e0521_build_failed,
    e0522_not_flashed,
    e0523_no_core_library,
    e0524_through_a_link,
    e0525_not_our_work,
    e0526_unproved_files,
    e0527_other_drive,
    e0528_several_drives,
    e0529_no_wokwi_board,
    e0530_wiring_not_of_the_chip,
    e0531_no_cargo,
    e0532_typecheck_stopped,
    e0533_typecheck_not_known,
    e0534_no_user_code,
    e0535_user_code_not_built,
    e0536_user_code_stopped,
    e0537_no_tests,
    e0538_test_failed,
    e0539_board_of_test,
    e0540_world_unreadable,
    e0541_world_unknown,
    e0542_world_value,
    e0543_world_time,
    e0544_world_fault,
    e0545_world_samples,
    e0546_image_refused,
    e0547_no_machine,
    e0548_locked_up,
    e0549_judged_wrong,
    e0550_pad_not_as_planned,
    e0551_world_too_large,
    e0552_command_not_done,
    e0553_no_watchdog,
    e0554_world_too_fast,
    e0555_identity_not_asked,
    e0556_not_a_schema,
    e0557_no_board,
    e0558_other_firmware,
    e0560_sinks_unreadable,
    e0561_sinks_unknown,
    e0562_sinks_address,
    e0563_sink_not_built,
    e0564_sinks_same_topic,
    e0565_not_a_record,
    e0566_no_new_record,
    e0567_program_not_reached,
    e0568_recorded_otherwise,
    e0570_measured_twice,
    e0571_not_for_this_plant,
    e0572_not_a_map,
    e0573_process_failed,
    e0574_does_not_fit,
    w0601_unused_property,
    w0602_slower_than_asked,
    w0603_narrow_type,
    w0604_unused_rule,
    w0605_onboard_part,
    w0606_table_oddity,
    w0607_part_not_certain,
    w0608_usages_unknown,
    w0609_one_address_on_two_buses,
    w0610_level_not_known,
    w0611_narrow_command,
    w0612_shown_not_raw,
    w0613_level_over_part,
    w0614_several_repeated,
    w0615_no_firmware,
    w0616_driven_over_part,
    w0617_not_in_wokwi,
    e0620_clock_out_of_reach,
    e0621_too_often,
    e0622_link_too_slow,
    w0623_nearly_busy,
    e0624_no_turns,
    w0625_no_turns_by_default,
    e0626_memory_full,
    e0627_too_many_steps,
    w0628_locked_too_long,
    w0629_read_faster_than_measured,
    e0630_step_too_long,
    h0701_eight_bit_address,
    h0702_target_none,
    h0703_default_protocol,
    h0704_printed_elsewhere,
    h0707_of_ten_thousand,
    h0708_drivers_alone,
    h0709_other_spelling,
    h0710_motor_goes_on,
    e0801_import_unreadable,
    e0802_import_no_table,
    e0803_import_no_sheet,
    w0804_import_dropped,
    w0805_import_doubtful,
    h0806_import_open,
    e0807_import_too_large,
    e0808_too_many_includes,
    e0809_include_unreadable,
    e0810_dbc_line,
    e0811_dbc_no_node,
}

/// The registry entry of a code.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CodeInfo {
    /// A letter for the severity and four digits.
    pub code: &'static str,
    /// A line without a full stop.
    pub title: &'static str,
    /// The long text of `sensedsl explain`, without its last line break.
    pub explanation: &'static str,
}

/// A stable code.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Code(&'static CodeInfo);

impl Code {
    /// The registry entry.
    #[must_use]
    pub const fn info(self) -> &'static CodeInfo {
        self.0
    }

    /// The code as written: `E0203`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.0.code
    }

    /// The severity of its diagnostics, which is the name's letter.
    #[must_use]
    pub fn severity(self) -> Severity {
        match self.name().as_bytes().first() {
            Some(b'W') => Severity::Warning,
            Some(b'H') => Severity::Hint,
            _ => Severity::Error,
        }
    }

    /// The code with this name, in upper or lower case.
    #[must_use]
    pub fn find(name: &str) -> Option<Self> {
        ALL.iter().copied().find(|code| code.name().eq_ignore_ascii_case(name))
    }
}

impl fmt::Debug for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_in_order_and_explained() {
        let mut names: Vec<_> = ALL.iter().map(|code| code.name()[1..].to_string()).collect();
        let given = names.clone();
        names.sort();
        names.dedup();
        assert_eq!(names, given, "codes are unique and stand in order");
        for code in ALL {
            let info = code.info();
            assert!(info.explanation.contains("Way out:"), "{code} gives no way out");
            assert!(!info.title.ends_with('.') && !info.explanation.ends_with('\n'), "{code}");
            assert!(info.code.starts_with(['E', 'W', 'H']), "{code}");
        }
    }
}
