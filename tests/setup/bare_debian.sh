#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# bare_debian.sh DIR [COMMAND...]: whether a stranger with nothing but Debian 12 gets there.
# bare_debian.sh --packages FOLDER DIR: the same with what `cpack` left in FOLDER, instead of a clone.
#
# Makes a minimal Debian 12 in DIR (new or empty), clones the committed state of this repository into it, and
# runs there as root, at 80 columns, all commands of the README in their order, its Python lines too (a night is cut
# to a minute); or each COMMAND given instead, e.g. './run test --matrix'. Of packages: installs them, searches, reports, checks, replays, builds a project with the
# library, runs the headline from Python, and removes them. Prints every command's exit code and time; exits 0 only if all did.
#
# Needs root, debootstrap, git and network; about 2 GB in DIR, and some minutes besides the commands' own
# time. DIR stays, to be looked at and removed with rm -rf. Nothing stays mounted, however the script ends.
# Packages come from the mirror of this machine's apt, or from $MIRROR.
set -euo pipefail

readonly suite=bookworm

die() {
  printf 'bare_debian: %s\n' "$*" >&2
  exit 2
}

# The first source of this machine that has Debian 12; asked of apt, which reads every form of sources.
mirror_of_this_machine() {
  apt-get update --print-uris 2>/dev/null |
    sed -n "s|^'\(.*\)/dists/$suite/InRelease'.*|\1|p" | sed -n 1p
}

# What apt needs to reach the mirror from here: names, proxies, lenience about dates, certificates.
copy_network_settings() {
  local chroot=$1
  cp -L /etc/resolv.conf /etc/hosts "$chroot/etc/"
  apt-config dump --no-empty | grep -E '^Acquire::(https?::|Check-|Retries)' | grep -v Proxy-Auto-Detect \
    >"$chroot/etc/apt/apt.conf.d/90host" || true
  if [[ -d /usr/local/share/ca-certificates ]]; then
    mkdir -p "$chroot/usr/local/share"
    cp -RL /usr/local/share/ca-certificates "$chroot/usr/local/share/"
  fi
  if [[ -x $chroot/usr/sbin/update-ca-certificates ]]; then
    inside "$chroot" update-ca-certificates >/dev/null
  fi
}

make_debian() {
  local chroot=$1 mirror=$2 options=(--variant=minbase)
  [[ $mirror != https:* ]] || options+=(--include=ca-certificates)
  debootstrap "${options[@]}" "$suite" "$chroot" "$mirror" >"$chroot.log" 2>&1 ||
    die "debootstrap failed; see $chroot.log"
  rm -f -- "$chroot.log"
  mount -t proc proc "$chroot/proc"
  mount -t tmpfs tmpfs "$chroot/dev/shm"
  copy_network_settings "$chroot"
}

# Runs a command in the chroot with nothing of this machine's environment but its proxies.
inside() {
  local chroot=$1 variable proxies=()
  for variable in http_proxy https_proxy no_proxy; do
    [[ -z ${!variable-} ]] || proxies+=("$variable=${!variable}")
  done
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root CI=true COLUMNS=80 "${proxies[@]}" \
    chroot "$chroot" "${@:2}" </dev/null
}

# What a package has to do, each in an empty folder of the chroot.
readonly package_jobs=(
  'apt-get update -qq && apt-get install -qq -y --no-install-recommends ./stiction_*.deb python3 >/dev/null'
  'stiction --version && stiction words >/dev/null'
  'stiction search --minutes 0.3 --generator small integers --contacts 2 --store s.store'
  'stiction report s.store -o report && ls report/index.html'
  'stiction check report/findings/*.certificate.json >/dev/null'
  'python3 /usr/share/stiction/certify/check_certificate.py report/findings/*.certificate.json >/dev/null'
  'stiction replay /usr/share/stiction/corpus/two-contact-cycle.json --step | tail -n 1'
  'stiction solve /usr/share/stiction/corpus/two-contact-cycle.json --method ipopt | head -n 1'
  'stiction bench --suite gate --families tame --json >/dev/null'
  'stiction records >/dev/null && test -e report/frontiers.csv'
  'test -e /usr/share/man/man1/stiction.1.gz && test -e /usr/share/man/man1/stiction-bench.1.gz'
  'apt-get install -qq -y --no-install-recommends ./libstiction-dev_*.deb g++ cmake ninja-build >/dev/null'
  'cmake -S consumer -B consumer/build -G Ninja >/dev/null && ninja -C consumer/build >/dev/null && consumer/build/consumer'
  'apt-get install -qq -y --no-install-recommends ./python3-stiction_*.deb >/dev/null'
  'python3 notebook_test.py /usr/share/doc/python3-stiction/examples/headline.ipynb'
  'python3 -c "import stiction; print(stiction.solve(stiction.Problem([[1]], [-1], 0, [\"frictionless\"]), \"ipopt\").outcome)"'
  'apt-get remove -qq -y python3-stiction >/dev/null && ! python3 -c "import stiction" 2>/dev/null && ! ls /usr/lib/python3/dist-packages/stiction'
  'apt-get remove -qq -y stiction libstiction-dev >/dev/null && ! command -v stiction && ! ls /usr/share/stiction'
)

# The commands of README.md: indented lines that begin with ./run or python3. The lines of its session in Python are
# what `./run python` reads.
readme_commands() {
  sed -nE -e 's/--minutes 480/--minutes 1/' -e '/^    \.\/run python$/d' \
    -e 's/^    ((\.\/run|python3) [^#]*[^# ]) *(#.*)?$/\1/p' "$1"
  printf "printf '%%s\\\\n' %q | ./run python\n" "$(sed -n 's/^    >>> //p' "$1")"
}

# Fails where a line of a text is wider than 80 columns and has a blank at which it could be broken.
fits_the_terminal() {
  awk '{ print } length > 80 && substr($0, 1, 80) ~ /[^ ] [^ ]/ { wide = 1 } END { exit wide }'
}

main() {
  local chroot mirror command start status worst=0 report=() packages= commands
  if [[ ${1-} == --packages ]]; then
    packages=$2
    shift 2
  fi
  (($#)) || die "usage: bare_debian.sh [--packages FOLDER] DIR [COMMAND...]"
  ((EUID == 0)) || die "needs root"
  mkdir -p -- "$1"
  chroot=$(readlink -f -- "$1")
  [[ -z $(ls -A -- "$chroot") ]] || die "$1 is not empty"
  shift
  if [[ -n $packages ]]; then
    (($#)) || set -- "${package_jobs[@]}"
  else
    if ((!$#)); then
      mapfile -t commands < <(readme_commands "$(dirname -- "$0")/../../README.md")
      set -- "${commands[@]}"
    fi
  fi
  mirror=${MIRROR:-$(mirror_of_this_machine)}
  [[ -n $mirror ]] || die "apt knows no source of $suite here; set MIRROR"

  echo "bare_debian: installing $suite from $mirror in $chroot"
  make_debian "$chroot" "$mirror"
  if [[ -n $packages ]]; then
    mkdir "$chroot/root/stiction"
    cp -- "$packages"/*.deb "$chroot/root/stiction/"
    cp -R -- "$(dirname -- "$0")/../install/consumer" "$(dirname -- "$0")/../python/notebook_test.py" \
      "$chroot/root/stiction/"
  else
    git clone --quiet --no-hardlinks -- "$(dirname -- "$0")/../.." "$chroot/root/stiction"
  fi
  for command in "$@"; do
    echo "bare_debian: $command"
    start=$SECONDS status=0
    if [[ $command == "./run test"* || -n $packages ]]; then # ctest and apt have lines of their own width
      inside "$chroot" bash -c "cd /root/stiction && $command" || status=$?
    else
      inside "$chroot" bash -c "cd /root/stiction && $command" | fits_the_terminal || status=$?
    fi
    report+=("exit $status after $((SECONDS - start)) s: $command")
    ((status == 0)) || worst=1
  done
  printf 'bare_debian: %s\n' "${report[@]}"
  return $worst
}

# In a mount namespace of our own, whose mounts end with it.
if [[ -z ${STICTION_OWN_MOUNTS-} && $EUID == 0 ]]; then
  STICTION_OWN_MOUNTS=1 exec unshare --mount --propagation private -- bash "$0" "$@"
fi
main "$@"
