#!/bin/sh
# Links for macOS as rustc asks a C compiler to: LLVM's linker, which comes with Rust, gets the linker's options.
#
#     SDKROOT=FOLDER macos_linker.sh OPTION...
#
# SDKROOT has in usr/lib the names of the system's libraries and of what they export.
set -euf

for option; do
    shift
    case $option in
    -Wl,*)
        IFS=,
        # shellcheck disable=SC2086 # several options
        set -- "$@" ${option#-Wl,}
        unset IFS
        ;;
    -mmacosx-version-min=*) set -- "$@" -platform_version macos "${option#*=}" "${option#*=}" ;;
    -dynamiclib) set -- "$@" -dylib ;;
    -nodefaultlibs) ;;
    *) set -- "$@" "$option" ;;
    esac
done
linker=$(find "$("${RUSTC:-rustc}" --print sysroot)/lib/rustlib" -path '*/gcc-ld/ld64.lld')
exec "$linker" -syslibroot "$SDKROOT" "$@"
