# What the parts of .ci/run share; each part sources this file. Paths are relative to the root of the repository.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export CARGO_TERM_COLOR=never RUSTDOCFLAGS="-D warnings"
# Nothing here is built a second time.
export CARGO_INCREMENTAL=0
CARGO_TARGET_DIR=$(realpath -m "${CARGO_TARGET_DIR:-target}")
export CARGO_TARGET_DIR

# Prints what happens next, and after how many seconds of the part.
say() { printf '[%s %d s] %s\n' "${0##*/}" "$SECONDS" "$*"; }

fail() {
    printf 'error: %s\n' "$*" >&2
    exit 1
}

# Says that something cannot be had here, so that it is not checked. The last lines of .ci/run count these.
left_out() {
    say "left out: $*"
    if [[ -n ${CI_LEFT_OUT:-} ]]; then printf '%s\n' "$*" >>"$CI_LEFT_OUT"; fi
}

# The same of all that remains of a part. This is no failure.
leave_out() {
    left_out "$@"
    exit 0
}

# Fetches the dependencies of a package outside the workspace, whose lock file has to be complete as committed.
fetch_or_leave_out() {
    if cargo fetch --locked --manifest-path "$1" 2>/dev/null; then return; fi
    ! cargo fetch --manifest-path "$1" 2>/dev/null || fail "${1%.toml}.lock is not complete; it was, now"
    leave_out "crates.io can't be reached, which has the dependencies of $1"
}

# Seconds of CPU of the programs that this shell has waited for, in milliseconds.
cpu() {
    local line
    times >"$times_file"
    line=$(tail -n 1 "$times_file")
    awk '{ split($1, u, /[ms]/); split($2, s, /[ms]/); printf "%d", 1000 * (60 * (u[1] + s[1]) + u[2] + s[2]) }' <<<"$line"
}

now() { printf '%d' "$((${EPOCHREALTIME/./} / 1000))"; }

# Ends the phase before, and begins `phase NAME`. The times go to the table of .ci/run.
phase() {
    end_phase
    say "$1"
    phase_name=$1 phase_wall=$(now)
    cpu >"$times_file.cpu"
    phase_cpu=$(<"$times_file.cpu")
}

end_phase() {
    [[ -n $phase_name ]] || return 0
    cpu >"$times_file.cpu"
    printf '%s\t%s\t%d\t%d\n' "${0##*/}" "$phase_name" "$(($(now) - phase_wall))" "$(($(<"$times_file.cpu") - phase_cpu))" \
        >>"${CI_TIMES:-/dev/null}"
    phase_name=
}

phase_name=
times_file=$(mktemp)
trap 'end_phase; rm -f "$times_file" "$times_file.cpu"' EXIT
