#!/bin/sh
# The layout that clang-format 14 gives. Others differ in small things, so where Debian has only a
# later one this does not apply: that is said, and is no skip, since nothing was left out by mistake.
tool=$(command -v clang-format-14 || command -v clang-format) || {
    echo 'clang-format is not here: make deps'
    exit 77
}
version=$($tool --version | sed -n 's/.*version \([0-9]*\).*/\1/p')
if [ "$version" != 14 ]; then
    echo "not applicable: clang-format is $version here, and the layout is that of 14"
    exit 0
fi
find src tests assets board -name '*.[ch]' -o -name '*.cc' | xargs "$tool" --dry-run -Werror
