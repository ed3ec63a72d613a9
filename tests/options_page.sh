#!/bin/sh
# options_page.sh MAN: src/options/README.md on stdout, with the table of keys that the host tool MAN prints.
set -eu
awk '/^<!-- end of the keys -->/ { inside = 0 } !inside { print } /^<!-- the keys: / { print ""; exit }' src/options/README.md
"$1" options.md
echo
sed -n '/^<!-- end of the keys -->/,$p' src/options/README.md
