#!/bin/sh
# Tries `packaging/Dockerfile` without Docker: does its steps in a root of Debian 12, which is made in FOLDER, wires Fig. 2
# there and, where `CHIBIOS` names a tree, builds its firmware.
#
#     sh packaging/docker.sh FOLDER [CONTEXT]
#
# CONTEXT has what is copied, `target/debian` unless you say. Needs root, and debootstrap.
set -eu
cd "$(dirname "$0")/.."
root=$1
context=${2:-${CARGO_TARGET_DIR:-$PWD/target}/debian}
folder=/
environment=
entry=
rm -rf "$root"
while read -r word rest; do
    case $word in
        '' | '#'*) ;;
        FROM)
            [ "$rest" = debian:12 ] || { echo "a root of $rest is not known here" && exit 2; }
            sh packaging/root.sh "$root"
            ;;
        RUN)
            echo "RUN $rest"
            # Each word of the environment is NAME=VALUE without blanks.
            # shellcheck disable=SC2086
            chroot "$root" env $environment DEBIAN_FRONTEND=noninteractive sh -euc "cd $folder && $rest" > "$root.log" 2>&1 || {
                tail "$root.log" && exit 1
            }
            ;;
        COPY)
            into=${rest##* }
            # The last word is where to, the others may be patterns.
            # shellcheck disable=SC2086
            (cd "$context" && cp ${rest% *} "$root$into")
            ;;
        ENV) environment="$environment $rest" ;;
        WORKDIR)
            folder=$rest
            mkdir -p "$root$folder"
            ;;
        ENTRYPOINT) entry=$(echo "$rest" | tr -d '[]",') ;;
        *) echo "$word is not known here" && exit 2 ;;
    esac
done < packaging/Dockerfile
du -sh "$root"
cp examples/fig2.sense packaging/outputs.sh "$root$folder"
# shellcheck disable=SC2086
chroot "$root" env $environment sh -euc "cd $folder && sh outputs.sh outputs $entry"
if [ -n "${CHIBIOS:-}" ]; then
    mkdir -p "$root/chibios"
    mount --bind "$CHIBIOS" "$root/chibios"
    trap 'umount "$root/chibios"' EXIT
    # shellcheck disable=SC2086
    chroot "$root" env $environment sh -euc "cd $folder && $entry build fig2.sense"
fi
