# Grids of simulations, and datasets derived from them. What claims all cores comes before what claims
# one, which then runs side by side, not alone between the others.


rule compile:
    output:
        PLAN.kernels_of("{group}"),
    log:
        "logs/compile-{group}.log",
    priority: of(PLAN.compile_priority)
    message:
        "compile kernels, once: {wildcards.group}"
    shell:
        "python -m riserstudy.jobs compile_kernels {wildcards.group} > {log:q} 2>&1"


rule compiled:
    input:
        PLAN.all_kernels,
    output:
        PLAN.compiled,
    log:
        "logs/compiled.log",
    priority: KERNELS
    message:
        "note that all kernels are compiled"
    shell:
        "python -m riserstudy.jobs compile_kernels > {log:q} 2>&1"


rule tune:
    input:
        of_any_age(PLAN.kernels),
    output:
        "results/{paper}/{study}.settings.json",
    log:
        "logs/{paper}/{study}.settings.log",
    wildcard_constraints:
        study=PLAN.pattern("studies"),
    priority: of(PLAN.study_priority)
    params:
        digest=of(PLAN.settings_digest),
        tier=PLAN.tier,
    message:
        "tune {wildcards.paper}/{wildcards.study}"
    shell:
        "python -m riserstudy.jobs tune {wildcards.paper} {wildcards.study} {output:q}"
        " --tier {params.tier} --expect {params.digest} > {log:q} 2>&1"


rule shard:
    input:
        of_any_age(PLAN.kernels),
        of(PLAN.settings_files),
    output:
        "results/{paper}/{study}.shards/{shard}-of-{shards}",
    log:
        "logs/{paper}/{study}.{shard}-of-{shards}.log",
    wildcard_constraints:
        study=PLAN.pattern("studies"),
        shard=r"\d+",
        shards=r"\d+",
    priority: of(PLAN.study_priority)
    threads: half(PLAN.shard_threads)
    params:
        digest=of(PLAN.shard_digest),
        tier=PLAN.tier,
        settings=of(PLAN.settings_option),
    message:
        "simulate {wildcards.paper}/{wildcards.study}, part {wildcards.shard} of {wildcards.shards}"
    shell:
        "python -m riserstudy.jobs shard {wildcards.paper} {wildcards.study} {wildcards.shard}"
        " {wildcards.shards} {output:q} --tier {params.tier} --threads {threads}"
        " --expect {params.digest} {params.settings} > {log:q} 2>&1"


rule simulate:
    input:
        of(PLAN.shard_files),
        of_any_age(PLAN.kernels),
        of(PLAN.settings_files),
    output:
        "results/{paper}/{study}.nc",
    log:
        "logs/{paper}/{study}.log",
    wildcard_constraints:
        study=PLAN.pattern("studies"),
    priority: of(PLAN.study_priority)
    threads: half(PLAN.threads)
    params:
        digest=of(PLAN.study_digest),
        tier=PLAN.tier,
        settings=of(PLAN.settings_option),
    message:
        "simulate {wildcards.paper}/{wildcards.study}"
    shell:
        "python -m riserstudy.jobs simulate {wildcards.paper} {wildcards.study} {output:q}"
        " --tier {params.tier} --threads {threads} --expect {params.digest} {params.settings}"
        " > {log:q} 2>&1"


rule sea_states:
    input:
        of_any_age(PLAN.kernels_of_seas),
        record=of_any_age(PLAN.records_of_seas),
    output:
        "results/{paper}/{study}.seas/{part}-of-{parts}",
    log:
        "logs/{paper}/{study}.{part}-of-{parts}.log",
    wildcard_constraints:
        study=PLAN.pattern("seas"),
        part=r"\d+",
        parts=r"\d+",
    priority: of(PLAN.seas_priority)
    threads: half(PLAN.seas_threads)
    params:
        digest=of(PLAN.seas_digest),
        tier=PLAN.tier,
    message:
        "simulate {wildcards.paper}/{wildcards.study}, part {wildcards.part} of {wildcards.parts}"
    shell:
        "python -m riserstudy.jobs sea_states {wildcards.paper} {wildcards.study} {wildcards.part}"
        " {output:q} --tier {params.tier} --threads {threads} --expect {params.digest} > {log:q} 2>&1"


rule hours:
    input:
        of(PLAN.parts_of_seas),
        of_any_age(PLAN.kernels_of_seas),
        record=of_any_age(PLAN.records_of_seas),
    output:
        "results/{paper}/{study}.nc",
    log:
        "logs/{paper}/{study}.log",
    wildcard_constraints:
        study=PLAN.pattern("seas"),
    priority: of(PLAN.seas_priority)
    params:
        digest=of(PLAN.seas_digest),
        tier=PLAN.tier,
    message:
        "count the hours of {wildcards.paper}/{wildcards.study}"
    shell:
        "python -m riserstudy.jobs hours {wildcards.paper} {wildcards.study} {output:q}"
        " --tier {params.tier} --threads {threads} --expect {params.digest} > {log:q} 2>&1"


rule derive:
    input:
        data=of(PLAN.derived_inputs),
        code=code(PLAN.derived_code),
    output:
        "results/{paper}/{study}.nc",
    log:
        "logs/{paper}/{study}.log",
    wildcard_constraints:
        study=PLAN.pattern("derived"),
    params:
        digest=of(PLAN.derived_digest),
        settings=of(PLAN.derived_settings),
    message:
        "derive {wildcards.paper}/{wildcards.study}"
    shell:
        "python -m riserstudy.jobs derive {wildcards.paper} {wildcards.study} {output:q} {input.data:q}"
        " --settings {params.settings:q} --expect {params.digest} > {log:q} 2>&1"
