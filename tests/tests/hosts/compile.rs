//! Every host of every design, compiled with all warnings as errors.

use std::path::Path;
use std::process::Command;

use sensedsl_generate::host::{self, HOSTS};
use sensedsl_job::host::{Compile, HostPlan};
use sensedsl_tests::{few, has, is_exhaustive, is_thorough, run};

use super::{designs, files};

/// Compiles all sources of a generated host with the options that the host states.
pub(crate) fn compile(compiler: &Compile, folder: &Path, system_includes: &[&Path]) {
    for source in files::sources(folder, compiler.extension) {
        let mut command = Command::new(compiler.program);
        command.current_dir(folder).args(compiler.arguments);
        if !compiler.standard.is_empty() {
            command.arg(compiler.standard);
        }
        for include in system_includes {
            command.arg("-isystem").arg(include);
        }
        run(command.arg(source));
    }
}

/// Hosts that include a middleware are compiled in `middleware.rs`, if its tree is available.
#[test]
fn every_host_is_of_its_language() {
    for host in HOSTS {
        let compiler = host.compile();
        if compiler.tree.is_some() || !has(compiler.program) {
            continue;
        }
        for (name, boards) in few(&designs::all(), 1) {
            let folder = files::generate(host.name(), &format!("{name}-language"), boards);
            compile(&compiler, &folder, &[]);
        }
    }
}

#[test]
fn cpp_is_of_other_compilers_and_standards() {
    let host = host::find("cpp").unwrap().compile();
    let others = [("clang++", "-std=c++17"), ("clang++", "-std=c++20"), ("g++", "-std=c++20")];
    for (program, standard) in others {
        if !is_exhaustive() || !has(program) {
            continue;
        }
        for (name, boards) in designs::all() {
            let folder = files::generate("cpp", &format!("{name}-{program}"), &boards);
            compile(&Compile { program, standard, ..host }, &folder, &[]);
        }
    }
}

#[test]
fn cmake_builds_cpp() {
    if !is_thorough() || !has("cmake") || !has("g++") {
        return;
    }
    let folder = files::generate("cpp", "cmake", &designs::several_boards());
    let build = folder.join("build");
    run(Command::new("cmake").arg("-S").arg(&folder).arg("-B").arg(&build));
    run(Command::new("cmake").arg("--build").arg(&build));
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

#[test]
fn every_host_has_a_readme_and_a_name_of_its_own() {
    let names: std::collections::BTreeSet<&str> = HOSTS.iter().map(|host| host.name()).collect();
    assert_eq!(names.len(), HOSTS.len(), "{names:?}");
    for host in HOSTS {
        let files = host.render(&HostPlan::new("robot", &designs::several_boards()));
        assert!(files.get("README.md").is_some(), "{} has no README.md", host.name());
    }
}
