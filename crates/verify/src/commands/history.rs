//! The command `history` prints and draws the accuracy of the committed records over time. It shows slow changes that
//! no single comparison with the baseline does.

use std::path::Path;

use crate::files;
use crate::judge::record;
use crate::render::{charts, history};
use crate::suite::Suite;

pub(super) fn history(suite: &Suite, out: &Path) -> anyhow::Result<u8> {
    let records = record::read(&suite.data().join("record"))?;
    anyhow::ensure!(!records.is_empty(), "there are no records yet; `{}` writes one", suite.commands().bless());
    let path = out.join("history.svg");
    files::write(&path, &charts::history(&records, suite.registry().entries())?)?;
    files::print(&format!("{}\nchart: {}\n", history::text(&records), path.display()))?;
    Ok(0)
}
