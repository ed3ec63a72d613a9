#!/bin/sh
# sun_sheet.sh OUT.png: a year of the sun on a sheet: the shadow at nine hours of four dates, a row for each date. `make sun-sheet` leaves
# it to be looked at. SCENE=FILE: another scene than the default one; SUN=LAT,LON, ZONE=Europe/Berlin, DATES, HOURS: another place, other
# times by the clock of the zone; SIZE=WxH: of a picture.
set -eu
build=${BUILD:-build/release}
gnomon=${GNOMON:-build/release/gnomon}
out=${1:?usage: sun_sheet.sh OUT.png}
dates=${DATES:-2026-03-20 2026-06-21 2026-09-23 2026-12-21}
hours=${HOURS:-04 06 08 10 12 14 16 18 20}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
set --
for date in $dates; do
    for hour in $hours; do
        file="$folder/$date-$hour.png"
        "$gnomon" render ${SCENE:+"$SCENE"} --no-animation --sun "${SUN:-52.5,13.4}" --sun-time-zone "${ZONE:-Europe/Berlin}" \
            --date "${date}T$hour:00" --size "${SIZE:-320x180}" -o "$file"
        set -- "$@" "$date $hour:00=$file"
    done
done
"$build/tests/tool_sheet" "$out" "$(echo "$hours" | wc -w)" "$@"
echo "$out: $# pictures"
