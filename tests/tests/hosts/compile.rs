//! Every host of every design, compiled with all warnings as errors.

use std::path::Path;
use std::process::Command;

use sensedsl_codegen::host::{HOSTS, HostPlan};
use sensedsl_tests::few;

use super::{designs, files, tools};

const WARNINGS: [&str; 6] =
    ["-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"];

/// Compiles all sources of a generated host without linking.
pub(crate) fn compile(compiler: &str, standard: &str, folder: &Path, system_includes: &[&Path]) {
    for source in files::sources(folder) {
        let mut command = Command::new(compiler);
        command.arg(format!("-std={standard}")).args(WARNINGS).arg("-fsyntax-only");
        command.arg("-I").arg(folder.join("include"));
        for include in system_includes {
            command.arg("-isystem").arg(include);
        }
        tools::run(command.arg(source));
    }
}

#[test]
fn cpp() {
    for compiler in few(&["g++", "clang++"], 1) {
        if !tools::have(compiler) {
            continue;
        }
        for (name, boards) in designs::all() {
            let folder = files::generate("cpp", &format!("{name}-{compiler}"), &boards);
            for standard in few(&["c++17", "c++20"], 1) {
                compile(compiler, standard, &folder, &[]);
            }
        }
    }
}

#[test]
fn cmake_builds_cpp() {
    if !tools::have("cmake") || !tools::have("g++") {
        return;
    }
    let folder = files::generate("cpp", "cmake", &designs::several_boards());
    let build = folder.join("build");
    tools::run(Command::new("cmake").arg("-S").arg(&folder).arg("-B").arg(&build));
    tools::run(Command::new("cmake").arg("--build").arg(&build));
    assert!(build.join("monitor_Front").exists() && build.join("monitor_Spare").exists());
}

#[test]
fn two_runs_print_the_same_bytes() {
    for (name, boards) in designs::all() {
        for host in HOSTS {
            let render = || host.render(&HostPlan::new("robot", &boards));
            assert_eq!(render(), render(), "{name} {}", host.name());
        }
    }
}

#[test]
fn nothing_leaves_its_comment_or_its_line() {
    for host in HOSTS {
        for (path, entry) in host.render(&HostPlan::new("robot", &designs::hostile())).iter() {
            let text = String::from_utf8(entry.bytes.clone()).unwrap();
            for line in text.lines() {
                assert!(!line.starts_with("int y;"), "{path}: {line}");
                assert!(
                    !line.trim_start().starts_with("//") || !line.ends_with('\\'),
                    "{path}: {line}"
                );
            }
        }
    }
}
