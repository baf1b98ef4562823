# What papers printed beside what was simulated.


rule grade:
    input:
        data=of(PLAN.grade_inputs),
        code=code(PLAN.grade_code),
    output:
        table="results/{paper}/reproduction.csv",
        errata="results/{paper}/errata.csv",
        margins="results/{paper}/margins.csv",
        false="results/{paper}/false_claims.csv",
    log:
        "logs/{paper}/grade.log",
    params:
        digest=of(PLAN.grade_digest),
    message:
        "grade {wildcards.paper}"
    shell:
        "python -m riserstudy.jobs grade {wildcards.paper} {output.table:q} {output.errata:q}"
        " {output.margins:q} {output.false:q} {input.data:q} --expect {params.digest} > {log:q} 2>&1"


rule reproduction:
    input:
        tables=PLAN.graded_files(),
        errata=PLAN.graded_files(kind="errata"),
        margins=PLAN.graded_files(kind="margins"),
        false=PLAN.graded_files(kind="false_claims"),
    output:
        table="results/reproduction.csv",
        errata="results/errata.csv",
        margins="results/margins.csv",
        false="results/false_claims.csv",
    log:
        "logs/reproduction.log",
    message:
        "join the graded tables"
    shell:
        "python -m riserstudy.jobs join_tables {output.table:q} {input.tables:q} > {log:q} 2>&1"
        " && python -m riserstudy.jobs join_tables {output.errata:q} {input.errata:q} >> {log:q} 2>&1"
        " && python -m riserstudy.jobs join_tables {output.margins:q} {input.margins:q} >> {log:q} 2>&1"
        " && python -m riserstudy.jobs join_tables {output.false:q} {input.false:q} >> {log:q} 2>&1"
