# Each job reads this file on its node, in the folder of the repository, before it begins.
# Add what your nodes need (module load ...).

# A folder for each node: what numba compiles apart from the kernel is not safe between nodes that
# share a file system (numba issue 7952). The first job of a node compiles for about a minute.
NUMBA_CACHE_DIR="$PWD/.snakemake/numba/$(uname -n)"
export NUMBA_CACHE_DIR
