//! C and C++ compilers read the generated files, with every warning on and trigraphs enabled.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_diagnostics::{is_hidden, visible};
use sensedsl_tests::{TempDir, few, has, is_thorough, root, tree};

use super::corpus::{projects, words};

fn run(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let log = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && log.is_empty(), "{command:?}\n{log}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// Compiles the firmware's model, which has all names; the rest of the firmware needs a `ChibiOS`
/// tree.
fn compile_model(compiler: &str, board: &Path) {
    let mut command = Command::new(compiler);
    command.args([
        "-std=c99",
        "-Wall",
        "-Wextra",
        "-Wpedantic",
        "-Werror",
        "-trigraphs",
        "-fsyntax-only",
    ]);
    command.arg(format!("-I{}", root().join("crates/firmware-c/runtime").display()));
    run(command.arg(board.join("generated/sense_model.c")));
}

/// Compiles the headers of the host without middleware, which have all names and texts; its
/// programs are the same for all designs, except for the types that they name.
fn compile_host(compiler: &str, host: &Path) {
    let include = host.join("include");
    let scratch = TempDir::new("headers");
    let headers = tree(&include).into_keys().filter(|path| path.starts_with("sense/"));
    let source: String = headers.map(|path| format!("#include \"{path}\"\n")).collect();
    let source = scratch.write("all.cpp", source + "int main() { return 0; }\n");
    let mut command = Command::new(compiler);
    command.args(["-std=c++17", "-Wall", "-Wextra", "-Werror", "-trigraphs", "-fsyntax-only"]);
    run(command.arg("-I").arg(include).arg(source));
}

fn boards(output: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(output.join("firmware")).unwrap();
    entries.map(|entry| entry.unwrap().path()).collect()
}

#[test]
fn names_that_are_words_of_c_compile() {
    for compiler in ["gcc", "clang", "arm-none-eabi-gcc"] {
        if has(compiler) {
            boards(words()).iter().for_each(|board| compile_model(compiler, board));
        }
    }
}

#[test]
fn names_that_are_words_of_cpp_compile() {
    if !is_thorough() {
        return;
    }
    for compiler in few(&["g++", "clang++"], 1) {
        if has(compiler) {
            compile_host(compiler, &words().join("host/cpp"));
        }
    }
}

#[test]
fn hostile_labels_and_quantities_compile_in_cpp() {
    for compiler in few(&["g++", "clang++"], 1) {
        if has(compiler) {
            few(projects(), 1)
                .iter()
                .for_each(|project| compile_host(compiler, &project.output.join("host/cpp")));
        }
    }
}

/// A program that uses the generated library prints the texts of the design, with hidden characters
/// as codes.
#[test]
fn a_program_prints_a_hostile_quantity_as_it_is() {
    if !has("g++") {
        return;
    }
    let project = &projects()[0];
    let scratch = TempDir::new("quantities");
    let include = project.output.join("host/cpp/include");
    let header = tree(&include).into_keys().find(|path| path.ends_with("/Robot.hpp")).unwrap();
    let namespace = header.rsplit_once('/').unwrap().0.replace('/', "::");
    let mut source = format!("#include \"{header}\"\n#include <cstdio>\nint main() {{\n");
    for id in 1..=project.texts.len() {
        source.push_str(&format!("    std::puts({namespace}::S{id}::quantity);\n"));
    }
    let source = scratch.write("main.cpp", source + "}\n");
    let program = scratch.join("program");
    let mut command = Command::new("g++");
    command.args(["-std=c++17", "-I"]).arg(include);
    run(command.arg(source).arg("-o").arg(&program));
    let log = run(&mut Command::new(program));
    let expected = project.texts.iter().map(|text| visible(text) + "\n");
    assert_eq!(log, expected.collect::<String>());
}

/// No generated file has a character that reverses text, colours a terminal or is invisible.
#[test]
fn no_generated_file_has_a_hidden_character() {
    for project in projects() {
        let mut count = 0;
        for (path, bytes) in tree(&project.output) {
            let text = String::from_utf8(bytes).unwrap();
            let hidden = text.chars().find(|&c| is_hidden(c) && !matches!(c, '\n' | '\t'));
            assert_eq!(hidden, None, "{path}");
            count += 1;
        }
        assert!(count > 40, "{count} files");
    }
}
