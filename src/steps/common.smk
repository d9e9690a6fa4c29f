"""What the rules of the paper and of the studies share."""


def case(section):
    """Return a section of the config, with the column in place of its name."""
    entry = config[section]
    return entry | {"column": config["structures"][entry["structure"]]}


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
