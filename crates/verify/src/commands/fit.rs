//! `verify fit`: the planner's table.

use std::path::Path;

use verify::files;
use verify::host::Host;
use verify::measure::planner::fit;

/// Measures the table and writes it where the library is built with it.
pub(super) fn fit() -> anyhow::Result<u8> {
    let Host { date, cpu, .. } = Host::here();
    let fitted = fit::fit(format!("{date} on {cpu}"))?;
    files::write(Path::new(fit::FILE), &fit::text(&fitted)?)?;
    Ok(0)
}
