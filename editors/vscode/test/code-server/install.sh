#!/bin/sh
# Installs VS Code in a browser beside this file, with the Node.js that it wants; both come from npm. No script of a
# package is run but that of `node`, which puts the program in its place.
set -eu
cd "$(dirname "$0")"
npm ci --ignore-scripts --no-audit --no-fund --loglevel error
npm rebuild node --loglevel error
PATH="$PWD/node_modules/node/bin:$PATH"
# Its own packages are those of its shrinkwrap files, which name more systems than `npm ci` takes.
for folder in lib/vscode lib/vscode/extensions; do
    (cd "node_modules/code-server/$folder" &&
        npm install --omit=dev --ignore-scripts --no-audit --no-fund --loglevel error)
done
