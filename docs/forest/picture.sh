#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# picture.sh FOLDER TREE...: a forest of these trees on hills, whole and close up, as FOLDER/*.png.
# The trees are in metres. LEAFHULL names the command, FOREST has more options of its verb.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
leafhull=${LEAFHULL:-$here/../../build/release/leafhull}
(($# >= 2)) || { echo "usage: picture.sh FOLDER TREE..." >&2; exit 2; }
folder=$1
shift
mkdir -p "$folder"

python3 "$here/hills.py" "$folder/hills.png"
"$leafhull" scatter "$@" --count 2500 --seed 2 --area 420x380 \
  --height-map "$folder/hills.png" --height 65 -o "$folder/scene.csv"
# shellcheck disable=SC2086  # FOREST is several words
"$leafhull" forest "$folder/scene.csv" -o "$folder/forest" --merge canopy \
  --radius-unit model --radius-max 0.8 --voxel-size 0.35 --single "$folder/forest.glb" ${FOREST:-}

draw() {
  "$leafhull" render "$folder/forest.glb" --as shape --camera "$here/$1.json" --size "$2" \
    -o "$folder/$3.png" "${@:4}"
}
paint=(--look watercolour --watercolour-style "$here/style.json")
draw whole 1400x560 whole "${paint[@]}"
draw close 1400x700 close "${paint[@]}"
draw near 1400x700 near
