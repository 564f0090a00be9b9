//! The shared files of the C++ hosts, function by function, and the output of their command lines.

use std::path::Path;
use std::process::Command;

use sensedsl_tests::{few, has, is_thorough, printed, run};

use super::link::{Application, design, scenes};
use super::tools::Background;
use super::{files, terminal};

#[test]
fn shared_files_do_what_they_say() {
    if !is_thorough() {
        return;
    }
    for (compiler, standard) in few(&[("g++", "c++98"), ("clang++", "c++17")], 1) {
        if !has(compiler) {
            continue;
        }
        let folder = files::generate("cpp", &format!("units-{compiler}"), &design());
        let program = folder.join("units");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("hosts/units.cpp");
        let mut command = Command::new(compiler);
        command.arg(format!("-std={standard}")).args([
            "-Wall",
            "-Wextra",
            "-Wconversion",
            "-Werror",
        ]);
        command.args(["-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-pthread"]);
        command.arg("-I").arg(folder.join("include")).arg(source).arg("-o").arg(&program);
        run(&mut command);
        let empty = files::folder(&format!("units-{compiler}-empty"));
        assert_eq!(printed(Command::new(program).arg(empty)), "ok\n");
    }
}

#[test]
fn cpp_comes_back() {
    let Some((folder, program)) = terminal::build("link", &design(), "STM32F4DiscoveryBoard")
    else {
        return;
    };
    let start = |device: &Path| Background::start(Command::new(&program).arg(device), &folder);
    scenes(&Application { name: "cpp", program: "monitor_STM32F4DiscoveryBoard", start: &start });
}

#[test]
fn wrong_calls_are_told_apart_from_wrong_boards() {
    let Some((_, program)) = terminal::build("calls", &design(), "STM32F4DiscoveryBoard") else {
        return;
    };
    let call = |arguments: &[&str]| {
        let output = Command::new(&program).args(arguments).output().unwrap();
        let text =
            String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
        (output.status.code().unwrap(), text.into_owned())
    };
    for (arguments, status, text) in [
        (&["--help"][..], 0, "usage: "),
        (&["--version"], 0, "schema 0xb2d2a70b"),
        (&[], 2, "which device?"),
        (&["--nope", "x"], 2, "unknown option --nope"),
        (&["--baud=fast", "x"], 2, "no baud rate: fast"),
        (&["/dev/ttyNONE"], 2, "cannot open /dev/ttyNONE: there is no such device"),
        (&["/tmp"], 2, "cannot open /tmp: it is a folder"),
        (&["--", "--help"], 2, "cannot open --help: there is no such device"),
    ] {
        let (found, printed) = call(arguments);
        assert_eq!(found, status, "{arguments:?}: {printed}");
        assert!(printed.contains(text), "{arguments:?}: no {text:?} in {printed}");
    }
}

#[test]
fn two_designs_are_installed_and_found_by_one_program() {
    if !is_thorough() || !has("cmake") || !has("g++") {
        return;
    }
    let prefix = files::folder("prefix");
    // Names that CMake itself uses cause no trouble.
    for name in ["car", "test"] {
        let folder = files::generate_as(name, "cpp", &format!("installed-{name}"), &design());
        let build = folder.join("build");
        run(Command::new("cmake").arg("-S").arg(&folder).arg("-B").arg(&build));
        // The library consists only of headers: nothing needs to be built.
        run(Command::new("cmake")
            .arg(format!("-DCMAKE_INSTALL_PREFIX={}", prefix.display()))
            .arg("-P")
            .arg(build.join("cmake_install.cmake")));
    }
    let user = files::folder("installed-user");
    let cmake = "cmake_minimum_required(VERSION 3.13)\nproject(user LANGUAGES CXX)\n\
                 find_package(car CONFIG REQUIRED)\nfind_package(test CONFIG REQUIRED)\n\
                 add_executable(user user.cpp)\ntarget_link_libraries(user PRIVATE car::car test::test)\n";
    std::fs::write(user.join("CMakeLists.txt"), cmake).unwrap();
    let source = "#include <sense/car/STM32F4DiscoveryBoard.hpp>\n#include <sense/test/STM32F4DiscoveryBoard.hpp>\n\
                  #include <iostream>\nint main() {\n    const auto print = [](const auto &) {};\n\
                  sense::car::STM32F4DiscoveryBoard front(print);\n    sense::test::STM32F4DiscoveryBoard rear(print);\n\
                  std::cout << front.is_ready() << rear.is_ready() << front.devices();\n}\n";
    std::fs::write(user.join("user.cpp"), source).unwrap();
    let build = user.join("build");
    run(Command::new("cmake")
        .arg("-S")
        .arg(&user)
        .arg("-B")
        .arg(&build)
        .arg(format!("-DCMAKE_PREFIX_PATH={}", prefix.display())));
    run(Command::new("cmake").arg("--build").arg(&build));
    assert!(
        printed(&mut Command::new(build.join("user"))).starts_with("00  sensor   IRFront uint16\n")
    );
}
