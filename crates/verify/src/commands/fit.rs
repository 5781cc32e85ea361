//! `verify fit` measures the planner's table of costs and errors and writes it into the library's sources. It is a
//! command of its own because the table must be measured again on a change of a model, which needs no run of the
//! checks.

use std::path::Path;

use verify::files;
use verify::host::Host;
use verify::measure::planner::fit;

/// Measures the table and writes it into the file with which the library is built.
pub(super) fn fit() -> anyhow::Result<u8> {
    let Host { date, cpu, .. } = Host::here();
    let fitted = fit::fit(format!("{date} on {cpu}"))?;
    files::write(Path::new(fit::FILE), &fit::text(&fitted)?)?;
    Ok(0)
}
