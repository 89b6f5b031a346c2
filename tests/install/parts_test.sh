#!/usr/bin/env bash
# parts_test.sh PROGRAM PARTS SCRATCH: the script PARTS/dask_parts.py finds in parts what mobbscope conflicts finds.
set -euo pipefail
program=$1 parts=$2 scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch/bin"
ln -s "$program" "$scratch/bin/mobbscope"
cd "$scratch"
printf 'id,t,x,y\n1,0,0,0\n1,1,1,0\n1,2,2,0\n2,0,2,0\n2,1,1,0.1\n2,2,0,0\n3,1,1,9\n3,2,1,9\n4,1,1.3,9\n4,2,1.3,9\n' >tracks.csv
PATH=$scratch/bin:$PATH PYTHONPATH=$parts python3 -B "$parts/dask_parts.py" >merged
"$program" conflicts tracks.csv >whole
cmp merged whole
grep -q '^2 conflicts among 4 agents' whole
