#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# One task of a Slurm job array: the share that its number says. Give each task a thousand calibrations or more: starting
# one takes Slurm seconds. hexcal must be on the PATH; OUT is a folder that all nodes see.
#   job=$(sbatch --parsable --array=1-20 examples/batch/slurm_array.sh MANIFEST OUT)
#   sbatch --dependency=afterany:$job --wrap="hexcal batch MANIFEST --out=OUT --merge"
# Tasks that failed (a node died): the merge names what is missing; the same two lines do it, and nothing twice.
#SBATCH --job-name=hexcal
#SBATCH --cpus-per-task=1
set -euo pipefail
exec hexcal batch "$1" --out="$2" --quiet --threads="${SLURM_CPUS_PER_TASK:-1}" \
  --task="$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
