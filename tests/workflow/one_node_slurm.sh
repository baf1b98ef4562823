#!/bin/sh
# A Slurm of one node in a folder: `one_node_slurm.sh start|stop FOLDER`, as root, without systemd.
# Sets nothing outside the folder; the commands in FOLDER/bin know it. (SLURM_CONF alone is not enough:
# the executor takes Slurm's variables out of the environment of its jobs.)
# Debian: apt install slurmctld slurmd slurm-client munge
set -eu
PATH=$PATH:/usr/sbin:/sbin # of the daemons, which a shell of `su` without `-` lacks
folder=$(realpath "$2")

write_configuration() {
    host=$(hostname -s)
    memory=$(awk '/^MemTotal/ {print int($2 / 1200)}' /proc/meminfo) # MB, with some to spare
    cat > "$folder/slurm.conf" << END
ClusterName=one_node
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
# Jobs start at once, and squeue knows how they ended for as long as a test may take.
SchedulerParameters=batch_sched_delay=0,sched_interval=2
MinJobAge=7200
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$memory State=UNKNOWN
PartitionName=one_node Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
}

write_commands() {
    for name in sbatch scancel scontrol sinfo squeue srun; do
        printf '#!/bin/sh\nSLURM_CONF="%s" exec %s "$@"\n' "$folder/slurm.conf" "$(command -v $name)" > "$folder/bin/$name"
        chmod 755 "$folder/bin/$name"
    done
}

start() {
    mkdir -p "$folder/state" "$folder/spool" "$folder/bin"
    chmod 755 "$folder"
    head -c 1024 /dev/urandom > "$folder/munge.key"
    chmod 400 "$folder/munge.key"
    munged --force --socket "$folder/munge.socket" --key-file "$folder/munge.key" \
        --pid-file "$folder/munged.pid" --log-file "$folder/munged.log" --seed-file "$folder/munge.seed"
    write_configuration
    write_commands
    slurmctld -f "$folder/slurm.conf"
    slurmd -f "$folder/slurm.conf"
    for _ in $(seq 60); do
        if "$folder/bin/sinfo" -h -o %T 2> /dev/null | grep -q idle; then
            return
        fi
        sleep 1
    done
    echo "the node did not come up; see $folder/*.log" >&2
    exit 1
}

stop() {
    for daemon in slurmd slurmctld munged; do
        if [ -s "$folder/$daemon.pid" ]; then
            kill "$(cat "$folder/$daemon.pid")" || true
        fi
    done
}

"$1"
