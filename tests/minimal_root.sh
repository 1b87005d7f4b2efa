#!/bin/sh
# The proof of the two commands: a minimal Debian 12 made from nothing, the committed HEAD cloned
# into it, and COMMAND run there. As root:
#
#   tests/minimal_root.sh [DIR [COMMAND]]
#
# DIR, absent or empty, is kept; without it a temporary directory is used and removed in the end.
# The new root gets from this machine only what tells it how to reach its packages: the mirror
# ($MIRROR, if set, instead), resolver, proxies, locally trusted certificates, pip's index.
set -eu

command=${2:-'./dev demo --brief && ./dev test'}
repository=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)

die() {
    echo "minimal_root: $*" >&2
    exit 2
}

[ "$(id -u)" -eq 0 ] || die "needs root, for debootstrap and chroot"
for tool in debootstrap git unshare; do
    command -v "$tool" >/dev/null || die "needs $tool"
done

# --- A directory ---------------------------------------------------------------------------------

if [ -n "${1:-}" ]; then
    mkdir -p "$1"
    [ -z "$(ls -A "$1")" ] || die "$1 is not empty"
    root=$(CDPATH='' cd -- "$1" && pwd)
else
    root=$(mktemp -d "${TMPDIR:-/var/tmp}/minimal_root.XXXXXX")
    # Safe: nothing of this machine is ever mounted below it, see unshare.
    trap 'rm -rf --one-file-system "$root"' EXIT
    trap 'exit 130' INT TERM
fi

# --- Debian --------------------------------------------------------------------------------------

# shellcheck disable=SC2016 # expanded by apt-get
sources=$(apt-get indextargets --format '$(REPO_URI)' \
    'Created-By: Packages' 'Release: bookworm' 'Component: main')
mirror=${MIRROR:-$(echo "$sources" | head -n 1)}
[ -n "$mirror" ] || die "this machine has no source of bookworm packages: set MIRROR"

echo "minimal_root: debootstrap into $root"
include=
case $mirror in https:*) include=--include=ca-certificates ;; esac
log=$(mktemp)
debootstrap --variant=minbase ${include:+"$include"} bookworm "$root" "$mirror" >"$log" 2>&1 ||
    { tail -n 20 "$log" && die "debootstrap failed, see $log"; }
rm "$log"

cp /etc/resolv.conf "$root/etc/resolv.conf"
apt-config dump | grep -iE '^Acquire::.*(Proxy|CaInfo)' >"$root/etc/apt/apt.conf.d/90host" || true

# Certificates that this machine's administrator trusts. minbase has no ca-certificates yet; when
# ./dev brings it, it adds them to the new root's own.
mkdir -p "$root/usr/local/share/ca-certificates"
for certificate in /usr/local/share/ca-certificates/*.crt; do
    [ ! -e "$certificate" ] || cp "$certificate" "$root/usr/local/share/ca-certificates/"
done

# --- The command in it -----------------------------------------------------------------------------

git clone --quiet --no-local "$repository" "$root/thing_kin"
echo "minimal_root: $(git -C "$root/thing_kin" log -1 --format='%h %s'): $command"

# A clean environment but for the ways out. Indexes and wheels that are files of this machine are
# left behind: the new root could not read them.
set -- PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root
for name in http_proxy https_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
    eval "value=\${$name:-}"
    [ -z "$value" ] || set -- "$@" "$name=$value"
done
for key in index-url trusted-host proxy; do
    value=$(pip config get "global.$key" 2>/dev/null) || continue
    set -- "$@" "PIP_$(echo "$key" | tr a-z- A-Z_)=$value"
done

# In namespaces of its own: the mounts and any process left over vanish with it, however it ends.
# shellcheck disable=SC2016 # expanded inside
env -i "$@" unshare --mount --pid --fork --kill-child --mount-proc="$root/proc" sh -c '
    mount -t tmpfs tmpfs "$1/dev/shm"
    exec chroot "$1" sh -c "cd /thing_kin && $2"
' sh "$root" "$command" </dev/null
echo "minimal_root: passed"
