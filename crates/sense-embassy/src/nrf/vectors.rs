//! The table of interrupts.

unsafe extern "C" {
    /// The program's table, which the start-up code names.
    static __vector_table: u32;
}

/// Takes the interrupts over from a boot loader, which would pass them on by way of its own table.
pub fn take() {
    // SAFETY: the registers belong to the program alone, and the table lasts as long as it does.
    unsafe {
        (*cortex_m::peripheral::SCB::PTR).vtor.write(&raw const __vector_table as u32);
    }
}
