#!/usr/bin/env bash
# Says how a job goes: running, success or failed. Needs no accounting: a job that Slurm has forgotten has ended. Where
# Slurm does not answer, it is asked again later.
[[ "$1" == did_not_fit.* ]] && echo success && exit
said=$(scontrol show job "$1" 2>&1)
state=$(sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p' <<< "$said")
[[ -z "$state" && "$said" == *"Invalid job id"* ]] && state=COMPLETED
case "$state" in
  PENDING|CONFIGURING|RUNNING|COMPLETING|SUSPENDED|REQUEUED|REQUEUE_HOLD|STAGE_OUT|SIGNALING|RESIZING|STOPPED|'')
    echo running ;;
  COMPLETED) echo success ;;
  *) echo failed ;;
esac
