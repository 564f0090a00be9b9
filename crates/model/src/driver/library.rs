//! The library of drivers that ships with the tool: the texts of `drivers/`, embedded, so that no file has to be found.

/// The files of the library: name and text.
pub const LIBRARY: &[(&str, &str)] = &[
    ("drivers/air_quality.sense", include_str!("../../drivers/air_quality.sense")),
    ("drivers/bus_servos.sense", include_str!("../../drivers/bus_servos.sense")),
    ("drivers/environment.sense", include_str!("../../drivers/environment.sense")),
    ("drivers/expanders.sense", include_str!("../../drivers/expanders.sense")),
    ("drivers/field_bus.sense", include_str!("../../drivers/field_bus.sense")),
    ("drivers/force_pressure_flow.sense", include_str!("../../drivers/force_pressure_flow.sense")),
    ("drivers/input.sense", include_str!("../../drivers/input.sense")),
    ("drivers/lamps.sense", include_str!("../../drivers/lamps.sense")),
    ("drivers/light.sense", include_str!("../../drivers/light.sense")),
    ("drivers/magnetic.sense", include_str!("../../drivers/magnetic.sense")),
    ("drivers/motion.sense", include_str!("../../drivers/motion.sense")),
    ("drivers/motor_controllers.sense", include_str!("../../drivers/motor_controllers.sense")),
    ("drivers/motors.sense", include_str!("../../drivers/motors.sense")),
    ("drivers/navigation.sense", include_str!("../../drivers/navigation.sense")),
    ("drivers/output.sense", include_str!("../../drivers/output.sense")),
    ("drivers/position.sense", include_str!("../../drivers/position.sense")),
    ("drivers/power.sense", include_str!("../../drivers/power.sense")),
    ("drivers/radio_control.sense", include_str!("../../drivers/radio_control.sense")),
    ("drivers/rangers.sense", include_str!("../../drivers/rangers.sense")),
    ("drivers/ranging_optical.sense", include_str!("../../drivers/ranging_optical.sense")),
    ("drivers/steppers.sense", include_str!("../../drivers/steppers.sense")),
    ("drivers/weather.sense", include_str!("../../drivers/weather.sense")),
];

/// Search terms, and the drivers that they mean: lines of words and names.
pub(crate) const SEARCH: &str = include_str!("../../drivers/search.csv");
