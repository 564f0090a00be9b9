//! The files that `use` can name: those that are open in the same folder.

use super::item::Item;
use super::subject::Subject;
use crate::protocol::completion::FILE;

pub(super) fn used(subject: &Subject<'_, '_>) -> Vec<Item> {
    let cx = subject.cx;
    let folder = cx.path.rfind('/').map_or("", |end| cx.path.get(..=end).unwrap_or_default());
    let used: Vec<String> = cx.ast().uses().filter_map(|one| Some(one.path()?.value())).collect();
    let others = cx.documents.paths().filter(|path| *path != cx.path);
    let names = others.filter_map(|path| path.strip_prefix(folder));
    let names = names.filter(|name| name.ends_with(".sense"));
    names
        .filter(|name| used.iter().all(|one| one != name))
        .map(|name| Item::new(name, FILE))
        .collect()
}
