#!/bin/sh
# packaging/install.sh install|uninstall BUILD PREFIX [DESTDIR]: install everything, or remove it again.
#
# Both use one list, so nothing is left behind. Files appear complete: install(1) beside the target, then rename.
set -eu
cd "$(dirname "$0")/.."
verb=$1 build=$2 prefix=$3 root=${4-}$3

# place MODE FILE NAME: NAME is relative to the prefix.
place() {
	if [ "$verb" = uninstall ]; then
		rm -f "$root/$3"
		# Remove folders that belong only to Relume, once empty.
		case $3 in
		lib/relume/lib/*) rmdir "$root/${3%/*}" "$root/lib/relume/lib" 2>/dev/null || : ;;
		share/doc/relume/*) (folder=${3%/*} && cd "$root/share/doc" && rmdir -p "${folder#share/doc/}") 2>/dev/null || : ;;
		lib/relume/* | share/relume/*) rmdir "$root/${3%/*}" 2>/dev/null || : ;;
		esac
		return
	fi
	mkdir -p "$root/${3%/*}"
	install -m "$1" "$2" "$root/$3.new"
	mv -f "$root/$3.new" "$root/$3"
}

# place_page NAME: a page of $documents. Links to files that only the source has become plain text.
place_page() {
	script=''
	for target in $(grep -o ']([^)# ]*' "$1" | cut -c 3- | grep -v '^http'); do
		case " $documents " in
		*" $(realpath -m --relative-to=. "${1%"${1##*/}"}$target") "*) ;;
		*) script="$script;s|\\[\\([^]]*\\)\\](${target}[^)]*)|\\1|g" ;;
		esac
	done
	sed "${script#;}" "$1" >"$build/page.md"
	place 644 "$build/page.md" "share/doc/relume/$1"
}

version=$(cat VERSION)
sed "s|@PREFIX@|$prefix|; s|@VERSION@|$version|" packaging/relume.pc.in >"$build/relume.pc"
sed "s|@PREFIX@|$prefix|; s|@VERSION@|$version|" packaging/relume-rays.pc.in >"$build/relume-rays.pc"

place 755 "$build/relume" bin/relume
place 644 "$build/visual/libGL.so.1" lib/relume/visual/libGL.so.1 # before its neighbours: their folder is removed with the last of them
place 644 "$build/librelume.so" lib/relume/librelume.so
# The recorder for 32-bit programs, if `make i386` has built it: the loader then picks between two folders (capture/record.c).
i386=lib/i386-linux-gnu/librelume.so
if [ "$verb" = uninstall ] || [ -e "$build/$i386" ]; then
	place 644 "$build/$i386" "lib/relume/$i386"
	place 644 "$build/librelume.so" lib/relume/lib/x86_64-linux-gnu/librelume.so
fi
place 644 "$build/relume-oiio.so" lib/relume/relume-oiio.so
place 644 "$build/librelume-rays.so" lib/relume/librelume-rays.so
place 644 capture/relume.h include/relume.h
place 644 verbs/query/relume-rays.h include/relume-rays.h
place 644 "$build/relume.pc" share/pkgconfig/relume.pc
place 644 "$build/relume-rays.pc" share/pkgconfig/relume-rays.pc
place 644 diff/score/score.schema.json share/relume/score.schema.json
documents=$(echo LICENSE README.md CHANGELOG.md CONTRIBUTING.md HACKING.md SECURITY.md docs/*.md corpus/picture.jpg docs/gallery/*)
for document in $documents; do
	case $document in
	*.md) place_page "$document" ;;
	*) place 644 "$document" "share/doc/relume/$document" ;;
	esac
done
for page in "$build"/pages/man/*.[15]; do
	place 644 "$page" "share/man/man${page##*.}/${page##*/}"
done
for example in corpus/hooks/*.cl corpus/hooks/*.yaml; do
	place 644 "$example" "share/doc/relume/examples/${example#corpus/}"
done
for recipe in packaging/recipes/*; do
	place 644 "$recipe" "share/doc/relume/examples/ci/${recipe##*/}"
done
place 644 "$build/pages/bash/relume" share/bash-completion/completions/relume
place 644 "$build/pages/zsh/_relume" share/zsh/site-functions/_relume
place 644 "$build/pages/fish/relume.fish" share/fish/vendor_completions.d/relume.fish
