# The page that tells how everything came out.


rule report:
    input:
        studies=PLAN.study_files,
        compiled=PLAN.compiled,
        database="results/results.sqlite",
    output:
        "results/report.html",
    log:
        "logs/report.log",
    params:
        digest=PLAN.report_digest,
        papers=PLAN.papers,
        units=PLAN.units,
    message:
        "make the report"
    shell:
        "python -m riserstudy.jobs report {output:q} --papers {params.papers} --compiled {input.compiled:q}"
        " --database {input.database:q} --units {params.units} > {log:q} 2>&1"
