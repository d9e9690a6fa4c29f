"""What the paper and its studies pass to their jobs of structures and other named entries."""


def settings(section, part=PAPER):
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
    """Make the jobs whose scripts use the kernel wait until it is compiled.

    A function among the inputs of a rule names files only when its wildcards are known.
    """
    for each in workflow.rules:
        if each.name == "kernel" or everything in each.input:
            continue
        if any(map(callable, each.input)):
            each.set_input(partial(_compiled, list(each.input)))
        else:
            each.set_input(*_compiled(each.input, None))


def _compiled(inputs, wildcards):
    """Return what a job with these inputs has to wait for: the compiled kernel, or nothing."""
    found = (each(wildcards) if callable(each) else [each] for each in inputs)
    uses_it = any("src/topheavy/kernel/compiled.py" in each for each in found)
    return ["results/kernel.compiled"] if uses_it else []
