//! Parameters of the node, one for each actuator: requests of `rcl_interfaces` in, answers and commands out.
//!
//! The services are this file's own and not those of the library's spinner: they say why a value is refused, know an
//! actuator's limits, take a whole number for a `double`, and speak either mapping of services to DDS.

use std::collections::BTreeMap;

use ros2_client::parameters::raw;
use ros2_client::rcl_interfaces::{
    DescribeParametersRequest, DescribeParametersResponse, GetParameterTypesRequest,
    GetParameterTypesResponse, GetParametersRequest, GetParametersResponse, ListParametersRequest,
    ListParametersResponse, ListParametersResult, SetParametersAtomicallyResponse,
    SetParametersRequest, SetParametersResponse,
};
use ros2_client::{Message, Name, Node, ParameterValue, Server, ServiceMapping, ServiceTypeName};
use sensedsl_wire::Scalar;
use serde_json::{Number, Value};

use super::topics::qos;
use crate::command::{self, Command};
use crate::plan::{Place, Plan};

/// The most requests of one service that are answered before values go on.
const AT_ONCE_MAX: usize = 32;

/// The services of all parameters.
pub(super) struct Parameters {
    /// The board and the actuator of each name.
    names: BTreeMap<String, (usize, usize)>,
    takes_commands: bool,
    get: Server<GetParametersRequest, GetParametersResponse>,
    types: Server<GetParameterTypesRequest, GetParameterTypesResponse>,
    describe: Server<DescribeParametersRequest, DescribeParametersResponse>,
    list: Server<ListParametersRequest, ListParametersResponse>,
    set: Server<SetParametersRequest, SetParametersResponse>,
    set_all: Server<SetParametersRequest, SetParametersAtomicallyResponse>,
}

/// The name of an actuator's parameter.
fn name(place: &Place<'_>) -> String {
    format!("{}.{}", place.on.board.name, place.device.name)
}

/// The names of all parameters, for the node.
pub(super) fn names(plan: &Plan) -> Vec<String> {
    plan.places().filter(Place::is_actuator).map(|place| name(&place)).collect()
}

/// What an actuator was set to.
pub(super) fn told(place: &Place<'_>, raw: &[Scalar]) -> (String, ParameterValue) {
    let numbers = || raw.iter().map(|one| place.number(*one));
    let flags = || numbers().map(|number| number != 0.0);
    let value = match (place.device.value.length.is_some(), place.is_bool()) {
        (true, true) => ParameterValue::BooleanArray(flags().collect()),
        (true, false) => ParameterValue::DoubleArray(numbers().collect()),
        (false, true) => ParameterValue::Boolean(flags().next().unwrap_or_default()),
        (false, false) => ParameterValue::Double(numbers().next().unwrap_or_default()),
    };
    (name(place), value)
}

fn server<Q: Message + Clone + 'static, A: Message + 'static>(
    node: &mut Node,
    mapping: ServiceMapping,
    (name, kind): (&str, &str),
) -> Result<Server<Q, A>, String> {
    let name = format!("{}/{name}", node.fully_qualified_name());
    let name = Name::parse(&name).map_err(|why| format!("`{name}` is no service: {why:?}"))?;
    let kind = ServiceTypeName::new("rcl_interfaces", kind);
    node.create_server(mapping, &name, &kind, qos(), qos()).map_err(|why| why.to_string())
}

/// Answers what was asked since the last call.
fn answer<Q: Message + Clone + 'static, A: Message + 'static>(
    server: &Server<Q, A>,
    mut to: impl FnMut(Q) -> A,
) {
    // What cannot be read is as if it had not come, and who is gone needs no answer.
    for _ in 0..AT_ONCE_MAX {
        match server.receive_request() {
            Ok(Some((id, request))) => drop(server.send_response(id, to(request))),
            Ok(None) => return,
            Err(_) => {}
        }
    }
}

impl Parameters {
    pub(super) fn new(
        node: &mut Node,
        plan: &Plan,
        mapping: ServiceMapping,
        takes_commands: bool,
    ) -> Result<Self, String> {
        let actuators = plan.places().filter(Place::is_actuator);
        Ok(Self {
            names: actuators.map(|place| (name(&place), (place.board, place.index))).collect(),
            takes_commands,
            get: server(node, mapping, ("get_parameters", "GetParameters"))?,
            types: server(node, mapping, ("get_parameter_types", "GetParameterTypes"))?,
            describe: server(node, mapping, ("describe_parameters", "DescribeParameters"))?,
            list: server(node, mapping, ("list_parameters", "ListParameters"))?,
            set: server(node, mapping, ("set_parameters", "SetParameters"))?,
            set_all: server(
                node,
                mapping,
                ("set_parameters_atomically", "SetParametersAtomically"),
            )?,
        })
    }

    /// Answers all requests; the actuators that somebody wants to set, or why that was refused.
    pub(super) fn serve(&self, node: &Node, plan: &Plan) -> Vec<(String, Result<Command, String>)> {
        let value = |name: &String| node.get_parameter(name).unwrap_or(ParameterValue::NotSet);
        answer(&self.get, |request| GetParametersResponse {
            values: request.names.iter().map(|name| value(name).into()).collect(),
        });
        answer(&self.types, |request| GetParameterTypesResponse {
            values: request
                .names
                .iter()
                .map(|name| ParameterValue::to_parameter_type_raw(&value(name)))
                .collect(),
        });
        answer(&self.describe, |request| DescribeParametersResponse {
            values: request.names.into_iter().map(|name| self.described(plan, name)).collect(),
        });
        answer(&self.list, |request| ListParametersResponse { result: self.listed(&request) });
        let mut wanted = Vec::new();
        answer(&self.set, |request| {
            let results = request.parameter.into_iter().map(|one| {
                let judged = self.judged(plan, &one);
                let result = result(judged.as_ref().err().cloned());
                wanted.push((one.name, judged));
                result
            });
            SetParametersResponse { results: results.collect() }
        });
        answer(&self.set_all, |request| {
            let judged = request.parameter.into_iter().map(|one| {
                let judged = self.judged(plan, &one);
                (one.name, judged)
            });
            let mut judged: Vec<_> = judged.collect();
            let refused = judged.iter().find_map(|(_, judged)| judged.as_ref().err().cloned());
            if refused.is_some() {
                // None is set if one of them is refused.
                judged.retain(|(_, judged)| judged.is_err());
            }
            wanted.append(&mut judged);
            SetParametersAtomicallyResponse { result: result(refused) }
        });
        wanted
    }

    fn place<'p>(&self, plan: &'p Plan, name: &str) -> Option<Place<'p>> {
        let (board, index) = self.names.get(name)?;
        plan.place(*board, *index)
    }

    /// The command that a parameter is.
    fn judged(&self, plan: &Plan, wanted: &raw::Parameter) -> Result<Command, String> {
        let place = self.place(plan, &wanted.name).ok_or("there is no such actuator")?;
        if !self.takes_commands {
            return Err("other programs may not set actuators here".to_owned());
        }
        command::of_json(&place, &json(wanted.value.clone().into())?)
    }

    fn described(&self, plan: &Plan, name: String) -> raw::ParameterDescriptor {
        let place = self.place(plan, &name);
        let empty = || place.map_or(ParameterValue::NotSet, |place| told(&place, &[]).1);
        let limits = place.and_then(|place| {
            let limit = |shown: Option<f64>| shown.map(|shown| place.scaled(shown));
            Some((limit(place.device.min)?, limit(place.device.max)?))
        });
        let unit = place.and_then(|place| place.route.unit.clone());
        let range = limits.map(|(from_value, to_value)| raw::FloatingPointRange {
            from_value,
            to_value,
            step: 0.0,
        });
        raw::ParameterDescriptor {
            r#type: ParameterValue::to_parameter_type_raw(&empty()),
            description: match (place, unit) {
                (Some(place), Some(unit)) => {
                    format!("actuator {} in {unit}", place.device.name)
                }
                (Some(place), None) => format!("actuator {}", place.device.name),
                (None, _) => String::new(),
            },
            additional_constraints: String::new(),
            read_only: !self.takes_commands,
            dynamic_typing: false,
            floating_point_range: range.into_iter().collect(),
            integer_range: Vec::new(),
            name,
        }
    }

    /// The names that a request asks for, as rclcpp picks them: those with fewer dots than its depth, all for 0; of
    /// prefixes those below one of them.
    fn listed(&self, request: &ListParametersRequest) -> ListParametersResult {
        let dots = |text: &str| text.bytes().filter(|byte| *byte == b'.').count() as u64;
        let is_near = |text: &str| request.depth == 0 || dots(text) < request.depth;
        let is_below = |name: &str, prefix: &String| {
            let rest = name.strip_prefix(prefix.as_str());
            let rest = rest
                .and_then(|rest| if rest.is_empty() { Some("") } else { rest.strip_prefix('.') });
            rest.is_some_and(is_near)
        };
        let is_listed = |name: &&String| {
            let of_prefix = || request.prefixes.iter().any(|prefix| is_below(name, prefix));
            if request.prefixes.is_empty() { is_near(name) } else { of_prefix() }
        };
        let names: Vec<String> = self.names.keys().filter(is_listed).cloned().collect();
        let mut prefixes: Vec<String> =
            names.iter().filter_map(|name| Some(name.rsplit_once('.')?.0.to_owned())).collect();
        prefixes.dedup();
        ListParametersResult { names, prefixes }
    }
}

fn result(refused: Option<String>) -> raw::SetParametersResult {
    let successful = refused.is_none();
    raw::SetParametersResult { successful, reason: refused.unwrap_or_default() }
}

/// A parameter as other programs send values.
fn json(value: ParameterValue) -> Result<Value, String> {
    let number = |number: f64| Number::from_f64(number).map(Value::Number);
    let value = match value {
        ParameterValue::Boolean(flag) => Some(flag.into()),
        ParameterValue::Integer(whole) => Some(whole.into()),
        ParameterValue::Double(real) => number(real),
        ParameterValue::String(text) => Some(text.into()),
        ParameterValue::BooleanArray(all) => Some(all.into()),
        ParameterValue::IntegerArray(all) => Some(all.into()),
        ParameterValue::DoubleArray(all) => {
            all.into_iter().map(number).collect::<Option<Vec<Value>>>().map(Value::Array)
        }
        ParameterValue::NotSet | ParameterValue::ByteArray(_) | ParameterValue::StringArray(_) => {
            None
        }
    };
    value.ok_or_else(|| "an actuator takes a number, `true` or `false`, or a list".to_owned())
}
