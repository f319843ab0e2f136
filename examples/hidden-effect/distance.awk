# SPDX-License-Identifier: BSD-3-Clause
# How far predicted poses (second table) are from the true ones (first table), in position.
#   awk -F, -f distance.awk TRUTH.csv PREDICTED.csv
FNR == 1 { next }  # the header
NR == FNR { x[$1] = $2; y[$1] = $3; z[$1] = $4; next }
$1 in x { n++; sum += ($2 - x[$1])^2 + ($3 - y[$1])^2 + ($4 - z[$1])^2 }
END { printf "%d poses, RMS %.4f mm\n", n, 1e3 * sqrt(sum / n) }
