#!/bin/sh
# A Fortran 90 host with MUMPS: Schur complement and condensed loads from MUMPS, contact forces from
# the library, those of the bar that are known.
#
#     sh tests/host_mumps.sh [--require]
#
# Without gfortran or the sequential MUMPS it is skipped and ends with 77; with --require it
# fails. MUMPS names the directory of dmumps_struc.h, default /usr/include; MUMPS_SEQ that of its
# mpif.h.
set -eu
LC_ALL=C
export LC_ALL

script=host_mumps
mumps=${MUMPS:-/usr/include}
sequential=${MUMPS_SEQ:-$mumps/mumps_seq}
missing=
command -v "${FC:-gfortran}" >/dev/null 2>&1 || missing=" gfortran"
[ -f "$mumps/dmumps_struc.h" ] && [ -f "$sequential/mpif.h" ] || missing="$missing libmumps-seq-dev"
if [ -n "$missing" ]; then
    echo "host_mumps: SKIPPED: missing (names of Debian):$missing"
    [ "${1:-}" != --require ] || exit 1
    exit 77
fi
# shellcheck source=tests/fortran/build.sh
. "$(dirname -- "$0")/fortran/build.sh"

hosts=$root/c_examples/hosts/fortran
for kind in static shared; do
    compile "mumps_schur_$kind" "$kind" "-I$sequential" "-I$mumps" "$root/include/signorini.f90" \
        "$hosts/bar_mesh.f90" "$hosts/mumps_schur.f90" -ldmumps_seq
    compare "mumps_schur_$kind"
done
