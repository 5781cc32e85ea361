//! `verify history` prints and draws the accuracy of the committed records over time. It shows slow changes that no
//! single comparison with the baseline does.

use toss::Registry;
use verify::files;
use verify::judge::record;
use verify::render::{charts, history};

use super::Folders;

pub(super) fn history(folders: &Folders) -> anyhow::Result<u8> {
    let records = record::read(&folders.validation.join("record"))?;
    anyhow::ensure!(!records.is_empty(), "there are no records yet; `cargo xtask verify --bless` writes one");
    let path = folders.out.join("history.svg");
    files::write(&path, &charts::history(&records, Registry::standard().entries())?)?;
    files::print(&format!("{}\nchart: {}\n", history::text(&records), path.display()))?;
    Ok(0)
}
