#!/usr/bin/env bash
# Says how a job goes: running, success or failed. Needs no accounting: a job that Slurm has forgotten has ended.
[[ "$1" == did_not_fit.* ]] && echo success && exit
state=$(scontrol show job "$1" 2>/dev/null | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p')
case "$state" in
  PENDING|CONFIGURING|RUNNING|COMPLETING|SUSPENDED|REQUEUED) echo running ;;
  COMPLETED|'') echo success ;;
  *) echo failed ;;
esac
