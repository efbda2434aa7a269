#!/bin/sh
# corpus/picture.sh BUILD (as `make picture`): the README's picture, corpus/picture.jpg: a Cornell box as OpenGL draws it, and ray traced
# with a mirror for the red wall, glass, shadows, and light from wall to wall.
set -eu
cd "$(dirname "$0")/.."
out=$1/picture

rm -rf "$out"
mkdir -p "$out"
tests/xvfb.sh "$1/relume" record -o "$out/box.trace" --quit-after 1 -- "$1/corpus/cornell" --glass --mirror --size 400x400
"$1/relume" render "$out/box.trace" -o "$out/frames/box.####.exr" --mode path --samples 128
"$1/relume" film "$out/frames" -o "$out/box.webm"
cp "$out/box.jpg" corpus/picture.jpg
ls -l corpus/picture.jpg
