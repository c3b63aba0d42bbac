#!/bin/sh
# Prints the state of Slurm job $1 for Snakemake: success, failed or running. Jobs that are killed, by the memory limit
# for example, do not report it themselves. Clusters without accounting (sacct) keep finished jobs for minutes.
state=$(sacct -X -n -P -j "$1" -o State 2>/dev/null | head -n 1)
[ -n "$state" ] || state=$(scontrol -o show job "$1" 2>/dev/null | sed 's/.*JobState=\([A-Z_]*\).*/\1/')
case $state in
  COMPLETED) echo success ;;
  '' | PENDING | RUNNING | CONFIGURING | COMPLETING | SUSPENDED | REQUEUED | RESIZING) echo running ;;
  *) echo failed ;;
esac
