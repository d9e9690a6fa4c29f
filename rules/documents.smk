"""What follows from all results: figures, notebooks, verdicts, comparison, article and supplement."""

CLAIMS = {"paper/claims.yaml": PAPER} | {
    f"studies/{study}/claims.yaml": SETTINGS[study] for study in PAPER["studies"]
}
for path, known in CLAIMS.items():
    read_claims(path, known)  # before any job: a misspelt key, a number that is no key
BEYOND = [
    "motions",
    "break_even",
    "friction",
    "engine",
]  # figures; the others are the paper's
SCRIPTS = [
    path for path in sorted(glob("figures/*.py")) if "\ndef draw(" in open(path).read()
]
SHARED = [path for path in glob("figures/*.py") if path not in SCRIPTS]
NOTEBOOKS = [os.path.basename(path)[:-6] for path in sorted(glob("notebooks/*.ipynb"))]
# The scripts, tables and parameters of all rules: by these `make check` draws findings again.
RULES = {
    each.name: {
        "script": os.path.relpath(
            os.path.join(os.path.dirname(each.snakefile), each.script)
        ),
        "params": {
            name: given for name, given in each.params.items() if name != "code"
        },
        "tables": [
            str(path)
            for path in each.output
            if str(path).endswith(".csv") and "{" not in str(path)
        ],
        "reads": [
            str(path) for path in each.input if str(path).startswith("results/tables/")
        ],
        "findings": "findings" in each.output.keys(),
        "part": os.path.basename(each.snakefile).removesuffix(".smk"),
    }
    for each in workflow.rules
    if each.script
    and any(str(path).startswith("results/tables/") for path in each.output)
}


for part in ["paper", "beyond"]:
    scripts = [path for path in SCRIPTS if (path[8:-3] in BEYOND) == (part == "beyond")]
    words = {word for path in scripts for word in re.findall(r"\w+", open(path).read())}

    rule:
        name:
            f"{part}_figures"
        input:
            [path for path in made(".csv") if os.path.basename(path)[:-4] in words],
            scripts=scripts,
            captions="figures/captions.yaml",
            style="figures/style.mplstyle",
        output:
            [path.replace(".py", ".svg") for path in scripts],
        log:
            f"results/logs/{part}_figures.log",
        benchmark:
            f"results/benchmarks/{part}_figures.tsv"
        params:
            code=code("src/steps/draw.py", *SHARED) | DOCUMENTS | CORE,
            config={name: PAPER[name] for name in BEYOND if part == "beyond"},
        message:
            f"Drawing the figures ({part})"
        script:
            "../src/steps/draw.py"


rule notebook:
    input:
        lambda wildcards: re.findall(
            r"results/tables/\w+\.csv",
            open(f"notebooks/{wildcards.name}.ipynb").read(),
        ),
        kernel="results/kernel.compiled",
        notebook="notebooks/{name}.ipynb",
    output:
        executed="results/notebooks/{name}.ipynb",
        page="results/notebooks/{name}.html",
    log:
        "results/logs/notebook_{name}.log",
    benchmark:
        "results/benchmarks/notebook_{name}.tsv"
    params:
        code=code("src/steps/notebook.py", *SMALL, "src/topheavy/plot.py")
        | STEP
        | library("bodies", "derivation", "ground", "kernel", "outcomes", "risk"),
        records=checksums(*HORIZONTAL, *UPWARD),
    script:
        "../src/steps/notebook.py"


rule claims:
    input:
        made(".json"),
        ledgers=list(CLAIMS),
    output:
        "results/claims.json",
    log:
        "results/logs/claims.log",
    benchmark:
        "results/benchmarks/claims.tsv"
    params:
        code=code("src/steps/judge.py") | DOCUMENTS,
        settings=CLAIMS,
    message:
        "Judging every claim"
    script:
        "../src/steps/judge.py"


rule comparison:
    input:
        [path for rule in RULES.values() for path in rule["tables"]],
        published=glob("tests/reference/*"),
    output:
        table="results/comparison.csv",
        rules="results/rules.json",
        settings="results/settings.json",
    log:
        "results/logs/comparison.log",
    benchmark:
        "results/benchmarks/comparison.tsv"
    params:
        code=code("src/steps/compare.py") | STEP,
        rules=RULES,
        settings=CLAIMS,
        bounds=PAPER["reproducibility"],
    message:
        "Comparing tables with the published ones"
    script:
        "../src/steps/compare.py"


rule verdicts:
    input:
        claims="results/claims.json",
        captions="figures/captions.yaml",
    output:
        "results/verdicts.md",
    log:
        "results/logs/verdicts.log",
    benchmark:
        "results/benchmarks/verdicts.tsv"
    params:
        code=code("src/steps/verdicts.py") | DOCUMENTS,
        rules={
            name: {"script": rule["script"], "tables": rule["tables"]}
            for name, rule in RULES.items()
        },
    script:
        "../src/steps/verdicts.py"


for document in ["report", "supplement"]:

    rule:
        name:
            document
        input:
            made(".svg"),
            made(".csv"),
            made(".json"),
            sources=glob("paper/*.typ") + ["paper/references.bib", "CITATION.cff"],
            sections=[f"studies/{study}/section.typ" for study in PAPER["studies"]],
            captions="figures/captions.yaml",
            source=f"paper/{document}.typ",
        output:
            f"paper/{document}.pdf",
        log:
            f"results/logs/{document}.log",
        benchmark:
            f"results/benchmarks/{document}.tsv"
        params:
            code=code("src/steps/typeset.py") | DOCUMENTS,
            studies=PAPER["studies"],
            config=PAPER,
        message:
            f"Compiling the {document}"
        script:
            "../src/steps/typeset.py"


# The last: the documents are there when a verdict is not the expected one.
rule expected:
    input:
        "paper/report.pdf",
        "paper/supplement.pdf",
        claims="results/claims.json",
        comparison="results/comparison.csv",
    output:
        "results/summary.txt",
    log:
        "results/logs/expected.log",
    benchmark:
        "results/benchmarks/expected.tsv"
    params:
        code=code("src/steps/expect.py") | DOCUMENTS,
    script:
        "../src/steps/expect.py"


# On a cluster, only the shards are worth a job.
workflow.localrules(*(each.name for each in workflow.rules if "shard" not in each.name))
