#!/bin/sh
# Checks both programs. Further options go to verify: --bless takes what is better or new into the baselines, and
# --only random-cos-tilt runs one check. VERIFY is the program verify.
set -e
verify=${VERIFY:-unfair-toss/target/release/verify}
c++ -std=c++17 -O2 -o solver solver.cpp
code=0
# The closed form errs by rounding alone, which differs between machines: only four times as much is worse.
"$verify" --quick --command "python3 solver.py" --worse-above 4 --validation validation/python --out out/python "$@" || code=$?
"$verify" --quick --command ./solver --validation validation/cpp --out out/cpp "$@" || code=$?
exit $code
