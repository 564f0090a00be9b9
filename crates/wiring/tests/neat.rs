//! Neat wirings of designs: which pins they are on, what is said of them, and that designs without
//! places keep theirs.
#![allow(missing_docs, reason = "tests need none")]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    reason = "only tests"
)]

use sensedsl_certify::Subject;
use sensedsl_model::design::Design;
use sensedsl_model::{FileRequest, Files, NoFiles, ReadError, Request, resolve};
use sensedsl_wiring::assignment::{Assignment, Plain, Status};
use sensedsl_wiring::{Keep, Search, Solved, Wiring};

/// The example of `docs/solver.md`, with its pins on two connectors. PB7 is on both.
const TABLE: &str = "Pin,ADC,I2C,Timer,Places
PA0,ADC1_IN0,-,TIM2_CH1,CN1.1
PA1,ADC1_IN1,-,TIM2_CH2 TIM5_CH2,CN1.2
PB6,-,I2C1_SCL,-,CN1.3
PB7,ADC1_IN7,I2C1_SDA,TIM4_CH2 TIM17_CH1,CN2.1
PB10,ADC1_IN10,I2C2_SCL,TIM3_CH1 TIM16_CH1,CN2.2
PB11,-,I2C2_SDA,-,CN2.3
";

const DESIGN: &str = "board Small on \"small.csv\" {
    link { transport = none; }
    sensor Compass returns int16 { id = 1; type = i2c; address = 0x1E; }
    sensor Light returns uint16 { id = 2; type = analog; }
    sensor Wheel returns uint32 { id = 3; type = icu; }
}";

struct Table(String);

impl Files for Table {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        (wanted.path == "small.csv").then(|| self.0.clone()).ok_or(ReadError::Missing)
    }
}

fn design(table: &str) -> Design {
    let request =
        Request { path: "small.sense", text: DESIGN, target: Some("none"), ..Request::default() };
    let resolved = resolve(&request, &Table(table.to_owned()));
    resolved.design.unwrap_or_else(|| panic!("{:?}", resolved.diagnostics))
}

fn built_in(text: &str) -> Design {
    let resolved = resolve(&Request { path: "x.sense", text, ..Request::default() }, &NoFiles);
    resolved.design.unwrap_or_else(|| panic!("{:?}", resolved.diagnostics))
}

fn solved(design: &Design, keep: Option<&Keep>, search: Search) -> Assignment {
    match Wiring::new(design, keep).solve(&search) {
        Solved::Wired(wiring) => *wiring,
        other @ (Solved::Infeasible(_) | Solved::Failed(_)) => panic!("{other:?}"),
    }
}

/// The pins of all wires, with the contact that each uses.
fn pins(design: &Design, wiring: &Assignment) -> Vec<String> {
    let mut all = Vec::new();
    for (on, board) in wiring.used(design) {
        for wire in on.connections.iter().flat_map(|one| &one.wires) {
            let pin = wire.pin(board).unwrap();
            let place = wire.place.and_then(|number| pin.places[number].contact());
            all.push(format!("{}{}", pin.name, place.map_or(String::new(), |at| format!("@{at}"))));
        }
    }
    all
}

#[test]
fn a_part_leaves_from_one_connector_if_that_costs_nothing() {
    let design = design(TABLE);
    let neat = solved(&design, None, Search::default());
    assert_eq!(pins(&design, &neat), ["PB10@CN2.2", "PB11@CN2.3", "PA0@CN1.1", "PA1@CN1.2"]);
    assert_eq!((neat.status, neat.cost, neat.rise()), (Status::Optimal, 10, 0));
    let neatness = neat.neatness;
    assert_eq!((neatness.sides, neatness.span, neatness.is_proved), (3, 1, true));
    assert_eq!(neatness.before, Some(Plain { sides: 4, span: 0, cost: 10 }));
    let any = solved(&design, None, Search { any: true, rise: 0 });
    assert_eq!((any.neatness.is_proved, any.neatness.before), (false, None));
}

#[test]
fn a_pin_uses_the_contact_that_suits_its_part() {
    let both = TABLE.replace("TIM17_CH1,CN2.1", "TIM17_CH1,CN2.1 CN1.4");
    let design = design(&both);
    let neat = solved(&design, None, Search::default());
    // The first of the best is as neat, so it stays.
    assert_eq!(pins(&design, &neat), ["PB6@CN1.3", "PB7@CN1.4", "PA0@CN1.1", "PA1@CN1.2"]);
    assert_eq!(neat.neatness.before, Some(Plain { sides: 3, span: 1, cost: 10 }));
}

#[test]
fn neatness_may_cost_as_much_as_is_allowed() {
    // I2C2 costs two more, and a wiring that is as neat as it costs at least that.
    let dear = TABLE.replace("PB11,-,I2C2_SDA,-", "PB11,-,I2C2_SDA,TIM8_CH1 TIM9_CH1");
    let design = design(&dear);
    for (rise, sides, cost) in [(0, 4, 10), (1, 4, 10), (2, 3, 12), (9, 3, 12)] {
        let neat = solved(&design, None, Search { any: false, rise });
        assert_eq!((neat.neatness.sides, neat.cost), (sides, cost), "{rise}");
        assert_eq!(neat.rise(), cost - 10);
        assert_eq!(neat.status == Status::Optimal, cost == 10, "{rise}");
        assert_eq!(neat.bound.map(|bound| bound.cost), (cost > 10).then_some(10), "{rise}");
        assert!(neat.neatness.is_proved, "{rise}");
    }
}

#[test]
fn what_is_kept_does_not_move_to_be_neater() {
    let design = design(TABLE);
    let mut keep = Keep::default();
    keep.add("Compass", "scl", "Small", "PB6");
    keep.add("Compass", "sda", "Small", "PB7");
    let kept = solved(&design, Some(&keep), Search::default());
    assert_eq!(pins(&design, &kept)[..2], ["PB6@CN1.3", "PB7@CN2.1"]);
    assert_eq!(kept.moved, 0);
}

#[test]
fn without_places_nothing_changes() {
    let (head, rows) = TABLE.split_once('\n').unwrap();
    let cut = |line: &str| line.rsplit_once(',').unwrap().0.to_owned();
    let rows: Vec<String> = rows.lines().map(cut).collect();
    let design = design(&format!("{}\n{}\n", cut(head), rows.join("\n")));
    let wiring = solved(&design, None, Search { any: false, rise: 5 });
    assert_eq!(pins(&design, &wiring), ["PB6", "PB7", "PA0", "PA1"]);
    assert_eq!((wiring.neatness.sides, wiring.neatness.span), (0, 0));
    assert_eq!((wiring.neatness.is_proved, wiring.neatness.before), (true, None));
}

#[test]
fn the_paper_s_figure_keeps_its_pins() {
    let text = std::fs::read_to_string("../../examples/fig2.sense").unwrap();
    let design = built_in(&text);
    let wiring = solved(&design, None, Search::default());
    assert_eq!(pins(&design, &wiring), ["PB0", "PB1", "PA8", "PC9", "PB4"]);
    assert_eq!((wiring.cost, wiring.neatness.sides), (5, 0));
}

/// The certificate is of the neat wiring, and there is none of a dearer one.
#[test]
fn the_neat_wiring_is_certified() {
    let design = design(TABLE);
    let wiring = Wiring::new(&design, None);
    let proved = wiring.solve_with_proof(&Subject::default());
    let text = proved.certificate.unwrap().unwrap();
    let certificate = sensedsl_proof::read(&text).unwrap();
    sensedsl_proof::verify(&certificate).unwrap();
    let Solved::Wired(wired) = proved.solved else { panic!("there is a wiring") };
    assert_eq!(*wired, solved(&design, None, Search::default()));
    assert!(text.contains("PB10"));
}

#[test]
fn a_board_has_sides_and_one_input_has_one_output() {
    // A Pico has one connector with contacts at two edges.
    let text = "board Robot on RASPBERRYPI_PICO {
        sensor Height returns uint16 { id = 1; type = i2c; address = 0x70; }
        sensor Turn returns uint16 {
            id = 2; type = spi; clock = 1 MHz; mode = 1; register = 0x3F; length = 2;
        }
        sensor Light returns uint16 { id = 3; type = analog; }
        sensor Bump returns bool[3] { type = digital; }
    }";
    let design = built_in(text);
    let one = solved(&design, None, Search::default());
    assert_eq!(one, solved(&design, None, Search::default()));
    let neatness = one.neatness;
    assert!(neatness.is_proved);
    // Each part is on one side, and its wires are next to each other but for a ground between.
    assert_eq!(neatness.sides, 4);
    assert!(neatness.span <= 8, "{}", neatness.span);
}
