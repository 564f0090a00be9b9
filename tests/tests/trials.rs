//! `sensedsl test` as people and build servers run it: designs with tests in; what is printed, drawn and returned out.

use sensedsl_tests::{TempDir, has, missing, read, sensedsl};

/// A thermostat whose code is the user's.
const OVEN: &str = "board Oven on NUCLEO_F446RE {
    sensor Heat returns uint16 { type = analog; delay = 10 ms; quantity = \"degC\"; scale = 0.1; }
    actuator Heater accepts uint16 { type = pwm; failsafe = 0; }
    actuator Target accepts float32 { type = code; default = 180; min = 0; max = 250; quantity = \"degC\"; }
    controller Hold every 20 ms { reads = [Heat, Target]; sets = [Heater]; }
}
test Regulates {
    world = \"worlds/oven.toml\";
    for = 4 s;
    at 1 s set Target = 100 degC;
    when Heat > Target + 5 then Heater == 0 within 100 ms;
    always Heater in 0 % .. 100 %;
    never Hold.overruns > 0;
}
test Stays {
    world = \"worlds/oven.toml\";
    for = 2 s;
    always Heat < 60 degC;
}
";
const WORLD: &str = "[devices]\nHeat = { points = [[0, 20], [4, 220]] }\n";
/// A thermostat that switches at its target.
const CODE: &str = "#include \"hold.h\"
void hold_init(void) {}
void hold_step(const struct hold_in *in, struct hold_out *out, uint32_t dt_us) {
    (void)dt_us;
    hold_put_heater(out, hold_get_heat(in) < in->target.value ? 5000 : 0);
}
";

fn project(name: &str, code: &str) -> TempDir {
    let folder = TempDir::new(name);
    folder.write("oven.sense", OVEN);
    std::fs::create_dir_all(folder.join("worlds")).unwrap();
    std::fs::create_dir_all(folder.join("code/user")).unwrap();
    folder.write("worlds/oven.toml", WORLD);
    folder.write("code/user/hold.c", code);
    folder
}

#[test]
fn a_test_runs_the_users_code_and_says_what_did_not_hold() {
    if !has("cc") {
        missing("cc");
        return;
    }
    let folder = project("trials", CODE);
    let call = |words: &[&str]| {
        let words = ["test", "oven.sense", "--code", "code"].iter().chain(words).copied();
        sensedsl(words).within(folder.path()).run()
    };
    let ran = call(&["Regulates"]).exits(0);
    assert!(ran.stdout.contains("Regulates passed (4 s)"), "{}", ran.stdout);
    assert!(
        ran.stdout.contains("held      when Heat > Target + 5 then Heater == 0 within 100 ms"),
        "{}",
        ran.stdout
    );
    let ran = call(&["--picture", "stays.svg"]).exits(1);
    assert!(
        ran.stdout.contains("Stays FAILED") && ran.stdout.contains("2 tests: 1 passed, 1 failed"),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stderr.contains("error[E0538]") && ran.stderr.contains("oven.sense:18"),
        "{}",
        ran.stderr
    );
    assert!(read(&folder.join("stays.svg")).contains(">always Heat &lt; 60 degC<"));
    let json = call(&["--format", "json"]).exits(1).json();
    assert_eq!(json["tests"][1]["rules"][0]["verdict"], "violated");
    let at = json["tests"][1]["rules"][0]["first"]["at"].as_f64().unwrap();
    assert!((0.8..0.85).contains(&at), "{at}");
    let junit = call(&["--format", "junit"]).exits(1).stdout;
    assert!(
        junit.contains("tests=\"4\" failures=\"1\"") && junit.contains("type=\"E0538\""),
        "{junit}"
    );
}

#[test]
fn code_that_crashes_fails_the_test() {
    if !has("cc") {
        missing("cc");
        return;
    }
    let folder = project(
        "trials-crash",
        &CODE.replace("(void)dt_us;", "if (in->heat.value > 500) __builtin_trap();"),
    );
    let ran = sensedsl(["test", "oven.sense", "Regulates", "--code", "code"])
        .within(folder.path())
        .run()
        .exits(1);
    assert!(ran.stderr.contains("error[E0536]"), "{}", ran.stderr);
}

#[test]
fn what_cannot_be_run_is_told() {
    let folder = project("trials-wrong", CODE);
    let call = |words: &[&str]| sensedsl(words.iter().copied()).within(folder.path()).run();
    let ran = call(&["test", "oven.sense", "Regulate"]).exits(2);
    assert!(ran.stderr.contains("E0537") && ran.stderr.contains("`Regulates`"), "{}", ran.stderr);
    assert!(call(&["test", "oven.sense"]).exits(1).stderr.contains("E0534"));
    folder.write(
        "none.sense",
        "board Oven on NUCLEO_F446RE { sensor Heat returns uint16 { type = analog; } }",
    );
    assert!(call(&["test", "none.sense"]).exits(1).stderr.contains("error[E0537]"));
    folder.write("lost.sense", OVEN.replace("worlds/oven", "worlds/lost"));
    let ran = call(&["test", "lost.sense", "--code", "code"]).exits(1);
    assert!(ran.stderr.contains("lost.toml"), "{}", ran.stderr);
    folder.write("away.sense", OVEN.replace("worlds/oven", "../../../away"));
    let ran = call(&["test", "away.sense", "--code", "code"]).exits(1);
    assert!(ran.stderr.contains("E0223"), "{}", ran.stderr);
}
