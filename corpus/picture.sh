#!/bin/sh
# corpus/picture.sh BUILD (as `make picture`): the README's picture, corpus/picture.jpg: marbles as OpenGL draws them, and the same recording
# ray traced with a mirror, glass and the soft shadows of a lamp with a size.
set -eu
cd "$(dirname "$0")/.."
out=$1/picture

rm -rf "$out"
mkdir -p "$out"
tests/xvfb.sh "$1/relume" record -o "$out/marbles.trace" --quit-after 21 -- "$1/corpus/glx/marbles" --size 400x300
"$1/relume" render "$out/marbles.trace" -f 20 --look corpus/glx/marbles.look.yaml --samples 16 --rays 32 -o "$out/frames/marbles.####.exr"
"$1/relume" film "$out/frames" -o "$out/marbles.webm"
cp "$out/marbles.jpg" corpus/picture.jpg
ls -l corpus/picture.jpg
