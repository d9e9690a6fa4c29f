"""What the rules of the paper and of the studies share."""


def case(section):
    """Return a section of the config, with the column in place of its name."""
    entry = config[section]
    return entry | {"column": config["structures"][entry["structure"]]}


def named(entries, section):
    """Return those of the entries (structures, say) that a section of a config names.

    So a rule depends on them, and on no others.
    """
    if isinstance(section, dict):
        parts = [*section, *section.values()]
    elif isinstance(section, (list, tuple)):
        parts = section
    else:
        return {section: entries[section]} if section in entries else {}
    found = {name for part in parts for name in named(entries, part)}
    return {name: entries[name] for name in entries if name in found}


def everything(wildcards):
    """Return all that a run makes, but for the list of it, which is made last.

    What only another job needs is named as well: when it is missing, Snakemake makes it again only
    if somebody asks for it. A failed or interrupted job leaves its outputs missing.
    """
    drawn = {table for tables in FIGURES.values() for table in tables}
    wanted = dict.fromkeys(f"results/tables/{table}.csv" for table in sorted(drawn))
    for rule in workflow.rules:
        if rule.name in ("all", "manifest") or rule.name.startswith("claim_"):
            continue
        asked = [*rule.input, *([] if rule.has_wildcards() else rule.output)]
        wanted |= dict.fromkeys(str(path) for path in asked if not callable(path))
    return [path for path in wanted if "{" not in path]


def study_case(study, section):
    """The same of the config of a study."""
    entry = STUDY_CONFIG[study][section]
    if "structure" not in entry:
        return entry
    return entry | {"column": config["structures"][entry["structure"]]}


def caption_of(result):
    """Return what the HTML report says of a result: its caption and verdict (figures/caption.rst)."""
    claims = json.loads(Path("results/claims.json").read_text(encoding="utf-8"))
    return captioned(str(result), read_captions(caption_files(config)), claims)


def shown(output):
    """Mark the last output of a rule for the HTML report; its caption is looked up when that is made.

    One label alone, since Snakemake's page turns a second one that has two values into a switch.
    """

    def label(wildcards, output):
        about = caption_of(output[-1])
        return {"result: claims": f"{about['title']}: {about['verdict']}"}

    return report(
        output,
        caption="figures/caption.rst",
        category=lambda wildcards, output: caption_of(output[-1])["category"],
        labels=label,
    )
