//! The table of `docs/hosts.md` agrees with the hosts' own descriptions. `SENSEDSL_BLESS=1 cargo
//! test -p sensedsl-tests hosts::page` rewrites it.

use sensedsl_generate::host::HOSTS;
use sensedsl_tests::{root, text};

const HEAD: &str = "| host | language | needs | gives |\n| --- | --- | --- | --- |\n";

#[test]
fn the_page_has_every_host() {
    let page = text("docs/hosts.md");
    let (before, table) = page.split_once(HEAD).expect("docs/hosts.md has the table's head");
    let (_, after) = table.split_once("\n\n").expect("text behind the table");
    let row = |host: &&dyn sensedsl_job::host::Host| {
        let about = host.about();
        format!("| `{}` | {} | {} | {} |\n", host.name(), about.language, about.needs, about.gives)
    };
    let rows: String = HOSTS.iter().map(row).collect();
    let wanted = format!("{before}{HEAD}{rows}\n{after}");
    if std::env::var("SENSEDSL_BLESS").as_deref() == Ok("1") {
        std::fs::write(root().join("docs/hosts.md"), &wanted).unwrap();
    } else {
        assert_eq!(page, wanted, "run it with SENSEDSL_BLESS=1");
    }
}
