//! E0527: the drive is not that of the board.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0527",
    title: "the drive is not that of the board",
    explanation: r#"`flash` copies a program to the drive of a board: that of the boot loader of an RP2040 or RP2350, which has a file
INFO_UF2.TXT with the chip, or that of an ST-LINK, which is named after the MCU (`NODE_F401RE`). The drive that was
found, or that `--drive` names, is that of another chip, or of none. The program was not copied: another chip would not
run it.

Way out: plug in the board that the design names and start its boot loader, or change the board in the design. With
`--drive`, name the folder at which the drive of the board is mounted."#,
});

/// `drive` has its folder and its owner, `board` its name and its chip, both with an article.
pub fn other_drive(span: Span, drive: (&str, &str), board: (&str, &str)) -> Diagnostic {
    let ((folder, owner), (board, chip)) = (drive, board);
    let message = format!("the drive at {folder} is that of {owner}, and {board} has {chip}");
    Diagnostic::new(CODE, span, message)
        .help(format!("plug in a board with {chip}, or name the board that you have in the design"))
}

/// What is at `folder` takes no programs.
pub fn no_drive(span: Span, folder: &str) -> Diagnostic {
    let message = format!("{folder} is not a drive that takes programs");
    Diagnostic::new(CODE, span, message).help(
        "name the folder that has the file INFO_UF2.TXT of a boot loader, or MBED.HTM and DETAILS.TXT of an ST-LINK",
    )
}
