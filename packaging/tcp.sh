#!/bin/sh
# Whether a simulated board is found over TCP: the first program watches the board of the second one.
#
#     sh packaging/tcp.sh MONITOR SIMULATOR...
set -eu
monitor=$1
shift
"$@" simulate fig2.sense --tcp 47291 --seconds 60 > board.log 2>&1 &
board=$!
trap 'kill "$board" 2>/dev/null || true' EXIT
tries=0
until grep -q 'tcp:127.0.0.1:47291' board.log; do
    tries=$((tries + 1))
    [ "$tries" -lt 100 ] || { cat board.log && exit 1; }
    sleep 0.2
done
"$monitor" monitor tcp:127.0.0.1:47291 fig2.sense --seconds 3 --format lines --no-reconnect > values.txt 2> said.txt
grep -q USRear values.txt
grep 'firmware and design agree' said.txt
