#!/usr/bin/env bash
# Processes a small data set on a Slurm cluster of one node, which is set up in a temporary folder and removed
# afterward:
#   sudo bash run_test.sh PROGRAM MESH...       (PROGRAM: bspline_shell)
# Requires root, and the Debian packages slurmctld, slurmd, slurm-client, munge and snakemake. If a requirement is
# missing, or Slurm is already running, the exit code is 77.
set -euo pipefail
skip() { echo "Skipped: $1" >&2; exit 77; }
here=$(cd "$(dirname "$0")" && pwd)
[ $# -ge 2 ] || { echo "Usage: bash run_test.sh PROGRAM MESH..." >&2; exit 2; }
program=$(realpath -- "$1")
shift
PATH=$PATH:/usr/sbin
for command in slurmctld slurmd sbatch munged snakemake; do
  command -v "$command" >/dev/null || skip "$command is not installed."
done
[ "$(id -u)" -eq 0 ] || skip "starting Slurm's daemons requires root permissions."
! pgrep -x 'slurmctld|slurmd' >/dev/null || skip "Slurm is already running on this machine."

work=$(mktemp -d)
chmod 755 "$work"
daemons=()
stop() {
  [ ${#daemons[@]} -eq 0 ] || { kill "${daemons[@]}" 2>/dev/null; wait "${daemons[@]}" 2>/dev/null; } || true
  rm -rf "$work"
}
trap stop EXIT

# The daemons authenticate each other through a separate munge daemon.
mkdir -m 755 "$work"/munge
dd if=/dev/urandom of="$work/munge/key" bs=128 count=1 status=none
chmod 400 "$work/munge/key"
munged --foreground --force --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" --seed-file="$work/munge/seed" \
       --log-file="$work/munge/log" >/dev/null 2>&1 &
daemons+=($!)

# free ports, so that daemons of other users are not disturbed
port() { python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])'; }
host=$(hostname -s)
mkdir "$work/state" "$work/spool"
export SLURM_CONF=$work/slurm.conf
cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(port)
SlurmdPort=$(port)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
MpiDefault=none
ReturnToService=2
SchedulerParameters=batch_sched_delay=0
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(($(awk '/MemTotal/ { print $2 }' /proc/meminfo) / 1024)) State=UNKNOWN
PartitionName=test Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
for attempt in $(seq 50); do
  [ -S "$work/munge/socket" ] && break
  sleep 0.1
done
slurmctld -D -f "$SLURM_CONF" -L "$work/slurmctld.log" >/dev/null 2>&1 &
daemons+=($!)
slurmd -D -f "$SLURM_CONF" -L "$work/slurmd.log" >/dev/null 2>&1 &
daemons+=($!)
for attempt in $(seq 100); do
  [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && break
  sleep 0.2
done
[ "$(sinfo -h -o %t 2>/dev/null)" = idle ] || { tail -n 20 "$work"/*.log "$work/munge/log"; echo "Slurm could not be started." >&2; exit 1; }

mkdir "$work/results"
printf '%s\n' "$@" >"$work/list"
start=$SECONDS
snakemake --snakefile "$here/../Snakefile" --profile "$here" --directory "$work/results" \
          --config meshes="$work/list" program="$program" batch=2 memory_limit=1500 time_limit=120 pictures="${PICTURES-false}" ||
  { tail -n 20 "$work"/*.log "$work"/results/.snakemake/slurm/*; exit 1; }
jobs=$(find "$work/results/.snakemake/slurm" -name '*.log' | wc -l)
[ "$jobs" -eq $((($# + 1) / 2)) ] || { echo "Slurm ran $jobs jobs for $# meshes in batches of two." >&2; exit 1; }
[ "$(wc -l <"$work/results/table.csv")" -eq $(($# + 1)) ] || { cat "$work/results/table.csv"; exit 1; }
echo "$# meshes, $jobs Slurm jobs, $((SECONDS - start)) s:"
cut -d, -f1-6 "$work/results/table.csv"
