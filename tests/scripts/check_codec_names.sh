#!/usr/bin/env bash
# Checks that codecs are named in their own folders and in the files below alone (docs/architecture.md, "Coded data are
# values"): a new codec is then a folder in each room and a line in each table.
#   check_codec_names.sh SOURCE_DIR
set -euo pipefail
root=$1

fail() {
    echo "check_codec_names: $*" >&2
    exit 1
}

# FILE: why it names codecs.
allowed=(
    "paim/codec/codecs.cpp: the codecs that files may have"
    "compressor/encode/search/transfer_encoders.cpp: the codecs that a search tries"
    "player/render/transfer_textures.cpp: the codecs that the player draws"
)

# What names a codec: svd, Svd, cpca, clusters and whatever is called after them. The decomposition itself (SVD, the room
# compressor/encode/svd, its function jacobi_svd_bytes and the program paim-svd-study) does not.
names='[Ss]vd|[Cc]pca|CPCA|[Cc]luster|CLUSTER'
mathematics='SVD|compressor/encode/svd/|jacobi_svd_bytes|paim-svd-study'

is_allowed() {
    local entry
    for entry in "${allowed[@]}"; do
        [[ $entry == "$1:"* ]] && return 0
    done
    return 1
}

cd "$root"
found=()
while IFS= read -r -d '' file; do
    if sed -E "s#$mathematics##g" "$file" | grep -E "$names" >/dev/null; then found+=("$file"); fi
done < <(find paim compressor player analysis poses \( -name '*.cpp' -o -name '*.h' -o -name '*.inc' \) \
    -not -path '*/svd/*' -not -path '*/cpca/*' -not -path '*/cluster/*' -print0 | sort -z)

for file in "${found[@]}"; do
    is_allowed "$file" ||
        fail "$file names a codec: $(sed -E "s#$mathematics##g" "$file" | grep -nE "$names" | head -n 1)"
done
# A file that no longer names a codec leaves the list.
for entry in "${allowed[@]}"; do
    file=${entry%%:*}
    [[ " ${found[*]} " == *" $file "* ]] || fail "$file is allowed to name a codec, but names none"
done
