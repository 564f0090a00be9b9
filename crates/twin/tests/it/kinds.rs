//! Every kind of the registry on the twin: the values of a sensor come and are those of the world, and the outputs of
//! an actuator follow the host.

use sensedsl_model::kind::KindName;
use sensedsl_wire::Direction;

use crate::commanded::tried_as;
use crate::run::plainly;

/// A board with one device of a kind.
fn board(kind: KindName, direction: Direction) -> String {
    let spec = kind.spec();
    let head = match direction {
        Direction::Sensor => "sensor D returns",
        Direction::Actuator => "actuator D accepts",
    };
    format!(
        "board STM32F407G_DISC1 {{
            link {{ transport = uart; unit = USART3; }}
            release CS43L22;
            {head} {} {{ id = 1; type = {kind}; delay = 20 ms; {} }}
        }}",
        spec.natural, spec.example
    )
}

/// What code makes is not measured, and a parameter has no output: tests of controllers have that kind.
fn kinds(direction: Direction) -> impl Iterator<Item = KindName> {
    KindName::wired().filter(move |kind| kind.spec().directions.contains(&direction))
}

#[test]
fn sensors_of_every_kind_report_what_the_world_does() {
    for kind in kinds(Direction::Sensor) {
        let run = plainly(&board(kind, Direction::Sensor), "", 5);
        assert!(run.wrong().is_empty(), "{kind}: {:#?}", run.wrong());
        let reports = run.of("D").reports;
        assert!(reports > 3, "{kind}: {reports} reports: crates/twin does not know its interface");
    }
}

#[test]
fn actuators_of_every_kind_follow_the_host() {
    for kind in kinds(Direction::Actuator) {
        let text = board(kind, Direction::Actuator);
        let all = tried_as(&text, &text, "");
        assert_eq!(all.len(), 1, "{kind}: crates/twin does not know its interface");
        for one in all {
            assert_eq!((one.wrong, one.left), (0, 0), "{kind}: {one:#?}");
            assert!(one.looks >= 5 && one.commands >= 4, "{kind}: {one:#?}");
        }
    }
}
