# The page that tells how everything came out.


rule report:
    input:
        studies=PLAN.study_files,
        compiled=PLAN.compiled,
        database="results/results.sqlite",
        code=[
            ancient(file)
            for paper in PLAN.papers
            for file in chapter_files(paper, PLAN.report_code(paper))
        ],
    output:
        "results/report.html",
    log:
        "logs/report.log",
    params:
        digest=PLAN.report_digest,
        papers=PAPERS,
        units=PLAN.units,
    message:
        "make the report"
    shell:
        "python -m riserstudy.jobs report {output:q} {input.database:q} {input.compiled:q}"
        " {params.papers} --units {params.units} --expect {params.digest} > {log:q} 2>&1"
