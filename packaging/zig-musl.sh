#!/bin/sh
# A linker for x86_64-unknown-linux-musl: the C compiler of Zig (`pip install ziglang`), which brings musl along. Rust
# names objects and libraries of its own musl, which Zig has under other names.
for argument in "$@"; do
    shift
    case $argument in
        -lgcc_s | -lgcc_eh | -lgcc) argument=-lunwind ;;
        --target=* | -m64 | -nostartfiles | *self-contained/*crt*.o) continue ;;
        *rcrt1.o | *crt1.o | *crti.o | *crtn.o | *crtbegin*.o | *crtend*.o) continue ;;
    esac
    set -- "$@" "$argument"
done
exec python3 -m ziglang cc -target x86_64-linux-musl "$@"
