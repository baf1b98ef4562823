# The page that tells how everything came out.


rule report:
    input:
        studies=PLAN.study_files,
        compiled=PLAN.compiled,
        datasets=DATASETS,
        figures=[file for file in FIGURES if file.endswith(".png")],
        tables=PLAN.joined_tables(),
    output:
        "results/report.html",
    log:
        "logs/report.log",
    params:
        digest=PLAN.report_digest,
        papers=PLAN.papers,
    message:
        "make the report"
    shell:
        "python -m riserstudy.jobs report {output:q} --papers {params.papers} --compiled {input.compiled:q}"
        " --files {input.datasets:q} {input.figures:q} {input.tables:q} > {log:q} 2>&1"
