"""What every replication does with its results: figures, notebooks, verdicts, report, provenance."""

FIGURES = {
    figure: tables for part in PARTS.values() for figure, tables in part.figures.items()
}
FINDINGS = list(findings_made(workflow.rules))
LEDGER = [part.claims for part in PARTS.values()]
SECTIONS = [path for part in PARTS.values() for path in part.sections]
NOTEBOOKS = sorted(path.stem for path in Path("notebooks").glob("*.ipynb"))
DOCUMENTS = [
    name for name in ("report", "supplement") if Path(f"paper/{name}.typ").is_file()
]
SNAKEFILES = [
    os.path.relpath(each.get_path_or_uri(secret_free=True))
    for each in workflow.included
]
ORIGINS = Origins(workflow.rules)
PUBLISHED = {
    made: path for made, path in published_results().items() if ORIGINS.of(made)
}

check_ledger(LEDGER, FINDINGS)
CLAIMS = read_ledger(LEDGER)
CAPTIONS = read_captions(part.captions for part in PARTS.values())


# Figures and notebooks ---------------------------------------------------------------------------


rule figure:
    input:
        tables=lambda wildcards: expand(
            "results/tables/{table}.csv", table=FIGURES[wildcards.figure]
        ),
        style="figures/style.mplstyle",
    output:
        shown("{figure}.svg"),
    log:
        "results/logs/{figure}.log",
    wildcard_constraints:
        figure="|".join(FIGURES),
    params:
        title=lambda wildcards: CAPTIONS[f"{wildcards.figure}.svg"]["title"],
        alt=lambda wildcards: alternative(CAPTIONS[f"{wildcards.figure}.svg"]),
    message:
        "Figure {wildcards.figure}"
    script:
        "../../{wildcards.figure}.py"


rule notebook:
    input:
        lambda wildcards: code(f"notebooks/{wildcards.name}.ipynb"),
        lambda wildcards: results_read(f"notebooks/{wildcards.name}.ipynb"),
        notebook="notebooks/{name}.ipynb",
        data=PARTS[PAPER].data,
    output:
        executed="results/notebooks/{name}.ipynb",
        page="results/notebooks/{name}.html",
    benchmark:
        "results/benchmarks/notebook_{name}.tsv"
    message:
        "Executing the notebook {wildcards.name}"
    script:
        "rules/notebook.py"


# The ledger judged, and the end of the run -------------------------------------------------------


rule claims:
    input:
        ledger=LEDGER,
        findings=expand("results/findings/{name}.json", name=FINDINGS),
    output:
        "results/claims.json",
    script:
        "rules/every_claim.py"


rule compare:
    input:
        results=list(PUBLISHED),
        published=list(PUBLISHED.values()),
        origins=sorted(Path("tests/reference").glob("origins.json")),
    output:
        table="results/comparison.csv",
        config="results/config.yaml",
        origins="results/origins.json",
    params:
        config=config,
        results=PUBLISHED,
        origins={made: ORIGINS.of(made) for made in PUBLISHED},
    script:
        "rules/compare.py"


rule verdict:
    input:
        claims="results/claims.json",
        comparison="results/comparison.csv",
        findings=expand("results/findings/{rule}.json", rule=CHECKS),
    output:
        "results/summary.txt",
    params:
        checks=CHECKS,
    script:
        "rules/verdict.py"


rule costs:
    input:
        expand("results/findings/{name}.json", name=FINDINGS),
        expand(
            "results/notebooks/{name}.{kind}", name=NOTEBOOKS, kind=["ipynb", "html"]
        ),
    output:
        "results/costs.csv",
    script:
        "rules/costs.py"


for document in DOCUMENTS:

    rule:
        name:
            document
        input:
            reads(f"paper/{document}.typ", *SECTIONS),
            expand("results/findings/{name}.json", name=FINDINGS),
            expand("{figure}.svg", figure=FIGURES),
            captions=[part.captions for part in PARTS.values()],
            source=f"paper/{document}.typ",
        output:
            f"paper/{document}.pdf",
        benchmark:
            f"results/benchmarks/{document}.tsv"
        params:
            studies=config["studies"],
        message:
            f"Compiling the {document}"
        script:
            "rules/report.py"


# The audit: what was made and by what, each claim alone -------------------------------------------


rule crate:
    input:
        code(*SNAKEFILES),
        everything,
        configuration="config/config.yaml",
        lock="uv.lock",
        machine="src/replication/VERSION",
        project="pyproject.toml",
        citation="CITATION.cff",
        claims="results/claims.json",
    output:
        CRATE,
    params:
        configs={name: part.config for name, part in PARTS.items()},
        # what a run measures, and what make html and make benchmark write
        differs_each_run=[
            *rules.costs.output,
            "results/report.html",
            "results/benchmark",
        ],
    script:
        "rules/crate.py"


# `snakemake --cores 2 claim_<id>` computes what the claim needs, and prints its verdict.
for claim in CLAIMS:

    rule:
        name:
            f"claim_{claim.id}"
        input:
            findings=([f"results/findings/{claim.rule}.json"] if claim.rule else []),
        params:
            claim=claim,
        message:
            f"Judging {claim.id}"
        script:
            "rules/one_claim.py"


complete(workflow, timed=False)
refuse_unmade(
    workflow.rules,
    {table for tables in FIGURES.values() for table in tables},
    Path("tests/reference"),
)
check_captions(
    CAPTIONS,
    [f"{figure}.svg" for figure in FIGURES],
    [claim.id for claim in CLAIMS],
    made_by(workflow.rules),
)
refuse_unshown(
    FIGURES, reads(*(f"paper/{document}.typ" for document in DOCUMENTS), *SECTIONS)
)
longest_first()
only_shards_leave_this_machine()
