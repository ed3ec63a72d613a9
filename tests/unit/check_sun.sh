#!/bin/sh
# The place of the sun, rise and set by core/sun.h against PyEphem (sun.py). Skipped (77) without it: python3-ephem of Debian, for
# Debian's own python3.
tool=${BUILD:-build/release}/tests/tool_sun
/usr/bin/python3 -c 'import ephem' 2> /dev/null || { echo 'SKIP: python3-ephem is not installed' && exit 77; }
exec /usr/bin/python3 tests/unit/sun.py "$tool"
