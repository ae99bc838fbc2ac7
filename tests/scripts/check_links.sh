#!/usr/bin/env bash
# Checks that every relative link of the Markdown pages leads to a file, and to a heading of it where
# it names one, and that every page of docs/ that sources name is there.
#   check_links.sh SOURCE_DIR
set -euo pipefail
cd "$1"

bad=0
complain() {
    echo "check_links: $*" >&2
    bad=1
}

# Headings of a page as links name them: lower case, without punctuation, hyphens for spaces.
headings() {
    sed -n 's/^##* *//p' "$1" | tr 'A-Z ' 'a-z-' | tr -cd 'a-z0-9_\n-'
}

num_links=0
while IFS= read -r page; do
    # Code is no place for links, but brackets in it may look like them.
    # shellcheck disable=SC2016  # the backquotes are Markdown's
    links=$(sed -e '/^```/,/^```/d' -e 's/`[^`]*`//g' "$page" | grep -oE '\]\([^)]+\)' || true)
    while IFS= read -r link; do
        [ -n "$link" ] || continue
        link=${link#](}
        link=${link%)}
        [[ $link =~ ^[a-z]+: ]] && continue
        num_links=$((num_links + 1))
        path=${link%%#*}
        target=$page
        [ -z "$path" ] || target=$(dirname "$page")/$path
        if [ ! -e "$target" ]; then
            complain "${page#./}: $link: no such file"
        elif [[ $link == *#* ]]; then
            headings "$target" | grep -qxF -- "${link#*#}" ||
                complain "${page#./}: $link: no such heading"
        fi
    done <<<"$links"
done < <(find . \( -name .git -o -name build -o -name 'demo*-output' \) -prune -o -name '*.md' -print)
[ "$num_links" -gt 0 ] || complain "found no links at all"

while IFS=: read -r file page; do
    [ -e "$page" ] || complain "${file#./}: names $page, which is not there"
done < <(grep -roE --exclude-dir=.git --exclude-dir=build --exclude-dir='demo*-output' \
    --include='*.h' --include='*.cpp' --include='*.txt' --include='*.py' --include='*.md' --include=make \
    '\bdocs/[A-Za-z0-9_/.-]+\.(md|svg|png)' . | sort -u)

exit "$bad"
