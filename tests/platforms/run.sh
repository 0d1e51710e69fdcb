# Sourced by tests/platforms.sh: what is built, run and compared on each platform.
# shellcheck shell=sh disable=SC2154

# What is compared: programs that write their results into a folder.
compared="bar_on_plane bolted_junction two_blocks"

# This machine's programs, and their results.
native() {
    : >"$work/table"
    configured c_examples "$work/native" && cmake --build "$work/native" --target $compared >"$work/log" 2>&1 ||
        { tail -n 20 "$work/log"; return 1; }
    results native ""
}

# configured SOURCE FOLDER OPTION...
configured() {
    source=$1
    folder=$2
    shift 2
    cmake -S "$root/$source" -B "$folder" "$@" >"$work/log" 2>&1 || { tail -n 20 "$work/log"; return 1; }
}

# results PLATFORM RUNNER: what the programs write there, in the folder `out` of the platform.
results() {
    mkdir -p "$work/$1/out"
    for program in $compared; do
        file=./$program
        [ ! -f "$work/$1/$program.exe" ] || file=$file.exe
        # shellcheck disable=SC2086 # a program or none
        (cd "$work/$1" && $2 "$file" out >"out/$program.txt" 2>&1) ||
            { tail -n 5 "$work/$1/out/$program.txt"; say "$1: $program has failed"; return 1; }
    done
}

# The digits of the paper's Table 1 as the program prints them.
table_of_the_bar() {
    tr -d '\r' <"$work/$1/out/bar_on_plane.txt" | grep -E '^ *[0-9]+ (open|slip|stick) '
}

# agree PLATFORM: its results are this machine's.
agree() {
    apart=0
    for file in "$work"/native/out/*.csv; do
        name=$(basename "$file")
        worst=$(awk -F ', *' -f "$here/compare.awk" "$file" "$work/$1/out/$name") ||
            { say "$1: $name differs: $worst"; return 1; }
        apart=$(printf '%s\n%s\n' "$apart" "$worst" | sort -g | tail -n 1)
    done
    table_of_the_bar native >"$work/expected"
    table_of_the_bar "$1" | diff "$work/expected" - || { say "$1: the bar's digits are others"; return 1; }
}

# programs PLATFORM RUNNER CMAKE_OPTION...: all C programs but tests named in `too_long`, then the comparison.
too_long=
programs() {
    platform=$1
    runner=$2
    shift 2
    configured c_examples "$work/$platform" "-DSIGNORINI_BUILT=$built" "-DCMAKE_CROSSCOMPILING_EMULATOR=$runner" "$@" || return 1
    cmake --build "$work/$platform" >"$work/$platform.log" 2>&1 ||
        { grep -B 2 -A 6 -i 'error' "$work/$platform.log" | head -n 40; return 1; }
    (cd "$work/$platform" && ctest --timeout 3000 --output-on-failure ${too_long:+-E "$too_long"}) \
        >"$work/$platform.log" 2>&1
    passed=$(grep -c 'Test .*Passed' "$work/$platform.log")
    grep -e '\*\*\*' "$work/$platform.log"
    lost=$(grep -c 'Test .*\*\*\*' "$work/$platform.log")
    results "$platform" "$runner" && agree "$platform" || return 1
    printf '%-8s C: %s programs passed, %s failed; results off by at most %s\n' "$platform" "$passed" "$lost" "$apart" \
        >>"$work/table"
    [ "$passed" -gt 0 ] && [ "$lost" -eq 0 ]
}

# fortran PLATFORM COMPILER RUNNER: all Fortran programs.
fortran() {
    if FC=$2 RUNNER=$3 BUILT=$built WORK=$work/$1/fortran sh "$root/tests/fortran.sh" >"$work/$1.fortran.log" 2>&1; then
        printf '%-8s Fortran: %s programs passed\n' "$1" "$(find "$work/$1/fortran" -name '*.out' | wc -l)" >>"$work/table"
    else
        tail -n 20 "$work/$1.fortran.log"
        return 1
    fi
}

# The CMake package, installed for Windows, and programs of tests/install with it: C and Fortran, shared and static.
windows_package() {
    prefix=$work/windows/a\ prefix
    cmake --install "$work/windows" --prefix "$prefix" >"$work/log" 2>&1 &&
        configured tests/install "$work/windows/consumer" "-DCMAKE_PREFIX_PATH=$prefix" "-DEXAMPLES=$root/c_examples" "$@" \
            -DCMAKE_Fortran_COMPILER=x86_64-w64-mingw32-gfortran &&
        cmake --build "$work/windows/consumer" >"$work/log" 2>&1 || { tail -n 20 "$work/log"; return 1; }
    for name in libsignorini.dll.a signorini.lib signorini.def; do
        [ -s "$prefix/lib/$name" ] || { say "windows: $name is not installed"; return 1; }
    done
    cp "$prefix/bin/signorini.dll" "$work/windows/consumer"
    for name in shared static; do
        "$wine" "$work/windows/consumer/$name.exe" >"$work/log" || { say "windows: $name has failed"; return 1; }
    done
    for name in fortran fortran_static fortran_77; do
        "$wine" "$work/windows/consumer/$name.exe" | tr -d '\r' | diff "$work/pairs" - ||
            { say "windows: $name prints something else"; return 1; }
    done
    echo "windows  CMake package: 5 programs, shared and static, with import libraries for MinGW and Microsoft" \
        >>"$work/table"
}

# The README's commands for Windows, with the names that the compilers have here.
windows_readme() {
    awk '/^### On Windows/ { found = 1 } inside && /^```/ { exit } inside { print } found && /^```sh/ { inside = 1 }' \
        "$root/README.md" | sed -e '/^cargo/d' -e 's/^g[a-z]* /x86_64-w64-mingw32-&/' -e "s|target/release|$built|g" \
        -e "s|^$built/first.exe|'$wine' &|" >"$work/commands"
    cat "$work/pairs" "$work/pairs" >"$work/twice"
    (cd "$root" && sh -e "$work/commands") | tr -d '\r' | diff "$work/twice" - ||
        { say "windows: the README's commands print something else"; return 1; }
    echo "windows  README: first.c and first.f by its commands" >>"$work/table"
}

# The names that Intel's compiler gives to entries of Fortran 77: gfortran's object, its one reference renamed.
windows_names() {
    for name in sgsolv SGSOLV; do
        x86_64-w64-mingw32-gfortran -I"$root/include" -c "$root/c_examples/first/first.f" -o "$work/first.o" &&
            x86_64-w64-mingw32-objcopy --redefine-sym "sgsolv_=$name" "$work/first.o" "$work/renamed.o" &&
            x86_64-w64-mingw32-gfortran -static "$work/renamed.o" "$work/windows/signorini.lib" \
                -o "$work/windows/named.exe" || return 1
        "$wine" "$work/windows/named.exe" | tr -d '\r' | diff "$work/pairs" - || { say "windows: no $name"; return 1; }
    done
    echo "windows  Fortran 77 by the names sgsolv and SGSOLV" >>"$work/table"
}

run_windows() {
    library_for x86_64-pc-windows-gnu || return 1
    WINEPREFIX=$work/wine
    WINEDEBUG=-all
    # Wine keeps names of files in the encoding of this.
    LC_ALL=C.UTF-8
    export WINEPREFIX WINEDEBUG LC_ALL
    # Rust's standard library draws random numbers from a DLL that Wine has from version 9 on.
    mkdir -p "$work/wine.dll"
    x86_64-w64-mingw32-gcc -O1 -shared "$here/bcryptprimitives.c" -ladvapi32 -o "$work/wine.dll/bcryptprimitives.dll"
    WINEPATH=Z:$work/wine.dll
    export WINEPATH
    set -- -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_C_COMPILER=x86_64-w64-mingw32-gcc -DCMAKE_EXE_LINKER_FLAGS=-static \
        -DCMAKE_RC_COMPILER=x86_64-w64-mingw32-windres
    programs windows "$wine" -DCMAKE_CXX_COMPILER=x86_64-w64-mingw32-g++ "$@"
    result=$?
    grep '^pair ' "$root/README.md" >"$work/pairs"
    windows_package "$@" && windows_readme && windows_names || result=1
    fortran windows x86_64-w64-mingw32-gfortran "$wine" || result=1
    return $result
}

run_aarch64() {
    CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc
    QEMU_LD_PREFIX=/usr/aarch64-linux-gnu
    export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER QEMU_LD_PREFIX
    library_for aarch64-unknown-linux-gnu || return 1
    say "aarch64: hertz, out_of_memory and reduction_threads SKIPPED: they take hours under qemu"
    too_long='^(hertz|out_of_memory|reduction_threads)$'
    programs aarch64 qemu-aarch64-static -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 \
        -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++
    result=$?
    too_long=
    fortran aarch64 aarch64-linux-gnu-gfortran qemu-aarch64-static || result=1
    return $result
}

# Static programs, with the unwinder that comes with Rust: that of Debian's gcc asks for functions of glibc. So do the
# libraries of its compilers for C++ and Fortran.
run_musl() {
    library_for x86_64-unknown-linux-musl || return 1
    unwinder=$("$RUSTC" --print target-libdir --target x86_64-unknown-linux-musl)/self-contained/libunwind.a
    say "musl: C++ and Fortran SKIPPED: Debian's compilers have libraries for glibc alone"
    programs musl "" -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_C_COMPILER=musl-gcc -DCMAKE_EXE_LINKER_FLAGS=-static \
        "-DCMAKE_C_STANDARD_LIBRARIES=$unwinder" -DCMAKE_CXX_COMPILER=NOTFOUND || return 1
    grep '^pair ' "$root/README.md" >"$work/pairs"
    musl-gcc -static -I"$root/include" "$root/c_examples/first/first.c" "$built/libsignorini.a" \
        "$unwinder" -o "$work/musl/first" &&
        "$work/musl/first" | diff "$work/pairs" - || { say "musl: first.c prints something else"; return 1; }
    echo "musl     README: first.c" >>"$work/table"
}

# Linked and not run: Rust's linker makes the shared library, and zig the C programs, with zig's list of what the
# system's library exports. LLVM's tools do not know the name of the newest processor in it.
run_macos() {
    stubs=$work/macos.sdk
    mkdir -p "$stubs/usr/lib"
    exports=$("$zig" -c 'import os, ziglang; print(os.path.dirname(ziglang.__file__))')/lib/libc/darwin/libSystem.tbd
    for name in System c m; do
        sed 's/arm64e\.x1-/arm64-/g' "$exports" >"$stubs/usr/lib/lib$name.tbd" || return 1
    done
    # The crate `libc` names a library of which nothing is used here.
    printf -- "--- !tapi-tbd\ntbd-version: 4\ntargets: [ x86_64-macos, arm64-macos ]\ninstall-name: %s\n...\n" \
        /usr/lib/libiconv.2.dylib >"$stubs/usr/lib/libiconv.tbd"
    # CMake asks for the version of the system.
    printf '#!/bin/sh\necho 11.0\n' >"$stubs/sw_vers"
    chmod 755 "$stubs/sw_vers"
    PATH=$stubs:$PATH
    CARGO_TARGET_AARCH64_APPLE_DARWIN_LINKER=$here/macos_linker.sh
    CARGO_TARGET_X86_64_APPLE_DARWIN_LINKER=$here/macos_linker.sh
    export CARGO_TARGET_AARCH64_APPLE_DARWIN_LINKER CARGO_TARGET_X86_64_APPLE_DARWIN_LINKER
    macos_programs aarch64 && macos_programs x86_64
}

# macos_programs PROCESSOR: the library is not optimised, which is faster and needs as many functions of the system.
macos_programs() {
    CARGO_PROFILE_RELEASE_OPT_LEVEL=0
    SDKROOT=$stubs
    export CARGO_PROFILE_RELEASE_OPT_LEVEL SDKROOT
    library_for "$1-apple-darwin" || return 1
    unset CARGO_PROFILE_RELEASE_OPT_LEVEL SDKROOT
    installed=$(llvm-objdump --macho --dylib-id "$built/libsignorini.dylib" | tail -n 1)
    [ "$installed" = @rpath/libsignorini.dylib ] || { say "macos: the library's name is $installed"; return 1; }
    SYSTEM=Darwin NM=llvm-nm sh "$root/tests/symbols.sh" "$built/libsignorini.dylib" || return 1
    printf '#!/bin/sh\nexec "%s" -m ziglang cc -target %s-macos "$@"\n' "$zig" "$1" >"$work/macos-$1-cc"
    chmod 755 "$work/macos-$1-cc"
    # Programs are not installed, so the system's tools for that are not needed.
    configured c_examples "$work/macos-$1" "-DSIGNORINI_BUILT=$built" -DCMAKE_SYSTEM_NAME=Darwin \
        "-DCMAKE_SYSTEM_PROCESSOR=$1" "-DCMAKE_C_COMPILER=$work/macos-$1-cc" -DCMAKE_CXX_COMPILER=NOTFOUND \
        -DCMAKE_OSX_SYSROOT= -DCMAKE_INSTALL_NAME_TOOL=false -DCMAKE_LINKER=false || return 1
    cmake --build "$work/macos-$1" >"$work/log" 2>&1 || { grep -i -A 6 error "$work/log" | head -n 40; return 1; }
    llvm-objdump --macho --private-headers "$work/macos-$1/bar_on_plane" | grep -q "path $built " ||
        { say "macos: a program does not know where the library is"; return 1; }
    for library in libsignorini.a libsignorini.dylib; do
        "$work/macos-$1-cc" -I"$root/include" "$root/c_examples/first/first.c" "$built/$library" \
            -o "$work/macos-$1/first" || { say "macos: first.c is not linked with $library"; return 1; }
    done
    printf 'macos    %s: %s C programs linked, not run\n' "$1" \
        "$(find "$work/macos-$1" -maxdepth 1 -type f -perm -u+x | wc -l)" >>"$work/table"
}
