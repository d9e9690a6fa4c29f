"""What the paper and its studies pass to their jobs of structures and other named entries."""


def case(section, part=PAPER):
    """Return a section of the config of a part, with the column in place of the structure's name."""
    entry = PARTS[part].config[section]
    if "structure" not in entry:
        return entry
    return entry | {"column": config["structures"][entry["structure"]]}


def named(entries, section):
    """Return those of the entries (structures, say) that a section of a config names.

    So a rule depends on them, and on no others.
    """
    if isinstance(section, dict):
        inner = [*section, *section.values()]
    elif isinstance(section, (list, tuple)):
        inner = section
    else:
        return {section: entries[section]} if section in entries else {}
    found = {name for part in inner for name in named(entries, part)}
    return {name: entries[name] for name in entries if name in found}


def after_the_kernel():
    """Make the rules whose scripts use the kernel wait until it is compiled."""
    for each in workflow.rules:
        if "src/topheavy/kernel/compiled.py" in each.input and each.name != "kernel":
            each.set_input("results/kernel.compiled")
