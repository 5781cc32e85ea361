//! Writes a report into a folder: the page with its charts for people, and the files for programs.

use std::path::Path;

use super::charts::{self, Chart};
use super::report::{PROPOSAL, Report};
use super::{github, html, junit};
use crate::files;

impl Report {
    /// Writes report.html, report.json, junit.xml, summary.md, charts and, if there are any, proposed limits into `folder`.
    pub fn write(&self, folder: &Path) -> anyhow::Result<()> {
        let charts = charts::charts(self)?;
        for (file, text) in [
            ("report.json", self.json()?),
            ("junit.xml", junit::xml(self)?),
            ("summary.md", github::summary(self)),
            ("report.html", html::page(self, &charts)),
        ] {
            files::write(&folder.join(file), &text)?;
        }
        for Chart { file, svg, .. } in &charts {
            files::write(&folder.join(file), svg)?;
        }
        if let Some(proposal) = self.proposed_limits() {
            files::write(&folder.join(PROPOSAL), &proposal)?;
        }
        Ok(())
    }
}
