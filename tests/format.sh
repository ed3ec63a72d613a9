#!/bin/sh
# The layout that clang-format 14 gives; other versions differ in small things.
version=$(clang-format --version 2> /dev/null | sed -n 's/.*version \([0-9]*\).*/\1/p')
if [ "$version" != 14 ]; then
    echo "clang-format is ${version:-not here}; the layout is that of version 14"
    exit 77
fi
find src tests assets board -name '*.[ch]' | xargs clang-format --dry-run -Werror
