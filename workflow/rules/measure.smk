# Datasets that chapters measure by their own code. No other job runs beside those that tell times.


rule measure:
    input:
        compiled=PLAN.compiled,
        code=code(PLAN.measured_code),
    output:
        "results/{paper}/{study}.nc",
    log:
        "logs/{paper}/{study}.log",
    wildcard_constraints:
        study=PLAN.pattern("measured"),
    priority: of(PLAN.measure_priority)
    threads: of(PLAN.measured_threads)
    params:
        digest=of(PLAN.measured_digest),
        tier=PLAN.tier,
        papers=PAPERS,
    message:
        "measure {wildcards.paper}/{wildcards.study}"
    shell:
        "python -m riserstudy.jobs --alone measure {wildcards.paper} {wildcards.study} {output:q}"
        " --tier {params.tier} {params.papers} --threads {threads}"
        " --expect {params.digest} > {log:q} 2>&1"
