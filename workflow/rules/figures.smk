# Figures from datasets, and a target for each figure and each paper.


rule figure:
    input:
        PLAN.figure_inputs,
    output:
        png="results/{paper}/{figure}.png",
        pdf="results/{paper}/{figure}.pdf",
    params:
        digest=PLAN.figure_digest,
    log:
        "logs/{paper}/{figure}.log",
    message:
        "draw {wildcards.paper}/{wildcards.figure}"
    wildcard_constraints:
        figure=PLAN.figure_pattern,
    shell:
        "python workflow/scripts/draw.py {wildcards.paper} {wildcards.figure}"
        " {output.png:q} {output.pdf:q} {input:q} > {log:q} 2>&1"


for paper, name in PLAN.figures():

    rule:
        name:
            f"{paper}_{name}"
        localrule: True
        input:
            f"results/{paper}/{name}.png",


for paper in PLAN.papers:

    rule:
        name:
            paper
        localrule: True
        input:
            PLAN.figure_files(paper),


rule figures:
    localrule: True
    input:
        FIGURES,
