//! The hand-written runtime that every board has, copied beside what is generated. What is a driver's is in its folder.

/// Path below `uproxy/` and text.
pub(super) const FILES: &[(&str, &str)] = &[
    ("core/up_convert.c", include_str!("../../../../../runtime/core/up_convert.c")),
    ("core/up_convert.h", include_str!("../../../../../runtime/core/up_convert.h")),
    ("core/up_decode.c", include_str!("../../../../../runtime/core/up_decode.c")),
    ("core/up_decode.h", include_str!("../../../../../runtime/core/up_decode.h")),
    ("core/up_encode.c", include_str!("../../../../../runtime/core/up_encode.c")),
    ("core/up_encode.h", include_str!("../../../../../runtime/core/up_encode.h")),
    ("core/up_memo.c", include_str!("../../../../../runtime/core/up_memo.c")),
    ("core/up_memo.h", include_str!("../../../../../runtime/core/up_memo.h")),
    ("core/up_report.c", include_str!("../../../../../runtime/core/up_report.c")),
    ("core/up_report.h", include_str!("../../../../../runtime/core/up_report.h")),
    ("core/up_schema.c", include_str!("../../../../../runtime/core/up_schema.c")),
    ("core/up_schema.h", include_str!("../../../../../runtime/core/up_schema.h")),
    ("core/up_text.c", include_str!("../../../../../runtime/core/up_text.c")),
    ("core/up_text.h", include_str!("../../../../../runtime/core/up_text.h")),
    ("chibios/up_link.c", include_str!("../../../../../runtime/chibios/up_link.c")),
    ("chibios/up_link.h", include_str!("../../../../../runtime/chibios/up_link.h")),
    ("chibios/up_link_serial.c", include_str!("../../../../../runtime/chibios/up_link_serial.c")),
    ("chibios/up_link_usb.c", include_str!("../../../../../runtime/chibios/up_link_usb.c")),
    ("chibios/up_rt.c", include_str!("../../../../../runtime/chibios/up_rt.c")),
    ("chibios/up_rt.h", include_str!("../../../../../runtime/chibios/up_rt.h")),
    ("chibios/up_shell.c", include_str!("../../../../../runtime/chibios/up_shell.c")),
    ("chibios/up_shell.h", include_str!("../../../../../runtime/chibios/up_shell.h")),
    ("chibios/uproxy.mk", include_str!("../../../../../runtime/chibios/uproxy.mk")),
];
