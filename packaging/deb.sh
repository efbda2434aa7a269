#!/bin/sh
# packaging/deb.sh BUILD (as `make deb`): build the Debian package from a copy of the tree, and check it by lintian.
# packaging/deb.sh BUILD i386 (as `make deb-i386`): on amd64, the package with the recorder for 32-bit programs.
#
# Leaves BUILD/deb/*.deb or BUILD/deb-i386/*.deb; exits with lintian's code, which reports errors and warnings.
set -eu
cd "$(dirname "$0")/.."
version=$(cat VERSION)
out=$1/deb${2:+-$2}
rm -rf "$out"
mkdir -p "$out/relume-$version"
if git rev-parse --git-dir >/dev/null 2>&1; then
	git ls-files -z --cached --others --exclude-standard
else
	find . -path ./build -prune -o -type f -print0
fi | tar -c --null --files-from=- --ignore-failed-read | tar -x -C "$out/relume-$version"
cd "$out/relume-$version"
mv packaging/debian debian
head -n 1 debian/changelog | grep -q "^relume ($version) " || { echo "debian/changelog does not speak of version $version" >&2; exit 1; }
# -d: the build uses the tools of amd64.
# shellcheck disable=SC2086 # two options
dpkg-buildpackage -us -uc -b ${2:+-a$2 -d} >../build.log 2>&1 || { tail -n 30 ../build.log >&2; exit 5; }
cd ..
for package in *.deb; do echo "$out/$package"; done
lintian --fail-on error,warning --display-info ./*.changes
