#!/bin/sh
# changed.sh FOLDER FILE.c..: those of the files that differ from the branch that they are for, or
# include a header that does: FOLDER/FILE.syntax.d says what they include. That branch is origin's,
# or main; what is not committed counts. Nothing where there is no git or no such branch.
set -eu
deps=$1
shift
for branch in origin/HEAD origin/main main; do
    base=$(git merge-base HEAD "$branch" 2> /dev/null) && break
done
[ -n "$base" ] || exit 0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
{
    git diff --name-only --no-renames "$base"
    git ls-files --others --exclude-standard
} | grep '\.[ch]$' > "$work/changed" || exit 0
for file in "$@"; do
    if cat "$deps/${file%.c}.syntax.d" 2> /dev/null | tr ' ' '\n' | grep -qxF -f "$work/changed"; then
        echo "$file"
    fi
done
