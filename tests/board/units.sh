#!/bin/sh
# The unit tests of buttons, built for Debian 13 (`make check-gpiod2`), on its own libraries: libgpiod 2
# among them.
set -eu
root=$(SUITE=trixie tests/board/sysroot.sh) || exit
ld=$(find -L "$root/lib64" "$root/lib" -maxdepth 1 -name 'ld-linux-*.so.*' | head -n 1)
libraries=$(find "$root/usr/lib" -maxdepth 1 -name '*-linux-gnu*' | head -n 1)
status=0
for program in "$BUILD"/tests/test_*; do
    "$ld" --library-path "$libraries" "$program" || status=1
done
"$ld" --library-path "$libraries" --list "$BUILD/gnomon" | grep 'libgpiod\.so\.3' ||
    { echo 'FAIL: gnomon is not built with libgpiod 2' && status=1; }
exit $status
