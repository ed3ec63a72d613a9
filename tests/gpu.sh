#!/bin/sh
# gpu.sh: what `gnomon doctor --report` finds on this machine's GPU, by EGL without a display: the self-test must pass. Prints its row of
# the table in board/README.md; the report is in $BUILD/report.json. Where the CPU draws, it reports that it does not apply, but with SOFTWARE=1.
# REPORT=FILE: judges that one, and makes none.
set -eu
gnomon=${GNOMON:-build/release/gnomon} report=${BUILD:-build/release}/report.json
work=$(mktemp)
trap 'rm -f "$work"' EXIT
"$gnomon" doctor --backend egl > "$work" || { cat "$work" && exit 1; }
if grep -q '^  renderer .* - the CPU$' "$work" && [ -z "${SOFTWARE:-}" ]; then
    echo "not applicable: SKIP, no GPU draws here: $(sed -n 's/^  renderer *//p' "$work")"
    exit 0
fi
if [ -n "${REPORT:-}" ]; then report=$REPORT; else "$gnomon" doctor --report --backend egl -o "$report"; fi
grep -q '"failed": 0$' "$report" || { echo 'FAIL: rows of the self-test:' && { grep -B 4 '"pass": false' "$report" || true; } && exit 1; }
! grep '"failure": "' "$report" || { echo 'FAIL: the bench' && exit 1; }
