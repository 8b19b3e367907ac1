#!/usr/bin/env bash
# A Slurm cluster of one node for the test of the Slurm engine: slurm_cluster.sh DIR CONTROLLER_PORT NODE_PORT.
# Everything of it lies in DIR (its munged has a key and a socket of its own) and belongs to whoever starts it. It is up
# when DIR/ready is there. DIR/missing names a program that is not installed; DIR/problem says why the cluster does not come
# up though all are, which is a fault: neither root nor anything of the machine's own Slurm is needed, only a user with a
# name and a host with one. It ends, and its jobs with it, when standard input does.
set -euo pipefail

dir=$1 controller_port=$2 node_port=$3
PATH=$PATH:/usr/sbin:/sbin
export SLURM_CONF=$dir/slurm.conf
daemons=()

# tell FILE TEXT: FILE is there when all of it is.
tell() {
  echo "$2" >"$dir/$1.new"
  for log in "$dir"/*.out; do
    [[ ! -s $log ]] || tail -n 5 "$log" >>"$dir/$1.new"
  done
  mv "$dir/$1.new" "$dir/$1"
  exit 1
}

# needs PACKAGES PROGRAM...
needs() {
  local packages=$1 program
  shift
  for program in "$@"; do
    command -v "$program" >/dev/null || tell missing "$program is not installed (Debian: $packages)"
  done
}

# daemon NAME COMMAND...: dies with this script, however that ends.
daemon() {
  local name=$1
  shift
  setpriv --pdeathsig KILL "$@" >"$dir/$name.out" 2>&1 </dev/null &
  daemons+=($!)
}

# soon COMMAND...: within 40 seconds.
soon() {
  for _ in {1..400}; do
    if "$@" >/dev/null 2>&1; then return 0; fi
    sleep 0.1
  done
  return 1
}

queue_is_empty() { [[ -z $(squeue --noheader --format=%i) ]]; }
node_is_idle() { [[ $(sinfo --noheader --format=%T) == *idle* ]]; }

end() {
  set +e
  [[ -e $dir/ready || -e $dir/missing || -e $dir/problem ]] ||
    (tell problem "slurm_cluster.sh ended before the cluster was up; standard error says why")
  if ((${#daemons[@]} == 3)); then
    scancel --user="$(id -un)" >/dev/null 2>&1 && soon queue_is_empty
    # Whoever does not go by itself: each such process has this cluster's directory in its command line.
    pgrep -f "slurmstepd.*$dir/|^.*sluice.* --out $dir/" | xargs -r kill -KILL
  fi
  kill "${daemons[@]}" 2>/dev/null
  wait
}

trap end EXIT
needs "slurm-wlm and munge" munged slurmctld slurmd sbatch squeue scontrol sinfo scancel
needs "util-linux, procps and hostname" setpriv pgrep hostname

mkdir -p "$dir/state" "$dir/spool"
head -c 128 /dev/urandom >"$dir/munge.key"
chmod 400 "$dir/munge.key"
host=$(hostname -s)
user=$(id -un)
# cred_expire: a job that was put back waits for so long before it starts again; two minutes without it.
# config_overrides: the node has what stands here, whatever the machine has.
cat >"$SLURM_CONF" <<CONF
ClusterName=sluice
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
SlurmctldPort=$controller_port
SlurmdPort=$node_port
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$dir/munge.socket,cred_expire=5
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
SlurmdParameters=config_overrides
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
NodeName=one NodeHostname=$host NodeAddr=127.0.0.1 Port=$node_port CPUs=2 RealMemory=4000 State=UNKNOWN
PartitionName=other Nodes=one Default=YES MaxTime=INFINITE State=UP
PartitionName=hydro Nodes=one MaxTime=INFINITE State=UP
CONF

daemon munged munged --foreground --key-file="$dir/munge.key" --socket="$dir/munge.socket" \
  --pid-file="$dir/munged.pid" --log-file="$dir/munged.log" --seed-file="$dir/munged.seed" --num-threads=2
soon test -S "$dir/munge.socket" || tell problem "munged does not start"
daemon slurmctld slurmctld -D
daemon slurmd slurmd -D -N one
soon node_is_idle || tell problem "the node does not come up"
touch "$dir/ready"
cat >/dev/null
