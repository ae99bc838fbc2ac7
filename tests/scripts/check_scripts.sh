#!/usr/bin/env bash
# Checks that every test is built, and the shell scripts: syntax, shellcheck where it is installed, and how ./demo answers
# what it is asked before it does anything.
#   check_scripts.sh SOURCE_DIR
set -euo pipefail
root=$(realpath "$1")
scripts=(demo check .ci/run scripts/install-packages scripts/figures/make tests/scripts/check_scripts.sh
    tests/scripts/check_codec_names.sh tests/scripts/check_links.sh)

fail() {
    echo "check_scripts: $*" >&2
    exit 1
}

for script in "${scripts[@]}"; do
    bash -n "$root/$script" || fail "$script: bash -n failed"
    [ -x "$root/$script" ] || fail "$script: is not executable"
done
if command -v shellcheck >/dev/null; then
    (cd "$root" && shellcheck "${scripts[@]}") || fail "shellcheck failed"
fi

# From another directory, as a user may call it.
cd /
help=$("$root/demo" --help) || fail "demo --help: expected exit code 0, got $?"
[[ $help == "Usage: ./demo"*--full* ]] || fail "demo --help: expected its usage, got: $help"

code=0
message=$("$root/demo" --ful 2>&1) || code=$?
[ "$code" = 1 ] || fail "demo --ful: expected exit code 1, got $code"
[[ $message == "Usage: ./demo"* ]] || fail "demo --ful: expected the usage, got: $message"

# A test that no CMakeLists.txt names never runs.
while IFS= read -r -d '' test; do
    grep -rqF --include=CMakeLists.txt "$(basename "$test")" "$root/tests" ||
        fail "${test#"$root"/}: is in no CMakeLists.txt"
done < <(find "$root/tests" -name '*_test.cpp' -print0)
