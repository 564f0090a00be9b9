#!/usr/bin/env bash
# What the action does once the program is installed: each check that is asked for runs on all files, and the status tells
# whether all passed.
#
# FILES has the designs, a pattern each, CHECKS the names of the checks; SARIF names a file for the findings, JUNIT a
# folder for what was checked, or nothing.
set -euo pipefail

shopt -s globstar nullglob
# Patterns are meant to be expanded.
# shellcheck disable=SC2206
files=(${FILES:-**/*.sense})
if ((${#files[@]} == 0)); then
    echo "::error::no file fits ${FILES:-**/*.sense}"
    exit 2
fi
status=0

# checked NAME COMMAND...: runs it, and goes on.
checked() {
    local name=$1
    shift
    echo "::group::$name"
    "$@" || {
        status=1
        echo "::error::$name failed"
    }
    echo "::endgroup::"
}

# The tests of a file; the results are for people, or for a build server.
# shellcheck disable=SC2317 # `checked` calls it.
tested() {
    local name=${1%.sense}
    if [[ -n ${JUNIT:-} ]]; then
        sensedsl test "$1" --format junit > "$JUNIT/test-${name//\//-}.xml"
    else
        sensedsl test "$1"
    fi
}

if [[ -n ${SARIF:-} ]]; then
    # 1 means that there are findings, which are what is wanted here; 2 that it was called wrongly.
    found=0
    sensedsl check --format sarif "${files[@]}" > "$SARIF" || found=$?
    if ((found > 1)) || [[ ! -s $SARIF ]]; then
        echo "::error::the findings could not be written to $SARIF"
        exit 2
    fi
fi
if [[ -n ${JUNIT:-} ]]; then
    mkdir -p "$JUNIT"
    found=0
    sensedsl check --format junit "${files[@]}" > "$JUNIT/check.xml" || found=$?
    if ((found > 1)) || [[ ! -s $JUNIT/check.xml ]]; then
        echo "::error::the results could not be written to $JUNIT"
        exit 2
    fi
fi
for check in ${CHECKS:-check fmt}; do
    case $check in
        check) checked check sensedsl check --format github "${files[@]}" ;;
        fmt) checked fmt sensedsl fmt --check "${files[@]}" ;;
        simulate)
            for file in "${files[@]}"; do
                results=()
                if [[ -n ${JUNIT:-} ]]; then
                    name=${file%.sense}
                    results=(--junit "$JUNIT/simulate-${name//\//-}.xml")
                fi
                checked "simulate $file" sensedsl simulate "$file" --judge "${results[@]}"
            done
            ;;
        test)
            for file in "${files[@]}"; do
                # A file without tests has nothing to hold a board to.
                grep -Eq '^[[:space:]]*test[[:space:]]' "$file" || continue
                checked "test $file" tested "$file"
            done
            ;;
        generate)
            for file in "${files[@]}"; do
                checked "generate $file" sensedsl generate "$file" -o "${file%.sense}" --check
            done
            ;;
        *)
            echo "::error::there is no check $check: check, fmt, simulate, test, generate"
            exit 2
            ;;
    esac
done
exit "$status"
