//! The file for `--config`: the one that `--init-config` writes, and those that are wrong.

use sensedsl_tests::{read, sensedsl};

use super::{robot, text};

#[test]
fn the_written_file_is_taken_as_it_is() {
    let (scratch, _) = robot("sinks-init");
    let (file, config) = (scratch.join("robot.sense"), scratch.join("sinks.toml"));
    let init = format!("--init-config={}", text(&config));
    let wrote = sensedsl(["monitor", text(&file), &init]).run().exits(0);
    assert!(wrote.stderr.starts_with("wrote ") && wrote.stdout.is_empty(), "{wrote:?}");
    let written = read(&config);
    for expected in [
        "# [mqtt]",
        "\n[websocket]\n",
        "# [devices.\"Rover/Light\"]",
        "# actuator Servo uint16 in deg",
        "#     [messages.battery]",
    ] {
        assert!(written.contains(expected), "{expected}: {written}");
    }
    let call = ["monitor", "simulate", text(&file), "--seconds", "0.3", "--config", text(&config)];
    let run = sensedsl(call).run().exits(0);
    assert!(run.stderr.contains("WebSocket: "), "{}", run.stderr);
    // It is printed as well, with what the arguments ask for, and never written over.
    let printed =
        sensedsl(["monitor", text(&file), "--init-config", "--mqtt", "pi.local"]).run().exits(0);
    assert!(printed.stdout.contains("\n[mqtt]\nbroker = \"pi.local:1883\""), "{}", printed.stdout);
    assert!(printed.stdout.contains("\n# [websocket]\n"), "{}", printed.stdout);
    let own = format!("{written}# my own\n");
    let _ = scratch.write("sinks.toml", &own);
    let again = sensedsl(["monitor", text(&file), &init]).run().exits(2);
    assert!(again.stderr.contains("remove the file"), "{}", again.stderr);
    assert_eq!(read(&config), own);
}

#[test]
fn wrong_files_and_arguments_begin_nothing() {
    let (scratch, _) = robot("sinks-wrong");
    let file = scratch.join("robot.sense");
    for (config, expected) in [
        ("[mqtt]\nbrocker = \"x:1\"\n", &["E0560", "sinks.toml:2:1", "did you mean `broker`?"][..]),
        ("[mqtt\n", &["E0560", "not TOML", "--init-config"]),
        ("", &["E0560", "names no program", "add a table"]),
        ("[boards.Rover]\nrate_hz = 1\n", &["E0560", "names no program"]),
        ("[mqtt]\n[devices.\"Rover/Ligth\"]\n", &["E0561", "did you mean `Rover/Light`?"]),
        ("[mqtt]\nbroker = \"x\"\n", &["E0562", "it has no port"]),
        (
            "[mqtt]\n[devices.Light]\ntopic = \"a\"\n[devices.Turns]\ntopic = \"a\"\n",
            &["E0564", "another `topic`"],
        ),
        ("[mqtt]\n[devices.Light]\nunit = \"V\"\n", &["E0560", "it is shown in cm"]),
        (
            "[mqtt]\n[messages.b]\ntype = \"BatteryState\"\nvoltage = \"Light\"\n",
            &["E0560", "sinks.toml:4:11", "`Light` is in cm, and `voltage` needs V"],
        ),
    ] {
        let path = scratch.write("sinks.toml", config);
        let call = ["monitor", "simulate", text(&file), "--config", text(&path)];
        let run = sensedsl(call).run().exits(2);
        for expected in expected {
            assert!(run.stderr.contains(expected), "{config}: {}", run.stderr);
        }
        assert_eq!(run.stdout, "", "{config}");
    }
    let has_ros2 = cfg!(feature = "all-sinks");
    for (arguments, expected) in [
        (
            ["--ros-distro", "humble"],
            if has_ros2 { "is for ROS 2: write a table" } else { "E0563" },
        ),
        (["--ros-distro", "jazy"], "a similar value exists: 'jazzy'"),
        (["--mqtt", "mqtt://x"], "E0562"),
        (["--websocket=localhost:80", "-q"], "E0562"),
        (["--plotjuggler=here", "-q"], "E0562"),
        (["--config", "/no/such/file.toml"], "E0111"),
    ] {
        let run = sensedsl(["monitor", "simulate", text(&file)]).args(arguments).run().exits(2);
        assert!(run.stderr.contains(expected), "{arguments:?}: {}", run.stderr);
    }
    // A file without programs is one for those that the arguments name.
    let path = scratch.write("rates.toml", "[boards.Rover]\nrate_hz = 1\n");
    let call =
        ["monitor", "simulate", text(&file), "--seconds", "0.3", "--plotjuggler", "--config"];
    let _ = sensedsl(call).arg(&path).run().exits(0);
}
