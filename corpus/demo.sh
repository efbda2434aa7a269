#!/bin/sh
# corpus/demo.sh BUILD (as `make demo`): record marbles on a board, ray trace the recording, score it, say where to look.
# Every stage prints what it did and how long it took; what it said in detail is in BUILD/demo/log.
set -u
cd "$(dirname "$0")/.." || exit 5
build=$1
out=$build/demo
make=${MAKE:-make}
frames=60

now() { date +%s.%N; }

# stage NAME CMD...: run a command, keep what it prints; NAME, seconds and $summary on one line.
stage() {
	name=$1
	shift
	printf '%-9s' "$name"
	begin=$(now)
	"$@" >"$out/log/$name" 2>&1
	code=$?
	seconds=$(echo "$begin $(now)" | awk '{ printf "%.1f", $2 - $1 }')
	if [ "$code" != 0 ]; then
		echo "failed after $seconds s, exit code $code:"
		cat "$out/log/$name"
		exit "$code"
	fi
	printf '%6s s   ' "$seconds"
}

rm -rf "$out"
mkdir -p "$out/log" "$out/frames"

stage install "$make" --no-print-directory deps-demo BUILD="$build"
sed -n 's/^installing://p' "$out/log/install" | tr -s ' ' '\n' | awk 'NF { n++ } END { print n ? n " packages and what they need" : "nothing, all is there" }'
touch "$out/log/begun"
stage build "$make" --no-print-directory -j"$(nproc)" all "$build/corpus/glx/marbles" BUILD="$build"
echo "$(find "$build" -name '*.o' -newer "$out/log/begun" | wc -l) files compiled"
stage record tests/xvfb.sh "$build/relume" record -o "$out/marbles.trace" --ref color,depth --quit-after $frames -- "$build/corpus/glx/marbles" --size 400x300
echo "$frames frames of marbles on a board, with reference colour and depth"
stage render "$build/relume" render "$out/marbles.trace" --look corpus/glx/marbles.look.yaml --rays 8 -o "$out/frames/marbles.####.exr"
echo "$(ls "$out/frames" | wc -l) frames ray traced to OpenEXR, on $("$build/relume" devices | head -n 1)"
stage film "$build/relume" film "$out/frames" -o "$out/marbles.webm" --caption marbles
echo "what OpenGL drew beside the traced frames, $(wc -c <"$out/marbles.webm") bytes"
stage score "$build/relume" diff "$out/marbles.trace" "$out/frames" --report "$out/report" --film "$out/marbles.webm"
echo "$(tail -n 1 "$out/log/score")"

cat <<END

Raster frame, gl, beauty and difference side by side, and the film:
    $out/report/index.html
    $out/report/sheet.png
The frames:
    $out/frames/marbles.0000.exr ...
Another program: build/relume record --ref color,depth -- PROGRAM; build/relume help lists the rest.
END
