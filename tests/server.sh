# Sourced by xvfb.sh and wayland.sh, which describe their usage in `usage`: a scratch folder, and a server that ends
# with the command.
set -u

if [ $# -eq 0 ]; then
	echo "usage: $usage" >&2
	exit 2
fi

scratch=$(mktemp -d) || exit 5
server=
# shellcheck disable=SC2317 # reached by the trap
clean_up() {
	[ -n "$server" ] && kill "$server" 2>/dev/null && wait "$server" 2>/dev/null
	rm -rf "$scratch"
}
trap clean_up EXIT
trap 'exit 129' HUP
trap 'exit 130' INT
trap 'exit 143' TERM
mkdir -m 700 "$scratch/home" "$scratch/runtime" || exit 5
export HOME="$scratch/home" XDG_RUNTIME_DIR="$scratch/runtime" LIBGL_ALWAYS_SOFTWARE=1
unset XDG_CACHE_HOME XDG_CONFIG_HOME XDG_DATA_HOME

# did_not_start WHAT: the server is missing; prints the reason and exits.
did_not_start() {
	echo "$0: $1 did not start:" >&2
	cat "$scratch/log" >&2
	exit 5
}
