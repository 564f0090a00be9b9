//! `sensedsl import`, as users call it: its output on each stream and its exit status; the other
//! commands must accept the result.

use sensedsl_tests::{Scratch, root, sensedsl, text};

const MCU: &str = r#"<?xml version="1.0"?>
<Mcu Family="STM32F4" Package="LQFP64" RefName="STM32F405RGTx" xmlns="http://dummy.com">
  <IP InstanceName="GPIO" Name="GPIO" Version="demo_v1_0"/>
  <Pin Name="PB6" Position="58" Type="I/O"><Signal Name="I2C1_SCL"/><Signal Name="GPIO"/></Pin>
  <Pin Name="VDD" Position="1" Type="Power"/>
</Mcu>
"#;
const MODES: &str = r#"<IP Name="GPIO" xmlns="http://dummy.com"><GPIO_Pin PortName="PB" Name="PB6">
  <PinSignal Name="I2C1_SCL"><SpecificParameter Name="GPIO_AF">
    <PossibleValue>GPIO_AF4_I2C1</PossibleValue></SpecificParameter></PinSignal>
</GPIO_Pin></IP>
"#;
const PROJECT: &str = "\
Mcu.Name=STM32F407V(E-G)Tx\nMcu.UserName=STM32F407VGTx\nProjectManager.ProjectName=rover\n\
PA1.GPIO_Label=IR front\nPA1.Signal=ADCx_IN1\nSH.ADCx_IN1.0=ADC1_IN1,IN1\n\
PB6.Signal=I2C1_SCL\nPB7.Signal=I2C1_SDA\nPD12.Signal=GPIO_Output\n\
PB4.Signal=S_TIM3_CH1\nSH.S_TIM3_CH1.0=TIM3_CH1,Input_Capture1_from_TI1\n\
PA13.Mode=Serial_Wire\nPA13.Signal=SYS_JTMS-SWDIO\n";

#[test]
fn an_mcu_finds_its_alternate_functions_beside_it() {
    let scratch = Scratch::new("import-mcu");
    let mcu = scratch.write("mcu/chip.xml", MCU);
    let call = || sensedsl(["import"]).arg(&mcu);
    let alone = call().run().exits(1);
    assert!(alone.stdout.is_empty() && alone.stderr.contains("E0801"), "{}", alone.stderr);
    scratch.write("mcu/IP/GPIO-demo_v1_0_Modes.xml", MODES);
    let both = call().run().exits(0);
    let expected =
        "# mcu = STM32F405RGTx\n# package = LQFP64\nPin,Position,I2C\nPB6,58,I2C1_SCL@4\n";
    assert_eq!((both.stdout.as_str(), both.stderr.as_str()), (expected, ""));
}

#[test]
fn a_project_becomes_a_file_that_solves_on_its_pins() {
    let scratch = Scratch::new("import-ioc");
    let project = scratch.write("rover.ioc", PROJECT);
    let rover = scratch.join("rover.sense");
    let made = sensedsl(["import"]).arg(&project).arg("-o").arg(&rover).run().exits(0);
    assert!(made.stdout.is_empty() && made.stderr.contains("H0806"), "{}", made.stderr);
    let solved = sensedsl(["solve", "-q", "--format", "json"]).arg(&rover).run().exits(0).json();
    let devices = solved["boards"][0]["devices"].as_array().unwrap();
    let pins: Vec<_> = devices.iter().map(|device| &device["wires"][0]["pin"]).collect();
    assert_eq!(pins, ["PA1", "PB4", "PD12"]);
    let table = sensedsl(["import", "--table"]).arg(&project).run().exits(0).stdout;
    assert_eq!(table, sensedsl_tests::read(&scratch.join("rover.csv")));
    assert!(table.contains("PA13,,SYS_JTMS-SWDIO,"), "{table}");
}

#[test]
fn workbooks_give_table_1_back() {
    let expected = text("crates/board/boards/STM32F4DiscoveryBoard/pins.csv");
    for name in ["table1.xlsx", "table1.ods"] {
        let book = root().join("crates/import/tests/data").join(name);
        let made = sensedsl(["import"]).arg(&book).run().exits(0);
        assert_eq!(made.stdout, expected, "{name}");
        let missing = sensedsl(["import", "--sheet", "Nothing"]).arg(&book).run().exits(2);
        assert!(missing.stderr.contains("E0803") && missing.stderr.contains("`Pins`"));
    }
}

#[test]
fn the_standard_input_is_a_source_and_nonsense_is_refused() {
    let made = sensedsl(["import", "-"]).stdin("Pin;ADC\nPA1;ADC1_IN1\n").run().exits(0);
    assert_eq!(made.stdout, "Pin,ADC\nPA1,ADC1_IN1\n");
    let latin1 = sensedsl(["import", "-"]).stdin(*b"Pin;I\xb2C\nPB6;I2C1-SCL\n").run().exits(0);
    assert!(latin1.stdout.contains("I²C") && latin1.stderr.contains("B1: byte 5 (0xB2)"));
    let binary = sensedsl(["import", "-"]).stdin(*b"\x7fELF\x00\x01").run().exits(1);
    assert!(binary.stdout.is_empty() && binary.stderr.contains("E0801"));
    let missing = sensedsl(["import", "no-such-file.csv"]).run().exits(2);
    assert!(missing.stdout.is_empty());
}
