//! Make and `CMake` in a folder with a name that they could misinterpret.

use std::path::Path;
use std::process::{Command, Output};

use sensedsl_tests::{TempDir, few, has, printed, text, tree};

use super::corpus::{OWNED, generate, words_design};

/// Make's functions and comments, and the shell's separators; without `:` and `=`, which no Make
/// supports in a path.
const FOLDER: &str = "a $(shell touch owned-by-injection) b #c;`touch owned-by-injection` & 'd' %";

/// `CMake` takes a `;` in a path as the end of a list item.
const FOLDER_OF_CMAKE: &str =
    "a $(shell touch owned-by-injection) b #c`touch owned-by-injection` & 'd' %";

fn is_owned(folder: &Path) -> bool {
    tree(folder).keys().any(|path| path.rsplit('/').next() == Some(OWNED))
}

/// A `ChibiOS` tree with only the files that Make includes before it builds anything.
fn empty_tree(scratch: &TempDir, makefile: &str) -> std::path::PathBuf {
    for line in makefile.lines() {
        let included = line.trim().strip_prefix("include $(CHIBIOS)/");
        if let Some(path) = included {
            scratch.write(&format!("tree/{path}"), "");
        }
    }
    let rules =
        makefile.lines().find_map(|line| line.strip_prefix("RULESPATH := $(CHIBIOS)/")).unwrap();
    scratch.write(&format!("tree/{rules}/arm-none-eabi.mk"), "");
    scratch.write(&format!("tree/{rules}/rules.mk"), "all:\n\techo $(CSRC) $(UDEFS)\n");
    let configuration =
        makefile.lines().find_map(|line| line.strip_prefix("BASE_CFG := $(CHIBIOS)/")).unwrap();
    scratch.write(&format!("tree/{configuration}/mcuconf.h"), "");
    scratch.join("tree")
}

#[test]
fn make_takes_a_folder_of_any_name() {
    if !has("make") {
        return;
    }
    let scratch = TempDir::new("make");
    let source = scratch.write("fig2.sense", text("examples/fig2.sense"));
    let output = scratch.join(FOLDER);
    let next = generate(&source, &output);
    let board = output.join("firmware/STM32F4DiscoveryBoard");
    let chibios = empty_tree(&scratch, &sensedsl_tests::read(&board.join("Makefile")));
    let variable = format!("CHIBIOS={}", chibios.display());
    let sources =
        printed(Command::new("make").arg("-C").arg(&board).args(["-n", "all"]).arg(&variable));
    assert!(
        sources.contains("generated/sense_hw.c") && sources.contains("user/user.c"),
        "{sources}"
    );
    // The line that `generate` suggests typing next must be valid for a shell.
    let typed = next.lines().find_map(|line| line.strip_prefix("next: sensedsl build ")).unwrap();
    let typed = format!("printf '%s\\n' {typed}");
    let log = printed(Command::new("sh").arg("-c").arg(typed).current_dir(scratch.path()));
    let words: Vec<&str> = log.lines().collect();
    assert_eq!(words, [output.to_str().unwrap(), "--chibios", "/path/to/ChibiOS"]);
    assert!(!is_owned(scratch.path()));
}

/// The output of `CMake` for a host's folder in `output`; it builds in a scratch folder.
fn configured(output: &Path, host: &str, scratch: &TempDir) -> Output {
    let mut command = Command::new("cmake");
    command.arg("-S").arg(output.join("host").join(host));
    command.arg("-B").arg(scratch.join(&format!("build-{host}")));
    command.output().unwrap()
}

#[test]
fn cmake_takes_a_folder_of_any_name_and_words_as_names() {
    if !has("cmake") || !has("g++") {
        return;
    }
    let scratch = TempDir::new("cmake");
    let source = scratch.write("words.sense", words_design());
    let output = scratch.join(FOLDER_OF_CMAKE);
    let _ = generate(&source, &output);
    let output = configured(&output, "cpp", &scratch);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(!is_owned(scratch.path()));
}

#[test]
fn a_folder_that_cmake_cannot_take_is_told() {
    if !has("cmake") || !has("g++") {
        return;
    }
    let scratch = TempDir::new("semicolon");
    let source = scratch.write("words.sense", words_design());
    let output = scratch.join("a;b");
    let _ = generate(&source, &output);
    for host in ["cpp", "libcluon", "opendavinci", "opendavinci2014"] {
        let output = configured(&output, host, &scratch);
        let log = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success() && log.contains("has a semicolon"), "{host}: {log}");
    }
}

#[test]
fn a_file_of_any_name_is_a_design() {
    if !has("cmake") || !has("g++") {
        return;
    }
    let names =
        [FOLDER_OF_CMAKE, "-rf", "\u{202e}gnp", FOLDER, "a;b", "\"q\" \\n", "class", "7up", "ä 机"];
    for (number, name) in few(&names, 1).iter().enumerate() {
        let scratch = TempDir::new(&format!("named{number}"));
        let source = scratch.write(&format!("{name}.sense"), words_design());
        let output = scratch.join("out");
        let _ = generate(&source, &output);
        let output = configured(&output, "cpp", &scratch);
        assert!(output.status.success(), "{name:?}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(!is_owned(scratch.path()));
    }
}
