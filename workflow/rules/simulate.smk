# Grids of simulations, and datasets derived from them.


rule compile:
    output:
        touch(PLAN.compiled),
    log:
        "logs/compile.log",
    message:
        "compile the kernels"
    shell:
        "python workflow/scripts/compile_kernels.py > {log:q} 2>&1"


rule simulate:
    input:
        PLAN.compiled,
    output:
        "results/{paper}/{study}.nc",
    params:
        digest=PLAN.study_digest,
        tier=PLAN.tier,
    threads: PLAN.threads
    log:
        "logs/{paper}/{study}.log",
    message:
        "simulate {wildcards.paper}/{wildcards.study}"
    wildcard_constraints:
        study=PLAN.study_pattern,
    shell:
        "python workflow/scripts/simulate.py {wildcards.paper} {wildcards.study} {output:q}"
        " --tier {params.tier} --threads {threads} --expect {params.digest} > {log:q} 2>&1"


rule derive:
    input:
        PLAN.derived_inputs,
    output:
        "results/{paper}/{study}.nc",
    params:
        digest=PLAN.derived_digest,
    log:
        "logs/{paper}/{study}.log",
    message:
        "derive {wildcards.paper}/{wildcards.study}"
    wildcard_constraints:
        study=PLAN.derived_pattern,
    shell:
        "python workflow/scripts/derive.py {wildcards.paper} {wildcards.study} {output:q} {input:q}"
        " > {log:q} 2>&1"
