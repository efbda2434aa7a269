#!/bin/sh
# corpus/demo.sh BUILD (as `make demo`): record marbles on a board, ray trace the recording, score it, say where to look.
# Every stage prints a line as it begins, and one with its time and result; its own output is in BUILD/demo/log.
set -u
cd "$(dirname "$0")/.." || exit 5
build=$1
out=$build/demo
make=${MAKE:-make}
frames=60

now() { date +%s.%N; }

# stage NAME PLAN CMD...: print NAME and PLAN, run a command and keep what it prints; then begin a line with NAME and
# seconds, which the caller ends with the result.
stage() {
	name=$1
	printf '%-9s   ...     %s\n' "$name" "$2"
	shift 2
	begin=$(now)
	"$@" >"$out/log/$name" 2>&1
	code=$?
	seconds=$(echo "$begin $(now)" | awk '{ printf "%.1f", $2 - $1 }')
	if [ "$code" != 0 ]; then
		printf '%-9s failed after %s s, exit code %s:\n' "$name" "$seconds" "$code"
		cat "$out/log/$name"
		exit "$code"
	fi
	printf '%-9s%6s s   ' "$name" "$seconds"
}

rm -rf "$out"
mkdir -p "$out/log" "$out/frames"

stage install 'Debian packages that are missing' "$make" --no-print-directory deps-demo BUILD="$build"
sed -n 's/^installing://p' "$out/log/install" | tr -s ' ' '\n' | awk 'NF { n++ } END { print n ? n " packages and what they need" : "nothing: everything is installed" }'
touch "$out/log/begun"
stage build 'Relume and marbles, a program to record; a few minutes the first time' \
	"$make" --no-print-directory -j"$(nproc)" all "$build/corpus/glx/marbles" BUILD="$build"
echo "$(find "$build" -name '*.o' -newer "$out/log/begun" | wc -l) files compiled"
stage record "$frames frames of marbles" tests/xvfb.sh "$build/relume" record -o "$out/marbles.trace" --ref color,depth --quit-after $frames -- "$build/corpus/glx/marbles" --size 400x300
echo "$frames frames of marbles on a board, with reference colour and depth"
stage render "$frames frames; the first ones wait while OpenCL kernels are compiled" \
	"$build/relume" render "$out/marbles.trace" --look corpus/glx/marbles.look.yaml --rays 8 -o "$out/frames/marbles.####.exr"
echo "$(ls "$out/frames" | wc -l) frames ray traced to OpenEXR, on $("$build/relume" devices | head -n 1)"
stage film 'a film of the frames' "$build/relume" film "$out/frames" -o "$out/marbles.webm" --caption marbles
echo "what OpenGL drew beside the traced frames, $(wc -c <"$out/marbles.webm") bytes"
stage score 'every pixel, against what OpenGL drew' "$build/relume" diff "$out/marbles.trace" "$out/frames" --report "$out/report" --film "$out/marbles.webm"
echo "$(tail -n 1 "$out/log/score")"

cat <<END

Raster frame, gl, beauty and difference side by side, and the film:
    $out/report/index.html
    $out/report/sheet.png
The frames:
    $out/frames/marbles.0000.exr ...
Another program: build/relume record --ref color,depth -- PROGRAM; build/relume help lists the rest.
END
