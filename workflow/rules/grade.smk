# What papers printed beside what was simulated.


rule grade:
    input:
        PLAN.grade_inputs,
    output:
        table="results/{paper}/reproduction.csv",
        errata="results/{paper}/errata.csv",
    log:
        "logs/{paper}/grade.log",
    params:
        digest=PLAN.grade_digest,
    message:
        "grade {wildcards.paper}"
    shell:
        "python workflow/scripts/grade.py {wildcards.paper} {output.table:q} {output.errata:q}"
        " {input:q} > {log:q} 2>&1"


rule reproduction:
    input:
        tables=PLAN.graded_files(),
        errata=PLAN.graded_files(kind="errata"),
    output:
        table="results/reproduction.csv",
        errata="results/errata.csv",
    log:
        "logs/reproduction.log",
    message:
        "join the graded tables"
    shell:
        "python workflow/scripts/join_tables.py {output.table:q} {input.tables:q} > {log:q} 2>&1"
        " && python workflow/scripts/join_tables.py {output.errata:q} {input.errata:q} >> {log:q} 2>&1"
