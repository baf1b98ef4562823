# Figures from datasets, schematics from scenes, and a target for each figure and each paper.


rule figure:
    input:
        data=of(PLAN.figure_inputs),
        code=code(PLAN.figure_code),
    output:
        png="results/{paper}/{figure}.png",
        pdf="results/{paper}/{figure}.pdf",
        csv="results/{paper}/{figure}.csv",
    log:
        "logs/{paper}/draw_{figure}.log",
    wildcard_constraints:
        figure=PLAN.figure_pattern,
    params:
        digest=of(PLAN.figure_digest),
        units=PLAN.units,
    message:
        "draw {wildcards.paper}/{wildcards.figure}"
    shell:
        "python -m riserstudy.jobs draw {wildcards.paper} {wildcards.figure}"
        " {output:q} {input.data:q} --units {params.units} --expect {params.digest} > {log:q} 2>&1"


for paper, name in PLAN.figures():

    rule:
        name:
            f"{paper}_{name}"
        input:
            multiext(f"results/{paper}/{name}", ".png", ".pdf", ".csv"),
        localrule: True


for paper in PLAN.papers:

    rule:
        name:
            paper
        input:
            PLAN.dataset_files(paper),
            PLAN.figure_files(paper),
            PLAN.graded_files(paper),
        localrule: True


rule figures:
    input:
        FIGURES,
    localrule: True
