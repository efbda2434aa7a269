#!/bin/sh
# tests/fresh.sh BUILD (as `make show-fresh`): the two commands of README.md on a fresh Debian 12.
#
# Makes a chroot with debootstrap's minimal variant and only `make` added, clones the committed project into it, and
# runs `make demo` twice and `make check` there as root. The second demo must install and compile nothing.
# Needs root and debootstrap; takes minutes and 3 GB below BUILD. FRESH_MIRROR names another Debian mirror.
set -u
cd "$(dirname "$0")/.." || exit 5
build=$(mkdir -p "$1/fresh" "$1/show" && cd "$1" && pwd) || exit 5
root=$build/fresh/root
log=$build/fresh

clean_up() {
	for mount in proc dev/pts dev sys; do
		mountpoint -q "$root/$mount" && umount -R "$root/$mount"
	done
	mountpoint -q "$root/dev" || mountpoint -q "$root/sys" || rm -rf "$root"
}
trap clean_up EXIT
trap 'exit 130' INT TERM

fail() {
	echo "fresh: $1" >&2
	exit 1
}

inside() {
	chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -c "cd /root/relume && $1" \
		</dev/null >"$log/$2.log" 2>&1
}

clean_up
# shellcheck disable=SC2086 # no mirror: no argument
debootstrap --variant=minbase --include=make bookworm "$root" ${FRESH_MIRROR:-} >"$log/debootstrap.log" 2>&1 ||
	fail "debootstrap failed: $log/debootstrap.log"
mount -t proc proc "$root/proc" && mount --bind /dev "$root/dev" && mount --bind /dev/pts "$root/dev/pts" &&
	mount --rbind --make-rslave /sys "$root/sys" || fail "proc, dev and sys cannot be mounted"
cp /etc/resolv.conf "$root/etc/"
git clone -q . "$root/root/relume" || fail "the project cannot be cloned"

inside "make demo" demo1
first=$?
inside "make demo" demo2
second=$?
inside "make check" check
check=$?
counted=$(grep -E '^[0-9]+ passed, ' "$log/check.log" | tail -n 1)
cp -r "$root/root/relume/build/demo" "$log/" 2>/dev/null

grep -q '^install .*nothing' "$log/demo2.log" && installed=nothing || installed=something
compiled=$(sed -n 's/^build .*  \([0-9]*\) files compiled$/\1/p' "$log/demo2.log")
/usr/bin/python3 - "$build/show/fresh.json" "$first" "$second" "$installed" "${compiled:-?}" "$check" "$counted" <<'END'
import json, sys
path, first, second, installed, compiled, check, counted = sys.argv[1:]
rows = [("make demo on a fresh Debian 12", f"exit code {first}", "exit code 0", first == "0"),
        ("make demo again", f"exit code {second}, installs {installed}, compiles {compiled} files",
         "exit code 0, installs nothing, compiles 0 files", (second, installed, compiled) == ("0", "nothing", "0")),
        ("make check there", f"exit code {check}: {counted}", "exit code 0", check == "0")]
rows = [{"what": what, "figure": figure, "bar": bar, "peer": None, "passed": good} for what, figure, bar, good in rows]
json.dump({"name": "fresh", "command": "make show-fresh", "rows": rows}, open(path, "w"), indent=1)
print(*(f"{row['what']}: {row['figure']} (bar: {row['bar']})" for row in rows), sep="\n")
sys.exit(not all(row["passed"] for row in rows))
END
