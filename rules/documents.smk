"""What follows from all results: figures, notebooks, verdicts, comparison, article and supplement."""

CLAIMS = {"paper/claims.yaml": PAPER}
read_claims(
    "paper/claims.yaml", PAPER
)  # before any job: a misspelt key, a number that is no key
BEYOND = [
    "motions",
    "break_even",
    "friction",
    "engine",
]  # figures; the others are the paper's
FIGURES = [
    path for path in sorted(glob("figures/*.py")) if "\ndef draw(" in open(path).read()
]
# The scripts, tables and parameters of all rules: by these `make check` draws findings again.
RULES = {
    name: {
        "script": files[0],
        "params": parameters(name),
        "sources": sources(name),
        "tables": [path for path in outputs(name) if path.endswith(".csv")],
        "reads": [path for path in inputs(name) if path.startswith("results/tables/")],
        "findings": f"results/findings/{name}.json" in outputs(name),
    }
    for name, files in SCRIPTS.items()
    if any(path.startswith("results/tables/") for path in outputs(name))
}


for part in ["paper", "beyond"]:
    scripts = [path for path in FIGURES if (path[8:-3] in BEYOND) == (part == "beyond")]
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
            [shown(path.replace(".py", ".svg"), "Figures") for path in scripts],
        log:
            f"results/logs/{part}_figures.log",
        params:
            code=code("src/documents/draw.py", *scripts, rule=f"{part}_figures"),
            config={
                name: PAPER[name]
                for name in (
                    ["structures", *(each for each in BEYOND if each in PAPER)]
                    if part == "beyond"
                    else ["spectra", "allen"]
                )
            },
        message:
            f"Drawing the figures ({part})"
        script:
            "../src/documents/draw.py"


for path in sorted(glob("notebooks/*.ipynb")):
    name = Path(path).stem

    rule:
        name:
            f"notebook_{name}"
        input:
            sorted({*re.findall(r"results/tables/\w+\.csv", open(path).read())}),
            *HORIZONTAL,
            *UPWARD,
            kernel="results/kernel.compiled",
            notebook=path,
            style="figures/style.mplstyle",
            sheet="paper/site/site.css",
        output:
            executed=f"results/notebooks/{name}.ipynb",
            page=f"results/notebooks/{name}.html",
        log:
            f"results/logs/notebook_{name}.log",
        params:
            code=code("src/documents/notebook.py", path, rule=f"notebook_{name}"),
        message:
            f"Executing the notebook {name}"
        script:
            "../src/documents/notebook.py"


rule functions:
    input:
        records=[*HORIZONTAL, *UPWARD],
        kernel="results/kernel.compiled",
        style="figures/style.mplstyle",
        sheet="paper/site/site.css",
    output:
        page="results/functions.html",
    log:
        "results/logs/functions.log",
    params:
        code=code(
            "src/documents/functions.py",
            *sorted(glob("src/topheavy/**/*.py", recursive=True)),
            "src/topheavy/__init__.pyi",
        ),
    message:
        "Writing the page of the library's functions"
    script:
        "../src/documents/functions.py"


rule claims:
    input:
        made(".json"),
        ledgers=list(CLAIMS),
    output:
        "results/claims.json",
    log:
        "results/logs/claims.log",
    priority: 4
    params:
        code=code("src/documents/judge.py", rule="claims"),
        settings=CLAIMS,
    message:
        "Judging every claim"
    script:
        "../src/documents/judge.py"


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
    params:
        code=code("src/documents/compare.py", rule="comparison"),
        rules=RULES,
        settings=CLAIMS,
        bounds=PAPER["reproducibility"],
    message:
        "Comparing tables with the published ones"
    script:
        "../src/documents/compare.py"


for document in ["report", "supplement"]:

    rule:
        name:
            document
        input:
            made(".svg"),
            made(".csv"),
            made(".json"),
            sources=glob("paper/*.typ") + ["paper/references.bib", "CITATION.cff"],
            captions="figures/captions.yaml",
            source=f"paper/{document}.typ",
        output:
            f"paper/{document}.pdf",
        log:
            f"results/logs/{document}.log",
        params:
            code=code("src/documents/typeset.py", rule=document),
            config=PAPER,
        message:
            f"Compiling the {document}"
        script:
            "../src/documents/typeset.py"


# The pages of results/site, and the lists of docs/ from the same rows.
rule site:
    input:
        made(".svg"),
        made(".gif"),
        made(".csv"),
        made(".json"),
        sources=glob("paper/*.typ") + ["paper/references.bib", "CITATION.cff"],
        claims="results/claims.json",
        rules="results/rules.json",
        captions="figures/captions.yaml",
        head="paper/site/head.css",
        style="paper/site/site.css",
        font="paper/site/math.woff",
        pdfs=["paper/report.pdf", "paper/supplement.pdf"],
        finished=made(".html"),
        scripts=["config/config.yaml"]
        + sorted(
            path
            for path in imported(*sum(SCRIPTS.values(), ()))
            if path.endswith(".py")
        ),
    output:
        site=directory("results/site"),
        numbers="results/numbers.md",
        verdicts=shown("results/verdicts.md", "Verdicts"),
    log:
        "results/logs/site.log",
    params:
        code=code("src/documents/site.py"),
        config=PAPER,
    message:
        "Making the pages of results/site"
    script:
        "../src/documents/site.py"


# Documents do not wait for it: they are made, too, when a verdict is not the expected one.
rule expected:
    input:
        claims="results/claims.json",
        comparison="results/comparison.csv",
    output:
        report("results/summary.txt", caption="report.rst", category="Verdicts"),
    log:
        "results/logs/expected.log",
    params:
        code=code("src/documents/judge.py", rule="expected"),
    message:
        "Comparing verdicts with the expected ones"
    script:
        "../src/documents/judge.py"


# On a cluster, only the shards are worth a job.
localrules:
    all,
    allen,
    animation,
    beyond_figures,
    break_even,
    claims,
    colonnades,
    comparison,
    contacts,
    designers,
    engine,
    equations,
    expected,
    explorer,
    friction,
    functions,
    gaps,
    guarantee,
    kernel,
    motions,
    notebook_derivation,
    notebook_paper,
    notebook_play,
    paper_figures,
    parameters,
    proven,
    records,
    report,
    site,
    spectra,
    statements,
    supplement,
    test_plan,
    trilith,
    uplift,
    vase,
    verification,
    worst_found,
