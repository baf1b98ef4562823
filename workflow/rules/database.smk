# All results as tables that can be asked. One job writes it, after all others, and reads again what changed.


rule database:
    input:
        studies=PLAN.study_files,
        published=PLAN.published_files,
        datasets=DATASETS,
        figures=FIGURES,
        tables=PLAN.joined_tables(),
    output:
        update("results/results.sqlite"),
    log:
        "logs/database.log",
    params:
        digest=PLAN.database_digest,
        papers=PAPERS,
    message:
        "make the results database"
    shell:
        "python -m riserstudy.jobs database {output:q} {params.papers}"
        " {input.datasets:q} {input.figures:q} {input.tables:q} > {log:q} 2>&1"
