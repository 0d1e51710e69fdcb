# How programs run on several processes: `options` for $mpirun, and the environment.

# Open MPI starts no more processes than there are cores, and none for root, unless it is told to.
# Processes that wait shall leave the core to the others. Ten minutes are an error.
options=
if "$mpirun" --version 2>/dev/null | grep -q 'Open MPI'; then
    options=--oversubscribe
    [ "$(id -u)" != 0 ] || options="$options --allow-run-as-root"
fi
OMPI_MCA_mpi_yield_when_idle=1
MPIEXEC_TIMEOUT=600
# One thread of the BLAS and of MUMPS for each process.
OMP_NUM_THREADS=1
OPENBLAS_NUM_THREADS=1
export OMPI_MCA_mpi_yield_when_idle MPIEXEC_TIMEOUT OMP_NUM_THREADS OPENBLAS_NUM_THREADS
