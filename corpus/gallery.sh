#!/bin/sh
# corpus/gallery.sh BUILD (as `make gallery`): the pictures of docs/look.md, docs/gallery/*.jpg: frames of the corpus as
# OpenGL drew them, and ray traced.
set -eu
cd "$(dirname "$0")/.."
out=$1/gallery

# picture NAME FRAME OPTIONS PROGRAM ARGS...: options of `relume render`
picture() {
	name=$1 frame=$2 options=$3 program=$4
	shift 4
	tests/xvfb.sh "$relume" record -o "$out/$name.trace" --quit-after $((frame + 1)) -- \
		"$build/corpus/$program" --size 400x300 "$@"
	# shellcheck disable=SC2086 # several words
	"$relume" render "$out/$name.trace" -f "$frame" $options -o "$out/$name/####.exr"
	"$relume" film "$out/$name" -o "$out/$name.webm"
	cp "$out/$name.jpg" docs/gallery/
}

build=$1 relume=$1/relume
rm -rf "$out"
mkdir -p "$out" docs/gallery
picture cornell 5 "--mode path --samples 64 --denoise" cornell
picture knot 5 "--look auto --samples 16 --denoise" phong
picture street 20 "--look auto --samples 16 --denoise" street
picture spheres 5 "--look auto --samples 16" spheres
picture facets 5 "--look auto --samples 16 --denoise" facets
ls -l docs/gallery
