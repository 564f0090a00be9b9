//! Names that lead to something other than a file of the project.

use std::os::unix::fs::symlink;

use rustix::fs::{CWD, FileType, Mode, mknodat};
use sensedsl_tests::{TempDir, is_thorough};

use super::{expect, expect_alone, repeat, sparse};

/// A pipe to which nobody writes.
fn pipe(folder: &TempDir, name: &str) {
    mknodat(CWD, folder.join(name), FileType::Fifo, Mode::RWXU, 0).unwrap();
}

fn board(table: &str) -> String {
    format!("board B on \"{table}\" {{ sensor A returns uint16 {{ id = 1; type = analog; }} }}\n")
}

#[test]
fn what_is_not_a_file_is_not_waited_for() {
    let folder = TempDir::new("limits");
    pipe(&folder, "p.sense");
    pipe(&folder, "p.csv");
    expect(&folder, &["check", "p.sense"], 2, "E0111");
    expect(&folder, &["import", "p.csv"], 2, "E0111");
    expect(&folder, &["check", "/dev/zero"], 2, "E0111");
    expect(&folder, &["import", "/dev/zero"], 2, "E0111");
    expect(&folder, &["check", "/proc/self/mem"], 2, "E0111");
    expect(&folder, &["check", "."], 2, "E0111");
    folder.write("use.sense", "use \"p.sense\";\n");
    expect(&folder, &["check", "use.sense"], 1, "E0118");
    folder.write("table.sense", board("p.csv"));
    expect(&folder, &["check", "table.sense"], 1, "E0118");
    folder.write("zero.sense", "use \"/dev/zero\";\n");
    expect(&folder, &["check", "--allow-outside", "/dev", "zero.sense"], 1, "E0118");
}

#[test]
fn nothing_outside_of_the_project_is_read() {
    let folder = TempDir::new("limits");
    folder.write("outer.sense", "driver x for analog { delay = 1 s; }\n");
    folder.write("project/up.sense", "use \"../outer.sense\";\n");
    folder.write("project/absolute.sense", "use \"/etc/passwd\";\n");
    folder.write("project/linked.sense", "use \"link.sense\";\n");
    folder.write("project/table.sense", board("/etc/passwd"));
    symlink("../outer.sense", folder.join("project/link.sense")).unwrap();
    for name in ["up", "absolute", "linked", "table"] {
        expect(&folder, &["check", &format!("project/{name}.sense")], 1, "E0223");
    }
}

#[test]
fn files_that_use_each_other_end() {
    let folder = TempDir::new("limits");
    // The last of these numbers of files once overflowed the stack.
    for at in 0..if is_thorough() { 16_000 } else { 1_100 } {
        folder.write(&format!("c{at}.sense"), format!("use \"c{}.sense\";\n", at + 1));
    }
    expect_alone(&folder, &["check", "c0.sense"], "E0224");
    for at in 0..1_100 {
        folder.write(&format!("m{at}.sense"), "\n");
    }
    folder.write("many.sense", repeat(1_100, |at| format!("use \"m{at}.sense\";\n")));
    expect_alone(&folder, &["check", "many.sense"], "E0224");
}

#[test]
fn large_files_are_not_read() {
    let folder = TempDir::new("limits");
    sparse(&folder, "large.sense", 60_000_000);
    expect(&folder, &["check", "large.sense"], 1, "E0112");
    sparse(&folder, "large.csv", 80_000_000);
    folder.write("table.sense", board("large.csv"));
    expect(&folder, &["check", "table.sense"], 1, "E0112");
}
