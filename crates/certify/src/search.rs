//! The record of the solver's search as text: everything by its position in the order of names.
#![expect(clippy::indexing_slicing, reason = "labels are there for all numbers, which are checked")]

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use sensedsl_solve::problem::{
    Alternative, BoardId, Claim, DeviceId, Holder, PinId, Problem, ResourceId,
};
use sensedsl_solve::trace::{Exchange, Multipliers, Question, Record, Step};
use serde_json::{Map, Value, json};

use crate::labels::Labels;
use crate::swaps::Swap;
use crate::write::holders;

/// The position of everything in the order of names.
pub(crate) struct Places {
    boards: Vec<usize>,
    pins: Vec<usize>,
    devices: Vec<usize>,
    users: Vec<usize>,
    /// Device, alternative.
    ways: Vec<Vec<usize>>,
    /// Device, alternative, role.
    roles: Vec<Vec<Vec<usize>>>,
    /// Device, alternative, role, candidate.
    wires: Vec<Vec<Vec<Vec<usize>>>>,
    resources: BTreeMap<u32, usize>,
    groups: BTreeMap<u32, usize>,
    rules: BTreeMap<u32, usize>,
    streams: BTreeMap<u32, usize>,
}

/// The position of each name in the order of all.
fn sorted(names: &[impl Ord]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..names.len()).collect();
    order.sort_by_key(|place| &names[*place]);
    let mut places = vec![0; names.len()];
    for (place, name) in order.into_iter().enumerate() {
        places[name] = place;
    }
    places
}

/// The positions of the numbers that are used, from `first` on.
fn used(numbers: &BTreeSet<u32>, names: &[String], first: usize) -> BTreeMap<u32, usize> {
    let mut order: Vec<u32> = numbers.iter().copied().collect();
    order.sort_by_key(|number| &names[*number as usize]);
    order.into_iter().zip(first..).collect()
}

/// Everything that is named in a problem.
#[derive(Default)]
struct Used {
    resources: BTreeSet<u32>,
    groups: BTreeSet<u32>,
    rules: BTreeSet<u32>,
}

impl Used {
    fn group(&mut self, holder: Holder) {
        if let Holder::Group(group) = holder {
            self.groups.insert(group);
        }
    }

    fn claims(&mut self, claims: &[Claim]) {
        for (resource, holder) in holders(claims) {
            self.resources.insert(resource);
            self.group(holder);
        }
    }

    fn way(&mut self, way: &Alternative) {
        self.claims(&way.claims);
        self.rules.extend(way.violates.iter().map(|rule| rule.0));
        for wire in way.roles.iter().flat_map(|role| &role.candidates) {
            self.group(wire.holder);
            self.claims(&wire.claims);
            self.rules.extend(wire.violates.iter().map(|rule| rule.0));
        }
    }
}

impl Places {
    pub(crate) fn new(problem: &Problem, labels: &Labels) -> Self {
        let mut named = Used::default();
        let all = problem.devices.iter().flat_map(|device| &device.alternatives);
        all.for_each(|way| named.way(way));
        let requests = problem.dma.iter().flat_map(|user| &user.requests);
        let streams = requests.flat_map(|request| &request.streams).map(|stream| stream.0);
        let ways = |device: usize| -> Vec<&String> {
            labels.alternatives[device].iter().map(|way| &way.name).collect()
        };
        let wires = |device: usize| {
            let of_way = |way: &Alternative| {
                let of_role = |role: &sensedsl_solve::problem::Role| {
                    let name = |one: &sensedsl_solve::problem::Candidate| {
                        let pin = &labels.pins[one.pin.0 as usize];
                        format!("{pin} {}", labels.signals[&one.signal.0])
                    };
                    sorted(&role.candidates.iter().map(name).collect::<Vec<_>>())
                };
                way.roles.iter().map(of_role).collect()
            };
            problem.devices[device].alternatives.iter().map(of_way).collect()
        };
        let roles = |device: usize| {
            labels.alternatives[device].iter().map(|way| sorted(&way.roles)).collect()
        };
        let devices = 0..problem.devices.len();
        Self {
            boards: sorted(&labels.boards),
            pins: sorted(&labels.pins),
            devices: sorted(&labels.devices),
            users: sorted(&labels.dma),
            ways: devices.clone().map(|device| sorted(&ways(device))).collect(),
            roles: devices.clone().map(roles).collect(),
            wires: devices.map(wires).collect(),
            resources: used(&named.resources, &labels.resources, 0),
            groups: used(&named.groups, &labels.groups, 1),
            rules: used(&named.rules, &labels.rules, 0),
            streams: used(&streams.collect(), &labels.streams, 0),
        }
    }

    fn device(&self, device: DeviceId) -> usize {
        self.devices[device.0 as usize]
    }

    fn way(&self, (device, way): (DeviceId, usize)) -> [usize; 2] {
        [self.device(device), self.ways[device.0 as usize][way]]
    }

    fn role(&self, (device, way): (DeviceId, usize), role: usize) -> usize {
        self.roles[device.0 as usize][way][role]
    }

    fn resource(&self, resource: ResourceId) -> usize {
        self.resources[&resource.0]
    }

    fn pin(&self, pin: PinId) -> usize {
        self.pins[pin.0 as usize]
    }
}

/// Writes a record.
pub(crate) struct Text<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) places: &'a Places,
    /// The swaps that are used, in the order of their first use.
    swaps: Vec<Swap>,
}

impl<'a> Text<'a> {
    /// The text; `None` if two boards that should be equal are not.
    pub(crate) fn of(problem: &'a Problem, places: &'a Places, record: &Record) -> Option<String> {
        let mut text = Self { problem, places, swaps: Vec::new() };
        let mut steps = Vec::new();
        for step in &record.steps {
            steps.push(text.step(record, step)?.to_string());
        }
        let facilities: Vec<String> =
            record.facilities.iter().map(|facility| text.facility(facility).to_string()).collect();
        let covers: Vec<Value> = record.covers.iter().map(|cover| text.cover(cover)).collect();
        let swaps: Vec<String> =
            text.swaps.iter().map(|swap| text.swap(swap).to_string()).collect();
        let mut all = String::new();
        // Writing to a String cannot fail.
        let _ = write!(
            all,
            "{{\"weights\": {},\n\"facilities\": [\n{}\n],\n\"covers\": {},\n\"swaps\": [\n{}\n],\n\"steps\": [\n{}\n]}}",
            json!(record.weights),
            facilities.join(",\n"),
            json!(covers),
            swaps.join(",\n"),
            steps.join(",\n"),
        );
        Some(all)
    }

    fn facility(&self, facility: &sensedsl_solve::trace::Facility) -> Value {
        let places = self.places;
        let members: Vec<usize> =
            facility.members.iter().flat_map(|way| places.way(*way)).collect();
        let wires: Vec<Vec<usize>> = facility
            .wires
            .iter()
            .map(|roles| {
                let of = facility.members.iter().zip(roles);
                of.map(|(way, role)| places.role(*way, *role)).collect()
            })
            .collect();
        let users: Vec<usize> =
            facility.users.iter().map(|user| places.users[user.0 as usize]).collect();
        let slots: Vec<usize> = facility.slots.iter().map(|r| places.resource(*r)).collect();
        json!({
            "members": members,
            "resource": facility.resource.map(|resource| places.resource(resource)),
            "wires": wires,
            "users": users,
            "slots": slots,
        })
    }

    fn cover(&self, cover: &sensedsl_solve::trace::Cover) -> Value {
        let devices: Vec<usize> =
            cover.devices.iter().map(|device| self.places.device(*device)).collect();
        json!({
            "devices": devices, "great": cover.great, "small": cover.small, "need": cover.need,
        })
    }

    fn swap(&self, swap: &Swap) -> Value {
        let places = self.places;
        let row = |pairs: &BTreeMap<u32, u32>, place: &dyn Fn(&u32) -> Option<usize>| {
            let once = pairs.iter().filter(|(one, other)| one < other);
            let both = once.filter_map(|(one, other)| Some([place(one)?, place(other)?]));
            both.flatten().collect::<Vec<usize>>()
        };
        let ways: Vec<usize> = swap
            .ways
            .iter()
            .flat_map(|(device, one, other)| {
                let ways = &places.ways[*device];
                [places.devices[*device], ways[*one], ways[*other]]
            })
            .collect();
        let boards = swap.boards.iter().flat_map(|(one, other)| [one, other]);
        let boards: Vec<usize> = boards.map(|board| places.boards[*board]).collect();
        let devices = swap.devices.iter().flat_map(|(one, other)| [one, other]);
        let devices: Vec<usize> = devices.map(|device| places.device(*device)).collect();
        let rows = [
            ("boards", boards),
            ("pins", row(&swap.pins, &|pin| places.pins.get(*pin as usize).copied())),
            ("resources", row(&swap.resources, &|one| places.resources.get(one).copied())),
            ("holders", row(&swap.groups, &|group| places.groups.get(group).copied())),
            ("users", row(&swap.users, &|user| places.users.get(*user as usize).copied())),
            ("streams", row(&swap.streams, &|stream| places.streams.get(stream).copied())),
            ("rules", row(&swap.rules, &|rule| places.rules.get(rule).copied())),
            ("devices", devices),
            ("ways", ways),
        ];
        let stated = rows.into_iter().filter(|(_, row)| !row.is_empty());
        Value::Object(stated.map(|(name, row)| (name.to_owned(), json!(row))).collect())
    }

    fn step(&mut self, record: &Record, step: &Step) -> Option<Value> {
        Some(match step {
            Step::Dead => json!("dead"),
            Step::Closed(by) => json!({ "closed": self.by(by) }),
            Step::Narrowed(by) => json!({ "narrowed": self.by(by) }),
            Step::Split { on, twins, boards } => {
                let mut split = Map::new();
                split.insert("on".into(), self.question(*on));
                let mut swaps = Vec::new();
                for devices in twins {
                    swaps.push(self.swap_of_devices(devices)?);
                }
                for board in boards {
                    let own = self.board_of(record, *on);
                    swaps.push(self.swap_of_boards(own, *board)?);
                }
                if !swaps.is_empty() {
                    split.insert("swaps".into(), json!(swaps));
                }
                json!({ "split": split })
            }
        })
    }

    fn question(&self, on: Question) -> Value {
        let places = self.places;
        match on {
            Question::Way(device, way) => json!({ "way": places.way((device, way)) }),
            Question::Wire(device, way, role, wire) => {
                let place = places.wires[device.0 as usize][way][role][wire];
                let [device_place, way_place] = places.way((device, way));
                let role = places.role((device, way), role);
                json!({ "wire": [device_place, way_place, role, place] })
            }
            Question::Kept(rule) => json!({ "kept": places.rules[&rule.0] }),
            Question::Unused(board) => json!({ "unused": places.boards[board.0 as usize] }),
            Question::Open(facility) => json!({ "open": facility }),
        }
    }

    /// The board that a question is about.
    fn board_of(&self, record: &Record, on: Question) -> BoardId {
        let board = |device: DeviceId, way: usize| {
            self.problem.devices[device.0 as usize].alternatives[way].board
        };
        match on {
            Question::Way(device, way) | Question::Wire(device, way, ..) => board(device, way),
            Question::Open(facility) => {
                let (device, way) = record.facilities[facility].members[0];
                board(device, way)
            }
            Question::Unused(board) => board,
            Question::Kept(_) => BoardId(0),
        }
    }

    /// The number of the swap of two boards.
    fn swap_of_boards(&mut self, one: BoardId, other: BoardId) -> Option<usize> {
        let boards = (one.0.min(other.0) as usize, one.0.max(other.0) as usize);
        let is_known = |swap: &Swap| swap.boards == Some(boards);
        self.number_of(is_known, |problem| Swap::of_boards(problem, boards))
    }

    /// The number of the swap of devices.
    fn swap_of_devices(&mut self, devices: &Exchange) -> Option<usize> {
        let ordered = |(one, other): &(DeviceId, DeviceId)| (*one.min(other), *one.max(other));
        let devices: Exchange = devices.iter().map(ordered).collect();
        let is_known = |swap: &Swap| swap.devices == devices;
        self.number_of(is_known, |problem| Swap::of_devices(problem, &devices))
    }

    fn number_of(
        &mut self,
        is_known: impl Fn(&Swap) -> bool,
        make: impl FnOnce(&Problem) -> Option<Swap>,
    ) -> Option<usize> {
        if let Some(known) = self.swaps.iter().position(is_known) {
            return Some(known);
        }
        self.swaps.push(make(self.problem)?);
        Some(self.swaps.len() - 1)
    }

    fn by(&self, by: &Multipliers) -> Value {
        let places = self.places;
        let mut all = Map::new();
        all.insert("scale".into(), json!(1_u64 << by.shift));
        let mut put = |name: &str, row: Vec<i64>| {
            if !row.is_empty() {
                all.insert(name.into(), json!(row));
            }
        };
        let at = |place: usize| place as i64;
        put("pins", by.pins.iter().flat_map(|(p, x)| [at(places.pin(*p)), *x]).collect());
        let resources = by.resources.iter();
        put("resources", resources.flat_map(|(r, x)| [at(places.resource(*r)), *x]).collect());
        let streams =
            by.streams.iter().filter(|(stream, _)| places.streams.contains_key(&stream.0));
        put("streams", streams.flat_map(|(s, x)| [at(places.streams[&s.0]), *x]).collect());
        let links = by.links.iter();
        put("links", links.flat_map(|(f, d, x)| [at(*f), at(places.device(*d)), *x]).collect());
        let tickets = by.tickets.iter();
        put(
            "tickets",
            tickets.flat_map(|(f, r, x)| [at(*f), at(places.resource(*r)), *x]).collect(),
        );
        put("rules", self.rules(by));
        put("covers", by.covers.iter().flat_map(|(c, x)| [at(*c), *x]).collect());
        Value::Object(all)
    }

    /// Roles are numbered by name in each alternative, so a role of the record may have several
    /// places.
    fn rules(&self, by: &Multipliers) -> Vec<i64> {
        let mut all: BTreeMap<[usize; 3], i64> = BTreeMap::new();
        for (rule, device, place, price) in &by.rules {
            let Some(rule) = self.places.rules.get(&rule.0) else { continue };
            let roles = &self.places.roles[device.0 as usize];
            let of_way = |roles: &Vec<usize>| match place {
                0 => Some(0),
                role => roles.get(role - 1).map(|place| place + 1),
            };
            for place in roles.iter().filter_map(of_way).collect::<BTreeSet<usize>>() {
                let paid = all.entry([*rule, self.places.device(*device), place]).or_default();
                *paid = (*price).max(*paid);
            }
        }
        all.into_iter()
            .flat_map(|(key, price)| key.into_iter().map(|place| place as i64).chain([price]))
            .collect()
    }
}
