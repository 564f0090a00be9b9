#!/bin/sh
# What every way to install must give: the outputs for Fig. 2 and the list of boards, in a folder, to be compared with
# `diff -r`. Run where `fig2.sense` is, with the command that runs the program:
#
#     sh packaging/outputs.sh FOLDER sensedsl
#     sh packaging/outputs.sh FOLDER wine sensedsl.exe
#
# Says how many seconds the first picture took.
set -eu
into=$1
shift
rm -rf "$into"
mkdir -p "$into"
began=$(date +%s)
"$@" solve fig2.sense --format svg > "$into/picture.svg" 2> "$into/messages-of-picture.txt"
echo "the first picture: $(($(date +%s) - began)) s"
"$@" solve fig2.sense > "$into/solve.txt" 2> "$into/messages.txt"
"$@" solve fig2.sense --format json > "$into/solve.json" 2> "$into/messages-of-json.txt"
"$@" boards > "$into/boards.txt" 2> "$into/heads.txt"
# The names of folders are printed, so they are the same everywhere.
rm -rf hosts tree
"$@" generate fig2.sense --quiet --target none --without firmware -o hosts 2> "$into/messages-of-hosts.txt"
"$@" generate fig2.sense -o tree > "$into/generate.txt" 2>&1
"$@" generate fig2.sense --quiet -o tree --check 2> "$into/messages-of-check.txt"
# Where an open file cannot be removed, its lock stays.
rm -rf hosts/.sensedsl-work tree/.sensedsl-work
mv hosts tree "$into"
grep -q 'proved optimal' "$into/solve.txt"
grep -q '<svg' "$into/picture.svg"
# Ends of lines are the console's business where the program prints on one; in files they are not.
find "$into" -maxdepth 1 -name '*.txt' -exec sed -i 's/\r$//' {} +
echo "$(find "$into" -type f | wc -l) files"
