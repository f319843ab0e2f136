#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A batch on several processes, or machines, by mpirun (Debian: openmpi-bin). hexcal must be on the PATH; on several
# machines, OUT is a folder that all of them see.
#   examples/batch/mpirun.sh PROCESSES MANIFEST OUT [flags of mpirun: --hostfile=..., --oversubscribe]
# The last process to end puts the results together. What a killed process leaves undone, the same command does.
set -euo pipefail
processes=$1 manifest=$2 out=$3
shift 3
exec mpirun -np "$processes" "$@" hexcal batch "$manifest" --out="$out" --quiet
