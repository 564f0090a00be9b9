#!/bin/sh
# Writes the manual pages and the completions of a program into a folder, where a system looks for them:
#
#     sh packaging/share.sh PROGRAM FOLDER
set -eu
program=$1
share=$2
rm -rf "$share/man" "$share/bash-completion" "$share/zsh" "$share/fish"
mkdir -p "$share/man/man1" "$share/bash-completion/completions" "$share/zsh/site-functions" "$share/fish/vendor_completions.d"
"$program" --quiet man "$share/man/man1"
"$program" completions bash > "$share/bash-completion/completions/sensedsl"
"$program" completions zsh > "$share/zsh/site-functions/_sensedsl"
"$program" completions fish > "$share/fish/vendor_completions.d/sensedsl.fish"
