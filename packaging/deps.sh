#!/bin/sh
# packaging/deps.sh list|need|install GROUP... [-- PACKAGE...]
#
#   list      print the packages of groups (packaging/deps.txt), as this release names them
#   need      install nothing; if packages are missing, list them, print the command that installs them, and exit with 1
#   install   install missing packages, with sudo unless run by root
#
# Needs a POSIX shell, awk, and apt. Without dpkg, `need` passes: the compiler then reports what is missing.
set -u
list=$(dirname "$0")/deps.txt
verb=$1
shift

groups='' more=''
while [ $# -gt 0 ]; do
	[ "$1" != -- ] || { shift; more=$*; break; }
	groups="$groups $1"
	shift
done

# The entries of the groups, one per line, without duplicates.
entries() {
	awk -v groups="$groups" -v more="$more" '
		/^[a-z0-9-]+:/ { name = $1; sub(":", "", name); $1 = ""; has[name] = has[name] " " $0 }
		function expand(name, parts, n, i) {
			if (done[name]++) return
			n = split(has[name], parts, " ")
			for (i = 1; i <= n; i++)
				if (parts[i] ~ /^@/) expand(substr(parts[i], 2)); else if (!seen[parts[i]]++) print parts[i]
		}
		END {
			n = split(groups, names, " ")
			for (k = 1; k <= n; k++) expand(names[k])
			n = split(more, names, " ")
			for (k = 1; k <= n; k++) if (!seen[names[k]]++) print names[k]
		}' "$list"
}

is_installed() {
	case $installed in *" $1 "*) return 0 ;; *) return 1 ;; esac
}

# Queries apt once the first missing package is found; this takes a second.
is_known() {
	# shellcheck disable=SC2086
	: "${known:= $(apt-cache --no-all-versions show $names 2>/dev/null | sed -n 's/^Package: //p' | tr '\n' ' ') }"
	case $known in *" $1 "*) return 0 ;; *) return 1 ;; esac
}

# choose: pick for each entry the package that is installed, or that the release has; sets $all, $missing, $lacking.
choose() {
	names=$(entries | sed 's/?$//' | tr '|' '\n')
	# shellcheck disable=SC2086 # one word a package
	installed=" $(dpkg-query -W -f '${db:Status-Status} ${Package} ${Provides}\n' $names 2>/dev/null |
		sed -n 's/^installed //p' | sed 's/([^)]*)//g; s/,//g' | tr '\n' ' ') "
	known='' all='' missing='' lacking=''
	for entry in $(entries); do
		chosen=''
		for name in $(echo "${entry%\?}" | tr '|' ' '); do
			if is_installed "$name"; then chosen=$name; break; fi
		done
		if [ -n "$chosen" ]; then all="$all $chosen"; continue; fi
		for name in $(echo "${entry%\?}" | tr '|' ' '); do
			if is_known "$name"; then chosen=$name; break; fi
		done
		if [ -z "$chosen" ] && [ "$entry" != "${entry%\?}" ]; then
			lacking="$lacking ${entry%\?}"
			continue
		fi
		: "${chosen:=${entry%%|*}}"
		all="$all $chosen"
		missing="$missing $chosen"
	done
}

say_lacking() {
	for name in $lacking; do
		echo "this release lacks $name: $(sed -n "s/^lacking $name: //p" "$list")"
	done
}

case $verb in
list)
	choose
	printf '%s\n' $all
	;;
need)
	command -v dpkg-query >/dev/null || exit 0
	choose
	[ -n "$missing" ] || exit 0
	cat >&2 <<-END
	packages are missing:$missing
	install them with 'make deps-build', or with

	    apt-get install --no-install-recommends$missing

	END
	exit 1
	;;
install)
	[ "$(id -u)" = 0 ] && sudo='' || sudo=sudo
	choose
	if [ -z "$missing" ] && [ -z "$lacking" ]; then exit 0; fi
	export DEBIAN_FRONTEND=noninteractive
	# An unreadable index does not stop packages that are known without it.
	$sudo apt-get -q update >&2
	choose
	say_lacking
	[ -n "$missing" ] || exit 0
	echo "installing:$missing"
	# shellcheck disable=SC2086
	$sudo apt-get -q -y -o DPkg::Lock::Timeout=300 --no-install-recommends install $missing >&2
	;;
*)
	echo "usage: packaging/deps.sh list|need|install GROUP... [-- PACKAGE...]" >&2
	exit 2
	;;
esac
