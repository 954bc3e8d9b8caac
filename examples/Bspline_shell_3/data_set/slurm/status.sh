#!/usr/bin/env bash
# Prints the state of a Slurm job for snakemake: running, success or failed. Does not require accounting.
for attempt in 1 2 3; do
  state=$(scontrol -o show job "$1" 2>/dev/null | grep -o 'JobState=[A-Z_]*') && break
  state=$(sacct -X -n -P -j "$1" -o State 2>/dev/null | head -n 1) && [ -n "$state" ] && break
  sleep 2     # the controller may be busy
done
case ${state#JobState=} in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | STOPPED | REQUEUED | REQUEUE_HOLD | RESIZING | SIGNALING | STAGE_OUT) echo running ;;
  *) echo failed ;;
esac
