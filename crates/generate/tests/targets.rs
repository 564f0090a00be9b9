//! Targets and the profiles they read.

use std::collections::BTreeSet;

use sensedsl_board::profile;
use sensedsl_generate::target::{self, TARGETS};

/// The full names of all targets that have profiles.
fn profiled() -> BTreeSet<String> {
    let names = profile::names().into_iter().filter(|name| name != profile::NONE);
    names.filter_map(|name| profile::full_name(&name)).map(str::to_owned).collect()
}

#[test]
fn every_profile_has_a_generator_that_can_read_it() {
    let mut count = 0;
    for name in profiled() {
        for line in profile::lines(&name).unwrap() {
            let target = target::of(&line.profile);
            let target = target.unwrap_or_else(|| panic!("{name} is not in TARGETS"));
            assert_eq!(target.problems(&line.profile), [""; 0], "{name} {}", line.profile.family);
            count += 1;
        }
    }
    assert!(count > 50, "{count}");
}

#[test]
fn every_generator_has_a_name_of_its_own_and_a_profile() {
    let systems: BTreeSet<String> =
        profiled().iter().filter_map(|name| Some(name.rsplit_once('-')?.0.to_owned())).collect();
    let names: Vec<&str> = TARGETS.iter().map(|target| target.name()).collect();
    assert_eq!(names.iter().collect::<BTreeSet<_>>().len(), names.len(), "{names:?}");
    for target in TARGETS {
        let name = target.name();
        assert!(systems.contains(name), "targets/ has no profile for {name}");
        let lines = profile::lines(profile::full_name(name).unwrap()).unwrap();
        let serves = lines.iter().any(|line| !target.kinds(&line.profile).is_empty());
        assert!(serves, "{name} serves no kind");
    }
}

/// Every key that a profile has for its generator is checked.
#[test]
fn a_damaged_part_is_told() {
    let mut profile = profile::lines(profile::DEFAULT).unwrap().remove(0).profile;
    let target = target::of(&profile).unwrap();
    profile.own.file.insert("nonsense".to_owned(), toml::Value::Boolean(true));
    assert!(target.problems(&profile)[0].contains("nonsense"), "{:?}", target.problems(&profile));
    profile.own.file.clear();
    assert_eq!(target.problems(&profile).len(), 1);
    assert!(target.refusal(&profile, None).is_some());
}
