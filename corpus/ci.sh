#!/bin/sh
# corpus/ci.sh [-n NAME] [-f FRAMES] [-k KEPT] [-b BASELINE] -- PROGRAM [ARGUMENTS]
# What a continuous integration runs to notice that one picture of an OpenGL program changed:
#
#   record   only when the program or its arguments changed since the last run
#   render   only frames that are not there yet, or were made from another recording, or by another version of Relume
#   gate     every frame against what the program itself showed, and against the approved frames
#   keep     the page, JUnit XML, a summary in Markdown and all figures, whatever came out
#
# KEPT (default: ci) is a folder that the CI server keeps between runs; BASELINE (default: approved) lies in the repository.
# Exit codes are those of `relume diff`: 0 passed, 1 a picture changed, 4 frames that nobody has approved yet.
# RELUME names the command where it is not in PATH. The program needs a display: on a server, xvfb-run -a corpus/ci.sh ...
set -u
name='' frames=10 kept=ci baseline=approved
relume=${RELUME:-relume}
while getopts n:f:k:b: option; do
	case $option in
	n) name=$OPTARG ;;
	f) frames=$OPTARG ;;
	k) kept=$OPTARG ;;
	b) baseline=$OPTARG ;;
	*) exit 2 ;;
	esac
done
shift $((OPTIND - 1))
[ $# -gt 0 ] || { echo "usage: ci.sh [-n NAME] [-f FRAMES] [-k KEPT] [-b BASELINE] -- PROGRAM [ARGUMENTS]" >&2; exit 2; }
program=$(command -v "$1") || { echo "ci.sh: there is no program '$1'" >&2; exit 5; }
name=${name:-${1##*/}}
out=$kept/$name
mkdir -p "$out" || exit 5

{ sha256sum <"$program"; printf '%s\n' "$frames" "$@"; } >"$out/program.now"
if cmp -s "$out/program.now" "$out/program"; then
	echo "record   nothing: the program is the same"
else
	echo "record   $frames frames"
	"$relume" record -o "$out/$name.trace" --ref color,depth --quit-after "$frames" -- "$@" || exit 5
	mv "$out/program.now" "$out/program"
fi

"$relume" render "$out/$name.trace" -o "$out/frames/$name.####.exr" --skip-existing --allow-incomplete || exit
rm -f "$out/summary.md"
"$relume" diff --baseline "$baseline/$name" --report "$out/report" --junit "$out/junit.xml" --json "$out/scores.json" \
	--markdown "${GITHUB_STEP_SUMMARY:-$out/summary.md}" "$out/$name.trace" "$out/frames"
code=$?
echo "page     $out/report/index.html"
[ "$code" != 4 ] || echo "approve  $relume approve $out/frames $baseline/$name"
exit "$code"
